#include "circlepoint/sensor/band_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

TEST(BandNoise, TotalPowerIsTheSumOfTheBandsEvenWhereTheyFold) {
  const std::vector<NoiseBand> bands{{0.0, 10.0, 0.3}, {10.0, 500.0, 0.4}};
  for (const double rate : {500.0, 2000.0}) {
    double power = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      power += band_noise(bands, 20000, rate, seed).squaredNorm() / (20.0 * 20000 * 3);
    }
    EXPECT_NEAR(power, 0.25, 0.01) << rate;
  }
}

TEST(BandNoise, ChannelsAndSeedsAreIndependentAndTheSameSeedRepeats) {
  const std::vector<NoiseBand> bands{{0.0, 100.0, 1.0}};
  const Samples3 noise = band_noise(bands, 50000, 500.0, 3);
  const Eigen::Matrix3d covariance = noise.transpose() * noise / 50000.0;
  EXPECT_LT((covariance - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.06);
  EXPECT_EQ(noise, band_noise(bands, 50000, 500.0, 3));
  EXPECT_NE(noise, band_noise(bands, 50000, 500.0, 4));
}

TEST(BandNoise, NoBandsIsSilenceAndAnEmptyBandIsRefused) {
  EXPECT_EQ(band_noise({}, 10, 100.0, 0).norm(), 0.0);
  EXPECT_THROW(band_noise({{10.0, 10.0, 1.0}}, 10, 100.0, 0), InvalidInput);
  EXPECT_THROW(band_noise({{0.0, 10.0, -1.0}}, 10, 100.0, 0), InvalidInput);
  EXPECT_THROW(band_noise({}, 0, 100.0, 0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
