#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "arm_noise.hpp"

namespace circlepoint {
namespace {

// Noise of one stretch whose channels are moving averages: an autoregressive model of any order could do a little better.
TEST(ArmNoiseTest, HoldsItsOrdersOnceSettled) {
  constexpr Index rows = 400;
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  MovingStretch stretch;
  stretch.time = Eigen::VectorXd::LinSpaced(rows, 0.0, 20.0);
  stretch.noise = 0;
  ArmRows all;
  all.channels = 3;
  all.cutoff = 10.0;
  all.sample_rate = 200.0;
  all.rate = 20.0;
  all.stretches = {stretch};
  const auto residuals = [&] {
    const Eigen::MatrixXd white = Eigen::MatrixXd::NullaryExpr(rows + 1, 3, [&] { return normal(generator); });
    return StretchResiduals{white.topRows(rows) + 0.9 * white.bottomRows(rows)};
  };
  const auto noise = [&](const ArmNoise* before, bool settled) {
    return estimate_noise(all, residuals(), Eigen::MatrixXd(0, 3), {}, 10.0, 1.0, {{}}, before, settled);
  };
  const auto orders = [](const ArmNoise& of) {
    std::vector<Index> found;
    for (const AutoregressiveModel& channel : of.kinds[0].channels) {
      found.push_back(channel.order());
    }
    return found;
  };
  ArmNoise first = noise(nullptr, false);
  bool changes = false;
  for (int trial = 0; trial < 10; ++trial) {
    changes = changes || orders(noise(&first, false)) != orders(first);
    EXPECT_EQ(orders(noise(&first, true)), orders(first));
  }
  EXPECT_TRUE(changes);
}

// Dwells of an arm whose encoders are coarse: a count tilts gravity in one direction, a hundred times the sensor's scatter.
TEST(ArmNoiseTest, TellsWhatDwellsScatterByBesideCountsThatTilt) {
  constexpr Index dwells = 40;
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  ArmRows rows;
  rows.channels = 3;
  rows.cutoff = 10.0;
  rows.sample_rate = 200.0;
  rows.rate = 20.0;
  for (const double excess : {0.0, 1e-3}) {
    double squares = 0.0;
    constexpr int trials = 20;
    for (int trial = 0; trial < trials; ++trial) {
      Eigen::MatrixXd residuals(dwells, 3);
      std::vector<Eigen::MatrixXd> covariance;
      for (Index i = 0; i < dwells; ++i) {
        const auto draw = [&](double) { return normal(generator); };
        const Eigen::Vector3d tilt = 1e-2 * Eigen::Vector3d::Zero().unaryExpr(draw).normalized();
        residuals.row(i) = tilt * normal(generator) + std::hypot(excess, 1e-4) * Eigen::Vector3d::Zero().unaryExpr(draw);
        covariance.emplace_back(tilt * tilt.transpose() + 1e-8 * Eigen::Matrix3d::Identity());
      }
      const ArmNoise noise = estimate_noise(rows, {}, residuals, covariance, 0.0, 1.0, {}, nullptr, false);
      squares += noise.dwell_excess[0] * noise.dwell_excess[0] / trials;
    }
    // By the mean of squares it would be told to a tenth of the tilts, 1e-3, at best.
    EXPECT_NEAR(std::sqrt(squares), excess, 1e-4);
  }
}

}  // namespace
}  // namespace circlepoint
