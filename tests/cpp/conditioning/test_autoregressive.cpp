#include "circlepoint/conditioning/autoregressive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// x_t = 1.2 x_t-1 - 0.5 x_t-2 + 0.3 e_t, from its stationary distribution on.
Eigen::VectorXd coloured(Index count, std::uint64_t seed) {
  RandomSource random(seed);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(count + 200);
  for (Index t = 2; t < x.size(); ++t) {
    x[t] = 1.2 * x[t - 1] - 0.5 * x[t - 2] + 0.3 * random.normal();
  }
  return x.tail(count);
}

std::vector<Eigen::VectorXd> segments(Index count, Index length) {
  std::vector<Eigen::VectorXd> result;
  for (Index i = 0; i < count; ++i) {
    result.push_back(coloured(length, static_cast<std::uint64_t>(i)));
  }
  return result;
}

TEST(Autoregressive, FindsTheProcessThatMadeTheSignal) {
  const AutoregressiveModel model = fit_autoregressive(segments(20, 2000), 2);
  ASSERT_EQ(model.order(), 2);
  EXPECT_NEAR(model.coefficients(2, 0), 1.2, 0.02);
  EXPECT_NEAR(model.coefficients(2, 1), -0.5, 0.02);
  EXPECT_NEAR(model.innovation_std[2], 0.3, 0.005);
}

TEST(Autoregressive, ManyShortSegmentsSayAsMuchAsALongOne) {
  const AutoregressiveModel model = fit_autoregressive(segments(3000, 12), 2);
  EXPECT_NEAR(model.coefficients(2, 0), 1.2, 0.03);
  EXPECT_NEAR(model.coefficients(2, 1), -0.5, 0.03);
}

TEST(Autoregressive, WhitensFromTheFirstSampleOn) {
  const AutoregressiveModel model = fit_autoregressive(segments(20, 2000), 2);
  double first = 0.0;
  double neighbours = 0.0;
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i) {
    Eigen::MatrixXd column = coloured(6, 1000 + static_cast<std::uint64_t>(i));
    whiten(model, column);
    first += column(0, 0) * column(0, 0);
    neighbours += column(0, 0) * column(1, 0);
  }
  EXPECT_NEAR(first / count, 1.0, 0.12);
  EXPECT_NEAR(neighbours / count, 0.0, 0.08);
}

TEST(Autoregressive, WhiteningIsLinearInItsColumns) {
  const AutoregressiveModel model = fit_autoregressive(segments(5, 500), 4);
  const Eigen::VectorXd x = coloured(50, 1);
  const Eigen::VectorXd y = coloured(50, 2);
  Eigen::MatrixXd columns(50, 3);
  columns << x, y, 2.0 * x - 3.0 * y;
  whiten(model, columns);
  EXPECT_LT((columns.col(2) - 2.0 * columns.col(0) + 3.0 * columns.col(1)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Autoregressive, ASignalThatALowerOrderPredictsEndsTheRecursion) {
  const Eigen::VectorXd wave = (Eigen::ArrayXd::LinSpaced(4000, 0.0, 400.0)).sin();
  EXPECT_LE(fit_autoregressive({wave}, 12).order(), 12);
  EXPECT_TRUE(fit_autoregressive({wave}, 12).innovation_std.allFinite());
}

TEST(Autoregressive, RefusesASignalWithoutPower) {
  EXPECT_THROW(fit_autoregressive({Eigen::VectorXd::Zero(10)}, 2), InvalidInput);
  EXPECT_THROW(fit_autoregressive({}, 2), InvalidInput);
  EXPECT_THROW(fit_autoregressive({coloured(10, 1)}, -1), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
