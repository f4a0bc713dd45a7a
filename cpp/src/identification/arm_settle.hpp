#pragma once
// The whole-arm estimate from one start: parameters and noise in turn, until both stay.

#include <vector>

#include "arm_problem.hpp"
#include "circlepoint/identification/whole_arm.hpp"

namespace circlepoint {

constexpr int most_iterations = 50;      // of one solution
constexpr double last_change = 0.1;      // of the sum of squares, by a step after which the next would be next to nothing

struct ArmFit {
  ArmProblem problem;
  ArmState state;
  NormalEquations data{};           // at the state, without priors
  std::vector<PartEquations> parts{};
  Eigen::MatrixXd information{};    // data and priors
  Eigen::MatrixXd covariance{};
  ArmResiduals now{};
  int iterations = 0;
  Index outliers = 0;               // rows left out as knocks
  double unsettled = 0.0;           // standard deviations
  bool converged = false;
};

// Takes problem and state of a start to the estimate. Rows that knock are cut out, encoders that are evidently off get columns.
void settle(ArmFit& fit, const std::vector<bool>& moves, const WholeArmOptions& options);

// Sum of the normalised squares, the noise not inflated.
double normalised_squares(const ArmFit& fit);

// Minus twice the logarithm of the likelihood, but for what all fits of one recording share; priors included, the noise not inflated, and
// rows that are left out as if they were like the others.
double misfit(const ArmFit& fit);

}  // namespace circlepoint
