#include "circlepoint/geometry/joint_axis.hpp"

#include <gtest/gtest.h>

#include <random>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

TEST(JointAxis, LocalCoordinatesInvertRetract) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto vector3 = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (int trial = 0; trial < 1000; ++trial) {
    const Line line = make_line(vector3(), vector3());
    const Line other = make_line(line.direction + 0.2 * vector3(), line.point + 0.2 * vector3());
    const Line back = retract(line, local_coordinates(line, other));
    EXPECT_LT((back.direction - other.direction).norm(), 1e-12);
    EXPECT_LT((back.point - other.point).norm(), 1e-11);
  }
}

TEST(JointAxis, LocalCoordinatesOfTheLineItselfAreZeroAndTheirUnitsAreRadAndMetre) {
  const Line line = make_line(Eigen::Vector3d(0.3, -0.2, 0.9), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_TRUE(local_coordinates(line, line).isZero(1e-15));
  const Line turned = retract(line, Eigen::Vector4d(0.3, 0.4, 0.0, 0.0));
  EXPECT_NEAR(std::acos(turned.direction.dot(line.direction)), 0.5, 1e-14);
  const Line shifted = retract(line, Eigen::Vector4d(0.0, 0.0, 0.3, 0.4));
  EXPECT_NEAR((shifted.point - line.point).norm(), 0.5, 1e-14);
}

TEST(JointAxis, LocalCoordinatesAtRightAnglesAreRefused) {
  const Line line = make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  const Line across = make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero());
  EXPECT_THROW(local_coordinates(line, across), InvalidInput);
}

TEST(JointAxis, JacobianOfATransformIsItsDifferenceQuotient) {
  support::Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const ScrewAxis axis_b{JointType::revolute, make_line(random.unit(), random.vector())};
    const RigidTransform T_a_b = random.pose();
    const Line line_a = transform(T_a_b, axis_b.line);
    const Eigen::Matrix4d jacobian = local_coordinates_jacobian(T_a_b, axis_b);
    for (int k = 0; k < 4; ++k) {
      const auto moved = [&](double by) {
        return local_coordinates(line_a, transform(T_a_b, retract(axis_b.line, by * Eigen::Vector4d::Unit(k))));
      };
      EXPECT_THAT(jacobian.col(k), support::EntriesNear((moved(1e-5) - moved(-1e-5)) / 2e-5, 1e-8));
    }
  }
}

TEST(JointAxis, CovarianceGoesThereAndBackUnderATransform) {
  support::Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Matrix4d root = Eigen::Matrix4d::NullaryExpr([&] { return random.normal(); });
    JointAxis axis{{JointType::revolute, make_line(random.unit(), random.vector())}, root * root.transpose()};
    const RigidTransform T_a_b = random.pose();
    const JointAxis there = transform(T_a_b, axis);
    EXPECT_NEAR(there.direction_std(), axis.direction_std(), 1e-12);
    EXPECT_THAT(transform(T_a_b.inverse(), there).covariance, support::EntriesNear(axis.covariance, 1e-10));
  }
}

TEST(JointAxis, PrismaticAxisHasNoCovarianceOfItsPointInAnyFrame) {
  support::Random random(4);
  JointAxis axis{{JointType::prismatic, make_line(random.unit(), random.vector())}, Eigen::Matrix4d::Zero()};
  axis.covariance(0, 0) = axis.covariance(1, 1) = 4e-6;
  const JointAxis there = transform(random.pose(), axis);
  EXPECT_NEAR(there.direction_std(), 2e-3, 1e-15);
  EXPECT_EQ(there.point_std(), 0.0);
}

}  // namespace
}  // namespace circlepoint
