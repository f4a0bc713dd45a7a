#pragma once
// Start values of the whole-arm estimate: from single-joint tests where there are some, from random lines otherwise.

#include <optional>
#include <vector>

#include "arm_problem.hpp"

namespace circlepoint {

struct ArmStart {
  ArmState state;
  int tried = 0;       // random starts
  bool found = false;  // a start whose fit explains the readings better than gravity alone, found more than once or by tests
};

// Fills the lines of joints that move and are not `known` by trying random ones on a thinned-out problem, sensor errors as they
// are. The problem's layout is not used, its rows and prior on gravity are.
ArmStart find_start(const ArmProblem& problem, const ArmState& known_state, const std::vector<bool>& known,
                    const std::vector<bool>& moves, int random_starts, std::uint64_t seed);

}  // namespace circlepoint
