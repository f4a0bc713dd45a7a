#include "arm_tie.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr Index joints = 4;
constexpr Index functions = 11;
constexpr double noise = 0.05;  // counts

// Coefficients of a rigid arm on springs, each function of a pair with noise of its own and an error of the model.
struct SpringArm {
  ArmAtHome arm;
  std::vector<RestingFit> fits;
  Eigen::VectorXd truth;
  Eigen::VectorXd compliance = Eigen::VectorXd::LinSpaced(joints, 1.0, 2.5);

  SpringArm(std::uint64_t seed, double model_std) {
    RandomSource random(seed);
    const auto vector = [&](double size) { return Eigen::Vector3d(size * random.normal(), size * random.normal(), size * random.normal()); };
    for (Index j = 0; j < joints; ++j) {
      arm.axes.push_back({JointType::revolute, make_line(vector(1.0), vector(0.4))});
      arm.known.push_back(true);
    }
    arm.position = Eigen::VectorXd::NullaryExpr(joints, [&] { return random.normal(); });
    arm.up_gravity = vector(5.0);
    const Eigen::MatrixXd loads = Eigen::MatrixXd::NullaryExpr(load_parameters, joints, [&] { return 0.1 * random.normal(); });
    truth.resize(joints * (1 + (joints - 1) * functions));
    Index at = 0;
    for (Index resting = 0; resting < joints; ++resting) {
      RestingFit fit;
      fit.joint = resting;
      Eigen::VectorXd mine(1 + (joints - 1) * functions);
      mine[0] = 0.3 * random.normal();
      Index first = 1;
      for (Index moving = 0; moving < joints; ++moving) {
        if (moving == resting) {
          continue;
        }
        fit.fit.tests.push_back(static_cast<std::size_t>(moving));
        fit.fit.first.push_back(first);
        fit.moving.push_back(moving);
        fit.resolve.emplace_back(Eigen::MatrixXd::Identity(functions, functions));
        Eigen::VectorXd c = Eigen::VectorXd::Zero(functions);
        c.head(load_functions) = compliance[resting] * load_coefficients(arm, moving, resting) * loads.col(std::max(moving, resting));
        mine.segment(first, functions) = c + model_std * Eigen::VectorXd::NullaryExpr(functions, [&] { return random.normal(); });
        first += functions;
      }
      truth.segment(at, mine.size()) = mine;
      at += mine.size();
      fit.fit.estimate = mine + noise * Eigen::VectorXd::NullaryExpr(mine.size(), [&] { return random.normal(); });
      fit.fit.covariance = noise * noise * Eigen::MatrixXd::Identity(mine.size(), mine.size());
      fits.push_back(std::move(fit));
    }
  }
};

// Of each coefficient's error in its standard deviations.
double mean_square(const TiedFits& tied, const Eigen::VectorXd& truth) {
  return (tied.estimate - truth).cwiseAbs2().cwiseQuotient(tied.covariance.diagonal()).mean();
}

TEST(ArmTie, ARigidArmsCoefficientsBecomeMuchBetterKnownAndAsWellAsClaimed) {
  double squares = 0.0;
  double errors = 0.0;
  constexpr std::uint64_t seeds = 20;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const SpringArm made(seed, 0.0);
    const LoadModel model(made.fits, made.arm);
    const LoadPoint point = model.fit();
    EXPECT_LT(point.model_std, noise);
    const TiedFits tied = model.tied(point);
    squares += mean_square(tied, made.truth) / static_cast<double>(seeds);
    errors += (tied.estimate - made.truth).squaredNorm() / static_cast<double>(made.truth.size() * static_cast<Index>(seeds));
  }
  EXPECT_GT(squares, 0.5);
  EXPECT_LT(squares, 1.3);
  EXPECT_LT(std::sqrt(errors), 0.6 * noise);
}

TEST(ArmTie, WhereTheModelDoesNotHoldItsErrorIsFoundAndTheCountsAreBelieved) {
  double squares = 0.0;
  constexpr std::uint64_t seeds = 10;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const double error = seed % 2 == 0 ? 0.2 : 1.0;
    const SpringArm made(seed, error);
    const LoadModel model(made.fits, made.arm);
    const LoadPoint point = model.fit();
    EXPECT_GT(point.model_std, 0.5 * error);
    EXPECT_LT(point.model_std, 2.0 * error);
    const TiedFits tied = model.tied(point);
    squares += mean_square(tied, made.truth) / static_cast<double>(seeds);
  }
  EXPECT_GT(squares, 0.7);
  EXPECT_LT(squares, 1.3);
}

TEST(ArmTie, TheNearestPointToCoefficientsOfTheModelIsTheOneTheyComeFrom) {
  const SpringArm made(3, 0.0);
  const LoadModel model(made.fits, made.arm);
  const LoadPoint point = model.nearest(model.fit(), made.truth);
  std::vector<RestingFit> exact = made.fits;
  Index at = 0;
  for (RestingFit& fit : exact) {
    fit.fit.estimate = made.truth.segment(at, fit.fit.estimate.size());
    at += fit.fit.estimate.size();
  }
  const TiedFits tied = LoadModel(exact, made.arm).tied(point);
  EXPECT_LT((tied.estimate - made.truth).cwiseAbs().maxCoeff(), 5e-4);  // what is believed beforehand of compliances
  const LoadModel counted(exact, made.arm);
  EXPECT_GT((counted.tied(model.fit()).estimate - made.truth).cwiseAbs().maxCoeff(), 1e-3);  // without the search
}

TEST(ArmTie, APairWithAJointWhoseLineIsNotKnownKeepsWhatItsCountsTell) {
  SpringArm made(5, 0.0);
  made.arm.known[1] = false;
  const LoadModel model(made.fits, made.arm);
  const TiedFits tied = model.tied(model.fit());
  const JointFit& fit = made.fits[1].fit;
  const Index first = made.fits[0].fit.estimate.size();
  EXPECT_LT((tied.estimate.segment(first, fit.estimate.size()) - fit.estimate).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(tied.covariance(first + 1, first + 1), noise * noise, 1e-9);
}

}  // namespace
}  // namespace circlepoint
