#include "arm_counts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <random>

namespace circlepoint {
namespace {

// cos - 1 and sin of a joint that goes to and fro for 6 s, and alpha.
Eigen::MatrixXd functions(double rate) {
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(static_cast<Index>(6.0 * rate), 0.0, 6.0);
  const Eigen::ArrayXd angle = 1.2 * (1.0 - (std::numbers::pi * time).cos());
  Eigen::MatrixXd phi(time.size(), 3);
  phi.col(0) = angle.cos() - 1.0;
  phi.col(1) = angle.sin();
  phi.col(2) = 1.2 * std::numbers::pi * std::numbers::pi * (std::numbers::pi * time).cos();
  return phi;
}

struct Outcome {
  double squares = 0.0;  // normalised, a number each
  double std = 0.0;      // stated, counts, of the home
};

// Resting joints that yield by so many counts while two others move, seen by encoders of any zero.
Outcome read_yields(double yield, double rate, int trials) {
  const Eigen::MatrixXd phi = functions(rate);
  Outcome outcome;
  for (int trial = 0; trial < trials; ++trial) {
    std::mt19937 generator(static_cast<unsigned>(trial));
    std::uniform_real_distribution<double> within(-0.5, 0.5);
    const double home = within(generator);
    Eigen::VectorXd truth = Eigen::VectorXd::NullaryExpr(7, [&] { return 2.0 * yield * within(generator); });
    truth[0] = home;
    std::vector<CountRows> counts(2);
    for (Index test = 0; test < 2; ++test) {
      const Eigen::VectorXd position = (phi * truth.segment<3>(1 + 3 * test)).array() + home;
      read_counts(counts[static_cast<std::size_t>(test)], phi, position.array().round().matrix(), 10);
      count_repeats(counts[static_cast<std::size_t>(test)]);
    }
    const JointFit fit = fit_and_judge(counts, {0, 1});
    EXPECT_EQ(fit.tests.size(), 2U);
    const Eigen::VectorXd error = fit.estimate - truth;
    outcome.squares += error.dot(fit.covariance.ldlt().solve(error)) / static_cast<double>(error.size() * trials);
    outcome.std += std::sqrt(fit.covariance(0, 0)) / trials;
  }
  return outcome;
}

TEST(ArmCountsTest, StatesWhatChangesOfCountsTellAtAnyRate) {
  constexpr int trials = 60;
  for (const double yield : {2.0, 15.0}) {
    for (const double rate : {100.0, 1000.0}) {
      const Outcome outcome = read_yields(yield, rate, trials);
      EXPECT_LT(outcome.squares, 1.3) << yield << " counts at " << rate << " Hz";
      EXPECT_GT(outcome.squares, 0.2) << yield << " counts at " << rate << " Hz";
    }
  }
}

TEST(ArmCountsTest, KnowsTheHomeBetterTheFinerTheSamples) {
  constexpr int trials = 20;
  EXPECT_LT(read_yields(4.0, 1000.0, trials).std, 0.8 * read_yields(4.0, 50.0, trials).std);
  EXPECT_LT(read_yields(4.0, 1000.0, trials).std, 0.02);
}

// What says nothing of the model, here an encoder of something else, says nothing of how well changes are known.
TEST(ArmCountsTest, LeavesOutATestThatIsNotDescribedAndNoOther) {
  const Eigen::MatrixXd phi = functions(500.0);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> within(-0.5, 0.5);
  std::vector<CountRows> counts(6);
  std::vector<std::size_t> tests;
  for (std::size_t test = 0; test < counts.size(); ++test) {
    const Eigen::Vector3d truth = Eigen::Vector3d::NullaryExpr([&] { return 6.0 * within(generator); });
    Eigen::VectorXd position = (phi * truth).array() + 0.2;
    if (test == 3) {
      position = Eigen::VectorXd::LinSpaced(phi.rows(), 0.0, 20.0 * std::numbers::pi).array().sin() * 20.0;
    }
    read_counts(counts[test], phi, position.array().round().matrix(), 10);
    count_repeats(counts[test]);
    tests.push_back(test);
  }
  const JointFit fit = fit_and_judge(counts, tests);
  EXPECT_EQ(fit.tests, (std::vector<std::size_t>{0, 1, 2, 4, 5}));
  EXPECT_LT(counts[0].change_std, 0.1);
}

}  // namespace
}  // namespace circlepoint
