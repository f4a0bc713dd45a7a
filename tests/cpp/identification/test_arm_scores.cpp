#include <gtest/gtest.h>

#include <cmath>

#include "arm_scores.hpp"

namespace circlepoint {
namespace {

// The ratio of scores falls with the inflation to this power, and is one at `right`.
class InflationSearchSlope : public testing::TestWithParam<double> {};

TEST_P(InflationSearchSlope, FindsWhereTheRatioIsOne) {
  constexpr double right = 5.0;
  InflationSearch search;
  double inflation = 1.0;
  for (int pass = 0; pass < 4; ++pass) {
    inflation = search.next(inflation, std::pow(right / inflation, GetParam()));
  }
  EXPECT_NEAR(inflation, right, 1e-6 * right);
}

INSTANTIATE_TEST_SUITE_P(Slopes, InflationSearchSlope, testing::Values(1.0, 2.0, 3.0));

TEST(InflationSearchTest, NeverSaysThatThereIsLessNoiseThanTheResidualsShow) {
  InflationSearch search;
  EXPECT_EQ(search.next(1.0, 0.3), 1.0);
  EXPECT_EQ(search.next(1.0, 0.0), 1.0);
}

}  // namespace
}  // namespace circlepoint
