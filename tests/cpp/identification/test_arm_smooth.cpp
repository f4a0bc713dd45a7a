#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

TEST(MovingJoints, ThoseThatMoveAloneOrByManyCountsOrMostMoveOnTheirOwnAccount) {
  constexpr Index samples = 500;
  constexpr double rate = 250.0;
  SmoothSpan span;
  span.samples = {0, samples};
  span.joints.push_back({8.0, rate, SamplesX::Zero(samples, 3)});
  span.joints.push_back({4.0, rate, SamplesX::Zero(samples, 3)});
  span.joints.push_back({1.0, rate, SamplesX::Zero(samples, 3)});
  const Eigen::Vector3d counts(28.0, 1.5, 20.0);
  const Eigen::Vector3d resolution = Eigen::Vector3d::Constant(2e-3);
  for (SmoothJoints& joints : span.joints) {
    for (Index i = 0; i < samples; ++i) {
      const double turn = 2.0 * M_PI * 0.5 * static_cast<double>(i) / rate;  // half a hertz
      joints.position.row(i) = 0.5 * (1.0 - std::cos(turn)) * counts.cwiseProduct(resolution).transpose();
    }
  }
  const auto movers = [&](Index alone) { return moving_joints(span, span.samples, alone, resolution); };
  EXPECT_EQ(movers(0), (std::vector<bool>{true, false, false}));
  EXPECT_EQ(movers(-1), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(smoothing_for_yields(span, span.samples, movers(0)), 1);  // four times the motion's frequency passes
  const Eigen::Vector3d fine = Eigen::Vector3d::Constant(2e-5);
  EXPECT_EQ(moving_joints(span, span.samples, -1, fine), (std::vector<bool>{true, true, true}));
}

INSTANTIATE_TEST_SUITE_P(Orders, SmoothJointsOrder, testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace circlepoint
