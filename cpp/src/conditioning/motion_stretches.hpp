#pragma once
// Stretches of the joint stream from which a delay can be measured, with their regressors.

#include <vector>

#include "circlepoint/conditioning/clock_alignment.hpp"
#include "delay_profile.hpp"

namespace circlepoint::detail {

/// Stretches in which exactly one joint moves: regressors 1, cos, sin, acceleration, squared speed.
std::vector<MotionModel> single_joint_stretches(const UniformStream& joints, const ClockAlignmentOptions& options);

/// Moves from rest to rest of several joints along one path s: regressors 1, s ... s^4, acceleration, squared speed.
std::vector<MotionModel> path_stretches(const UniformStream& joints, const ClockAlignmentOptions& options);

}  // namespace circlepoint::detail
