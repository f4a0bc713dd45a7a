#pragma once
// The other line that a short motion shows as well. A joint that turns by a small angle tilts gravity in the sensor's frame by that
// angle times its axis' part across gravity; whether the axis points up or down along gravity only what is of second order in the angle
// tells, and the acceleration's moment about the line, which another place of it makes up for.

#include <vector>

#include "arm_settle.hpp"

namespace circlepoint {

// Settles the fit, then from the mirrored line of every revolute joint that travels little, and keeps the one of the smallest misfit, each
// with the noise found for it. (n): joints whose mirrored line explains the recording about as well.
std::vector<bool> settle_among_mirrored(ArmFit& fit, const std::vector<bool>& moves, const WholeArmOptions& options);

}  // namespace circlepoint
