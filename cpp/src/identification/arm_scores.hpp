#pragma once
// Whether the motions disagree with each other by more than the noise says.

#include <optional>
#include <vector>

#include "arm_problem.hpp"

namespace circlepoint {

// How much larger the motions' scores (gradients at the estimate, summed over stretches that repeat one motion: what the model lacks
// repeats with it) are than the noise makes them: sum g^T C g over
// sum tr C (H - H C H), with the estimate's covariance C (docs/method, eq. (M31)). One if noise and model hold, and where coarse
// encoders' rests are shared: what the stretches have in common then outweighs what each says alone.
double score_ratio(const ArmProblem& problem, const std::vector<PartEquations>& parts, const Eigen::MatrixXd& covariance);

// Finds, pass by pass, the inflation at which the stretches' scores are as large as they should be (M31). Where other data outweigh
// the motions, their residuals grow with the inflation, and the ratio falls with its square: to multiply by the ratio would swing
// for ever, so the slope is taken from the last two passes.
class InflationSearch {
 public:
  // What to try after `inflation` has given `ratio`; 1 at least.
  double next(double inflation, double ratio);

 private:
  struct Tried {
    double inflation;  // logarithms
    double ratio;
  };
  std::optional<Tried> before_;
};

}  // namespace circlepoint
