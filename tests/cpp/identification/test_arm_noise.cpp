#include <gtest/gtest.h>

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
    return estimate_noise(all, residuals(), Eigen::MatrixXd(0, 3), Eigen::MatrixXd(0, 3), 10.0, 1.0, {{}}, before, settled);
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

}  // namespace
}  // namespace circlepoint
