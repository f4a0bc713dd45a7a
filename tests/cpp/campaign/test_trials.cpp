#include "circlepoint/campaign/trials.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

AccelerometerSpecification kind() {
  AccelerometerSpecification sensor;
  sensor.bias_std = 2e-3;
  sensor.scale_std = 2e-4;
  sensor.misalignment_std = 1e-4;
  sensor.percussion_distance = 0.018;
  sensor.percussion_distance_std = 1e-4;
  return sensor;
}

// Tests of these joints of four; without its own, a joint has no line.
TrialConditions conditions(const std::vector<Index>& joints) {
  TrialConditions trial;
  trial.experiment.chain = support::four_joints();
  trial.experiment.up_gravity_sensor = support::up_gravity_four_joints;
  trial.experiment.sensor = kind();
  trial.experiment.trajectory =
      joint_trajectory(Eigen::Vector4d::Constant(-0.6), support::joint_tests(joints), 200.0, 0.6);
  trial.experiment.simulation.noise_std = 2e-3;
  trial.experiment.simulation.encoder_counts_per_revolution = Eigen::Vector4d::Constant(100'000.0);
  trial.experiment.start_spread = Eigen::Vector4d::Constant(6.283 / 100'000.0);
  trial.experiment.direction_std = 3e-3;
  trial.experiment.point_std = 1e-3;
  JointCalibrationOptions joint;
  joint.sensor = kind();
  trial.method = joint;
  trial.configurations = SamplesX::Random(20, 4);
  return trial;
}

std::vector<std::uint64_t> seeds(std::uint64_t count) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t i = 0; i < count; ++i) {
    all.push_back(derive_seed(7, i));
  }
  return all;
}

bool same_bits(const SamplesX& one, const SamplesX& other) {
  return one.rows() == other.rows() && one.cols() == other.cols() &&
         std::memcmp(one.data(), other.data(), static_cast<std::size_t>(one.size()) * sizeof(double)) == 0;
}

TEST(RunTrials, ThreadsDoNotChangeABit) {
  const TrialConditions trial = conditions({0, 1, 2, 3});
  const TrialResults alone = run_trials(trial, seeds(6), 1);
  const TrialResults together = run_trials(trial, seeds(6), 4);
  EXPECT_TRUE(same_bits(alone.line_error, together.line_error));
  EXPECT_TRUE(same_bits(alone.line_std, together.line_std));
  EXPECT_TRUE(same_bits(alone.line_nees, together.line_nees));
  EXPECT_TRUE(same_bits(alone.sensor_error, together.sensor_error));
  EXPECT_TRUE(same_bits(alone.end_point_error, together.end_point_error));
  EXPECT_FALSE(same_bits(alone.line_error.topRows(1), alone.line_error.bottomRows(1)));
}

TEST(RunTrials, ATrialIsItsSeedWhereverItStands) {
  const TrialConditions trial = conditions({2, 3});
  const auto all = seeds(4);
  const TrialResults results = run_trials(trial, all, 2);
  const TrialResults last = run_trials(trial, {all.back()}, 1);
  EXPECT_TRUE(same_bits(results.line_error.bottomRows(1), last.line_error));
}

TEST(RunTrials, ErrorsAreOfTheSizePredicted) {
  const TrialResults results = run_trials(conditions({0, 1, 2, 3}), seeds(12), 2);
  for (const TrialOutcome outcome : results.outcome) {
    EXPECT_EQ(outcome, TrialOutcome::complete);
  }
  // 12 x 4 lines of 4 degrees of freedom, correlated by the shared sensor.
  EXPECT_GT(results.line_nees.mean(), 0.5);
  EXPECT_LT(results.line_nees.mean(), 2.0);
  EXPECT_LT(results.end_point_error.maxCoeff(), 2e-3);
  const double ratio = results.end_point_error.norm() / results.end_point_std.norm();
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6);
  const Eigen::ArrayXXd normalised = results.sensor_error.leftCols(6).array() / results.sensor_std.leftCols(6).array();
  EXPECT_LT(normalised.square().mean(), 3.0);
}

TEST(RunTrials, AnArmWhoseTestsAreNotAllThereIsAResultWithItsReason) {
  const TrialResults results = run_trials(conditions({3}), seeds(2), 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(results.outcome[i], TrialOutcome::incomplete);
    EXPECT_EQ(results.reason[i].rfind("joint 1: ", 0), 0U) << results.reason[i];
  }
  EXPECT_TRUE(std::isnan(results.end_point_error[0]));
  EXPECT_TRUE(results.line_error.leftCols(12).array().isNaN().all());
  EXPECT_FALSE(results.line_error.rightCols(4).array().isNaN().any());
}

TEST(RunTrials, AnEstimateThatFailsIsAResultWithItsReason) {
  TrialConditions trial = conditions({3});
  trial.experiment.trajectory = joint_trajectory(Eigen::Vector4d::Zero(), {Dwell{.duration = 2.0}}, 200.0);
  WholeArmOptions options;
  options.sensor = kind();
  trial.method = options;
  const TrialResults results = run_trials(trial, seeds(1), 1);
  EXPECT_EQ(results.outcome[0], TrialOutcome::failed);
  EXPECT_FALSE(results.reason[0].empty());
}

TEST(RunTrials, ConditionsThatCannotBeSimulatedAreTheCallersError) {
  TrialConditions trial = conditions({3});
  trial.experiment.simulation.vibration.tangential_amplitude = 0.1;
  trial.experiment.simulation.vibration.frequency_max = 100.0;
  EXPECT_THROW(run_trials(trial, seeds(8), 3), InvalidInput);
  EXPECT_THROW(run_trials(trial, seeds(1), 0), InvalidInput);
}

TEST(RunTrials, ProgressCountsToTheEndAndMayStopIt) {
  const TrialConditions trial = conditions({3});
  Index told = 0;
  run_trials(trial, seeds(5), 2, [&told](Index done) {
    EXPECT_GT(done, told);
    told = done;
  });
  EXPECT_EQ(told, 5);
  Index calls = 0;
  EXPECT_THROW(run_trials(trial, seeds(40), 2,
                          [&calls](Index) {
                            ++calls;
                            throw std::runtime_error("enough");
                          }),
               std::runtime_error);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace circlepoint
