#pragma once
// Errors of the joints' encoders, their gains and what they are off by once a turn: which are estimated.

#include <vector>

#include "arm_problem.hpp"
#include "circlepoint/identification/whole_arm.hpp"

namespace circlepoint {

// Columns and priors for the moving joints' encoder errors that are to be estimated whatever the data show.
void claim_encoder_errors(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options);

// Columns and priors for those that are to be estimated where the data show them, by six standard deviations at this state: the
// most evident first, then the next beside it (docs/method, eq. (M34)). Whether there are any.
bool claim_evident_encoder_errors(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves,
                                  const WholeArmOptions& options);

}  // namespace circlepoint
