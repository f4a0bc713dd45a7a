#include "circlepoint/geometry/rigid_transform.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;

constexpr double pi = std::numbers::pi;

TEST(RotationExp, IsTheMatrixExponentialAtEveryAngle) {
  support::Random random(1);
  for (const double angle : {0.0, 1e-12, 1e-8, 9e-5, 1.1e-4, 1e-2, 1.0, pi - 1e-9, pi, 5.0}) {
    const Eigen::Vector3d rotation = angle * random.unit();
    EXPECT_THAT(rotation_exp(rotation), EntriesNear(Eigen::Matrix3d(skew(rotation).exp()), 1e-14)) << angle;
  }
}

TEST(RotationLog, InvertsTheExponentialUpToHalfATurn) {
  support::Random random(2);
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-4, 1.0, 3.0, pi - 1e-7}) {
    const Eigen::Vector3d rotation = angle * random.unit();
    EXPECT_THAT(rotation_log(rotation_exp(rotation)), EntriesNear(rotation, 1e-14)) << angle;
  }
  const Eigen::Vector3d half_turn = rotation_log(rotation_exp(pi * Eigen::Vector3d(0.6, -0.8, 0.0)));
  EXPECT_NEAR(half_turn.norm(), pi, 1e-14);
  EXPECT_NEAR(std::abs(half_turn.dot(Eigen::Vector3d(0.6, -0.8, 0.0))), pi, 1e-14);
}

TEST(Skew, IsTheCrossProduct) {
  support::Random random(3);
  const Eigen::Vector3d u = random.vector();
  const Eigen::Vector3d v = random.vector();
  EXPECT_THAT(skew(u) * v, EntriesNear(u.cross(v), 1e-15));
}

TEST(TangentBasis, CompletesARightHandedFrame) {
  support::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d z = trial == 0 ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : random.unit();
    Eigen::Matrix3d frame;
    frame << tangent_basis(z), z;
    EXPECT_THAT(frame * frame.transpose(), EntriesNear(Eigen::Matrix3d::Identity(), 1e-14));
    EXPECT_GT(frame.determinant(), 0.0);
  }
  EXPECT_THAT(tangent_basis(Eigen::Vector3d::UnitZ()).col(0), EntriesNear(Eigen::Vector3d::UnitX(), 0.0));
}

TEST(MakeRigidTransform, TakesRigidMatricesAndRefusesOthers) {
  support::Random random(5);
  const Eigen::Matrix4d rigid = random.pose().matrix();
  EXPECT_THAT(make_rigid_transform(rigid).matrix(), EntriesNear(rigid, 0.0));
  const auto altered = [&](Index row, Index column, double by) {
    Eigen::Matrix4d matrix = rigid;
    matrix(row, column) += by;
    return matrix;
  };
  EXPECT_THROW(make_rigid_transform(altered(0, 0, 1e-6)), InvalidInput);
  EXPECT_NO_THROW(make_rigid_transform(altered(0, 0, 1e-6), 1e-5));
  EXPECT_THROW(make_rigid_transform(altered(3, 0, 1e-6)), InvalidInput);
  EXPECT_THROW(make_rigid_transform(altered(1, 3, std::numeric_limits<double>::quiet_NaN())), InvalidInput);
  Eigen::Matrix4d mirrored = rigid;
  mirrored.col(2) *= -1.0;
  EXPECT_THROW(make_rigid_transform(mirrored), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
