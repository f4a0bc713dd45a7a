#include "circlepoint/chain/align_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::PoseNear;

/// An arm without two axes that coincide, so that every offset between the first and the last joint shows.
ScrewChain general_arm(support::Random& random, Index n, double prismatic) {
  ScrewChain chain = support::random_arm(random, n, {.prismatic = prismatic, .special = 0.0});
  chain.axes.back().type = JointType::revolute;
  return chain;
}

TEST(AlignChain, FindsWhereTheArmStandsAndHowFarItsEncodersAreOff) {
  support::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const ScrewChain nominal = general_arm(random, random.integer(5, 8), 0.0);
    const Index n = nominal.size();
    Eigen::VectorXd offsets = random.vector(n, 0.2);
    offsets[0] = offsets[n - 1] = 0.0;
    const RigidTransform placement = random.pose();
    // The built arm: the nominal one at q + offsets, described at the nominal reference.
    ScrewChain built = rebase(nominal, nominal.reference_configuration + offsets);
    built.reference_configuration = nominal.reference_configuration;
    const RigidTransform sensor = forward_kinematics(nominal, nominal.reference_configuration + offsets);
    for (ScrewAxis& axis : built.axes) {
      axis = transform(placement * sensor, axis);
    }
    const ChainAlignment found = align_chain(built, nominal);
    ASSERT_TRUE(found.converged) << "arm " << trial;
    ASSERT_THAT(found.T_target_source, PoseNear(placement, 1e-8)) << "arm " << trial;
    ASSERT_LT((found.joint_offsets - offsets).cwiseAbs().maxCoeff(), 1e-8) << "arm " << trial;
    ASSERT_LT(found.direction_rms + found.distance_rms, 1e-8);
  }
}

TEST(AlignChain, OffsetsThatNoLineShowsStayZero) {
  // The third joint turns about the axis of the last: no line shows by how much.
  ScrewChain nominal;
  nominal.axes = {{JointType::revolute, make_line({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0})},
                  {JointType::revolute, make_line({0.0, 1.0, 0.2}, {0.0, 0.0, 0.3})},
                  {JointType::revolute, make_line({1.0, 0.1, 0.0}, {0.4, 0.1, 0.3})},
                  {JointType::revolute, make_line({1.0, 0.1, 0.0}, {0.4, 0.1, 0.3})}};
  nominal.reference_configuration = Eigen::Vector4d::Zero();
  const Eigen::Vector4d offsets(0.0, 0.1, 0.2, 0.0);
  ScrewChain built = rebase(nominal, offsets);
  built.reference_configuration = nominal.reference_configuration;
  const ChainAlignment found = align_chain(built, nominal);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.joint_offsets[1], 0.1, 1e-9);
  EXPECT_LT(std::abs(found.joint_offsets[2]), 1e-9);
  EXPECT_LT(found.direction_rms + found.distance_rms, 1e-9);
}

TEST(AlignChain, APrismaticAxisHasNoPlace) {
  support::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const ScrewChain nominal = general_arm(random, 6, 0.4);
    ScrewChain built = nominal;
    for (ScrewAxis& axis : built.axes) {
      if (axis.type == JointType::prismatic) {
        axis.line = make_line(axis.line.direction, random.vector());
      }
    }
    const ChainAlignment found = align_chain(built, nominal);
    EXPECT_LT(found.direction_rms + found.distance_rms, 1e-9) << "arm " << trial;
    EXPECT_THAT(found.T_target_source, PoseNear(RigidTransform::Identity(), 1e-7)) << "arm " << trial;
  }
}

TEST(AlignChain, RefusesChainsThatAreNotTheSameJoints) {
  support::Random random(4);
  const ScrewChain four = general_arm(random, 4, 0.0);
  EXPECT_THROW(align_chain(four, general_arm(random, 5, 0.0)), InvalidInput);
  EXPECT_THROW(align_chain(ScrewChain{}, ScrewChain{}), InvalidInput);
  ScrewChain other = four;
  other.reference_configuration[1] += 0.1;
  EXPECT_THROW(align_chain(four, other), InvalidInput);
  other = four;
  other.axes[1].type = JointType::prismatic;
  EXPECT_THROW(align_chain(four, other), InvalidInput);
  EXPECT_THROW(align_chain(four, four, 0.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
