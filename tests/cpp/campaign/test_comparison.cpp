#include "circlepoint/campaign/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

using support::four_joints;

// What a calibration would say whose lines are the truth's, displaced by `local`.
JointCalibration displaced(const ScrewChain& truth, const std::vector<Eigen::Vector4d>& local,
                           const Eigen::Matrix4d& covariance) {
  JointCalibration calibration;
  calibration.reference_configuration = truth.reference_configuration;
  for (std::size_t joint = 0; joint < truth.axes.size(); ++joint) {
    JointEstimate estimate;
    estimate.joint = static_cast<Index>(joint);
    ScrewAxis axis = truth.axes[joint];
    axis.line = retract(axis.line, local[joint]);
    estimate.axis = JointAxis{axis, covariance};
    calibration.joints.push_back(estimate);
  }
  return calibration;
}

TEST(CompareLines, ADisplacementOfTheTruthIsTheErrorWhateverTheTruthsReference) {
  const ScrewChain truth = four_joints();
  std::vector<Eigen::Vector4d> local;
  for (int joint = 0; joint < 4; ++joint) {
    local.emplace_back(Eigen::Vector4d(1e-6, -2e-6, 3e-6, 4e-6) * (joint + 1));
  }
  const JointCalibration calibration = displaced(truth, local, 1e-12 * Eigen::Matrix4d::Identity());
  for (const double turned : {0.0, 0.7}) {
    const auto found = compare_lines(calibration, rebase(truth, Eigen::Vector4d::Constant(turned)));
    ASSERT_EQ(found.size(), 4U);
    for (std::size_t joint = 0; joint < 4; ++joint) {
      EXPECT_NEAR((found[joint].error - local[joint]).norm(), 0.0, 1e-10);
      EXPECT_NEAR(found[joint].nees, local[joint].squaredNorm() / 4e-12, 1e-3 * found[joint].nees);
      EXPECT_NEAR((found[joint].std - Eigen::Vector4d::Constant(1e-6)).norm(), 0.0, 1e-10);
    }
  }
}

TEST(CompareLines, ErrorsDrawnFromTheCovarianceHaveAMeanNormalisedSquareOfOne) {
  const ScrewChain truth = four_joints();
  Eigen::Matrix4d root = Eigen::Vector4d(2e-5, 1e-5, 3e-5, 5e-5).asDiagonal();
  root(2, 0) = 1e-5;
  root(3, 1) = -2e-5;
  RandomSource random(5);
  double sum = 0.0;
  constexpr int draws = 2000;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<Eigen::Vector4d> local;
    for (int joint = 0; joint < 4; ++joint) {
      Eigen::Vector4d normal;
      for (double& value : normal) {
        value = random.normal();
      }
      local.emplace_back(root * normal);
    }
    for (const LineComparison& line : compare_lines(displaced(truth, local, root * root.transpose()), truth)) {
      sum += line.nees;
    }
  }
  // 32,000 squares of normals: the mean is known to sqrt(2 / 32000).
  EXPECT_NEAR(sum / (4.0 * draws), 1.0, 4.0 * std::sqrt(2.0 / (16.0 * draws)));
}

TEST(CompareLines, AMissingJointIsNotANumberAndASingularCovarianceHasNoNormalisedSquare) {
  const ScrewChain truth = four_joints();
  JointCalibration calibration =
      displaced(truth, std::vector<Eigen::Vector4d>(4, Eigen::Vector4d::Zero()), Eigen::Matrix4d::Zero());
  calibration.joints[1].axis.reset();
  const auto found = compare_lines(calibration, truth);
  EXPECT_TRUE(found[1].error.array().isNaN().all());
  EXPECT_TRUE(found[0].error.isZero(1e-12));
  EXPECT_TRUE(std::isnan(found[0].nees));
}

TEST(CompareLines, AnEstimateThatPointsTheOtherWayIsHalfATurnWrong) {
  const ScrewChain truth = four_joints();
  JointCalibration calibration =
      displaced(truth, std::vector<Eigen::Vector4d>(4, Eigen::Vector4d::Zero()), Eigen::Matrix4d::Identity());
  Line& line = calibration.joints[0].axis->screw.line;
  line = make_line(-line.direction, line.point);
  EXPECT_NEAR(compare_lines(calibration, truth)[0].error.head<2>().norm(), 3.14159265358979, 1e-6);
}

TEST(CompareLines, AnArmOfOtherJointsIsRefused) {
  ScrewChain truth = four_joints();
  const JointCalibration calibration =
      displaced(truth, std::vector<Eigen::Vector4d>(4, Eigen::Vector4d::Zero()), Eigen::Matrix4d::Identity());
  truth.axes.pop_back();
  truth.reference_configuration = Eigen::Vector3d::Zero();
  EXPECT_THROW(compare_lines(calibration, truth), InvalidInput);
}

TEST(EndPointError, OfALastAxisMovedAlongItselfIsNoneAndAcrossItsArc) {
  const ScrewChain truth = four_joints();
  ScrewChain estimate = truth;
  SamplesX configurations(2, 4);
  configurations << 0.0, 0.0, 0.0, 0.0, 0.3, -0.2, 0.5, 2.0;
  Line& line = estimate.axes[3].line;
  line.point += 0.1 * line.direction;
  EXPECT_NEAR(end_point_error(estimate, truth, configurations), 0.0, 1e-12);
  line = retract(truth.axes[3].line, Eigen::Vector4d(0.0, 0.0, 1e-3, 0.0));
  // The sensor turns by 2 rad about an axis 1 mm off: 2 mm sin(1), in one configuration of two.
  EXPECT_NEAR(end_point_error(estimate, truth, configurations), 2e-3 * std::sin(1.0) / std::sqrt(2.0), 1e-9);
  EXPECT_THROW(static_cast<void>(end_point_error(estimate, truth, SamplesX(0, 4))), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
