#include "circlepoint/chain/screws_to_dh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "circlepoint/chain/kdl.hpp"
#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::PoseNear;

/// Forward kinematics of every export agree to this, m and 1.
constexpr double same_pose = 1e-9;
constexpr int arms = 1000;

template <class Chain>
RigidTransform kdl_forward_kinematics(const Chain& chain, const Eigen::VectorXd& q) {
  const KDL::Chain kdl_chain = to_kdl(chain);
  KDL::ChainFkSolverPos_recursive solver(kdl_chain);
  KDL::JntArray joints(static_cast<unsigned int>(q.size()));
  joints.data = q;
  KDL::Frame frame;
  EXPECT_EQ(solver.JntToCart(joints, frame), 0);
  return from_kdl(frame);
}

TEST(ScrewsToDh, EveryFormOfAnArmHasTheSameForwardKinematicsAsKdl) {
  support::Random random(1);
  for (int trial = 0; trial < arms; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const StandardDhChain standard = to_standard_dh(chain).chain;
    const ModifiedDhChain modified = to_modified_dh(chain).chain;
    const Eigen::VectorXd q = random.vector(chain.size(), 3.0);
    const RigidTransform expected = forward_kinematics(chain, q);
    ASSERT_THAT(kdl_forward_kinematics(chain, q), PoseNear(expected, same_pose)) << "arm " << trial;
    ASSERT_THAT(forward_kinematics(standard, q), PoseNear(expected, same_pose)) << "arm " << trial;
    ASSERT_THAT(forward_kinematics(modified, q), PoseNear(expected, same_pose)) << "arm " << trial;
    ASSERT_THAT(kdl_forward_kinematics(standard, q), PoseNear(expected, same_pose)) << "arm " << trial;
    ASSERT_THAT(kdl_forward_kinematics(modified, q), PoseNear(expected, same_pose)) << "arm " << trial;
  }
}

TEST(ScrewsToDh, ANominalChainChangesTheRowsAndNotTheMotion) {
  support::Random random(2);
  for (int trial = 0; trial < arms; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    auto standard = support::random_dh_arm<StandardDhChain>(random, chain.size());
    auto modified = support::random_dh_arm<ModifiedDhChain>(random, chain.size());
    for (std::size_t i = 0; i < chain.axes.size(); ++i) {
      standard.types[i] = modified.types[i] = chain.axes[i].type;
    }
    const Eigen::VectorXd q = random.vector(chain.size(), 3.0);
    const RigidTransform expected = forward_kinematics(chain, q);
    ASSERT_THAT(forward_kinematics(to_standard_dh(chain, {.nominal = standard}).chain, q), PoseNear(expected, same_pose))
        << "arm " << trial;
    ASSERT_THAT(forward_kinematics(to_modified_dh(chain, {.nominal = modified}).chain, q), PoseNear(expected, same_pose))
        << "arm " << trial;
  }
}

template <class DhChain>
void expect_same_motion_as_screws() {
  support::Random random(3);
  for (int trial = 0; trial < arms; ++trial) {
    const auto dh = support::random_dh_arm<DhChain>(random, random.integer(1, 10));
    const Eigen::VectorXd reference = random.vector(dh.size(), 2.0);
    const Eigen::VectorXd q = random.vector(dh.size(), 3.0);
    const ScrewChain in_base = to_screws(dh, reference, BaseFrame::chain_base);
    ASSERT_THAT(forward_kinematics(in_base, q), PoseNear(forward_kinematics(dh, q), same_pose));
    const ScrewChain in_sensor = to_screws(dh, reference, BaseFrame::sensor_at_reference);
    ASSERT_THAT(in_sensor.home, PoseNear(RigidTransform::Identity(), 0.0));
    ASSERT_THAT(in_base.home * forward_kinematics(in_sensor, q), PoseNear(forward_kinematics(dh, q), same_pose));
  }
}

TEST(DhToScrews, StandardChainMovesAsItsScrews) { expect_same_motion_as_screws<StandardDhChain>(); }
TEST(DhToScrews, ModifiedChainMovesAsItsScrews) { expect_same_motion_as_screws<ModifiedDhChain>(); }

TEST(ScrewsToDh, IntersectingNeighboursHaveNoJump) {
  // Two lines that pass each other on either side: a changes sign, nothing else does.
  for (const double gap : {-1e-6, 1e-6}) {
    ScrewChain chain;
    chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                  {JointType::revolute, make_line(Eigen::Vector3d::UnitY(), Eigen::Vector3d(gap, 0.0, 0.3))}};
    chain.reference_configuration = Eigen::VectorXd::Zero(2);
    const DhRow row = to_standard_dh(chain).chain.rows[0];
    EXPECT_NEAR(row.a, -gap, 1e-15);
    EXPECT_NEAR(row.alpha, 0.5 * std::numbers::pi, 1e-15);
    const DhRow modified = to_modified_dh(chain).chain.rows[1];
    EXPECT_NEAR(modified.a, -gap, 1e-15);
    EXPECT_NEAR(modified.alpha, 0.5 * std::numbers::pi, 1e-15);
  }
}

TEST(ScrewsToDh, CanonicalBranchHasPositiveAlphaAndAnglesWithinHalfATurn) {
  support::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const auto expect_canonical = [](const DhRow& row) {
      EXPECT_GE(row.alpha, 0.0);
      EXPECT_LE(row.alpha, std::numbers::pi);
      EXPECT_GT(row.theta, -std::numbers::pi);
      EXPECT_LE(row.theta, std::numbers::pi);
    };
    for (const DhRow& row : to_standard_dh(chain).chain.rows) {
      expect_canonical(row);
    }
    for (const DhRow& row : to_modified_dh(chain).chain.rows) {
      expect_canonical(row);
    }
  }
}

TEST(ScrewsToDh, NearParallelNeighboursAreReportedWithTheirAngle) {
  ScrewChain chain;
  const double angle = 2e-4;
  const Eigen::Vector3d tilted(0.0, std::sin(angle), -std::cos(angle));
  chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero())},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                {JointType::revolute, make_line(tilted, Eigen::Vector3d(0.4, 0.0, 0.0))},
                {JointType::revolute, make_line(tilted, Eigen::Vector3d(0.4, 0.3, 0.0))}};
  chain.reference_configuration = Eigen::VectorXd::Zero(4);
  const auto found = to_modified_dh(chain).near_parallel;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 1);
  EXPECT_NEAR(found[0].angle, angle, 1e-12);
  EXPECT_FALSE(found[0].parallel);
  EXPECT_EQ(found[1].first, 2);
  EXPECT_TRUE(found[1].parallel);
  EXPECT_TRUE(to_standard_dh(chain, {.near_parallel_threshold = 1e-4}).near_parallel.front().parallel);
  support::Random random(5);
  const Eigen::VectorXd q = random.vector(4, 3.0);
  EXPECT_THAT(forward_kinematics(to_standard_dh(chain).chain, q), PoseNear(forward_kinematics(chain, q), same_pose));
}

TEST(ScrewsToDh, WhatCannotBeConvertedIsRefused) {
  support::Random random(6);
  EXPECT_THROW(to_standard_dh(ScrewChain{}), InvalidInput);
  ScrewChain chain = support::random_arm(random, 3);
  auto nominal = support::random_dh_arm<StandardDhChain>(random, 4);
  EXPECT_THROW(to_standard_dh(chain, {.nominal = nominal}), InvalidInput);
  nominal.rows.pop_back();
  nominal.types = {chain.axes[0].type, chain.axes[1].type, JointType::prismatic};
  chain.axes[2].type = JointType::revolute;
  EXPECT_THROW(to_standard_dh(chain, {.nominal = nominal}), InvalidInput);
  EXPECT_THROW(to_standard_dh(chain, {.parallel_tolerance = 0.0}), InvalidInput);
  chain.reference_configuration.conservativeResize(2);
  EXPECT_THROW(to_modified_dh(chain), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
