// What the axes leave free is flagged, is nominal, and is as much as the count of degrees of freedom says.

#include <gtest/gtest.h>

#include "circlepoint/chain/screws_to_dh.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

Index prismatic_joints(const ScrewChain& chain) {
  return std::count_if(chain.axes.begin(), chain.axes.end(),
                       [](const ScrewAxis& axis) { return axis.type == JointType::prismatic; });
}

template <class Conversion>
void expect_free_values_are(const Conversion& result, const std::vector<DhRow>& expected) {
  for (Index i = 0; i < result.free.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const DhRow& row = result.chain.rows[k];
    EXPECT_TRUE(!result.free(i, 0) || row.a == expected[k].a) << "a, row " << i;
    EXPECT_TRUE(!result.free(i, 1) || row.alpha == expected[k].alpha) << "alpha, row " << i;
    EXPECT_TRUE(!result.free(i, 2) || row.d == expected[k].d) << "d, row " << i;
    EXPECT_TRUE(!result.free(i, 3) || row.theta == expected[k].theta) << "theta, row " << i;
  }
}

TEST(DhFreeParameters, AreSixAndTwoForEachPrismaticJoint) {
  // 4 n rows + 6 base + 6 tool parameters describe 4 per revolute, 2 per prismatic axis and 6 of home.
  support::Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const ScrewChain chain = support::random_arm(random, random.integer(3, 8), {.prismatic = 0.25, .special = 0.0});
    const bool has_located_axis = prismatic_joints(chain) + 1 < chain.size();
    if (!has_located_axis) {
      continue;
    }
    EXPECT_EQ(to_standard_dh(chain).free.count(), 6 + 2 * prismatic_joints(chain)) << "arm " << trial;
    EXPECT_EQ(to_modified_dh(chain).free.count(), 6 + 2 * prismatic_joints(chain)) << "arm " << trial;
  }
}

TEST(DhFreeParameters, OfARevoluteArmAreThePlacementOfBaseAndTool) {
  support::Random random(2);
  const ScrewChain chain = support::random_arm(random, 5, {.prismatic = 0.0, .special = 0.0});
  FreeFlags standard = FreeFlags::Zero(5, 4);
  standard.row(0) << false, false, true, true;
  standard.row(4).setConstant(true);
  EXPECT_EQ(to_standard_dh(chain).free, standard);
  FreeFlags modified = FreeFlags::Zero(5, 4);
  modified.row(0).setConstant(true);
  modified.row(4) << false, false, true, true;
  EXPECT_EQ(to_modified_dh(chain).free, modified);
}

TEST(DhFreeParameters, AreZeroWithoutANominalChainAndNominalWithOne) {
  support::Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const ScrewChain chain = support::random_arm(random);
    const std::vector<DhRow> zero(chain.axes.size());
    expect_free_values_are(to_standard_dh(chain), zero);
    expect_free_values_are(to_modified_dh(chain), zero);
    auto standard = support::random_dh_arm<StandardDhChain>(random, chain.size());
    auto modified = support::random_dh_arm<ModifiedDhChain>(random, chain.size());
    for (std::size_t i = 0; i < chain.axes.size(); ++i) {
      standard.types[i] = modified.types[i] = chain.axes[i].type;
    }
    expect_free_values_are(to_standard_dh(chain, {.nominal = standard}), standard.rows);
    expect_free_values_are(to_modified_dh(chain, {.nominal = modified}), modified.rows);
  }
}

template <class DhChain>
double largest_row_difference(const DhChain& first, const DhChain& second) {
  double largest = 0.0;
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    const DhRow& u = first.rows[i];
    const DhRow& v = second.rows[i];
    largest = std::max({largest, std::abs(u.a - v.a), std::abs(u.alpha - v.alpha), std::abs(u.d - v.d),
                        std::abs(u.theta - v.theta)});
  }
  return largest;
}

TEST(DhFreeParameters, AnExactNominalChainComesBackAsItWas) {
  support::Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = random.integer(1, 8);
    const Eigen::VectorXd reference = random.vector(n, 2.0);
    const auto standard = support::random_dh_arm<StandardDhChain>(random, n);
    const auto back = to_standard_dh(to_screws(standard, reference, BaseFrame::chain_base), {.nominal = standard}).chain;
    EXPECT_LT(largest_row_difference(back, standard), 1e-8) << "arm " << trial;
    const auto modified = support::random_dh_arm<ModifiedDhChain>(random, n);
    const auto again = to_modified_dh(to_screws(modified, reference, BaseFrame::chain_base), {.nominal = modified}).chain;
    EXPECT_LT(largest_row_difference(again, modified), 1e-8) << "arm " << trial;
  }
}

TEST(DhFreeParameters, ParallelNeighboursHaveZeroOffsetInTheLaterRow) {
  // Axes 2 and 3 of 4 parallel, a metre apart along them where the normals of the others end.
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d(0.0, 0.1, 0.2))},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.5, 0.0, 0.0))},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitY(), Eigen::Vector3d(0.6, 0.0, 1.2))}};
  chain.reference_configuration = Eigen::VectorXd::Zero(4);
  const StandardDhConversion standard = to_standard_dh(chain);
  EXPECT_TRUE(standard.free(2, 2));
  EXPECT_FALSE(standard.free(1, 2));
  EXPECT_EQ(standard.chain.rows[2].d, 0.0);
  EXPECT_NEAR(standard.chain.rows[1].d, 1.0, 1e-12);
  const ModifiedDhConversion modified = to_modified_dh(chain);
  EXPECT_TRUE(modified.free(2, 2));
  EXPECT_FALSE(modified.free(1, 2));
  EXPECT_EQ(modified.chain.rows[2].d, 0.0);
  EXPECT_NEAR(modified.chain.rows[1].d, 1.0, 1e-12);
}

TEST(DhFreeParameters, AScaraHasItsTextbookRows) {
  // Three parallel revolute axes and a vertical spindle: only the two link lengths are determined.
  ScrewChain chain;
  const auto vertical = [](double x) { return make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(x, 0.0, 0.0)); };
  chain.axes = {{JointType::revolute, vertical(0.0)},
                {JointType::revolute, vertical(0.4)},
                {JointType::prismatic, vertical(9.0)},
                {JointType::revolute, vertical(0.65)}};
  chain.reference_configuration = Eigen::VectorXd::Zero(4);
  const StandardDhChain scara = to_standard_dh(chain).chain;
  EXPECT_NEAR(scara.rows[0].a, 0.4, 1e-14);
  EXPECT_NEAR(scara.rows[1].a, 0.25, 1e-14);
  EXPECT_EQ(scara.rows[2], DhRow{});
  EXPECT_EQ(scara.rows[3], DhRow{});
}

TEST(DhFreeParameters, ACylindricalArmHasItsColumnOnItsFirstAxis) {
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                {JointType::prismatic, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(5.0, 5.0, 0.0))},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d(0.0, 0.2, 0.7))}};
  chain.reference_configuration = Eigen::VectorXd::Zero(3);
  const StandardDhConversion result = to_standard_dh(chain);
  EXPECT_EQ(result.chain.rows[0].a, 0.0);
  EXPECT_TRUE(result.free(0, 0));
  EXPECT_NEAR(std::abs(result.chain.rows[1].a), 0.2, 1e-14);
  EXPECT_FALSE(result.free(1, 0));
}

}  // namespace
}  // namespace circlepoint
