#include "circlepoint/conditioning/autoregressive.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
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

TEST(Autoregressive, AnAutocovarianceGivesTheProcessThatHasIt) {
  // Of the process above: r_1 = 1.2 / 1.5 r_0, r_k = 1.2 r_k-1 - 0.5 r_k-2, and r_0 by the innovations' variance.
  Eigen::Vector4d covariance(1.0, 0.8, 0.0, 0.0);
  covariance[2] = 1.2 * covariance[1] - 0.5 * covariance[0];
  covariance[3] = 1.2 * covariance[2] - 0.5 * covariance[1];
  const AutoregressiveModel model = autoregressive_of(covariance);
  EXPECT_LT((model.coefficients.row(3).transpose() - Eigen::Vector3d(1.2, -0.5, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(model.innovation_std[3], std::sqrt(1.0 - 1.2 * covariance[1] + 0.5 * covariance[2]), 1e-12);
}

TEST(Autoregressive, ModelsInSeriesWhitenAsOneAfterTheOther) {
  const AutoregressiveModel first = autoregressive_of(Eigen::Vector3d(1.0, 0.8, 0.46));
  const AutoregressiveModel second = autoregressive_of(Eigen::Vector2d(4.0, -1.0));
  const AutoregressiveModel both = in_series(first, second);
  ASSERT_EQ(both.order(), 3);
  Eigen::MatrixXd at_once = coloured(60, 3);
  Eigen::MatrixXd in_turn = at_once;
  whiten(both, at_once);
  whiten(first, in_turn);
  whiten(second, in_turn);
  // The first samples lack predecessors and are whitened by lower orders.
  EXPECT_LT((at_once - in_turn).bottomRows(57).cwiseAbs().maxCoeff(), 1e-12);
  Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(60, 60);
  whiten(both, identity);
  const Eigen::MatrixXd covariance = (identity.transpose() * identity).inverse();
  for (Index t = 1; t < 60; ++t) {
    EXPECT_NEAR(covariance(t, t), covariance(0, 0), 1e-9);  // stationary from the first sample on
  }
}

TEST(Autoregressive, WhatSegmentsLackIsAddedToTheirProducts) {
  const std::vector<Eigen::VectorXd> whole = segments(4, 400);
  std::vector<Eigen::VectorXd> half;
  Eigen::Vector3d lacking = Eigen::Vector3d::Zero();
  for (const Eigen::VectorXd& segment : whole) {
    half.emplace_back(0.5 * segment);
    for (Index lag = 0; lag < 3; ++lag) {
      lacking[lag] += 0.75 * segment.head(segment.size() - lag).dot(segment.tail(segment.size() - lag));
    }
  }
  const AutoregressiveModel expected = fit_autoregressive(whole, 2);
  const AutoregressiveModel model = fit_autoregressive(half, 2, lacking);
  EXPECT_LT((model.coefficients - expected.coefficients).norm(), 1e-12);
  EXPECT_LT((model.innovation_std - expected.innovation_std).norm(), 1e-12);
}

TEST(Autoregressive, RefusesASignalWithoutPower) {
  EXPECT_THROW(fit_autoregressive({Eigen::VectorXd::Zero(10)}, 2), InvalidInput);
  EXPECT_THROW(fit_autoregressive({}, 2), InvalidInput);
  EXPECT_THROW(fit_autoregressive({coloured(10, 1)}, -1), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
