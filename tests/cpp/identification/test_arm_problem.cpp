#include <gtest/gtest.h>

#include <random>

#include "arm_marginal.hpp"
#include "arm_offsets.hpp"
#include "arm_problem.hpp"
#include "arm_solve.hpp"

namespace circlepoint {
namespace {

// Two joints, one stretch that knows an offset of the first, and a dwell.
struct ProblemCase {
  ArmProblem problem;
  ArmState state;
};

ProblemCase a_problem(Index channels = 3) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const auto matrix = [&](Index rows, Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); }));
  };
  constexpr Index rows = 20;
  constexpr Index joints = 2;
  ProblemCase made;
  ArmState& state = made.state;
  state.axes = {{JointType::revolute, {Eigen::Vector3d::UnitZ(), {0.3, 0.1, 0.0}}},
                {JointType::revolute, {Eigen::Vector3d::UnitX(), {0.0, 0.2, -0.4}}}};
  state.reference = Eigen::VectorXd::Zero(joints);
  state.up_gravity = {0.0, 6.0, 7.0};
  state.encoder_gain = Eigen::VectorXd::Zero(joints);
  state.eccentricity = Eigen::Matrix2Xd::Zero(2, joints);

  ArmProblem& problem = made.problem;
  problem.layout.claim_lines(state.axes, {true, true});
  problem.layout.up_gravity = problem.layout.claim(3);
  problem.layout.clock_offset = problem.layout.claim(1);
  problem.rows.channels = channels;
  MovingStretch stretch;
  stretch.time = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
  stretch.position = matrix(rows, joints);
  stretch.velocity = matrix(rows, joints);
  stretch.acceleration = matrix(rows, joints);
  stretch.jerk = matrix(rows, joints);
  stretch.snap = matrix(rows, joints);
  stretch.reading = 9.0 * matrix(rows, channels);
  stretch.noise = 0;
  const OffsetTerm term{0, add_parameters(problem.rows, Eigen::MatrixXd::Constant(1, 1, 1e-6))};
  add_term(stretch, term, Eigen::VectorXd::Ones(rows), matrix(rows, 1), matrix(rows, 1));
  problem.rows.stretches = {stretch};
  DwellRow dwell;
  dwell.position = matrix(joints, 1);
  dwell.position_variance = Eigen::VectorXd::Constant(joints, 1e-8);
  dwell.reading = 9.0 * matrix(channels, 1);
  dwell.variance = Eigen::VectorXd::Constant(channels, 1e-4);
  problem.rows.dwells = {dwell};
  problem.offsets = Eigen::VectorXd::Zero(1);
  problem.noise = white_noise(problem.rows, 0.1, 0.02, 0.01);
  return made;
}

void expect_same(const std::vector<PartEquations>& parts, const std::vector<PartEquations>& expected, double tolerance) {
  ASSERT_EQ(parts.size(), expected.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NormalEquations& mine = parts[i].equations;
    const NormalEquations& theirs = expected[i].equations;
    EXPECT_LE((mine.information - theirs.information).norm(), tolerance * theirs.information.norm());
    EXPECT_LE((mine.gradient - theirs.gradient).norm(), tolerance * theirs.gradient.norm());
    EXPECT_LE(std::abs(mine.cost - theirs.cost), tolerance * theirs.cost);
  }
}

TEST(KeptSystemsTest, ServeAnyNoiseAtTheirState) {
  ProblemCase given = a_problem();
  KeptSystems kept;
  linearise_data(given.problem, given.state, &kept);
  given.problem.noise = white_noise(given.problem.rows, 0.03, 0.01, 0.01);
  const std::vector<PartEquations> expected = linearise_data(given.problem, given.state);
  expect_same(linearise_data(given.problem, given.state, &kept), expected, 0.0);
  const ArmResiduals residual = residuals(given.problem, given.state, &kept);
  EXPECT_EQ(residual.moving[0], residuals(given.problem, given.state).moving[0]);
  // The model was not asked again: other readings are not seen before somebody says so.
  given.problem.rows.stretches[0].reading.setZero();
  expect_same({linearise_data(given.problem, given.state, &kept)[0]}, {expected[0]}, 0.0);
  kept.forget();
  expect_same(linearise_data(given.problem, given.state, &kept), linearise_data(given.problem, given.state), 0.0);
}

TEST(KeptSystemsTest, FollowSmallStepsOfTheOffsetsAndAreMadeAnewForLargeOnes) {
  for (const double step : {1e-7, 9e-6, 1e-4, 0.1}) {
    ProblemCase given = a_problem(6);
    KeptSystems kept;
    linearise_data(given.problem, given.state, &kept);
    given.problem.offsets[0] += step;
    // Derivatives are kept as they were, up to a hundred-thousandth.
    expect_same(linearise_data(given.problem, given.state, &kept), linearise_data(given.problem, given.state), step > 1e-5 ? 0.0 : 1e-4);
    const Eigen::MatrixXd moving = residuals(given.problem, given.state, &kept).moving[0];
    EXPECT_LE((moving - residuals(given.problem, given.state).moving[0]).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(KeptSystemsTest, AreMadeAnewOnceManySmallStepsHaveGoneFar) {
  ProblemCase given = a_problem();
  KeptSystems kept;
  linearise_data(given.problem, given.state, &kept);
  for (int step = 0; step < 3; ++step) {
    given.problem.offsets[0] += 4e-6;
    linearise_data(given.problem, given.state, &kept);
  }
  EXPECT_EQ(kept.linearised_at, given.problem.offsets);
}

// The gyroscope's rows know the joints' offsets too.
TEST(LineariseDataTest, OffsetsColumnsAreThoseOfFiniteDifferences) {
  ProblemCase given = a_problem(6);
  KeptSystems kept;
  linearise_data(given.problem, given.state, &kept);
  const Eigen::VectorXd column = kept.stretches[0].col(given.problem.layout.columns);
  const auto moving = [&](double offset) {
    given.problem.offsets[0] = offset;
    return Eigen::MatrixXd(residuals(given.problem, given.state).moving[0]);
  };
  constexpr double step = 1e-5;
  const Eigen::MatrixXd expected = (moving(step) - moving(-step)) / (2.0 * step);
  EXPECT_GT(expected.rightCols<3>().norm(), 1.0);
  EXPECT_LT((column - expected.reshaped()).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SolveTest, TakesNoStepWhereNothingIsLeftToGain) {
  ProblemCase given = a_problem();
  const ArmResiduals off = residuals(given.problem, given.state);
  given.problem.rows.stretches[0].reading += 0.99 * off.moving[0];  // near what the model says
  given.problem.rows.dwells[0].reading += 0.99 * off.dwells.row(0).transpose();
  KeptSystems kept;
  const ArmSolution there = solve(given.problem, given.state, 200, 0.0, &kept);
  ASSERT_TRUE(there.converged);
  const ArmSolution again = solve(given.problem, there.state, 200, 0.1, &kept);
  EXPECT_EQ(again.iterations, 1);  // the evaluation at the start
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(flattened(again.state, given.problem.layout), flattened(there.state, given.problem.layout));
  expect_same(again.parts, linearise_data(given.problem, there.state), 0.0);
}

// Readings the arm explains badly: the model bends within what they leave open, and steps gain little each.
class SolveMisfit : public testing::TestWithParam<double> {};

TEST_P(SolveMisfit, EndsWhereLittleIsLeft) {
  ProblemCase given = a_problem();
  const ArmResiduals off = residuals(given.problem, given.state);
  given.problem.rows.stretches[0].reading += (1.0 - GetParam()) * off.moving[0];
  given.problem.rows.dwells[0].reading += (1.0 - GetParam()) * off.dwells.row(0).transpose();
  constexpr double negligible = 0.1;
  const ArmSolution found = solve(given.problem, given.state, 500, negligible);
  ASSERT_TRUE(found.converged);
  NormalEquations all = marginal(given.problem, found.parts).equations;
  all += linearise_prior(given.problem, found.state);
  EXPECT_LT(all.gradient.dot(all.information.ldlt().solve(all.gradient)), 0.1 * negligible);
}

INSTANTIATE_TEST_SUITE_P(Shares, SolveMisfit, testing::Values(0.03, 0.1));

TEST(KeptSystemsTest, AreMadeAnewAtAnotherState) {
  ProblemCase given = a_problem();
  KeptSystems kept;
  linearise_data(given.problem, given.state, &kept);
  given.state.clock_offset = 1e-9;
  expect_same(linearise_data(given.problem, given.state, &kept), linearise_data(given.problem, given.state), 0.0);
}

// A joint stands where no dwell was seen, at half a count from where another stretch has it.
TEST(ArmOffsetsTest, GivesARestOfAStretchItsOffsetWhetherShared) {
  constexpr double count = 1e-3;
  ArmRows rows;
  for (const double at : {0.0, 0.4 * count, 5.0 * count}) {
    MovingStretch stretch;
    stretch.time = Eigen::VectorXd::LinSpaced(6, 0.0, 1.0);
    stretch.position = SamplesX::Constant(6, 2, at);
    stretch.position.col(1) = stretch.time;  // moves
    stretch.follows.assign(2, false);
    rows.stretches.push_back(stretch);
  }
  DwellRow dwell;
  dwell.position = Eigen::Vector2d(9.0 * count, 0.0);
  dwell.position_variance = Eigen::Vector2d::Constant(count * count / 12.0);
  dwell.follows.assign(2, false);
  rows.dwells = {dwell};
  give_offsets(rows, Eigen::Vector2d::Constant(count));
  ASSERT_EQ(rows.offset_covariance.rows(), 2);
  EXPECT_DOUBLE_EQ(rows.offset_covariance(1, 1), count * count / 12.0);
  for (const MovingStretch& stretch : rows.stretches) {
    ASSERT_EQ(stretch.offsets.size(), 1U);
    EXPECT_EQ(stretch.offsets[0].joint, 0);
  }
  EXPECT_EQ(rows.stretches[0].offsets[0].parameter, rows.stretches[1].offsets[0].parameter);
  EXPECT_NE(rows.stretches[0].offsets[0].parameter, rows.stretches[2].offsets[0].parameter);
  EXPECT_TRUE(rows.dwells[0].offsets.empty());  // its own variance stands for it
  EXPECT_GT(rows.dwells[0].position_variance[0], 0.0);
}

}  // namespace
}  // namespace circlepoint
