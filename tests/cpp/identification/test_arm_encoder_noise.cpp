#include "arm_encoder_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// What is measured on white noise that really was low-passed to and fro and differentiated.
TEST(ArmEncoderNoise, AutocovarianceIsThatOfFilteredWhiteNoise) {
  constexpr double cutoff = 8.0;
  constexpr double rate = 250.0;
  constexpr Index step = 15;
  RandomSource random(1);
  SamplesX noise(400000, 1);
  for (Index i = 0; i < noise.rows(); ++i) {
    noise(i, 0) = random.normal();
  }
  const SamplesX position = sosfiltfilt(butter(4, cutoff, rate), noise, PadType::even, 200);
  const SamplesX acceleration = savgol_filter(position, 7, 6, 2, 1.0 / rate);
  const Eigen::MatrixXd table = smoothed_autocovariance(cutoff, rate, step, 4);
  const auto covary = [&](const SamplesX& a, const SamplesX& b, Index lag) {
    const Index count = a.rows() - lag;
    return a.col(0).tail(count).dot(b.col(0).head(count)) / static_cast<double>(count);
  };
  for (Index lag = 0; lag < 4; ++lag) {
    EXPECT_NEAR(covary(position, position, lag * step), table(lag, 0), 0.02 * table(0, 0));
    EXPECT_NEAR(covary(acceleration, position, lag * step), table(lag, 2), 0.02 * std::abs(table(0, 2)));
    EXPECT_NEAR(covary(acceleration, acceleration, lag * step), table(lag, 4), 0.02 * table(0, 4));
  }
}

TEST(ArmEncoderNoise, OddDerivativesAreThoseOfTheEvenOnes) {
  const Eigen::MatrixXd fine = smoothed_autocovariance(5.0, 1000.0, 1, 60);
  for (const Index column : {0, 1, 2, 3}) {
    const double scale = fine.col(column + 1).cwiseAbs().maxCoeff();
    for (Index lag = 1; lag < 59; ++lag) {
      const double slope = (fine(lag + 1, column) - fine(lag - 1, column)) / 2e-3;
      EXPECT_NEAR(slope, fine(lag, column + 1), 2e-3 * scale);
    }
  }
}

}  // namespace
}  // namespace circlepoint
