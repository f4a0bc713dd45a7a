#pragma once
// What the whole-arm estimate says of itself: names, what the data do not show, residuals on data not used.

#include <string>
#include <vector>

#include "arm_problem.hpp"

namespace circlepoint {

struct Identifiability {
  int rank = 0;
  double condition_number = 0.0;
  Eigen::VectorXd data_std;  // a column each; infinite where the data alone do not determine it
  std::vector<WeakCombination> weak;
};

// From the data's information and the estimate's covariance (with priors).
Identifiability identifiability(const NormalEquations& data, const Eigen::MatrixXd& covariance, const ArmState& state,
                                const ArmLayout& layout);

// Residuals by kind of motion and of the dwells, each also by estimates that leave one stretch (or dwell) out.
std::vector<StretchResidual> hold_out(const ArmProblem& problem, const ArmState& state, const std::vector<PartEquations>& parts,
                                      const Eigen::MatrixXd& information, const ArmResiduals& residuals);

}  // namespace circlepoint
