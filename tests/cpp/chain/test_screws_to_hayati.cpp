#include "circlepoint/chain/screws_to_hayati.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "circlepoint/chain/kdl.hpp"
#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::PoseNear;

/// Forward kinematics of every export agree to this, m and 1.
constexpr double same_pose = 1e-9;
constexpr int arms = 1000;

RigidTransform kdl_forward_kinematics(const HayatiChain& chain, const Eigen::VectorXd& q) {
  const KDL::Chain kdl_chain = to_kdl(chain);
  KDL::ChainFkSolverPos_recursive solver(kdl_chain);
  KDL::JntArray joints(static_cast<unsigned int>(q.size()));
  joints.data = q;
  KDL::Frame frame;
  EXPECT_EQ(solver.JntToCart(joints, frame), 0);
  return from_kdl(frame);
}

/// Every other pair of axes parallel up to 1e-9 to 1e-2 rad.
ScrewChain arm_of_near_parallels(support::Random& random) {
  ScrewChain chain = support::random_arm(random);
  for (std::size_t i = 0; i + 1 < chain.axes.size(); i += 2) {
    const double angle = std::pow(10.0, random.uniform(-9.0, -2.0));
    const double sense = random.chance(0.5) ? 1.0 : -1.0;
    chain.axes[i + 1].line =
        make_line(sense * (rotation_exp(angle * random.unit()) * chain.axes[i].line.direction), random.vector());
  }
  return chain;
}

/// A standard chain whose rows the conversion may take its branch from.
StandardDhChain nominal_of(support::Random& random, const ScrewChain& chain) {
  auto nominal = support::random_dh_arm<StandardDhChain>(random, chain.size());
  for (std::size_t i = 0; i < chain.axes.size(); ++i) {
    nominal.types[i] = chain.axes[i].type;
  }
  return nominal;
}

TEST(ScrewsToHayati, AnyArmHasTheSameForwardKinematicsAsKdl) {
  support::Random random(1);
  for (int trial = 0; trial < arms; ++trial) {
    const ScrewChain chain = trial % 2 == 0 ? support::random_arm(random) : arm_of_near_parallels(random);
    const HayatiChain hayati = to_hayati(chain).chain;
    const Eigen::VectorXd q = random.vector(chain.size(), 3.0);
    const RigidTransform expected = forward_kinematics(chain, q);
    ASSERT_THAT(forward_kinematics(hayati, q), PoseNear(expected, same_pose)) << "arm " << trial;
    ASSERT_THAT(kdl_forward_kinematics(hayati, q), PoseNear(expected, same_pose)) << "arm " << trial;
  }
}

TEST(ScrewsToHayati, ANominalChainChangesTheRowsAndNotTheMotion) {
  support::Random random(2);
  for (int trial = 0; trial < arms; ++trial) {
    const ScrewChain chain = trial % 2 == 0 ? support::random_arm(random) : arm_of_near_parallels(random);
    const StandardDhChain nominal = nominal_of(random, chain);
    const HayatiConversion found = to_hayati(chain, {.nominal = nominal});
    const Eigen::VectorXd q = random.vector(chain.size(), 3.0);
    ASSERT_THAT(forward_kinematics(found.chain, q), PoseNear(forward_kinematics(chain, q), same_pose)) << "arm " << trial;
    for (std::size_t i = 0; i < nominal.rows.size(); ++i) {
      const HayatiRow& row = found.chain.rows[i];
      const DhRow& expected = nominal.rows[i];
      const std::array values{row.a, row.alpha, row.d, row.theta};
      const std::array wanted{expected.a, expected.alpha, expected.d, expected.theta};
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (found.free(static_cast<Index>(i), static_cast<Index>(k)) && (k != 0 || values[k] != 0.0)) {
          ASSERT_NEAR(values[k], wanted[k], 1e-12) << "arm " << trial << ", row " << i << ", column " << k;
        }
      }
    }
  }
}

TEST(ScrewsToHayati, NoRowIsLongWhereNeighboursAreNearlyParallel) {
  for (const double angle : {0.0, 1e-9, 1e-7, 1e-5, 1e-3, 1e-2}) {
    ScrewChain chain;
    const Eigen::Vector3d tilted(0.0, std::sin(angle), std::cos(angle));
    chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero())},
                  {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                  {JointType::revolute, make_line(tilted, Eigen::Vector3d(0.4, 0.0, 0.0))},
                  {JointType::revolute, make_line(-tilted, Eigen::Vector3d(0.4, 0.3, 0.1))}};
    chain.reference_configuration = Eigen::VectorXd::Zero(4);
    const std::vector<HayatiRow> rows = to_hayati(chain).chain.rows;
    EXPECT_EQ(rows[0].form, RowForm::dh);
    EXPECT_EQ(rows[1].form, RowForm::hayati);
    EXPECT_EQ(rows[2].form, RowForm::hayati);
    for (const HayatiRow& row : rows) {
      EXPECT_LT(std::abs(row.d), 1.0);
      EXPECT_LT(std::abs(row.a), 1.0);
      EXPECT_TRUE(row.form == RowForm::hayati ? row.d == 0.0 : row.beta == 0.0);
    }
  }
}

TEST(ScrewsToHayati, WithoutNearParallelsTheRowsAreTheStandardOnes) {
  support::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = random.integer(2, 8);
    ScrewChain chain;
    for (Index i = 0; i < n; ++i) {
      chain.axes.push_back({JointType::revolute, make_line(random.unit(), random.vector())});
    }
    chain.reference_configuration = random.vector(n, 2.0);
    chain.home = random.pose();
    const HayatiConversion found = to_hayati(chain, {.near_parallel_threshold = 1e-4});
    const std::vector<DhRow> expected = to_standard_dh(chain).chain.rows;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const HayatiRow& row = found.chain.rows[i];
      const double away = std::hypot(row.a - expected[i].a, row.d - expected[i].d, row.alpha - expected[i].alpha);
      ASSERT_LT(away, 1e-8) << "arm " << trial << ", row " << i;
      ASSERT_LT(std::abs(std::remainder(row.theta - expected[i].theta, 2.0 * std::numbers::pi)), 1e-8);
    }
  }
}

TEST(ScrewsToHayati, TheJacobianPredictsWhatADisplacementDoesAndStaysBoundedBesideParallels) {
  support::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    ScrewChain chain = arm_of_near_parallels(random);
    for (ScrewAxis& axis : chain.axes) {
      axis.type = JointType::revolute;
    }
    const HayatiConversion at = to_hayati(chain);
    const Eigen::MatrixXd jacobian = hayati_parameter_jacobian(chain, at);
    ASSERT_TRUE(jacobian.allFinite());
    for (Index i = 0; i < chain.size(); ++i) {
      const HayatiRow& row = at.chain.rows[static_cast<std::size_t>(i)];
      if (row.form == RowForm::hayati) {
        EXPECT_LT(jacobian.row(5 * i).cwiseAbs().maxCoeff(), 1e3);
        EXPECT_EQ(jacobian.row(5 * i + 2).norm(), 0.0);
      }
    }
    HayatiOptions options;
    options.nominal = StandardDhChain{{}, at.chain.types, at.chain.base, at.chain.tool};
    for (const HayatiRow& row : at.chain.rows) {
      options.nominal->rows.push_back({row.a, row.alpha, row.d, row.theta});
      options.forms.push_back(row.form);
    }
    ScrewChain moved = chain;
    const Eigen::VectorXd local = random.vector(4 * chain.size(), 1e-8);
    for (Index i = 0; i < chain.size(); ++i) {
      Line& line = moved.axes[static_cast<std::size_t>(i)].line;
      line = retract(line, local.segment<4>(4 * i));
    }
    const std::vector<HayatiRow> rows = to_hayati(moved, options).chain.rows;
    const Eigen::VectorXd predicted = jacobian * local;
    const double tolerance = 1e-3 * predicted.cwiseAbs().maxCoeff() + 1e-12;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto k = 5 * static_cast<Index>(i);
      ASSERT_NEAR(rows[i].alpha - at.chain.rows[i].alpha, predicted[k + 1], tolerance) << "arm " << trial << ", row " << i;
      ASSERT_NEAR(rows[i].beta - at.chain.rows[i].beta, predicted[k + 4], tolerance) << "arm " << trial << ", row " << i;
      ASSERT_NEAR(rows[i].a - at.chain.rows[i].a, predicted[k], tolerance) << "arm " << trial << ", row " << i;
    }
  }
}

TEST(ScrewsToHayati, WhatCannotBeConvertedIsRefused) {
  support::Random random(6);
  EXPECT_THROW(to_hayati(ScrewChain{}), InvalidInput);
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX())},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY())}};
  chain.reference_configuration = Eigen::Vector3d::Zero();
  EXPECT_THROW(to_hayati(chain, {.forms = {RowForm::dh, RowForm::dh, RowForm::dh}}), InvalidInput);
  EXPECT_THROW(to_hayati(chain, {.forms = {RowForm::hayati, RowForm::hayati, RowForm::dh}}), InvalidInput);
  EXPECT_THROW(to_hayati(chain, {.forms = {RowForm::hayati}}), InvalidInput);
  EXPECT_THROW(to_hayati(chain, {.near_parallel_threshold = 1.0}), InvalidInput);
  auto nominal = support::random_dh_arm<StandardDhChain>(random, 4);
  EXPECT_THROW(to_hayati(chain, {.nominal = nominal}), InvalidInput);
  nominal.rows.pop_back();
  nominal.types = {JointType::revolute, JointType::revolute, JointType::prismatic};
  EXPECT_THROW(to_hayati(chain, {.nominal = nominal}), InvalidInput);
  const HayatiChain found = to_hayati(chain).chain;
  EXPECT_THROW(forward_kinematics(found, Eigen::VectorXd::Zero(2)), InvalidInput);
  chain.reference_configuration.conservativeResize(2);
  EXPECT_THROW(to_hayati(chain), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
