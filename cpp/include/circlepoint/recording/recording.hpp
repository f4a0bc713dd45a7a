#pragma once
// What was recorded: joint encoders and accelerometer on one uniform clock.
//
// Files and simulation both end here, and nothing downstream can tell which it was. Within a span the samples are
// equally spaced by 1 / sample_rate; between spans there is a gap in time, and no filter, integral or test crosses it.
// make_recording() gets raw logs there by the rules of timeline.hpp. Joints and sensor logged by two machines have two
// clocks, sensor_time = offset + rate * joint_time (clock_alignment.hpp estimates both): the sensor's samples are kept,
// the joints are interpolated at them, and time is the joint clock's.
//
// A table of still poses, each row the mean of one rest, is a recording too: every row is a span of its own, so nothing is
// said of the motion between, and time only counts the rows.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/recording/timeline.hpp"

namespace circlepoint {

struct Recording {
  Eigen::VectorXd time;         ///< (N) s, strictly increasing
  SamplesX joint_positions;     ///< (N, n) rad or m, raw encoder values
  Samples3 specific_force;      ///< (N, 3) m/s^2, at rest +g upwards
  std::optional<Samples3> angular_velocity;    ///< (N, 3) rad/s, where a gyroscope was recorded
  std::optional<Eigen::VectorXd> temperature;  ///< (N) degrees Celsius
  double sample_rate = 0.0;                    ///< Hz
  std::vector<IndexRange> spans;               ///< contiguous pieces, in order
  TimelineReport timeline;                     ///< what was found in the stamps (two clocks: the sensor's)
  std::optional<TimelineReport> joint_timeline;  ///< the joints' own stamps, where they had a clock of their own

  [[nodiscard]] Index samples() const { return time.size(); }
  [[nodiscard]] Index joints() const { return joint_positions.cols(); }
  /// Whether every row is the mean of a rest.
  [[nodiscard]] bool is_static() const { return samples() > 0 && static_cast<Index>(spans.size()) == samples(); }
};

/// sensor_time = offset + rate * joint_time.
struct ClockModel {
  double offset = 0.0;  ///< s
  double rate = 1.0;    ///< sensor seconds a joint second
};

/// What the sensor wrote, beside the joints or on its own clock.
struct SensorSamples {
  Samples3 specific_force;                     ///< (N, 3) m/s^2
  std::optional<Samples3> angular_velocity;    ///< (N, 3) rad/s
  std::optional<Eigen::VectorXd> temperature;  ///< (N) degrees Celsius
};

/// A recording from one log: time (N) s, joint_positions (N, n). Raises InvalidInput for sizes that differ, fewer than
/// 8 rows, values that are not finite (row, column, value) and time that does not advance (row, both values).
Recording make_recording(const Eigen::Ref<const Eigen::VectorXd>& time,
    const Eigen::Ref<const SamplesX>& joint_positions,
                         const SensorSamples& sensor, const TimelineOptions& options = {});

/// A recording from two logs with two clocks. Sensor samples without joint positions around them are left out. Raises
/// InvalidInput as above, and where the two logs do not overlap under the clock model.
Recording make_recording(const Eigen::Ref<const Eigen::VectorXd>& joint_time,
                         const Eigen::Ref<const SamplesX>& joint_positions,
                         const Eigen::Ref<const Eigen::VectorXd>& sensor_time, const SensorSamples& sensor,
                         const ClockModel& clock, const TimelineOptions& options = {});

/// A table of still poses (P, n) with what the sensor read at rest in each. Raises InvalidInput for sizes that differ, fewer
/// than 3 poses and values that are not finite (row, column, value).
Recording make_static_recording(const Eigen::Ref<const SamplesX>& joint_positions, const SensorSamples& sensor);

/// Several recordings of the same arm as one: each starts a new span. A recording that does not start after the one
/// before it is moved to one second after its end, and the timeline's notes say so. Sample rates within 1 % are
/// brought to the first one's; a gyroscope or temperature is kept where all have it. Raises InvalidInput for other
/// rates or joints, and for still poses beside logs.
Recording concatenate(const std::vector<Recording>& recordings);

}  // namespace circlepoint
