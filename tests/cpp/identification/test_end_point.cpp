#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "support/random_arms.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

TEST(EndPointStd, IsTheSpreadOfTheEndPointOfRandomChains) {
  support::Random random(1);
  const ScrewChain chain = support::four_joints();
  // Correlated errors of all sixteen coordinates, tenths of a milliradian and of a millimetre.
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(16, 16, [&] { return 3e-5 * random.normal(); });
  SamplesX poses(5, 4);
  for (Index i = 0; i < poses.rows(); ++i) {
    poses.row(i) = random.vector(4, 3.0);
  }
  const Eigen::VectorXd predicted = end_point_std(chain, root * root.transpose(), poses);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(poses.rows());
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::VectorXd local = root * Eigen::VectorXd::NullaryExpr(16, [&] { return random.normal(); });
    ScrewChain perturbed = chain;
    for (Index j = 0; j < 4; ++j) {
      Line& line = perturbed.axes[static_cast<std::size_t>(j)].line;
      line = retract(line, local.segment<4>(4 * j));
    }
    for (Index i = 0; i < poses.rows(); ++i) {
      const Eigen::VectorXd q = poses.row(i);
      squares[i] += (forward_kinematics(perturbed, q).translation() - forward_kinematics(chain, q).translation()).squaredNorm() / trials;
    }
  }
  for (Index i = 0; i < poses.rows(); ++i) {
    EXPECT_NEAR(predicted[i] / std::sqrt(squares[i]), 1.0, 0.06) << "pose " << i;
  }
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
