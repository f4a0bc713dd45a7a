#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

template <class DhChain>
Eigen::VectorXd parameters(const DhChain& chain) {
  Eigen::VectorXd values(4 * chain.size());
  for (Index i = 0; i < chain.size(); ++i) {
    const DhRow& row = chain.rows[static_cast<std::size_t>(i)];
    values.segment<4>(4 * i) << row.a, row.alpha, row.d, row.theta;
  }
  return values;
}

ScrewChain displaced(const ScrewChain& chain, const Eigen::VectorXd& local) {
  ScrewChain moved = chain;
  for (Index i = 0; i < chain.size(); ++i) {
    Line& line = moved.axes[static_cast<std::size_t>(i)].line;
    line = retract(line, local.segment<4>(4 * i));
  }
  return moved;
}

TEST(DhParameterJacobian, PredictsTheChangeOfTheParameters) {
  support::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const ScrewChain chain = support::random_arm(random, 6, {.prismatic = 0.2, .special = 0.0});
    const Eigen::VectorXd local = 1e-6 * Eigen::VectorXd::NullaryExpr(24, [&] { return random.normal(); });
    const ScrewChain moved = displaced(chain, local);
    const auto standard = to_standard_dh(chain);
    const auto modified = to_modified_dh(chain);
    // Second order: the parameters' curvature grows with the square of 1 / angle of neighbours.
    double smallest = 1.0;
    for (std::size_t i = 0; i + 1 < chain.axes.size(); ++i) {
      smallest = std::min(smallest, chain.axes[i].line.direction.cross(chain.axes[i + 1].line.direction).norm());
    }
    const double tolerance = 1e-9 / std::pow(smallest, 4.0);
    EXPECT_THAT(parameters(to_standard_dh(moved, {.nominal = standard.chain}).chain) - parameters(standard.chain),
                support::EntriesNear(dh_parameter_jacobian(chain, standard) * local, tolerance));
    EXPECT_THAT(parameters(to_modified_dh(moved, {.nominal = modified.chain}).chain) - parameters(modified.chain),
                support::EntriesNear(dh_parameter_jacobian(chain, modified) * local, tolerance));
  }
}

TEST(DhParameterJacobian, OfPerpendicularIntersectingAxesIsKnown) {
  // x_1 = z_0 x z_1: tilting z_1 about x_1 is a change of alpha, shifting line 1 along x_1 one of a.
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                {JointType::revolute, make_line(Eigen::Vector3d::UnitY(), Eigen::Vector3d::Zero())}};
  chain.reference_configuration = Eigen::VectorXd::Zero(2);
  const Eigen::MatrixXd jacobian = dh_parameter_jacobian(chain, to_standard_dh(chain));
  const Eigen::Vector3d x = Eigen::Vector3d::UnitZ().cross(Eigen::Vector3d::UnitY());
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(Eigen::Vector3d::UnitY());
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(8, 8);
  expected.block<1, 2>(0, 6) = x.transpose() * basis;
  expected.block<1, 2>(1, 4) = x.cross(Eigen::Vector3d::UnitY()).transpose() * basis;
  const Eigen::Matrix<double, 3, 2> first_basis = tangent_basis(Eigen::Vector3d::UnitZ());
  expected.block<1, 2>(0, 2) = -x.transpose() * first_basis;
  expected.block<1, 2>(1, 0) = -x.cross(Eigen::Vector3d::UnitZ()).transpose() * first_basis;
  EXPECT_THAT(jacobian, support::EntriesNear(expected, 1e-9));
}

TEST(DhParameterJacobian, IsOnTheBranchItIsTakenAt) {
  // alpha = pi/2 and theta next to the cut at pi: nothing may wrap or flip.
  support::Random random(2);
  auto nominal = support::random_dh_arm<StandardDhChain>(random, 5, {.prismatic = 0.0, .special = 0.0});
  for (DhRow& row : nominal.rows) {
    row = {0.0, -0.5 * std::numbers::pi, 0.2, std::numbers::pi};
  }
  const ScrewChain chain = to_screws(nominal, Eigen::VectorXd::Zero(5), BaseFrame::sensor_at_reference);
  const auto at = to_standard_dh(chain, {.nominal = nominal});
  EXPECT_LT(dh_parameter_jacobian(chain, at).cwiseAbs().maxCoeff(), 100.0);
  EXPECT_LT(dh_parameter_jacobian(chain, to_standard_dh(chain)).cwiseAbs().maxCoeff(), 100.0);
}

TEST(DhParameterJacobian, HasNoValueBetweenParallelsAndOrdinaryOnesElsewhere) {
  support::Random random(3);
  ScrewChain chain = support::random_arm(random, 5, {.prismatic = 0.0, .special = 0.0});
  chain.axes[2].line.direction = chain.axes[1].line.direction;
  chain.axes[2].line = make_line(chain.axes[2].line.direction, random.vector());
  const auto at = to_standard_dh(chain);
  const Eigen::MatrixXd jacobian = dh_parameter_jacobian(chain, at);
  // Pair (1, 2): all of row 1, theta of row 2; d of row 2 is free.
  EXPECT_TRUE(jacobian.middleRows<4>(4).array().isNaN().all());
  EXPECT_TRUE(jacobian.row(11).array().isNaN().all());
  EXPECT_TRUE(jacobian.row(10).isZero(0.0));
  EXPECT_TRUE(jacobian.topRows<4>().allFinite());
  EXPECT_TRUE(jacobian.bottomRows<8>().allFinite());
  EXPECT_LT(jacobian.bottomRows<8>().cwiseAbs().maxCoeff(), 1e3);
  const Eigen::MatrixXd modified = dh_parameter_jacobian(chain, to_modified_dh(chain));
  EXPECT_TRUE(modified.middleRows<2>(8).array().isNaN().all());
  EXPECT_TRUE(modified.bottomRows<8>().allFinite());
}

TEST(DhParameterJacobian, GrowsAsNeighboursComeToBeParallel) {
  support::Random random(4);
  double previous = 0.0;
  for (const double angle : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    ScrewChain chain;
    const Eigen::Vector3d tilted(0.0, std::sin(angle), std::cos(angle));
    chain.axes = {{JointType::revolute, make_line(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero())},
                  {JointType::revolute, make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero())},
                  {JointType::revolute, make_line(tilted, Eigen::Vector3d(0.4, 0.0, 0.0))},
                  {JointType::revolute, make_line(Eigen::Vector3d::UnitY(), Eigen::Vector3d(0.9, 0.1, 0.2))}};
    chain.reference_configuration = Eigen::VectorXd::Zero(4);
    const Eigen::MatrixXd jacobian = dh_parameter_jacobian(chain, to_standard_dh(chain));
    // theta of the middle row turns with the direction of the tilt: by its size over the angle.
    EXPECT_NEAR(jacobian.row(7).segment<2>(8).norm() * angle, 1.0, 2e-2);
    const double d = jacobian.row(6).norm();
    EXPECT_GT(d, 5.0 * previous);
    previous = d;
  }
}

TEST(DhParameterJacobian, RefusesTheConversionOfAnotherArm) {
  support::Random random(5);
  const ScrewChain four = support::random_arm(random, 4);
  const ScrewChain five = support::random_arm(random, 5);
  EXPECT_THROW(dh_parameter_jacobian(four, to_standard_dh(five)), InvalidInput);
  EXPECT_THROW(dh_parameter_jacobian(four, to_modified_dh(four), 0.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
