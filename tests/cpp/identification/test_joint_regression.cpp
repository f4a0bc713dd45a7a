#include "circlepoint/identification/joint_regression.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "support/joint_motion.hpp"
#include "support/matchers.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::OneJoint;
using support::OneJointMotion;
using support::Random;

Regressors regressors_of(const OneJointMotion& motion) { return joint_regressors(motion.angle, motion.rate, motion.acceleration); }

JointModel model_of(const OneJoint& joint) {
  const Eigen::Vector3d along = joint.axis.dot(joint.up_gravity) * joint.axis;
  return {joint.axis, joint.lever, joint.up_gravity - along, along + joint.bias,
          Eigen::Vector3d::Constant(joint.percussion_distance)};
}

// A part of a test, weighted by 1 / noise^2.
RegressionStatistics part(const OneJoint& joint, const OneJointMotion& motion, double noise, Random* random = nullptr) {
  RegressionStatistics statistics;
  Samples3 readings = support::readings(joint, motion);
  if (random != nullptr) {
    support::add_noise(readings, noise, *random);
  }
  statistics.add(regressors_of(motion), readings, 1.0 / (noise * noise));
  return statistics;
}

// A sweep and eq. (11).
RegressionStatistics whole_test(const OneJoint& joint, double noise = 1e-3, Random* random = nullptr) {
  RegressionStatistics statistics = part(joint, support::still_poses(16, -1.2, 2.4), noise, random);
  statistics += part(joint, support::raised_cosine(-1.2, 2.4, 0.5, 3, 100.0), noise, random);
  return statistics;
}

Eigen::Matrix4d line_covariance(const JointModelMatrix& information) {
  const auto selector = JointModelFit::line_selector();
  return selector * information.inverse() * selector.transpose();
}

TEST(JointRegression, CoefficientsTimesRegressorsAreTheReadingsOfRigidBodyKinematics) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    OneJoint joint = support::random_joint(random);
    joint.bias = 0.1 * random.vector();
    joint.percussion_distance = random.uniform(-0.05, 0.05);
    const OneJointMotion motion = support::raised_cosine(random.uniform(-3.0, 3.0), 2.5, 0.7, 2, 50.0);
    const Samples3 modelled = regressors_of(motion) * model_of(joint).coefficients();
    EXPECT_THAT(modelled, EntriesNear(support::readings(joint, motion), 1e-12));
  }
}

TEST(JointRegression, StatisticsOfPiecesAddUp) {
  Random random(2);
  const OneJointMotion motion = support::raised_cosine(0.3, 2.0, 0.5, 2, 100.0);
  const Regressors x = regressors_of(motion);
  Samples3 y = support::readings(support::random_joint(random), motion);
  support::add_noise(y, 0.01, random);
  RegressionStatistics whole;
  whole.add(x, y, 4.0);
  RegressionStatistics pieces;
  RegressionStatistics rest;
  pieces.add(x.topRows(123), y.topRows(123), 4.0);
  rest.add(x.bottomRows(x.rows() - 123), y.bottomRows(x.rows() - 123));
  pieces += rest.scaled(4.0);
  EXPECT_THAT(pieces.information, EntriesNear(whole.information, 1e-9 * whole.information.cwiseAbs().maxCoeff()));
  EXPECT_THAT(pieces.score, EntriesNear(whole.score, 1e-9 * whole.score.cwiseAbs().maxCoeff()));
  EXPECT_THAT(pieces.squares, EntriesNear(whole.squares, 1e-9 * whole.squares.maxCoeff()));
  EXPECT_DOUBLE_EQ(pieces.count, 4.0 * static_cast<double>(x.rows()));
  EXPECT_DOUBLE_EQ(whole.count, pieces.count);
}

TEST(JointRegression, ExactTestsGiveTheirModelBack) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const OneJoint joint = support::random_joint(random);
    const JointModelFit fit = fit_joint_model(whole_test(joint), {});
    const JointModel truth = model_of(joint);
    EXPECT_TRUE(fit.converged);
    EXPECT_LT(fit.cost, 1e-6);
    EXPECT_THAT(fit.model.axis, EntriesNear(truth.axis, 1e-8));
    EXPECT_THAT(fit.model.lever, EntriesNear(truth.lever, 1e-8));
    EXPECT_THAT(fit.model.gravity, EntriesNear(truth.gravity, 1e-7));
    EXPECT_THAT(fit.model.constant, EntriesNear(truth.constant, 1e-7));
    EXPECT_THAT(fit.model.line(), support::LineNear(make_line(joint.axis, -joint.lever), 1e-8));
  }
}

TEST(JointRegression, TheDistanceOfPercussionIsFoundWhereThePriorAllowsIt) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    OneJoint joint = support::random_joint(random);
    joint.percussion_distance = 0.0182;
    const RegressionStatistics statistics = whole_test(joint);
    const JointModelFit free = fit_joint_model(statistics, {.percussion_distance_std = 0.03});
    // Channel k shows its distance by d (1 - z_k^2): not where the axis runs along it.
    const Eigen::Array3d share = 1.0 - joint.axis.array().square();
    EXPECT_THAT((share * free.model.percussion_distance.array()).matrix(), EntriesNear((share * 0.0182).matrix(), 1e-4));
    EXPECT_THAT(free.model.lever, EntriesNear(joint.lever, 1e-4));
    const JointModelFit known = fit_joint_model(statistics, {.percussion_distance = 0.0182});
    EXPECT_THAT(known.model.percussion_distance, EntriesNear(Eigen::Vector3d::Constant(0.0182), 1e-9));
    EXPECT_THAT(known.model.lever, EntriesNear(joint.lever, 1e-7));
    const JointModelFit mistaken = fit_joint_model(statistics, {});
    EXPECT_GT((mistaken.model.lever - joint.lever).norm(), 1e-4);
  }
}

TEST(JointRegression, InformationIsThatOfTheSpreadOfRepeatedTests) {
  Random random(5);
  const OneJoint joint = support::random_joint(random);
  const Line truth = make_line(joint.axis, -joint.lever);
  Eigen::Matrix4d spread = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d predicted = Eigen::Matrix4d::Zero();
  constexpr int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    const JointModelFit fit = fit_joint_model(whole_test(joint, 5e-3, &random), {});
    const Eigen::Vector4d error = local_coordinates(truth, fit.model.line());
    spread += error * error.transpose() / trials;
    predicted += line_covariance(fit.information) / trials;
  }
  // 400 trials know a variance to 7 %.
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(predicted(k, k) / spread(k, k), 1.0, 0.25) << "local coordinate " << k;
  }
}

TEST(JointRegression, AVerticalAxisIsSeenByItsDynamicsAloneAndTheInformationSaysSo) {
  Random random(6);
  OneJoint tilted = support::random_joint(random);
  OneJoint vertical = tilted;
  vertical.up_gravity = standard_gravity * vertical.axis;
  // A bias across the axis reads like a tilt of 5 mrad: only the motion tells.
  vertical.bias = 0.05 * vertical.lever.normalized();
  const JointModelFit fit = fit_joint_model(whole_test(vertical), {.bias_std = 10.0, .gravity_std = 1.0});
  EXPECT_TRUE(fit.converged);
  EXPECT_THAT(fit.model.axis, EntriesNear(vertical.axis, 1e-5));
  EXPECT_THAT(fit.model.lever, EntriesNear(vertical.lever, 1e-5));
  EXPECT_LT(fit.model.gravity.norm(), 1e-3);

  // A thousand times better still poses say nothing more of it, and all of an axis across gravity.
  const auto direction_std = [](const OneJoint& joint, double static_noise) {
    RegressionStatistics statistics = part(joint, support::still_poses(16, -1.2, 2.4), static_noise);
    statistics += part(joint, support::raised_cosine(-1.2, 2.4, 0.5, 3, 100.0), 1e-2);
    const JointModelFit of = fit_joint_model(statistics, {.bias_std = 10.0, .gravity_std = 1.0});
    return std::sqrt(line_covariance(of.information).topLeftCorner<2, 2>().trace());
  };
  EXPECT_GT(direction_std(vertical, 1e-5), 0.5 * direction_std(vertical, 1e-2));
  EXPECT_LT(direction_std(tilted, 1e-5), 0.05 * direction_std(tilted, 1e-2));

  // A prior that knows the bias to be small takes the whole of it for a tilt.
  const JointModelFit misled = fit_joint_model(whole_test(vertical, 1.0), {.bias_std = 1e-5});
  EXPECT_GT(misled.model.axis.dot(vertical.lever.normalized()), 0.5 * 0.05 / standard_gravity);
}

TEST(JointRegression, AJointThatNeverAcceleratesIsNotIdentifiable) {
  Random random(7);
  const OneJointMotion still = support::still_poses(20, 0.0, 2.0);
  RegressionStatistics statistics;
  statistics.add(regressors_of(still), support::readings(support::random_joint(random), still), 1e6);
  EXPECT_THROW(fit_joint_model(statistics, {}), NotIdentifiable);
}

TEST(JointRegression, UnequalLengthsAndPriorsWithoutWidthAreRefused) {
  Random random(8);
  const OneJointMotion still = support::still_poses(20, 0.0, 2.0);
  EXPECT_THROW(joint_regressors(still.angle, still.rate.head(3), still.acceleration), InvalidInput);
  RegressionStatistics statistics;
  EXPECT_THROW(statistics.add(regressors_of(still), Samples3::Zero(19, 3)), InvalidInput);
  EXPECT_THROW(fit_joint_model(whole_test(support::random_joint(random)), {.bias_std = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
