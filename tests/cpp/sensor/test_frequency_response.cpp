#include "circlepoint/sensor/frequency_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

const std::vector<ResponseBand> qa700{{0.0, 10.0, 1e-3}, {10.0, 200.0, 0.05}, {200.0, 300.0, 0.10}};

TEST(FrequencyResponse, DrawnResponsesKeepWithinEveryBandAndDiffer) {
  double least = 1.0;
  double most = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SecondOrderResponse response = draw_response(qa700, seed);
    const double used = used_tolerance(response, qa700);
    EXPECT_LE(used, 1.0);
    least = std::min(least, used);
    most = std::max(most, used);
    for (double f = 1.0; f <= 300.0; f += 1.0) {
      const double tolerance = f <= 10.0 ? 1e-3 : f <= 200.0 ? 0.05 : 0.10;
      EXPECT_LE(std::abs(std::abs(response.at(f)) - 1.0), tolerance * (1.0 + 1e-9)) << f;
    }
  }
  EXPECT_LT(least, 0.5);
  EXPECT_GT(most, 0.8);
}

TEST(FrequencyResponse, TheSectionIsExactAtRestAndWhereAsked) {
  const SecondOrderResponse response{800.0, 0.6};
  const Eigen::Matrix<double, 1, 6> s = response_section(response, 4000.0, 300.0);
  const auto sampled = [&s](double frequency) {
    const std::complex<double> w = std::polar(1.0, -2.0 * std::numbers::pi * frequency / 4000.0);
    return (s[0] + s[1] * w + s[2] * w * w) / (s[3] + s[4] * w + s[5] * w * w);
  };
  EXPECT_NEAR(std::abs(sampled(0.0) - 1.0), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(sampled(300.0) - response.at(300.0)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(sampled(100.0) - response.at(100.0)), 0.0, 5e-3);
}

TEST(FrequencyResponse, WhatCannotBeMetIsRefused) {
  EXPECT_THROW(draw_response({}, 0), InvalidInput);
  EXPECT_THROW(draw_response({{0.0, 300.0, 1e-9}}, 0), InvalidInput);
  EXPECT_THROW(response_section({}, 500.0, 250.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
