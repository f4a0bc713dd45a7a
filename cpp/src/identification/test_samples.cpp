#include "test_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

IndexRange widen(const Recording& recording, const IndexRange& range, Index margin) {
  for (const IndexRange& span : recording.spans) {
    if (range.begin >= span.begin && range.end <= span.end) {
      return {std::max(span.begin, range.begin - margin), std::min(span.end, range.end + margin)};
    }
  }
  return range;
}

MotionSamples condition(const Recording& recording, const SingleJointMotion& motion, double cutoff,
                        const AccelerometerModel& sensor, int filter_order) {
  const double rate = recording.sample_rate;
  // Smoothing the encoders needs run-in; the samples used are the motion's own.
  const IndexRange wide = widen(recording, motion.samples, static_cast<Index>(std::lround(2.0 * rate / cutoff)));
  const double smooth = std::min(3.0 * cutoff, 0.4 * rate);
  const SamplesX position =
      sosfiltfilt(butter(filter_order, smooth, rate), recording.joint_positions.middleRows(wide.begin, wide.size()));
  // Derivatives of the sixth-degree polynomial through seven samples: two-point differences would shrink them by
  // (2 pi f / rate)^2 / 6, a tenth of a millimetre on a metre.
  const SamplesX velocity = savgol_filter(position, 7, 6, 1, 1.0 / rate);
  const SamplesX acceleration = savgol_filter(position, 7, 6, 2, 1.0 / rate);
  const Index skip = motion.samples.begin - wide.begin;
  const Index count = motion.samples.size();
  MotionSamples samples;
  samples.time = recording.time.segment(motion.samples.begin, count);
  samples.position = position.middleRows(skip, count);
  samples.velocity = velocity.middleRows(skip, count);
  samples.acceleration = acceleration.middleRows(skip, count);
  samples.specific_force.resize(count, 3);
  for (Index i = 0; i < count; ++i) {
    samples.specific_force.row(i) =
        sensor.correct(recording.specific_force.row(motion.samples.begin + i).transpose(), Eigen::Vector3d::Zero());
  }
  // A step of acceleration at the edge rings through the low-pass for some 2.5 / cutoff.
  const Index run_in = std::min(static_cast<Index>(std::lround(2.5 * rate / cutoff)), count / 4);
  samples.trim_begin = motion.from_rest ? 0 : run_in;
  samples.trim_end = motion.to_rest ? 0 : run_in;
  return samples;
}

}  // namespace

const MotionSamples& widest_motion(const TestSamples& samples) {
  if (samples.motions.empty()) {
    throw NotIdentifiable("no motion of this joint alone was found; record one, for example 0.5 Hz over 150 degrees for 6 s");
  }
  const auto travel = [&](const MotionSamples& motion) {
    const auto column = motion.position.col(samples.joint);
    return column.maxCoeff() - column.minCoeff();
  };
  return *std::max_element(samples.motions.begin(), samples.motions.end(),
                           [&](const auto& a, const auto& b) { return travel(a) < travel(b); });
}

namespace {

// The count that a joint's steps from one sample to the next are multiples of, and by which it moves from one value it holds to another,
// as no smooth motion does; 0: there is none.
double count_of(const Recording& recording, Index joint) {
  constexpr double same = 1e-8;
  constexpr double few = 10.0;       // counts a step, of which rounding in a file leaves whole numbers
  constexpr double off = 0.1;        // of a count
  constexpr double most = 0.9;       // of the small steps
  std::vector<Eigen::ArrayXd> of_spans;
  double smallest = std::numeric_limits<double>::infinity();
  for (const IndexRange& span : recording.spans) {
    const auto positions = recording.joint_positions.col(joint).segment(span.begin, span.size()).array();
    const Index count = std::max<Index>(1, span.size()) - 1;
    of_spans.emplace_back((positions.tail(count) - positions.head(count)).abs());
    for (const double step : of_spans.back()) {
      smallest = step > same ? std::min(smallest, step) : smallest;
    }
  }
  Index small = 0;
  Index whole = 0;
  bool from_hold_to_hold = false;
  for (const Eigen::ArrayXd& steps : of_spans) {
    const auto holds = [&](Index k) { return k >= 0 && k < steps.size() && steps[k] <= same; };
    for (Index k = 0; k < steps.size(); ++k) {
      if (steps[k] <= same || steps[k] >= few * smallest) {
        continue;
      }
      const double counts = steps[k] / smallest;
      ++small;
      whole += std::abs(counts - std::round(counts)) < off ? 1 : 0;
      from_hold_to_hold = from_hold_to_hold || (counts < 1.0 + off && holds(k - 1) && holds(k + 1));
    }
  }
  return from_hold_to_hold && static_cast<double>(whole) > most * static_cast<double>(small) ? smallest : 0.0;
}

}  // namespace

Eigen::VectorXd encoder_resolution(const Recording& recording, const JointCalibrationOptions& options) {
  if (options.encoder_resolution.size() == recording.joints()) {
    return options.encoder_resolution;
  }
  Eigen::VectorXd resolution = Eigen::VectorXd::Zero(recording.joints());
  if (!recording.is_static()) {  // from one still pose to the next a joint makes many steps
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      resolution[joint] = count_of(recording, joint);
    }
  }
  return resolution;
}

double choose_cutoff(const Recording& recording, const Segmentation& segmentation, const JointTest& test, double resolution) {
  constexpr double widest = 10.0;         // Hz, the paper's choice for its motion
  constexpr double reach = 1.0;           // m
  constexpr double tolerated = 0.02;      // m/s^2 of differentiated quantisation at that reach
  double frequency = 0.0;
  double travel = 0.0;
  for (const Index index : test.motions) {
    const SingleJointMotion& motion = segmentation.motions[static_cast<std::size_t>(index)];
    if (motion.travel > travel) {
      travel = motion.travel;
      frequency = motion.peak_velocity / (std::numbers::pi * motion.travel);
    }
  }
  double cutoff = widest;
  if (resolution > 0.0) {
    // White quantisation noise of resolution / sqrt(12), differentiated twice and cut at c:
    // std = resolution / sqrt(12) sqrt(2 c / rate) (2 pi c)^2 / sqrt(5).
    const double per_unit = reach * resolution / std::sqrt(12.0) * std::sqrt(2.0 / recording.sample_rate) * 4.0 *
                            std::numbers::pi * std::numbers::pi / std::sqrt(5.0);
    cutoff = std::min(cutoff, std::pow(tolerated / per_unit, 0.4));
  }
  return std::min(std::max(cutoff, 6.0 * frequency), 0.2 * recording.sample_rate);
}

TestSamples gather(const Recording& recording, const Segmentation& segmentation, Index test_index,
                   const AccelerometerModel& sensor, const Eigen::VectorXd& resolution,
                   const JointCalibrationOptions& options) {
  const JointTest& test = segmentation.tests[static_cast<std::size_t>(test_index)];
  TestSamples samples;
  samples.joint = test.joint;
  samples.test = test_index;
  samples.configuration = test.configuration;
  samples.cutoff = options.cutoff > 0.0 ? options.cutoff
                                        : choose_cutoff(recording, segmentation, test, resolution.maxCoeff());
  const auto dwells = static_cast<Index>(test.dwells.size());
  samples.dwell_positions.resize(dwells, recording.joints());
  samples.dwell_force.resize(dwells, 3);
  double variance = 0.0;
  for (Index k = 0; k < dwells; ++k) {
    const StaticDwell& dwell = segmentation.dwells[static_cast<std::size_t>(test.dwells[static_cast<std::size_t>(k)])];
    samples.dwell_positions.row(k) = dwell.joint_positions;
    samples.dwell_force.row(k) = sensor.correct(dwell.specific_force, Eigen::Vector3d::Zero());
    variance += dwell.specific_force_std.squaredNorm() / 3.0 / static_cast<double>(std::max<Index>(1, dwell.samples.size()));
  }
  samples.dwell_floor = dwells > 0 ? std::sqrt(variance / static_cast<double>(dwells)) : 0.0;
  const auto shortest = static_cast<Index>(std::lround(0.2 * recording.sample_rate));
  for (const Index index : test.motions) {
    const SingleJointMotion& motion = segmentation.motions[static_cast<std::size_t>(index)];
    if (motion.samples.size() > std::max<Index>(shortest, 32)) {
      samples.motions.push_back(condition(recording, motion, samples.cutoff, sensor, options.filter_order));
    }
  }
  return samples;
}

}  // namespace circlepoint
