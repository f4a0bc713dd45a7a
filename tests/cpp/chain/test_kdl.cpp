#include "circlepoint/chain/kdl.hpp"

#include <gtest/gtest.h>

#include <kdl/chainfksolvervel_recursive.hpp>
#include <kdl/chainjnttojacdotsolver.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;

Eigen::Vector3d as_eigen(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }

TEST(Kdl, FramesGoThereAndBack) {
  support::Random random(1);
  const RigidTransform pose = random.pose();
  EXPECT_THAT(from_kdl(to_kdl(pose)), support::PoseNear(pose, 0.0));
}

TEST(Kdl, FrameVelocityIsThatOfFrameMotion) {
  support::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const Index n = chain.size();
    const Eigen::VectorXd q = random.vector(n, 2.0);
    const Eigen::VectorXd q_dot = random.vector(n, 2.0);
    const FrameMotion motion = frame_motion(chain, q, q_dot, Eigen::VectorXd::Zero(n));
    const KDL::Chain kdl_chain = to_kdl(chain);
    KDL::ChainFkSolverVel_recursive solver(kdl_chain);
    KDL::JntArrayVel joints(static_cast<unsigned int>(n));
    joints.q.data = q;
    joints.qdot.data = q_dot;
    KDL::FrameVel frame;
    ASSERT_EQ(solver.JntToCart(joints, frame), 0);
    EXPECT_THAT(motion.velocity_base, EntriesNear(as_eigen(frame.p.v), 1e-10));
    EXPECT_THAT(motion.angular_velocity_sensor,
                EntriesNear(motion.T_base_sensor.linear().transpose() * as_eigen(frame.M.w), 1e-10));
  }
}

TEST(Kdl, FrameAccelerationIsThatOfFrameMotion) {
  support::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    // KDL's derivative of the Jacobian knows revolute joints only.
    const ScrewChain chain = support::random_arm(random, 0, {.prismatic = 0.0, .special = 0.5});
    const Index n = chain.size();
    const Eigen::VectorXd q = random.vector(n, 2.0);
    const Eigen::VectorXd q_dot = random.vector(n, 2.0);
    const Eigen::VectorXd q_ddot = random.vector(n, 2.0);
    const FrameMotion motion = frame_motion(chain, q, q_dot, q_ddot);
    const KDL::Chain kdl_chain = to_kdl(chain);
    KDL::ChainJntToJacSolver jacobian_solver(kdl_chain);
    KDL::ChainJntToJacDotSolver derivative_solver(kdl_chain);
    KDL::JntArrayVel joints(static_cast<unsigned int>(n));
    joints.q.data = q;
    joints.qdot.data = q_dot;
    KDL::Jacobian jacobian(static_cast<unsigned int>(n));
    KDL::Jacobian derivative(static_cast<unsigned int>(n));
    ASSERT_EQ(jacobian_solver.JntToJac(joints.q, jacobian), 0);
    ASSERT_EQ(derivative_solver.JntToJacDot(joints, derivative), 0);
    const Eigen::VectorXd acceleration = jacobian.data * q_ddot + derivative.data * q_dot;
    EXPECT_THAT(motion.acceleration_base, EntriesNear(acceleration.head<3>(), 1e-9));
    EXPECT_THAT(motion.angular_acceleration_sensor,
                EntriesNear(motion.T_base_sensor.linear().transpose() * acceleration.tail<3>(), 1e-9));
  }
}

}  // namespace
}  // namespace circlepoint
