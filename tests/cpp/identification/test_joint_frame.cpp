#include "circlepoint/identification/joint_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

TEST(JointFrame, IsRightHandedWithTheAxisThird) {
  support::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d z = random.unit();
    const Eigen::Matrix3d R = joint_frame(random.uniform(0.1, 5.0) * z);
    EXPECT_THAT(R.col(2), support::EntriesNear(z, 1e-15));
    EXPECT_THAT(R.transpose() * R, support::EntriesNear(Eigen::Matrix3d::Identity(), 1e-14));
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
  }
}

TEST(JointFrame, XIsThePartOfTheSensorsXOrthogonalToTheAxis) {
  const Eigen::Vector3d z = Eigen::Vector3d(0.5, -0.7, 0.6).normalized();
  const Eigen::Vector3d across = Eigen::Vector3d::UnitX() - z.x() * z;
  EXPECT_THAT(joint_frame(z).col(0), support::EntriesNear(across.normalized(), 1e-15));
}

TEST(JointFrame, AnAxisAlongTheSensorsXTakesItsY) {
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(-3.0, 0.1, -0.2)}) {
    const Eigen::Vector3d z = axis.normalized();
    const Eigen::Vector3d across = Eigen::Vector3d::UnitY() - z.y() * z;
    EXPECT_THAT(joint_frame(axis).col(0), support::EntriesNear(across.normalized(), 1e-15));
  }
}

TEST(JointFrame, AZeroDirectionIsRefused) { EXPECT_THROW(joint_frame(Eigen::Vector3d::Zero()), InvalidInput); }

}  // namespace
}  // namespace circlepoint
