#pragma once
// Placing one set of lines on another: an arm's nominal axes beside the calibrated ones.
//
// Calibrated lines live in the sensor's frame, nominal ones in the arm's base frame; where the sensor sits on the arm is
// not known. The rigid transform that brings corresponding lines closest, min sum |local coordinates|^2 with directions
// weighted by a length, makes the two comparable: what is left is how the built arm differs from its drawing. Start:
// the rotation that fits the directions (SVD). Two lines leave no freedom unless parallel; with fewer, or all parallel,
// the smallest displacement is taken.

#include <vector>

#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

/// T_target_source for lines in correspondence. `length` (m) weighs a radian of direction against a metre of position.
/// Of the lines of prismatic joints (`types`, one a line; empty: all revolute) only the directions count.
/// Raises InvalidInput for different numbers of lines or none.
RigidTransform align_lines(const std::vector<Line>& target, const std::vector<Line>& source, double length = 0.5,
                           const std::vector<JointType>& types = {});

}  // namespace circlepoint
