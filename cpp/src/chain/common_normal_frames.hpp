#pragma once
// The frames of the standard convention along a chain of lines. The modified convention is the standard one of the
// reversed chain with the signs of all rows turned, so that this is the only place where frames are laid.

#include <vector>

#include "circlepoint/chain/screws_to_dh.hpp"

namespace circlepoint {

struct FrameRules {
  const StandardDhChain* nominal = nullptr;  ///< null: no nominal chain, free values are zero
  double parallel_tolerance = 0.0;           ///< rad
  double canonical_sign = 1.0;               ///< +1: 0 < alpha < pi and a >= 0 between parallels; -1: the opposite signs
};

/// Rows, base, tool and free flags; near_parallel is left empty.
StandardDhConversion lay_standard_frames(const ScrewChain& chain, const FrameRules& rules);

/// The multiple of 2 pi of `angle` nearest `reference` (rad); half-way, the larger.
double nearest_turn(double angle, double reference);

}  // namespace circlepoint
