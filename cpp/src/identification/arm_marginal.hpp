#pragma once
// The whole-arm problem's equations without the shared offsets.

#include <Eigen/Core>
#include <vector>

#include "arm_problem.hpp"

namespace circlepoint {

// All parts in the layout's columns alone: the offsets are minimised over under their prior (Schur complement).
struct MarginalEquations {
  NormalEquations equations;
  Eigen::VectorXd offsets;  // (K) that minimise the cost, for the layout's columns as they are
};
MarginalEquations marginal(const ArmProblem& problem, const std::vector<PartEquations>& parts);
// One part so, as if no other knew its offsets.
NormalEquations marginal_part(const ArmProblem& problem, const PartEquations& part);

}  // namespace circlepoint
