#pragma once
// The whole-arm problem solved with the noise as it is.

#include "arm_problem.hpp"

namespace circlepoint {

struct ArmSolution {
  ArmState state;
  double cost = 0.0;
  int iterations = 0;
  bool converged = false;
};

// Levenberg-Marquardt (Ceres) with the noise as it is.
ArmSolution solve(const ArmProblem& problem, const ArmState& start, int max_iterations);

}  // namespace circlepoint
