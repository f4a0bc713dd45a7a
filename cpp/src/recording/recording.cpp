#include "circlepoint/recording/recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/recording/interpolate.hpp"

namespace circlepoint {
namespace {

constexpr double rate_tolerance = 1e-2;      // sample rates of recordings that may be joined
constexpr double same_rate = 1e-4;           // fitted rates that differ by less are the same clock's
constexpr double pause_between_files = 1.0;  // s

void require_rows(const char* column, Index rows, Index expected) {
  require(rows == expected, std::string(column) + " has " + std::to_string(rows) + " rows in place of " +
                                std::to_string(expected) + ": every column needs one value a row");
}

void require_finite(const std::string& column, const Eigen::Ref<const Eigen::VectorXd, 0,
    Eigen::InnerStride<>>& values) {
  for (Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values(i))) {
      std::ostringstream text;
      text << "column " << column << ", row " << i + 1 << " is " << values(i) << ": remove or repair the row";
      throw InvalidInput(text.str());
    }
  }
}

void validate_joints(Index rows, const Eigen::Ref<const SamplesX>& joint_positions) {
  require_rows("joint positions", joint_positions.rows(), rows);
  require(joint_positions.cols() > 0, "there are no joint positions: columns q1, q2, ... are needed");
  for (Index j = 0; j < joint_positions.cols(); ++j) {
    require_finite(std::string("q").append(std::to_string(j + 1)), joint_positions.col(j));
  }
}

void validate_sensor(Index rows, const SensorSamples& sensor) {
  constexpr std::array<const char*, 3> force_columns{"ax", "ay", "az"};
  constexpr std::array<const char*, 3> gyroscope_columns{"gx", "gy", "gz"};
  require_rows("specific force", sensor.specific_force.rows(), rows);
  for (Index k = 0; k < 3; ++k) {
    require_finite(force_columns[static_cast<std::size_t>(k)], sensor.specific_force.col(k));
  }
  if (sensor.angular_velocity) {
    require_rows("angular velocity", sensor.angular_velocity->rows(), rows);
    for (Index k = 0; k < 3; ++k) {
      require_finite(gyroscope_columns[static_cast<std::size_t>(k)], sensor.angular_velocity->col(k));
    }
  }
  if (sensor.temperature) {
    require_rows("temperature", sensor.temperature->size(), rows);
    require_finite("temp", *sensor.temperature);
  }
}

void set_sensor(Recording& recording, const Timeline& timeline, const SensorSamples& sensor) {
  recording.specific_force = regularise(timeline, sensor.specific_force);
  if (sensor.angular_velocity) {
    recording.angular_velocity = Samples3(regularise(timeline, *sensor.angular_velocity));
  }
  if (sensor.temperature) {
    recording.temperature = Eigen::VectorXd(regularise(timeline, *sensor.temperature).col(0));
  }
}

Timeline timeline_of(const char* which, const Eigen::Ref<const Eigen::VectorXd>& time, const TimelineOptions& options) {
  try {
    return make_timeline(time, options);
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string(which) + ": " + error.what());
  }
}

// The recording on a grid of another rate, span by span.
Recording at_rate(const Recording& recording, double rate) {
  Recording result = recording;
  result.sample_rate = rate;
  result.spans.clear();
  std::vector<double> grid;
  for (const IndexRange& span : recording.spans) {
    const double start = recording.time(span.begin);
    const auto begin = static_cast<Index>(grid.size());
    const auto steps = static_cast<Index>(std::floor((recording.time(span.end - 1) - start) * rate + 1e-9));
    for (Index k = 0; k <= steps; ++k) {
      grid.push_back(start + static_cast<double>(k) / rate);
    }
    result.spans.push_back({begin, static_cast<Index>(grid.size())});
  }
  result.time = Eigen::Map<const Eigen::VectorXd>(grid.data(), static_cast<Index>(grid.size()));
  const auto on_grid = [&](const Eigen::Ref<const SamplesX>& values) {
    SamplesX resampled(result.time.size(), values.cols());
    for (std::size_t s = 0; s < result.spans.size(); ++s) {
      const IndexRange from = recording.spans[s];
      const IndexRange to = result.spans[s];
      resampled.middleRows(to.begin, to.size()) =
          interpolate_cubic(recording.time.segment(from.begin, from.size()), values.middleRows(from.begin, from.size()),
                            result.time.segment(to.begin, to.size()));
    }
    return resampled;
  };
  result.joint_positions = on_grid(recording.joint_positions);
  result.specific_force = on_grid(recording.specific_force);
  if (recording.angular_velocity) {
    result.angular_velocity = Samples3(on_grid(*recording.angular_velocity));
  }
  if (recording.temperature) {
    result.temperature = Eigen::VectorXd(on_grid(*recording.temperature).col(0));
  }
  return result;
}

template <typename Matrix>
void append(Matrix& matrix, const Matrix& more) {
  Matrix joined(matrix.rows() + more.rows(), matrix.cols());
  joined << matrix, more;
  matrix = std::move(joined);
}

// Joins what was found in two logs; times in `more` are moved by `shift` seconds, rows by those before.
void append_report(TimelineReport& report, TimelineReport more, double shift) {
  const Index rows = report.samples;
  for (TimelineGap& gap : more.gaps) {
    gap.index += rows;
    gap.start += shift;
    report.gaps.push_back(gap);
  }
  const auto append_order = [&](std::vector<StampOrder>& list, const std::vector<StampOrder>& other) {
    for (const StampOrder& order : other) {
      list.push_back({order.index + rows, order.previous + shift, order.value + shift});
    }
  };
  append_order(report.repeated, more.repeated);
  const double total = static_cast<double>(report.samples + more.samples);
  report.jitter_std = std::sqrt((report.jitter_std * report.jitter_std * static_cast<double>(report.samples) +
                                 more.jitter_std * more.jitter_std * static_cast<double>(more.samples)) /
                                total);
  report.jitter_max = std::max(report.jitter_max, more.jitter_max);
  report.resolution = std::max(report.resolution, more.resolution);
  report.rule = more.rule == StampRule::believed ? more.rule : report.rule;
  report.samples += more.samples;
  report.late += more.late;
  report.filled += more.filled;
  report.notes.insert(report.notes.end(), more.notes.begin(), more.notes.end());
}

}  // namespace

Recording make_recording(const Eigen::Ref<const Eigen::VectorXd>& time,
    const Eigen::Ref<const SamplesX>& joint_positions,
                         const SensorSamples& sensor, const TimelineOptions& options) {
  validate_joints(time.size(), joint_positions);
  validate_sensor(time.size(), sensor);
  Timeline timeline = make_timeline(time, options);
  Recording recording;
  recording.joint_positions = regularise(timeline, joint_positions);
  set_sensor(recording, timeline, sensor);
  recording.time = std::move(timeline.time);
  recording.spans = std::move(timeline.spans);
  recording.sample_rate = timeline.report.sample_rate;
  recording.timeline = std::move(timeline.report);
  return recording;
}

Recording make_recording(const Eigen::Ref<const Eigen::VectorXd>& joint_time,
                         const Eigen::Ref<const SamplesX>& joint_positions,
                         const Eigen::Ref<const Eigen::VectorXd>& sensor_time, const SensorSamples& sensor,
                         const ClockModel& clock, const TimelineOptions& options) {
  require(std::isfinite(clock.offset) && std::isfinite(clock.rate) && clock.rate > 0.0,
          "the clock model needs a finite offset and a positive rate, got offset " + std::to_string(clock.offset) +
              " s, rate " + std::to_string(clock.rate));
  validate_joints(joint_time.size(), joint_positions);
  validate_sensor(sensor_time.size(), sensor);
  Timeline joints = timeline_of("joint log", joint_time, options);
  Timeline readings = timeline_of("sensor log", sensor_time, options);
  const SamplesX positions = regularise(joints, joint_positions);
  Recording all;
  set_sensor(all, readings, sensor);
  const Eigen::VectorXd in_joint_time = ((readings.time.array() - clock.offset) / clock.rate).matrix();

  Recording recording;
  std::vector<Index> kept;
  std::vector<SamplesX> pieces;
  for (const IndexRange& sensor_span : readings.spans) {
    for (const IndexRange& joint_span : joints.spans) {
      const double* begin = in_joint_time.data() + sensor_span.begin;
      const double* end = in_joint_time.data() + sensor_span.end;
      const double* first = std::lower_bound(begin, end, joints.time(joint_span.begin));
      const double* last = std::upper_bound(first, end, joints.time(joint_span.end - 1));
      if (last - first < 2) {
        continue;
      }
      const auto start = static_cast<Index>(kept.size());
      for (const double* t = first; t != last; ++t) {
        kept.push_back(t - in_joint_time.data());
      }
      recording.spans.push_back({start, static_cast<Index>(kept.size())});
      pieces.push_back(interpolate_cubic(joints.time.segment(joint_span.begin, joint_span.size()),
                                         positions.middleRows(joint_span.begin, joint_span.size()),
                                         Eigen::Map<const Eigen::VectorXd>(first, last - first)));
    }
  }
  if (kept.size() < 8) {
    std::ostringstream text;
    text << "the two logs do not overlap: in joint time the joints run from " << joints.time(0) << " to "
         << joints.time(joints.time.size() - 1) << " s, the sensor from " << in_joint_time(0) << " to "
         << in_joint_time(in_joint_time.size() - 1) << " s (offset " << clock.offset << " s, rate " << clock.rate
         << "); check the clock model";
    throw InvalidInput(text.str());
  }
  recording.joint_positions.resize(static_cast<Index>(kept.size()), positions.cols());
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    recording.joint_positions.middleRows(recording.spans[s].begin, recording.spans[s].size()) = pieces[s];
  }
  recording.time = in_joint_time(kept);
  recording.specific_force = all.specific_force(kept, Eigen::all);
  if (all.angular_velocity) {
    recording.angular_velocity = Samples3((*all.angular_velocity)(kept, Eigen::all));
  }
  if (all.temperature) {
    recording.temperature = Eigen::VectorXd((*all.temperature)(kept));
  }
  recording.sample_rate = readings.report.sample_rate * clock.rate;
  recording.timeline = std::move(readings.report);
  recording.joint_timeline = std::move(joints.report);
  return recording;
}

Recording make_static_recording(const Eigen::Ref<const SamplesX>& joint_positions, const SensorSamples& sensor) {
  constexpr Index fewest = 3;
  const Index poses = joint_positions.rows();
  require(poses >= fewest, "there are " + std::to_string(poses) + " still poses, at least " + std::to_string(fewest) + " are needed");
  validate_joints(poses, joint_positions);
  validate_sensor(poses, sensor);
  Recording recording;
  recording.time = Eigen::VectorXd::LinSpaced(poses, 0.0, static_cast<double>(poses - 1));
  recording.joint_positions = joint_positions;
  recording.specific_force = sensor.specific_force;
  recording.angular_velocity = sensor.angular_velocity;
  recording.temperature = sensor.temperature;
  recording.sample_rate = 1.0;
  for (Index row = 0; row < poses; ++row) {
    recording.spans.push_back({row, row + 1});
  }
  recording.timeline.samples = poses;
  recording.timeline.sample_rate = recording.sample_rate;
  recording.timeline.duration = recording.time(poses - 1);
  return recording;
}

Recording concatenate(const std::vector<Recording>& recordings) {
  require(!recordings.empty(), "there are no recordings to concatenate");
  Recording joined = recordings.front();
  for (std::size_t r = 1; r < recordings.size(); ++r) {
    const std::string name = "recording " + std::to_string(r + 1);
    const Recording& given = recordings[r];
    require(given.joints() == joined.joints(), name + " has " + std::to_string(given.joints())
        + " joints, the first has " +
                                                   std::to_string(joined.joints()));
    require(given.is_static() == joined.is_static(),
            name + (given.is_static() ? " is a table of still poses, the first is a log" : " is a log, the first is a table of still poses") +
                ": calibrate them apart");
    const double difference = std::abs(given.sample_rate - joined.sample_rate) / joined.sample_rate;
    require(difference <= rate_tolerance, name + " is sampled at " + std::to_string(given.sample_rate) +
                                              " Hz, the first at " + std::to_string(joined.sample_rate) +
                " Hz: recordings whose rates differ by more than 1 % are calibrated apart");
    Recording next = difference <= same_rate ? given : at_rate(given, joined.sample_rate);
    if (difference > same_rate) {
      next.timeline.notes.push_back(name + " was resampled from " + std::to_string(given.sample_rate) + " to " +
                                    std::to_string(joined.sample_rate) + " Hz");
    }
    const double end = joined.time(joined.samples() - 1);
    const double shift = next.time(0) > end ? 0.0 : end + pause_between_files - next.time(0);
    if (shift != 0.0) {
      std::ostringstream note;
      note << name << " starts at t = " << next.time(0) << " s, before the end of the one before it: moved by " <<
          shift << " s";
      next.timeline.notes.push_back(note.str());
      next.time.array() += shift;
    }
    const Index offset = joined.samples();
    for (const IndexRange& span : next.spans) {
      joined.spans.push_back({offset + span.begin, offset + span.end});
    }
    append(joined.time, next.time);
    append(joined.joint_positions, next.joint_positions);
    append(joined.specific_force, next.specific_force);
    if (joined.angular_velocity && next.angular_velocity) {
      append(*joined.angular_velocity, *next.angular_velocity);
    } else {
      joined.angular_velocity.reset();
    }
    if (joined.temperature && next.temperature) {
      append(*joined.temperature, *next.temperature);
    } else {
      joined.temperature.reset();
    }
    append_report(joined.timeline, std::move(next.timeline), shift);
    if (joined.joint_timeline && next.joint_timeline) {
      append_report(*joined.joint_timeline, std::move(*next.joint_timeline), shift);
    }
  }
  joined.timeline.duration = joined.time(joined.samples() - 1) - joined.time(0);
  return joined;
}

}  // namespace circlepoint
