#include "circlepoint/conditioning/sosfilt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

constexpr double sample_rate = 500.0;

SamplesX random_samples(Index rows, Index channels) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  return SamplesX::NullaryExpr(rows, channels, [&] { return normal(random); });
}

SamplesX sinusoid(Index rows, double frequency) {
  SamplesX x(rows, 1);
  for (Index i = 0; i < rows; ++i) {
    x(i, 0) = std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / sample_rate);
  }
  return x;
}

TEST(Sosfiltfilt, ATimeReversedSignalGivesTheTimeReversedResult) {
  // Where the transients of both ends have died away: they start from different states.
  const SecondOrderSections sos = butter(4, 40.0, sample_rate);
  for (const Index channels : {1, 2, 3, 4, 5, 8, 13}) {
    const SamplesX x = random_samples(1500, channels);
    const SamplesX reversed = x.colwise().reverse();
    const SamplesX back = sosfiltfilt(sos, reversed).colwise().reverse();
    const SamplesX gap = (back - sosfiltfilt(sos, x)).middleRows(500, 500);
    EXPECT_LT(gap.cwiseAbs().maxCoeff(), 1e-12) << channels << " channels";
  }
}

TEST(Sosfiltfilt, AnInteriorImpulseAnswersSymmetrically) {
  const SecondOrderSections sos = butter(3, {5.0, 40.0}, sample_rate, BandType::bandpass);
  SamplesX impulse = SamplesX::Zero(2001, 3);
  impulse.row(1000).setOnes();
  const SamplesX answer = sosfiltfilt(sos, impulse);
  const SamplesX reversed = answer.colwise().reverse();
  EXPECT_GT(answer(1000, 0), 0.1);
  EXPECT_LT((answer - reversed).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Sosfiltfilt, ASinusoidInThePassBandKeepsItsPhaseAndHasTheSquaredGain) {
  const double frequency = 10.0;
  const double cutoff = 40.0;
  const int order = 2;
  const SamplesX x = sinusoid(4000, frequency);
  const SamplesX y = sosfiltfilt(butter(order, cutoff, sample_rate), x);
  const double ratio =
      std::tan(std::numbers::pi * frequency / sample_rate) / std::tan(std::numbers::pi * cutoff / sample_rate);
  const double squared_gain = 1.0 / (1.0 + std::pow(ratio, 2.0 * order));
  EXPECT_LT((y - squared_gain * x).middleRows(1000, 2000).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Sosfiltfilt, AConstantPassesALowPassAndNotAHighPass) {
  const SamplesX constant = SamplesX::Constant(200, 3, 9.81);
  for (const PadType padtype : {PadType::odd, PadType::even, PadType::constant, PadType::none}) {
    EXPECT_LT((sosfiltfilt(butter(4, 40.0, sample_rate), constant, padtype) - constant).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT(sosfiltfilt(butter(4, 5.0, sample_rate, BandType::highpass), constant, padtype).cwiseAbs().maxCoeff(),
              1e-9);
  }
}

TEST(Sosfilt, ResultDoesNotDependOnTheNumberOfChannelsBeside) {
  const SecondOrderSections sos = butter(7, {20.0, 60.0}, sample_rate, BandType::bandpass);
  const SamplesX x = random_samples(5000, 11);
  const SamplesX together = sosfilt(sos, x);
  for (Index channel = 0; channel < x.cols(); ++channel) {
    const SamplesX alone = x.col(channel);
    EXPECT_EQ(sosfilt(sos, alone), together.col(channel)) << "channel " << channel;
  }
}

TEST(Sosfilt, TakesColumnsOfAWiderArrayWithoutACopy) {
  const SecondOrderSections sos = butter(2, 40.0, sample_rate);
  const SamplesX wide = random_samples(300, 7);
  const SamplesX copied = wide.middleCols(2, 3);
  EXPECT_EQ(sosfilt(sos, wide.middleCols(2, 3)), sosfilt(sos, copied));
  EXPECT_EQ(sosfiltfilt(sos, wide.middleCols(2, 3)), sosfiltfilt(sos, copied));
}

TEST(SosfiltZi, AStepIsAnsweredAtOnceByItsFinalValue) {
  const SecondOrderSections sos = butter(5, 40.0, sample_rate);
  const auto zi = sosfilt_zi(sos);
  double input = 1.0;
  for (Index i = 0; i < sos.rows(); ++i) {
    const double output = sos(i, 0) * input + zi(i, 0);
    EXPECT_NEAR(sos(i, 1) * input - sos(i, 4) * output + zi(i, 1), zi(i, 0), 1e-12);
    EXPECT_NEAR(sos(i, 2) * input - sos(i, 5) * output, zi(i, 1), 1e-12);
    input = output;
  }
  EXPECT_NEAR(input, 1.0, 1e-12);
}

TEST(Butter, ACutoffBeyondNyquistIsNamedWithIt) {
  try {
    butter(4, 300.0, sample_rate);
    FAIL() << "a cut-off of 300 Hz at 500 samples per second was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("300.0"));
    EXPECT_THAT(error.what(), testing::HasSubstr("250.0"));
  }
}

TEST(Sosfiltfilt, ASignalNoLongerThanItsExtensionIsRefused) {
  const SecondOrderSections sos = butter(4, 40.0, sample_rate);
  EXPECT_NO_THROW(sosfiltfilt(sos, random_samples(16, 3)));
  EXPECT_THROW(sosfiltfilt(sos, random_samples(15, 3)), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
