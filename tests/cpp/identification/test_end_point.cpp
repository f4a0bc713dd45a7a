#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "support/random_arms.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

ScrewChain displaced(ScrewChain chain, const Eigen::VectorXd& local) {
  for (Index j = 0; j < chain.size(); ++j) {
    Line& line = chain.axes[static_cast<std::size_t>(j)].line;
    line = retract(line, local.segment<4>(4 * j));
  }
  return chain;
}

// Of correlated errors, the columns of `root` one standard deviation each: predicted against 4,000 drawn ones, whose
// end-points are `place(error, pose)`.
template <class Place>
void expect_spread(const Eigen::VectorXd& predicted, const Eigen::MatrixXd& root, const SamplesX& poses, support::Random& random, const Place& place) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(poses.rows());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(root.rows());
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::VectorXd error = root * Eigen::VectorXd::NullaryExpr(root.cols(), [&] { return random.normal(); });
    for (Index i = 0; i < poses.rows(); ++i) {
      squares[i] += (place(error, poses.row(i)) - place(none, poses.row(i))).squaredNorm() / trials;
    }
  }
  for (Index i = 0; i < poses.rows(); ++i) {
    EXPECT_NEAR(predicted[i] / std::sqrt(squares[i]), 1.0, 0.06) << "pose " << i;
  }
}

// A result with these axes and nothing else.
WholeArmCalibration calibrated(const ScrewChain& chain) {
  WholeArmCalibration calibration;
  calibration.joints.reference_configuration = chain.reference_configuration;
  calibration.joints.joints.resize(chain.axes.size());
  for (std::size_t j = 0; j < chain.axes.size(); ++j) {
    calibration.joints.joints[j].axis = JointAxis{chain.axes[j]};
  }
  return calibration;
}

SamplesX random_poses(support::Random& random, Index joints) {
  return SamplesX::NullaryExpr(5, joints, [&] { return random.vector(1, 3.0)[0]; });
}

// Correlated errors, tenths of a milliradian and of a millimetre.
Eigen::MatrixXd random_root(support::Random& random, Index parameters) {
  return Eigen::MatrixXd::NullaryExpr(parameters, parameters, [&] { return 3e-5 * random.normal(); });
}

TEST(EndPointStd, IsTheSpreadOfTheEndPointOfRandomChains) {
  support::Random random(1);
  const ScrewChain chain = support::four_joints();
  const Eigen::MatrixXd root = random_root(random, 16);
  const SamplesX poses = random_poses(random, 4);
  expect_spread(end_point_std(chain, root * root.transpose(), poses), root, poses, random, [&](const Eigen::VectorXd& local, const Eigen::VectorXd& q) {
    return Eigen::Vector3d(forward_kinematics(displaced(chain, local), q).translation());
  });
}

TEST(EndPointStd, IsTheSpreadOfTheEndPointByLinesAndEncoders) {
  support::Random random(2);
  ScrewChain chain = support::four_joints();
  chain.reference_configuration << 0.3, -0.2, 0.5, 1.0;
  WholeArmCalibration calibration = calibrated(chain);
  // Something of the sensor's between, as in a result.
  calibration.parameters.push_back({.name = "bias_x"});
  for (Index j = 0; j < 4; ++j) {
    for (const char* coordinate : {"d1", "d2", "p1", "p2"}) {
      calibration.parameters.push_back({.name = "joint" + std::to_string(j + 1) + "." + coordinate});
    }
  }
  for (const char* name : {"joint2.gain", "joint3.eccentricity_cos", "joint3.eccentricity_sin"}) {
    calibration.parameters.push_back({.name = name});
  }
  Eigen::MatrixXd root = random_root(random, 20);
  root.bottomRows(3) *= 10.0;  // or the lines would hide them
  calibration.covariance = root * root.transpose();
  const SamplesX poses = random_poses(random, 4);
  const Eigen::VectorXd& reference = chain.reference_configuration;
  expect_spread(end_point_std(calibration, poses), root, poses, random, [&](const Eigen::VectorXd& error, Eigen::VectorXd q) {
    q[1] += error[17] * (q[1] - reference[1]);
    q[2] += error[18] * (std::cos(q[2]) - std::cos(reference[2])) + error[19] * (std::sin(q[2]) - std::sin(reference[2]));
    return Eigen::Vector3d(forward_kinematics(displaced(chain, error.segment<16>(1)), q).translation());
  });
}

TEST(EndPointStd, OfSingleJointResultsStandingAloneIsThatOfTheirLines) {
  const ScrewChain chain = support::four_joints();
  WholeArmCalibration calibration = calibrated(chain);  // without parameters: no start was found
  calibration.joints.covariance = 1e-8 * Eigen::MatrixXd::Identity(16, 16);
  const SamplesX poses = SamplesX::Constant(2, 4, 0.7);
  EXPECT_EQ(end_point_std(calibration, poses), end_point_std(chain, calibration.joints.covariance, poses));
  EXPECT_GT(end_point_std(calibration, poses)[0], 1e-6);
}

TEST(EndPointStd, NeedsAllAxesOfTheArm) {
  WholeArmCalibration calibration = calibrated(support::four_joints());
  calibration.joints.joints[2].axis.reset();
  EXPECT_THROW(end_point_std(calibration, SamplesX::Zero(1, 4)), NotIdentifiable);
}

TEST(EndPointStd, IsZeroAtTheReferenceConfigurationWhereTheSensorDefinesTheFrame) {
  const ScrewChain chain = support::four_joints();
  const SamplesX reference = chain.reference_configuration.transpose();
  EXPECT_LT(end_point_std(chain, 1e-8 * Eigen::MatrixXd::Identity(16, 16), reference)[0], 1e-12);
}

TEST(EndPointStd, ACovarianceOfAnotherSizeIsRefused) {
  const ScrewChain chain = support::four_joints();
  EXPECT_THROW(end_point_std(chain, Eigen::MatrixXd::Identity(12, 12), SamplesX::Zero(1, 4)), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
