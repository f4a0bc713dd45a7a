#include "test_regression.hpp"

#include <cmath>
#include <limits>

#include "circlepoint/conditioning/butterworth.hpp"

namespace circlepoint {
namespace {

// Motion of the other joints that changes no reading by 1e-6 m/s^2, on any arm a person could build.
constexpr double no_travel = 1e-9;        // rad or m
constexpr double no_velocity = 1e-8;      // rad/s or m/s
constexpr double no_acceleration = 1e-7;  // rad/s^2 or m/s^2

double sample_rate_of(const MotionSamples& motion) {
  const Index last = motion.time.size() - 1;
  return static_cast<double>(last) / (motion.time[last] - motion.time[0]);
}

bool others_rest(const TestSamples& samples, const MotionSamples& motion) {
  const double rate = sample_rate_of(motion);
  for (Index joint = 0; joint < samples.configuration.size(); ++joint) {
    if (joint == samples.joint) {
      continue;
    }
    // Derivatives of a constant are rounding, which grows with the rate.
    const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * std::abs(samples.configuration[joint]) * rate;
    if ((motion.position.col(joint).array() - samples.configuration[joint]).abs().maxCoeff() > no_travel ||
        motion.velocity.col(joint).cwiseAbs().maxCoeff() > no_velocity + rounding ||
        motion.acceleration.col(joint).cwiseAbs().maxCoeff() > no_acceleration + rounding * rate) {
      return false;
    }
  }
  return true;
}

Index used_samples(const MotionSamples& motion) { return motion.time.size() - motion.trim_begin - motion.trim_end; }

}  // namespace

TestRegression make_regression(const TestSamples& samples, int filter_order) {
  const Index joint = samples.joint;
  const double zero = samples.configuration[joint];
  TestRegression problem;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(samples.dwell_force.rows());
  problem.static_regressors = joint_regressors(samples.dwell_positions.col(joint).array() - zero, still, still);
  problem.static_readings = samples.dwell_force;
  Index total = 0;
  for (const MotionSamples& motion : samples.motions) {
    total += used_samples(motion);
  }
  problem.dynamic_regressors.resize(total, 5);
  problem.dynamic_readings.resize(total, 3);
  problem.time.resize(total);
  problem.position.resize(total);
  Index row = 0;
  for (const MotionSamples& motion : samples.motions) {
    problem.sample_rate = sample_rate_of(motion);
    SamplesX both(motion.time.size(), 8);
    both.leftCols<5>() = joint_regressors(motion.position.col(joint).array() - zero, motion.velocity.col(joint),
                                          motion.acceleration.col(joint));
    both.rightCols<3>() = motion.specific_force;
    both = sosfiltfilt(butter(filter_order, samples.cutoff, problem.sample_rate), both);
    const Index count = used_samples(motion);
    problem.dynamic_regressors.middleRows(row, count) = both.middleRows(motion.trim_begin, count).leftCols<5>();
    problem.dynamic_readings.middleRows(row, count) = both.middleRows(motion.trim_begin, count).rightCols<3>();
    problem.time.segment(row, count) = motion.time.segment(motion.trim_begin, count);
    problem.position.segment(row, count) = motion.position.col(joint).segment(motion.trim_begin, count);
    row += count;
  }
  return problem;
}

TestRegression without_yielding(const TestRegression& regression, const TestSamples& samples, const PartialChain& chain,
                                int filter_order) {
  TestRegression corrected = regression;
  const Index joint = samples.joint;
  if (!chain.knows(joint)) {
    return corrected;
  }
  if (samples.dwell_positions.rows() > 0) {
    const SamplesX at_rest = SamplesX::Zero(samples.dwell_positions.rows(), samples.dwell_positions.cols());
    corrected.static_readings -=
        yield_correction(chain, joint, samples.configuration, samples.dwell_positions, at_rest, at_rest);
  }
  Index row = 0;
  for (const MotionSamples& motion : samples.motions) {
    const Index count = used_samples(motion);
    if (!others_rest(samples, motion)) {
      const Samples3 correction = sosfiltfilt(
          butter(filter_order, samples.cutoff, sample_rate_of(motion)),
          yield_correction(chain, joint, samples.configuration, motion.position, motion.velocity, motion.acceleration));
      corrected.dynamic_readings.middleRows(row, count) -= correction.middleRows(motion.trim_begin, count);
    }
    row += count;
  }
  return corrected;
}

}  // namespace circlepoint
