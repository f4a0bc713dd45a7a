#include <gtest/gtest.h>

#include <cmath>

#include "arm_smooth.hpp"

namespace circlepoint {
namespace {

class SmoothJointsOrder : public testing::TestWithParam<int> {};

TEST_P(SmoothJointsOrder, DerivativesAtSomeRowsAreThoseOfARange) {
  constexpr Index samples = 40;
  SmoothJoints joints;
  joints.rate = 100.0;
  joints.position = SamplesX(samples, 2);
  for (Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / joints.rate;
    joints.position.row(i) << std::cos(7.0 * t), std::exp(-3.0 * t);
  }
  const Eigen::ArrayXi rows = Eigen::ArrayXi::LinSpaced(samples, 0, samples - 1);
  for (Index joint = 0; joint < 2; ++joint) {
    const Eigen::VectorXd range = joints.derivative(GetParam(), joint, 0, samples);
    const Eigen::VectorXd some = joints.derivative(GetParam(), joint, rows);
    EXPECT_LT((some - range).norm(), 1e-9 * std::pow(joints.rate, GetParam()));
  }
  // Of the cosine, well inside.
  const double t = 0.2;
  const double true_value = std::pow(7.0, GetParam()) * std::cos(7.0 * t + 0.5 * M_PI * GetParam());
  EXPECT_NEAR(joints.derivative(GetParam(), 0, Eigen::ArrayXi::Constant(1, 20))[0], true_value, 1e-4 * std::pow(7.0, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Orders, SmoothJointsOrder, testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace circlepoint
