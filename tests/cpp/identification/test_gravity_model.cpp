#include "circlepoint/identification/gravity_model.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "circlepoint/core/error.hpp"
#include "support/joint_motion.hpp"
#include "support/matchers.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::Random;

TEST(GravityModel, IsTheRestingReadingAtAnglesThatWereNotVisited) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    support::OneJoint joint = support::random_joint(random);
    joint.bias = 0.1 * random.vector();
    const auto visited = support::still_poses(3, random.uniform(-2.0, 2.0), 1.5);
    const GravityModel model = fit_gravity_model(visited.angle, support::readings(joint, visited));
    const auto others = support::still_poses(50, -3.0, 6.0);
    EXPECT_THAT(model.evaluate(others.angle), EntriesNear(support::readings(joint, others), 1e-11));
    EXPECT_THAT(model.constant, EntriesNear(joint.axis.dot(joint.up_gravity) * joint.axis + joint.bias, 1e-11));
    EXPECT_THAT(model.sine, EntriesNear(-joint.axis.cross(model.cosine), 1e-11));
  }
}

TEST(GravityModel, CovarianceIsTheSpreadOfRepeatedTests) {
  Random random(2);
  const auto sweep = support::still_poses(16, 0.0, 2.6);
  const Samples3 exact = support::readings(support::random_joint(random), sweep);
  const GravityModel truth = fit_gravity_model(sweep.angle, exact);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d predicted = Eigen::Matrix3d::Zero();
  constexpr int trials = 1500;
  for (int trial = 0; trial < trials; ++trial) {
    Samples3 noisy = exact;
    support::add_noise(noisy, 2e-3, random);
    const GravityModel model = fit_gravity_model(sweep.angle, noisy);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d error(model.constant[k] - truth.constant[k], model.cosine[k] - truth.cosine[k],
                                  model.sine[k] - truth.sine[k]);
      spread += error * error.transpose() / (3.0 * trials);
    }
    predicted += model.covariance / trials;
  }
  EXPECT_THAT(predicted.cwiseQuotient(spread), EntriesNear(Eigen::Matrix3d::Ones(), 0.15));
}

TEST(GravityModel, FewerThanThreeDistinctAnglesAreNotIdentifiable) {
  Random random(3);
  const support::OneJoint joint = support::random_joint(random);
  auto poses = support::still_poses(6, 0.0, 1.0);
  poses.angle << 0.2, 0.2, 0.9, 0.9, 0.2, 0.9;
  EXPECT_THROW(fit_gravity_model(poses.angle, support::readings(joint, poses)), NotIdentifiable);
  poses.angle << 0.2, 0.9, 0.2 + 2.0 * std::numbers::pi, 0.9, 0.2, 0.9 - 2.0 * std::numbers::pi;
  EXPECT_THROW(fit_gravity_model(poses.angle, support::readings(joint, poses)), NotIdentifiable);
  EXPECT_THROW(fit_gravity_model(poses.angle.head(2), support::readings(joint, poses).topRows(2)), NotIdentifiable);
}

TEST(GravityModel, UnequalLengthsAreRefused) {
  EXPECT_THROW(fit_gravity_model(Eigen::VectorXd::LinSpaced(4, 0.0, 1.0), Samples3::Ones(5, 3)), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
