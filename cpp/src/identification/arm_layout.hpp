#pragma once
// What the whole-arm estimate estimates, and what is known of it beforehand, by the options.

#include <vector>

#include "arm_problem.hpp"
#include "circlepoint/identification/whole_arm.hpp"

namespace circlepoint {

// Which columns there are, and the priors on them.
void lay_out(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options);

// Parameters the options hold fixed keep their nominal values whatever the start says.
void hold_fixed(ArmState& state, const ArmLayout& layout, const AccelerometerSpecification& sensor);

}  // namespace circlepoint
