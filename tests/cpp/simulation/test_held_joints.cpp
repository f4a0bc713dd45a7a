#include "circlepoint/simulation/held_joints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

JointTrajectory step_then_rest() {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(2);
  return joint_trajectory(start, {PointToPointMove{Eigen::Vector2d(0.2, 0.1), 0.3}, Dwell{6.0}}, 1000.0);
}

TEST(HeldJoints, OscillationsDecayToTwoPercentInTheSettlingTime) {
  const JointTrajectory commanded = step_then_rest();
  const JointTrajectory actual = follow(commanded, {.natural_frequency = Eigen::Vector2d(4.0, 0.0)});
  const Eigen::VectorXd error = actual.position.col(0) - commanded.position.col(0);
  const double early = error.segment(300, 300).cwiseAbs().maxCoeff();
  const double settled = error.segment(3300, 300).cwiseAbs().maxCoeff();
  EXPECT_GT(early, 1e-3);
  EXPECT_NEAR(settled / early, std::exp(-4.0), 0.15 * std::exp(-4.0));
  EXPECT_EQ(actual.position.col(1), commanded.position.col(1));
}

TEST(HeldJoints, DerivativesAreThoseOfThePosition) {
  const JointTrajectory actual = follow(step_then_rest(), {.natural_frequency = Eigen::Vector2d(3.0, 6.0)});
  const Index n = actual.samples();
  const SamplesX velocity = (actual.position.bottomRows(n - 2) - actual.position.topRows(n - 2)) * 500.0;
  const SamplesX acceleration = (actual.velocity.bottomRows(n - 2) - actual.velocity.topRows(n - 2)) * 500.0;
  EXPECT_LT((velocity - actual.velocity.middleRows(1, n - 2)).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((acceleration - actual.acceleration.middleRows(1, n - 2)).cwiseAbs().maxCoeff(), 0.05);
}

TEST(HeldJoints, ImpossibleLoopsAreRefused) {
  const JointTrajectory commanded = step_then_rest();
  EXPECT_THROW(follow(commanded, {.natural_frequency = Eigen::Vector3d(1.0, 1.0, 1.0)}), InvalidInput);
  EXPECT_THROW(follow(commanded, {.natural_frequency = Eigen::Vector2d(0.1, 1.0)}), InvalidInput);
  EXPECT_THROW(joint_compliance(Eigen::Vector2d(1.0, 0.0), 1.0), InvalidInput);
  EXPECT_NEAR(joint_compliance(Eigen::Vector2d(100.0, 200.0), 2.0)[1], 0.01, 1e-16);
}

}  // namespace
}  // namespace circlepoint
