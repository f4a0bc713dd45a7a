#include "arm_encoder_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// What is measured on white noise that really was low-passed to and fro.
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
  const Eigen::VectorXd table = smoothed_autocovariance(cutoff, rate, step, 4);
  for (Index lag = 0; lag < 4; ++lag) {
    const Index count = position.rows() - lag * step;
    const double found = position.col(0).tail(count).dot(position.col(0).head(count)) / static_cast<double>(count);
    EXPECT_NEAR(found, table[lag], 0.02 * table[0]);
  }
}

// A joint that turns to and fro, read by encoders whose zeros lie anywhere: what their errors really covary by.
TEST(ArmEncoderNoise, CovarianceOfCountErrorsIsThatOfManyZeros) {
  constexpr double cutoff = 8.0;
  constexpr double rate = 250.0;
  constexpr Index samples = 1000;
  Eigen::VectorXd position(samples);  // counts: fast, then slow, then fast again
  for (Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / rate;
    position[i] = 60.0 * std::sin(2.0 * t) + 3.0 * t;
  }
  const Eigen::ArrayXi rows = Eigen::ArrayXi::LinSpaced(12, 300, 630);
  const Eigen::MatrixXf claimed = count_error_covariance(position, rows, cutoff, rate);
  constexpr int zeros = 4000;
  RandomSource random(2);
  Eigen::MatrixXd errors(zeros, 36);
  for (int k = 0; k < zeros; ++k) {
    const double zero = random.uniform();
    SamplesX error(samples, 1);
    error.col(0) = ((position.array() + zero).floor() + 0.5 - position.array() - zero).matrix();
    const SamplesX smooth = sosfiltfilt(butter(4, cutoff, rate), error, PadType::even, 200);
    for (int order = 0; order < 3; ++order) {
      const SamplesX derived = order == 0 ? smooth : savgol_filter(smooth, 7, 6, order, 1.0 / rate);
      for (Index i = 0; i < 12; ++i) {
        errors(k, order * 12 + i) = derived(rows[i], 0);
      }
    }
  }
  const Eigen::MatrixXd found = errors.transpose() * errors / zeros;
  for (Index i = 0; i < 36; ++i) {
    for (Index k = 0; k < 36; ++k) {
      const double scale = std::sqrt(found(i, i) * found(k, k));
      EXPECT_NEAR(static_cast<double>(claimed(i, k)), found(i, k), 0.08 * scale) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace circlepoint
