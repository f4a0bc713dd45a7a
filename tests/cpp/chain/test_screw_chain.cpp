#include "circlepoint/chain/screw_chain.hpp"

#include <gtest/gtest.h>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::LineNear;
using support::PoseNear;

TEST(ScrewChain, HomeIsThePoseAtTheReferenceConfiguration) {
  support::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    EXPECT_THAT(forward_kinematics(chain, chain.reference_configuration), PoseNear(chain.home, 1e-14));
  }
}

TEST(ScrewChain, FrameMotionIsTheTimeDerivativeOfForwardKinematics) {
  support::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const Index n = chain.size();
    const Eigen::VectorXd q = random.vector(n, 2.0);
    const Eigen::VectorXd q_dot = random.vector(n, 1.0);
    const Eigen::VectorXd q_ddot = random.vector(n, 1.0);
    const auto at = [&](double t) {
      return frame_motion(chain, q + t * q_dot + 0.5 * t * t * q_ddot, q_dot + t * q_ddot, q_ddot);
    };
    constexpr double step = 1e-5;
    const FrameMotion now = at(0.0);
    const RigidTransform before = forward_kinematics(chain, q - step * q_dot + 0.5 * step * step * q_ddot);
    const RigidTransform after = forward_kinematics(chain, q + step * q_dot + 0.5 * step * step * q_ddot);
    EXPECT_THAT(now.T_base_sensor, PoseNear(forward_kinematics(chain, q), 1e-13));
    EXPECT_THAT(now.velocity_base, EntriesNear((after.translation() - before.translation()) / (2.0 * step), 1e-6));
    EXPECT_THAT(now.angular_velocity_sensor,
                EntriesNear(rotation_log(before.linear().transpose() * after.linear()) / (2.0 * step), 1e-6));
    const FrameMotion previous = at(-step);
    const FrameMotion next = at(step);
    EXPECT_THAT(now.acceleration_base, EntriesNear((next.velocity_base - previous.velocity_base) / (2.0 * step), 1e-5));
    // d/dt of the components in the sensor frame is the angular acceleration in that frame: omega x omega is zero.
    EXPECT_THAT(now.angular_acceleration_sensor,
                EntriesNear((next.angular_velocity_sensor - previous.angular_velocity_sensor) / (2.0 * step), 1e-6));
  }
}

TEST(ScrewChain, RestingSensorReadsGravityUpwards) {
  support::Random random(3);
  const ScrewChain chain = support::random_arm(random);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(chain.size());
  const Eigen::VectorXd q = random.vector(chain.size(), 2.0);
  const Eigen::Vector3d up(0.0, 0.0, standard_gravity);
  const Eigen::Vector3d expected = forward_kinematics(chain, q).linear().transpose() * up;
  EXPECT_THAT(specific_force(frame_motion(chain, q, zero, zero), up), EntriesNear(expected, 1e-12));
}

TEST(ScrewChain, AxisInSensorFrameDoesNotMoveWithItsOwnOrEarlierJoints) {
  support::Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const ScrewChain chain = support::random_arm(random, 6);
    const Eigen::VectorXd q = random.vector(6, 2.0);
    const Index joint = random.integer(0, 5);
    Eigen::VectorXd moved = q;
    moved.head(joint + 1) = random.vector(joint + 1, 2.0);
    EXPECT_THAT(axis_in_sensor_frame(chain, joint, moved).line, LineNear(axis_in_sensor_frame(chain, joint, q).line, 1e-12));
    const RigidTransform T_base_sensor = forward_kinematics(chain, chain.reference_configuration);
    const Line back = transform(T_base_sensor, axis_in_sensor_frame(chain, joint, chain.reference_configuration).line);
    EXPECT_THAT(back, LineNear(chain.axes[static_cast<std::size_t>(joint)].line, 1e-12));
  }
}

TEST(ScrewChain, RebaseKeepsTheMotion) {
  support::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const ScrewChain moved = rebase(chain, random.vector(chain.size(), 2.0));
    EXPECT_TRUE(moved.home.isApprox(RigidTransform::Identity()));
    const RigidTransform T_base_new = forward_kinematics(chain, moved.reference_configuration);
    const Eigen::VectorXd q = random.vector(chain.size(), 2.0);
    EXPECT_THAT(T_base_new * forward_kinematics(moved, q), PoseNear(forward_kinematics(chain, q), 1e-11));
  }
}

TEST(ScrewChain, RowsOfPosesAreThePoses) {
  support::Random random(6);
  const ScrewChain chain = support::random_arm(random, 5);
  const SamplesX q = SamplesX::NullaryExpr(20, 5, [&] { return random.normal(); });
  const SamplesX poses = forward_kinematics_rows(chain, q);
  ASSERT_EQ(poses.cols(), 16);
  for (Index i = 0; i < q.rows(); ++i) {
    const Eigen::Matrix4d pose = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(poses.row(i).data());
    EXPECT_THAT(pose, EntriesNear(forward_kinematics(chain, q.row(i).transpose()).matrix(), 1e-15));
  }
}

TEST(ScrewChain, WrongSizesAreRefused) {
  support::Random random(7);
  const ScrewChain chain = support::random_arm(random, 4);
  const Eigen::VectorXd three = Eigen::VectorXd::Zero(3);
  const Eigen::VectorXd four = Eigen::VectorXd::Zero(4);
  EXPECT_THROW(forward_kinematics(chain, three), InvalidInput);
  EXPECT_THROW(forward_kinematics_rows(chain, SamplesX::Zero(2, 3)), InvalidInput);
  EXPECT_THROW(frame_motion(chain, four, three, four), InvalidInput);
  EXPECT_THROW(frame_motion(chain, four, four, three), InvalidInput);
  EXPECT_THROW(axis_in_sensor_frame(chain, 4, four), InvalidInput);
  EXPECT_THROW(rebase(chain, three), InvalidInput);
  EXPECT_THROW(rebase(ScrewChain{}, three), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
