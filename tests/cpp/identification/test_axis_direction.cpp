#include "circlepoint/identification/axis_direction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "support/joint_motion.hpp"
#include "support/matchers.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::OneJoint;
using support::Random;

double angle_between_axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::asin(std::min(1.0, a.cross(b).norm())); }

TEST(AxisDirection, ClosedFormFindsTheAxisOfExactPosesWhateverTheBias) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    OneJoint joint = support::random_joint(random);
    joint.bias = random.vector();
    const AxisDirectionFit fit = fit_axis_direction(support::readings(joint, support::still_poses(12, -1.0, 2.0)));
    EXPECT_LT(angle_between_axes(fit.direction, joint.axis), 1e-7);
    EXPECT_NEAR(fit.offset, fit.direction.dot(joint.up_gravity + joint.bias), 1e-6);
    EXPECT_LT(fit.residual_std, 1e-6);
    EXPECT_LE(fit.spread[0], fit.spread[1]);
    EXPECT_LE(fit.spread[1], fit.spread[2]);
  }
}

TEST(AxisDirection, CovarianceIsTheSpreadOfRepeatedTests) {
  Random random(2);
  const OneJoint joint = support::random_joint(random);
  const Samples3 exact = support::readings(joint, support::still_poses(20, 0.0, 2.0));
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(joint.axis);
  Eigen::Matrix2d predicted = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    Samples3 noisy = exact;
    support::add_noise(noisy, 5e-3, random);
    const AxisDirectionFit fit = fit_axis_direction(noisy);
    const double sign = fit.direction.dot(joint.axis) > 0.0 ? 1.0 : -1.0;
    const Eigen::Vector2d error = basis.transpose() * (sign * fit.direction);
    spread += error * error.transpose() / trials;
    const Eigen::Matrix2d turn = basis.transpose() * tangent_basis(fit.direction);
    predicted += turn * fit.covariance * turn.transpose() / trials;
  }
  // 4000 trials know a variance to 2 %.
  EXPECT_NEAR(predicted(0, 0) / spread(0, 0), 1.0, 0.15);
  EXPECT_NEAR(predicted(1, 1) / spread(1, 1), 1.0, 0.15);
  EXPECT_NEAR((predicted(0, 1) - spread(0, 1)) / std::sqrt(spread(0, 0) * spread(1, 1)), 0.0, 0.15);
}

TEST(AxisDirection, RobustFitResistsAKnockThatTurnsTheClosedForm) {
  Random random(3);
  const OneJoint joint = support::random_joint(random);
  Samples3 poses = support::readings(joint, support::still_poses(40, 0.0, 2.5));
  support::add_noise(poses, 5e-4, random);
  for (const Index knocked : {3, 4, 30}) {
    poses.row(knocked) += 0.3 * joint.axis.transpose();
  }
  const AxisDirectionFit plain = fit_axis_direction(poses);
  const AxisDirectionFit robust = fit_axis_direction_robust(poses);
  EXPECT_GT(angle_between_axes(plain.direction, joint.axis), 2e-3);
  EXPECT_LT(angle_between_axes(robust.direction, joint.axis), 1e-4);
  EXPECT_TRUE(robust.converged);
  EXPECT_LT(robust.weights(Eigen::VectorXi{{3, 4, 30}}).maxCoeff(), 0.01);
  EXPECT_GT(robust.weights[10], 0.5);
}

TEST(AxisDirection, RobustFitOfCleanPosesIsTheClosedForm) {
  Random random(4);
  const OneJoint joint = support::random_joint(random);
  Samples3 poses = support::readings(joint, support::still_poses(60, 0.0, 2.5));
  support::add_noise(poses, 5e-4, random);
  const AxisDirectionFit plain = fit_axis_direction(poses);
  const AxisDirectionFit robust = fit_axis_direction_robust(poses);
  EXPECT_LT(angle_between_axes(plain.direction, robust.direction), 0.5 * std::sqrt(plain.covariance.trace()));
  EXPECT_NEAR(std::abs(robust.offset), std::abs(plain.offset), 1e-3);
  EXPECT_NEAR(robust.covariance.trace() / plain.covariance.trace(), 1.0, 0.3);
}

TEST(AxisDirection, ThePapersChartFindsTheMinimumOfTheSphereAwayFromItsEdge) {
  Random random(8);
  const RobustOptions chart{std::numeric_limits<double>::infinity(), 50, AxisChart::hemisphere};
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const OneJoint joint = support::random_joint(random);
    if (std::abs(joint.axis.z()) < 0.3) {
      continue;
    }
    ++compared;
    Samples3 poses = support::readings(joint, support::still_poses(60, 0.0, 2.5));
    support::add_noise(poses, 5e-4, random);
    const AxisDirectionFit fit = fit_axis_direction_robust(poses, chart);
    EXPECT_TRUE(fit.converged);
    EXPECT_LT(angle_between_axes(fit.direction, fit_axis_direction(poses).direction), 1e-7);
  }
  EXPECT_GT(compared, 15);
}

TEST(AxisDirection, ThePapersChartSaysSoWhereItDoesNotArrive) {
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    OneJoint joint = support::random_joint(random);
    joint.axis.z() = 0.0;
    joint.axis.normalize();
    Samples3 poses = support::readings(joint, support::still_poses(60, 0.0, 2.5));
    support::add_noise(poses, 5e-4, random);
    const AxisDirectionFit fit =
        fit_axis_direction_robust(poses, {std::numeric_limits<double>::infinity(), 50, AxisChart::hemisphere});
    const double angle = angle_between_axes(fit.direction, fit_axis_direction(poses).direction);
    EXPECT_TRUE(!fit.converged || angle < 1e-3) << angle;
  }
}

TEST(AxisDirection, ALossScaleMustBePositive) {
  Random random(10);
  const Samples3 poses = support::readings(support::random_joint(random), support::still_poses(9, 0.0, 2.0));
  EXPECT_THROW(fit_axis_direction_robust(poses, {0.0, 50}), InvalidInput);
  EXPECT_THROW(fit_axis_direction_robust(poses, {std::nan(""), 50}), InvalidInput);
}

TEST(AxisDirection, AxisParallelToGravityIsNotIdentifiable) {
  Random random(5);
  OneJoint joint = support::random_joint(random);
  joint.up_gravity = standard_gravity * joint.axis;
  Samples3 poses = support::readings(joint, support::still_poses(30, 0.0, 2.5));
  EXPECT_THROW(fit_axis_direction(poses), NotIdentifiable);
  EXPECT_THROW(fit_axis_direction_robust(poses), NotIdentifiable);
  support::add_noise(poses, 5e-4, random);
  EXPECT_THROW(fit_axis_direction(poses), NotIdentifiable);
  EXPECT_THROW(fit_axis_direction_robust(poses), NotIdentifiable);
}

TEST(AxisDirection, TooFewOrBrokenPosesAreRefused) {
  Random random(6);
  Samples3 poses = support::readings(support::random_joint(random), support::still_poses(5, 0.0, 2.0));
  EXPECT_THROW(fit_axis_direction(poses.topRows(2)), InvalidInput);
  poses(3, 1) = std::nan("");
  try {
    fit_axis_direction_robust(poses);
    FAIL() << "a pose that is not finite was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("row 3"), std::string::npos) << error.what();
  }
}

TEST(AxisDirection, OrientationFollowsTheSenseOfTheJoint) {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const OneJoint joint = support::random_joint(random);
    const support::OneJointMotion sweep = support::still_poses(8, random.uniform(-3.0, 3.0), random.chance(0.5) ? 1.0 : -1.0);
    Samples3 poses = support::readings(joint, sweep);
    support::add_noise(poses, 1e-3, random);
    EXPECT_EQ(orient_axis(joint.axis, sweep.angle, poses), joint.axis);
    EXPECT_EQ(orient_axis(-joint.axis, sweep.angle, poses), joint.axis);
    EXPECT_EQ(orient_axis(joint.axis, -sweep.angle, poses), -joint.axis);
    EXPECT_THROW(orient_axis(joint.axis, sweep.angle.head(5), poses), InvalidInput);
  }
}

}  // namespace
}  // namespace circlepoint
