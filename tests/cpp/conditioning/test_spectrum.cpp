#include "circlepoint/conditioning/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

double integral_over_frequency(const PowerSpectrum& spectrum, Index channel) {
  return spectrum.power.col(channel).sum() * spectrum.frequencies[1];
}

TEST(Welch, IntegralOverFrequencyIsThePowerOfTheSignal) {
  // Parseval's theorem holds exactly for one segment of even or odd length without window.
  for (const Index rows : {256, 255, 101}) {
    const SamplesX x = SamplesX::Random(rows, 3);
    const PowerSpectrum spectrum = welch(
        x, 500.0, {.window = Window::boxcar, .nperseg = rows, .noverlap = 0, .detrend = Detrend::none});
    for (Index channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(integral_over_frequency(spectrum, channel), x.col(channel).squaredNorm() / static_cast<double>(rows),
                  1e-12);
    }
  }
}

TEST(Welch, AverageOverDisjointSegmentsIsTheAverageOfTheirSpectra) {
  const SamplesX x = SamplesX::Random(300, 2);  // three segments: a pair and a single one
  const WelchOptions options{.nperseg = 100, .noverlap = 0};
  SamplesX mean = SamplesX::Zero(51, 2);
  for (const Index begin : {0, 100, 200}) {
    mean += welch(x.middleRows(begin, 100), 500.0, options).power / 3.0;
  }
  EXPECT_TRUE(welch(x, 500.0, options).power.isApprox(mean, 1e-12));
}

TEST(Welch, ASinusoidPeaksAtItsFrequencyWithHalfItsSquaredAmplitude) {
  SamplesX x(2000, 1);
  for (Index i = 0; i < x.rows(); ++i) {
    x(i, 0) = 3.0 * std::sin(2.0 * std::numbers::pi * 50.0 * static_cast<double>(i) / 500.0);
  }
  const PowerSpectrum spectrum = welch(x, 500.0, {.nperseg = 500, .scaling = SpectrumScaling::spectrum});
  Index peak = 0;
  EXPECT_NEAR(spectrum.power.col(0).maxCoeff(&peak), 4.5, 1e-9);
  EXPECT_DOUBLE_EQ(spectrum.frequencies[peak], 50.0);
}

TEST(Welch, ASegmentLongerThanTheSignalIsRefused) {
  EXPECT_THROW(welch(SamplesX::Zero(100, 1), 500.0, {.nperseg = 101}), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
