#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

struct SmoothSignal {
  double dx;
  SamplesX value, slope;
};

// Three channels of sine, cosine and exponential on [0, 2].
SmoothSignal smooth_signal(Index rows) {
  SmoothSignal signal{2.0 / static_cast<double>(rows - 1), SamplesX(rows, 3), SamplesX(rows, 3)};
  for (Index i = 0; i < rows; ++i) {
    const double t = signal.dx * static_cast<double>(i);
    signal.value.row(i) << std::sin(t), std::cos(t), std::exp(-t);
    signal.slope.row(i) << std::cos(t), -std::sin(t), -std::exp(-t);
  }
  return signal;
}

double simpson_error(Index rows) {
  const SmoothSignal signal = smooth_signal(rows);
  const SamplesX change = signal.value.rowwise() - signal.value.row(0);
  return (cumulative_simpson(signal.slope, signal.dx, 0.0) - change).cwiseAbs().maxCoeff();
}

double trapezoid_error(Index rows) {
  const SmoothSignal signal = smooth_signal(rows);
  const SamplesX change = signal.value.rowwise() - signal.value.row(0);
  return (cumulative_trapezoid(signal.slope, signal.dx, 0.0) - change).cwiseAbs().maxCoeff();
}

double gradient_error(Index rows, int edge_order) {
  const SmoothSignal signal = smooth_signal(rows);
  return (gradient(signal.value, signal.dx, edge_order) - signal.slope).cwiseAbs().maxCoeff();
}

TEST(CumulativeIntegral, OfTheDerivativeIsTheChangeToTheOrderOfTheRule) {
  EXPECT_NEAR(trapezoid_error(101) / trapezoid_error(201), 4.0, 0.1);
  EXPECT_GT(simpson_error(101) / simpson_error(201), 7.0);
  EXPECT_LT(simpson_error(201), 1e-6);
}

TEST(Gradient, ConvergesWithTheOrderOfItsEdges) {
  EXPECT_NEAR(gradient_error(101, 1) / gradient_error(201, 1), 2.0, 0.1);
  EXPECT_NEAR(gradient_error(101, 2) / gradient_error(201, 2), 4.0, 0.2);
}

TEST(CumulativeTrapezoid, DifferencesOfTheIntegralAreTheTrapezoids) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const Index channels : {1, 2, 3, 4, 5, 9}) {
    const SamplesX y = SamplesX::NullaryExpr(100, channels, [&] { return normal(random); });
    const SamplesX integral = cumulative_trapezoid(y, 0.5, 0.0);
    const SamplesX trapezoids = 0.25 * (y.topRows(99) + y.bottomRows(99));
    EXPECT_LT((integral.bottomRows(99) - integral.topRows(99) - trapezoids).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(CumulativeSimpson, EquallySpacedAbscissaeGiveWhatTheirSpacingGives) {
  for (const Index rows : {1, 2, 3, 4, 5, 100, 101}) {
    const SamplesX y = SamplesX::Random(rows, 3);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(rows, 0.0, 0.25 * static_cast<double>(rows - 1));
    EXPECT_TRUE(cumulative_simpson(y, x, 1.0).isApprox(cumulative_simpson(y, 0.25, 1.0), 1e-13)) << rows << " rows";
  }
}

TEST(CumulativeSimpson, AbscissaeThatTurnBackAreRefused) {
  const Eigen::VectorXd x = Eigen::Vector3d(0.0, 2.0, 1.0);
  EXPECT_THROW(cumulative_simpson(SamplesX::Zero(3, 1), x), InvalidInput);
}

TEST(SavgolFilter, DerivativeOfTheIntegralIsTheSmoothedSignal) {
  const SmoothSignal signal = smooth_signal(501);
  const SamplesX integral = cumulative_simpson(signal.value, signal.dx, 0.0);
  EXPECT_LT((savgol_filter(integral, 11, 4, 1, signal.dx) - signal.value).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(SavgolFilter, TakesColumnsOfAWiderArray) {
  const SamplesX wide = SamplesX::Random(200, 7);
  const SamplesX copied = wide.middleCols(2, 3);
  EXPECT_EQ(savgol_filter(wide.middleCols(2, 3), 11, 3), savgol_filter(copied, 11, 3));
}

}  // namespace
}  // namespace circlepoint
