#include "circlepoint/geometry/screw_axis.hpp"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::PoseNear;

Eigen::Matrix4d twist_matrix(const Eigen::Matrix<double, 6, 1>& twist) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix.topLeftCorner<3, 3>() = skew(twist.head<3>());
  matrix.topRightCorner<3, 1>() = twist.tail<3>();
  return matrix;
}

TEST(ScrewExp, IsTheMatrixExponentialOfTheTwist) {
  support::Random random(1);
  for (const JointType type : {JointType::revolute, JointType::prismatic}) {
    for (int trial = 0; trial < 50; ++trial) {
      const ScrewAxis axis{type, make_line(random.unit(), random.vector())};
      const double q = random.uniform(-3.0, 3.0);
      const Eigen::Matrix4d expected = (q * twist_matrix(axis.twist())).exp();
      EXPECT_THAT(screw_exp(axis, q).matrix(), EntriesNear(expected, 1e-12));
    }
  }
}

TEST(ScrewExp, TransformsAsAConjugation) {
  support::Random random(2);
  for (const JointType type : {JointType::revolute, JointType::prismatic}) {
    const ScrewAxis axis_b{type, make_line(random.unit(), random.vector())};
    const RigidTransform T_a_b = random.pose();
    EXPECT_THAT(screw_exp(transform(T_a_b, axis_b), 0.7), PoseNear(T_a_b * screw_exp(axis_b, 0.7) * T_a_b.inverse(), 1e-13));
  }
}

}  // namespace
}  // namespace circlepoint
