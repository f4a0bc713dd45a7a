#pragma once
// What was recorded: joint encoders and accelerometer on one uniform clock.
//
// Files and simulation both end here, and nothing downstream can tell which it was. Within a span the samples are
// equally spaced by 1 / sample_rate; between spans there is a gap in time, and no filter, integral or test crosses it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct Recording {
  Eigen::VectorXd time;         ///< (N) s, strictly increasing
  SamplesX joint_positions;     ///< (N, n) rad or m, raw encoder values
  Samples3 specific_force;      ///< (N, 3) m/s^2, at rest +g upwards
  std::optional<Samples3> angular_velocity;    ///< (N, 3) rad/s, where a gyroscope was recorded
  std::optional<Eigen::VectorXd> temperature;  ///< (N) degrees Celsius
  double sample_rate = 0.0;                    ///< Hz
  std::vector<IndexRange> spans;               ///< contiguous pieces, in order

  [[nodiscard]] Index samples() const { return time.size(); }
  [[nodiscard]] Index joints() const { return joint_positions.cols(); }
};

}  // namespace circlepoint
