#pragma once
// The coarse alignment: when the joints move, the specific force changes. Their activities are correlated over all
// offsets and rates by a pyramid, coarse in time first.

#include <Eigen/Core>

#include "uniform_stream.hpp"

namespace circlepoint::detail {

/// A line in the streams' own relative times: sensor = shift + rate * joint.
struct RelativeClock {
  double shift = 0.0;
  double rate = 1.0;

  [[nodiscard]] double sensor(double joint) const { return shift + rate * joint; }
  [[nodiscard]] double joint(double sensor_time) const { return (sensor_time - shift) / rate; }
};

/// Activity on a uniform grid from time 0: square root of the speed, mean removed; zero in gaps.
struct Activity {
  double period = 0.0;
  Eigen::VectorXd values;
};

Activity joint_activity(const UniformStream& joints);
Activity sensor_activity(const UniformStream& sensor);

struct CoarseAlignment {
  RelativeClock clock;
  double correlation = 0.0;  // of the activities over their overlap, -1..1
};

CoarseAlignment correlate(const Activity& joints, const Activity& sensor, double max_rate_deviation);

/// Delay (s, joint time) of the sensor's activity behind `clock` in a window of joint time, within +- `range`; and the
/// correlation reached.
struct WindowDelay {
  double delay = 0.0;
  double correlation = 0.0;
  double width = 0.0;  // s, of the correlation's peak
};
WindowDelay window_delay(const Activity& joints, const Activity& sensor, const RelativeClock& clock, double begin,
    double end,
                         double range);

}  // namespace circlepoint::detail
