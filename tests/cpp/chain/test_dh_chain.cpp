#include "circlepoint/chain/dh_chain.hpp"

#include <gtest/gtest.h>

#include <kdl/frames.hpp>

#include "circlepoint/chain/kdl.hpp"
#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::PoseNear;

TEST(DhChain, RowsAreKdlsOfTheSameConvention) {
  support::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const DhRow row{random.normal(), random.normal(), random.normal(), random.normal()};
    const double q = random.normal();
    EXPECT_THAT(standard_dh_transform(row, JointType::revolute, q),
                PoseNear(from_kdl(KDL::Frame::DH(row.a, row.alpha, row.d, row.theta + q)), 1e-14));
    EXPECT_THAT(standard_dh_transform(row, JointType::prismatic, q),
                PoseNear(from_kdl(KDL::Frame::DH(row.a, row.alpha, row.d + q, row.theta)), 1e-14));
    EXPECT_THAT(modified_dh_transform(row, JointType::revolute, q),
                PoseNear(from_kdl(KDL::Frame::DH_Craig1989(row.a, row.alpha, row.d, row.theta + q)), 1e-14));
    EXPECT_THAT(modified_dh_transform(row, JointType::prismatic, q),
                PoseNear(from_kdl(KDL::Frame::DH_Craig1989(row.a, row.alpha, row.d + q, row.theta)), 1e-14));
  }
}

TEST(DhChain, BaseAndToolAreOutermost) {
  support::Random random(2);
  auto chain = support::random_dh_arm<ModifiedDhChain>(random, 4);
  const Eigen::VectorXd q = random.vector(4, 2.0);
  const RigidTransform pose = forward_kinematics(chain, q);
  const RigidTransform before = random.pose();
  const RigidTransform after = random.pose();
  chain.base = before * chain.base;
  chain.tool = chain.tool * after;
  EXPECT_THAT(forward_kinematics(chain, q), PoseNear(before * pose * after, 1e-13));
}

TEST(DhChain, WrongSizesAreRefused) {
  support::Random random(3);
  auto chain = support::random_dh_arm<StandardDhChain>(random, 4);
  EXPECT_THROW(forward_kinematics(chain, Eigen::VectorXd::Zero(3)), InvalidInput);
  chain.types.pop_back();
  EXPECT_THROW(forward_kinematics(chain, Eigen::VectorXd::Zero(4)), InvalidInput);
  EXPECT_THROW(to_kdl(chain), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
