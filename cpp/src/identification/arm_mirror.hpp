#pragma once
// The other line that a short motion shows as well. A joint that turns by a small angle tilts gravity in the sensor's frame by that
// angle times its axis' part across gravity; whether the axis points up or down along gravity only what is of second order in the angle
// tells, and the acceleration's moment about the line, which another place of it makes up for.

#include <optional>
#include <vector>

#include "arm_solve.hpp"

namespace circlepoint {

struct MirrorSearch {
  std::optional<ArmSolution> better;  // of the smaller sum of squares
  std::size_t joint = 0;              // whose line was mirrored for it
  std::vector<bool> ambiguous;        // (n) the mirrored line explains the joint's motion about as well
};

// Solves from the mirrored line of every revolute joint that travels little. `cost` is the solution's that `state` and
// `covariance` belong to. Of joints already mirrored neither line is better: each is with the weights found for it.
MirrorSearch search_mirrored(const ArmProblem& problem, const ArmState& state, const Eigen::MatrixXd& covariance, double cost,
                             const std::vector<bool>& already);

}  // namespace circlepoint
