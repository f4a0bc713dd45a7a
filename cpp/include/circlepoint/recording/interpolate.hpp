#pragma once
// Interpolation between samples: the cubic spline with continuous second derivative, not-a-knot at both ends, so that a
// cubic is reproduced and accelerations taken from interpolated positions have no steps. It passes through the samples:
// it does not smooth, and noise on knots much closer together than their neighbours is amplified between them.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

/// Cubic spline (not-a-knot) through values (N, channels) at strictly increasing knots (N), evaluated at `at` (M).
/// N = 3 gives the parabola, 2 the straight line, 1 the constant. Outside the knots the end pieces are continued.
/// Raises InvalidInput for sizes that differ, no knots, or knots that do not increase.
SamplesX interpolate_cubic(const Eigen::Ref<const Eigen::VectorXd>& knots, const Eigen::Ref<const SamplesX>& values,
                           const Eigen::Ref<const Eigen::VectorXd>& at);

}  // namespace circlepoint
