#include "circlepoint/simulation/experiment.hpp"

#include <gtest/gtest.h>

#include "circlepoint/core/error.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

Experiment experiment() {
  Experiment experiment;
  experiment.chain = support::four_joints();
  experiment.up_gravity_sensor = support::up_gravity_four_joints;
  experiment.sensor.bias_std = 2e-3;
  experiment.sensor.uncorrected.bias_std = 0.1;
  experiment.trajectory = joint_trajectory(Eigen::Vector4d::Constant(-0.6), support::joint_tests({3}), 200.0, 0.6);
  experiment.simulation.noise_std = 2e-3;
  experiment.simulation.encoder_counts_per_revolution = Eigen::Vector4d::Constant(100'000.0);
  experiment.start_spread = Eigen::Vector4d::Constant(6.283 / 100'000.0);
  experiment.direction_std = 3e-3;
  experiment.point_std = 1e-3;
  return experiment;
}

TEST(SimulateExperiment, EverySeedIsAnotherArmSensorAndStart) {
  const Experiment common = experiment();
  const SimulatedExperiment one = simulate_experiment(common, 1);
  const SimulatedExperiment again = simulate_experiment(common, 1);
  const SimulatedExperiment other = simulate_experiment(common, 2);
  EXPECT_EQ(one.recording.specific_force, again.recording.specific_force);
  EXPECT_EQ(one.recording.joint_positions, again.recording.joint_positions);
  EXPECT_NE(one.sensor.bias, other.sensor.bias);
  EXPECT_NE(one.chain.axes[0].line.direction, other.chain.axes[0].line.direction);
  EXPECT_NE(one.recording.joint_positions(0, 0), common.trajectory.position(0, 0));
  Experiment drawn = common;
  drawn.direction_std = drawn.point_std = 0.0;
  EXPECT_EQ(simulate_experiment(drawn, 1).chain.axes[0].line.direction, common.chain.axes[0].line.direction);
  EXPECT_EQ(simulate_experiment(drawn, 1).sensor.bias, one.sensor.bias);
  drawn.point_std = -1.0;
  EXPECT_THROW(static_cast<void>(simulate_experiment(drawn, 1)), InvalidInput);
  drawn.point_std = 0.0;
  drawn.start_spread = Eigen::Vector2d::Zero();
  EXPECT_THROW(static_cast<void>(simulate_experiment(drawn, 1)), InvalidInput);
}

TEST(SimulateExperiment, TheSheetIsTheIndividualsAndCorrectsItsReadings) {
  Experiment acquired = experiment();
  acquired.simulation.acquisition = AcquisitionOptions{};
  const SimulatedExperiment corrected = simulate_experiment(acquired, 5);
  acquired.corrected = false;
  const SimulatedExperiment raw = simulate_experiment(acquired, 5);
  ASSERT_TRUE(raw.sheet.has_value());
  EXPECT_GT((raw.sensor.bias - corrected.sensor.bias).norm(), 1e-2);
  const Eigen::RowVector3d change = (raw.recording.specific_force - corrected.recording.specific_force).colwise().mean();
  EXPECT_NEAR((change.transpose() - raw.sheet->bias).norm(), 0.0, 1e-9);
  EXPECT_FALSE(simulate_experiment(experiment(), 5).sheet.has_value());
}

}  // namespace
}  // namespace circlepoint
