#include "circlepoint/simulation/excitation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

const Eigen::Vector3d start(0.1, -0.2, 0.3);

TEST(Excitation, RaisedCosineIsEquation11) {
  const JointTrajectory motion = joint_trajectory(start, {RaisedCosine{1, 2.6, 0.5, 6.0}}, 250.0);
  ASSERT_EQ(motion.samples(), 1501);
  for (Index i = 0; i + 1 < motion.samples(); ++i) {
    const double phase = 2.0 * std::numbers::pi * 0.5 * motion.time[i];
    EXPECT_NEAR(motion.position(i, 1), -0.2 + 2.6 * (1.0 - std::cos(phase)) / 2.0, 1e-13);
    EXPECT_EQ(motion.position(i, 0), 0.1);
    EXPECT_EQ(motion.velocity(i, 2), 0.0);
  }
}

TEST(Excitation, DerivativesAreThoseOfThePosition) {
  const std::vector<Excitation> pieces{
      PointToPointMove{Eigen::Vector3d(1.0, 0.5, -1.0), 1.3}, SteppedSweep{.joint = 2, .steps = 4, .span = -0.7},
      MultiJointMotion{.duration = 8.0, .amplitude = Eigen::Vector3d(1.0, 0.5, 0.2), .seed = 3},
      RaisedCosine{0, 1.0, 0.5, 2.0}};
  const double rate = 2000.0;
  const JointTrajectory motion = joint_trajectory(start, pieces, rate, 0.25);
  for (Index i = 1; i + 1 < motion.samples(); ++i) {
    const Eigen::RowVectorXd velocity = (motion.position.row(i + 1) - motion.position.row(i - 1)) * rate / 2.0;
    const Eigen::RowVectorXd acceleration = (motion.velocity.row(i + 1) - motion.velocity.row(i - 1)) * rate / 2.0;
    EXPECT_LT((velocity - motion.velocity.row(i)).cwiseAbs().maxCoeff(), 2e-3) << motion.time[i];
    const bool at_a_step_of_acceleration =
        (motion.acceleration.row(i + 1) - motion.acceleration.row(i - 1)).cwiseAbs().maxCoeff() > 1.0;
    if (!at_a_step_of_acceleration) {
      EXPECT_LT((acceleration - motion.acceleration.row(i)).cwiseAbs().maxCoeff(), 0.05) << motion.time[i];
    }
  }
}

TEST(Excitation, PiecesBeginWhereTheLastEndedAndEverythingEndsAtRest) {
  const JointTrajectory motion =
      joint_trajectory(start, {SteppedSweep{.joint = 0, .steps = 3, .span = 1.0, .return_duration = 0.0},
                               PointToPointMove{Eigen::Vector3d(1.0, 1.0, 1.0), 1.0}}, 100.0);
  const Index last = motion.samples() - 1;
  EXPECT_NEAR(motion.time[last], 3 * 0.8 + 2 * 0.6 + 1.0, 1e-12);
  EXPECT_NEAR(motion.position(360, 0), 1.1, 1e-12);
  EXPECT_LT((motion.position.row(last).array() - 1.0).abs().maxCoeff(), 1e-15);
  EXPECT_EQ(motion.velocity.row(last).norm(), 0.0);
  EXPECT_EQ(motion.acceleration.row(last).norm(), 0.0);
}

TEST(Excitation, MultiJointMotionStaysWithinItsAmplitudeAndMovesEveryJoint) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::Vector3d amplitude(0.3, 1.0, 2.0);
    const JointTrajectory motion =
        joint_trajectory(start, {MultiJointMotion{.duration = 30.0, .amplitude = amplitude, .seed = seed}}, 100.0);
    const SamplesX away = motion.position.rowwise() - start.transpose();
    for (Index j = 0; j < 3; ++j) {
      EXPECT_LE(away.col(j).cwiseAbs().maxCoeff(), amplitude[j]);
      EXPECT_GT(away.col(j).cwiseAbs().maxCoeff(), 0.3 * amplitude[j]);
    }
  }
}

TEST(Excitation, AtAStepOfAccelerationTheTrapezoidIntegralIsTheVelocity) {
  const double rate = 100.0;
  const JointTrajectory motion = joint_trajectory(start, {Dwell{0.5}, RaisedCosine{0, 2.6, 0.5, 2.0}, Dwell{0.5}}, rate);
  double integral = 0.0;
  double worst = 0.0;
  for (Index i = 1; i < motion.samples(); ++i) {
    integral += 0.5 * (motion.acceleration(i - 1, 0) + motion.acceleration(i, 0)) / rate;
    if (i != 50 && i != 250) {
      worst = std::max(worst, std::abs(integral - motion.velocity(i, 0)));
    }
  }
  const double peak = 1.3 * std::pow(std::numbers::pi, 2);
  EXPECT_NEAR(motion.acceleration(50, 0), 0.5 * peak, 1e-9);
  EXPECT_NEAR(motion.acceleration(250, 0), 0.5 * peak, 1e-9);
  EXPECT_LT(worst, 0.01 * peak / rate);
}

TEST(Excitation, AFractionalNumberOfCyclesIsRefused) {
  EXPECT_THROW(joint_trajectory(start, {RaisedCosine{0, 1.0, 0.5, 5.0}}, 100.0), InvalidInput);
  EXPECT_THROW(joint_trajectory(start, {RaisedCosine{3, 1.0, 0.5, 6.0}}, 100.0), InvalidInput);
  EXPECT_THROW(joint_trajectory(start, {Dwell{-1.0}}, 100.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
