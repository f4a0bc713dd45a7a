#include "circlepoint/recording/interpolate.hpp"

#include <gtest/gtest.h>

#include <random>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

TEST(InterpolateCubic, ReproducesACubicOnIrregularKnotsAndBeyondThem) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> step(0.05, 0.4);
  Eigen::VectorXd knots(12);
  double t = -1.0;
  for (Index i = 0; i < knots.size(); ++i) {
    knots(i) = t += step(random);
  }
  const auto cubic = [](const Eigen::VectorXd& x) {
    SamplesX y(x.size(), 2);
    y.col(0) = 1.0 - 2.0 * x.array() + 0.5 * x.array().square() - 3.0 * x.array().cube();
    y.col(1) = x.array().cube();
    return y;
  };
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(101, knots(0) - 0.1, knots(11) + 0.1);
  EXPECT_LT((interpolate_cubic(knots, cubic(knots), at) - cubic(at)).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(InterpolateCubic, FewKnotsGiveParabolaLineAndConstant) {
  const Eigen::Vector3d knots(0.0, 1.0, 3.0);
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, 2.0);
  const SamplesX squares = knots.cwiseAbs2();
  EXPECT_NEAR(interpolate_cubic(knots, squares, at)(0, 0), 4.0, 1e-12);
  EXPECT_NEAR(interpolate_cubic(knots.tail(2), squares.bottomRows(2), at)(0, 0), 5.0, 1e-12);
  EXPECT_NEAR(interpolate_cubic(knots.head(1), squares.topRows(1), at)(0, 0), 0.0, 1e-12);
}

TEST(InterpolateCubic, RefusesKnotsThatDoNotIncrease) {
  const Eigen::Vector3d knots(0.0, 1.0, 1.0);
  EXPECT_THROW(interpolate_cubic(knots, SamplesX::Zero(3, 1), knots), InvalidInput);
  EXPECT_THROW(interpolate_cubic(knots, SamplesX::Zero(2, 1), knots), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
