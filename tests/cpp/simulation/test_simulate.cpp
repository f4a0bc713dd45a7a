#include "circlepoint/simulation/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

const Eigen::Vector3d up(1.0, -2.0, 9.5);

ScrewChain three_joints() {
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line({0.0, 0.1, 1.0}, {0.5, 0.2, -0.1})},
                {JointType::revolute, make_line({1.0, 0.2, 0.0}, {-0.1, 0.3, 0.4})},
                {JointType::revolute, make_line({0.3, 1.0, -0.5}, {0.0, 0.0, 0.2})}};
  chain.reference_configuration = Eigen::Vector3d(0.1, -0.2, 0.3);
  return chain;
}

TEST(Simulate, CircularMotionReadsTheCentripetalAcceleration) {
  // Constant rate about a vertical axis at 0.4 m: r w^2 towards the axis, gravity along it.
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line({0.0, 0.0, 1.0}, {0.4, 0.0, 0.0})}};
  chain.reference_configuration = Eigen::VectorXd::Zero(1);
  JointTrajectory motion{Eigen::VectorXd::LinSpaced(100, 0.0, 0.99), SamplesX(100, 1), SamplesX::Constant(100, 1, 3.0),
                         SamplesX::Zero(100, 1), 100.0};
  motion.position.col(0) = 3.0 * motion.time;
  const Recording recording = simulate(chain, {0.0, 0.0, 9.81}, {}, motion);
  const Eigen::RowVector3d expected(0.4 * 9.0, 0.0, 9.81);
  EXPECT_LT((recording.specific_force.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Simulate, AtRestTheReadingIsGravityTurned) {
  const ScrewChain chain = three_joints();
  SamplesX poses = SamplesX::Random(50, 3) * 3.0;
  const Recording recording = simulate(chain, up, {}, static_poses(poses));
  for (Index i = 0; i < poses.rows(); ++i) {
    const Eigen::Vector3d expected =
        forward_kinematics(chain, Eigen::VectorXd(poses.row(i))).linear().transpose() * up;
    EXPECT_LT((recording.specific_force.row(i).transpose() - expected).norm(), 1e-13);
  }
}

TEST(Simulate, AYieldingArmIsTheRigidArmAtTheMeasuredPositions) {
  // Exact encoders see where the joints really are; differencing them must agree with what the sensor felt.
  const ScrewChain chain = three_joints();
  const JointTrajectory commanded = joint_trajectory(
      chain.reference_configuration,
      {MultiJointMotion{.duration = 4.0, .amplitude = Eigen::Vector3d(1.0, 1.0, 1.0), .seed = 5}}, 4000.0);
  const Recording recording =
      simulate(chain, up, {}, commanded, {.compliance = Eigen::Vector3d(1e-3, 2e-3, 5e-4)});
  const double sag = (recording.joint_positions - commanded.position).cwiseAbs().maxCoeff();
  EXPECT_GT(sag, 1e-3);
  EXPECT_LT(sag, 2e-2);
  JointTrajectory actual = commanded;
  actual.position = recording.joint_positions;
  const Index n = commanded.samples();
  const SamplesX before = actual.position.topRows(n - 2);
  const SamplesX after = actual.position.bottomRows(n - 2);
  actual.velocity.middleRows(1, n - 2) = (after - before) * 2000.0;
  actual.acceleration.middleRows(1, n - 2) = (after - 2.0 * actual.position.middleRows(1, n - 2) + before) * 16e6;
  const Recording rigid = simulate(chain, up, {}, actual);
  const Samples3 difference = recording.specific_force - rigid.specific_force;
  EXPECT_LT(difference.middleRows(1, n - 2).cwiseAbs().maxCoeff(), 2e-4);
}

TEST(Simulate, JointsGiveWayDownwards) {
  // A horizontal axis with the sensor 0.5 m away horizontally: up is +z, the axis +y at x = -0.5; turning about +y
  // lowers the sensor, so the joint yields by + compliance x 0.5 x 9.81.
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line({0.0, 1.0, 0.0}, {-0.5, 0.0, 0.0})}};
  chain.reference_configuration = Eigen::VectorXd::Zero(1);
  const Recording recording = simulate(chain, {0.0, 0.0, 9.81}, {}, static_poses(SamplesX::Zero(1, 1)),
                                       {.compliance = Eigen::VectorXd::Constant(1, 1e-3)});
  EXPECT_NEAR(recording.joint_positions(0, 0), 1e-3 * 0.5 * 9.81, 1e-15);
}

TEST(Simulate, SwitchingVibrationOnDoesNotChangeTheNoise) {
  const ScrewChain chain = three_joints();
  const JointTrajectory motion =
      joint_trajectory(chain.reference_configuration, {Dwell{1.0}, RaisedCosine{0, 1.0, 0.5, 2.0}}, 250.0);
  SimulationOptions options{.noise_std = 0.01, .seed = 9};
  const Recording quiet = simulate(chain, up, {}, motion, options);
  options.vibration.tangential_amplitude = 0.1;
  const Recording shaken = simulate(chain, up, {}, motion, options);
  EXPECT_EQ(quiet.specific_force.topRows(250), shaken.specific_force.topRows(250));
  EXPECT_NE(quiet.specific_force, shaken.specific_force);
}

TEST(Simulate, SizesThatDoNotMatchTheChainAreRefused) {
  const ScrewChain chain = three_joints();
  const JointTrajectory rest = static_poses(SamplesX::Zero(2, 3));
  EXPECT_THROW(simulate(chain, up, {}, static_poses(SamplesX::Zero(2, 2))), InvalidInput);
  EXPECT_THROW(simulate(chain, up, {}, rest, {.encoder_counts_per_revolution = Eigen::Vector2d(1e4, 1e4)}),
               InvalidInput);
  EXPECT_THROW(simulate(chain, up, {}, rest, {.compliance = Eigen::Vector2d(0.0, 0.0)}), InvalidInput);
  EXPECT_THROW(simulate(chain, up, {}, rest, {.vibration = {.tangential_amplitude = 0.1}}), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
