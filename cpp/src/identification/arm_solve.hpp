#pragma once
// The whole-arm problem solved with the noise as it is.

#include "arm_problem.hpp"

namespace circlepoint {

struct ArmSolution {
  ArmState state;
  std::vector<PartEquations> parts;  // at that state
  double cost = 0.0;
  int iterations = 0;
  bool converged = false;
};

// Levenberg-Marquardt (Ceres) with the noise as it is. Ends with a step that lowers the sum of squares by less than
// `negligible_change` and leaves a fiftieth of that, where a thousandth is all that is left, or where none lowers it by 1e-9 of itself.
// `kept` spares the model where it was evaluated last, and takes what it gives.
ArmSolution solve(const ArmProblem& problem, const ArmState& start, int max_iterations, double negligible_change = 0.0,
                  KeptSystems* kept = nullptr);

}  // namespace circlepoint
