#pragma once
// Cumulative integrals down the columns of samples.
//
// Trapezoid: the integral over [i, i+1] is d_i (y_i + y_i+1) / 2, exact for straight lines, error O(d^2).
// Simpson: the parabola through three neighbouring samples is integrated over each of its two intervals in turn
// (Cartwright 2017, equations 8 and 10), exact for parabolas, error O(d^3) and alternating in sign between even and odd
// samples; fewer than three samples fall back to the trapezoid. The last of an odd number of intervals takes the
// parabola of the last three samples.
// Without `initial` the result has one row less than y, the integral up to each sample but the first.

#include <Eigen/Core>
#include <optional>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

/// Equally spaced by `dx`. `initial` is none or 0 and puts a row of zeros first.
/// Raises InvalidInput for no samples or another `initial`.
SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, double dx = 1.0,
                              std::optional<double> initial = std::nullopt);

/// At the abscissae `x` (N). Raises InvalidInput also when x has another length than y.
SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                              std::optional<double> initial = std::nullopt);

/// Equally spaced by `dx`. `initial` is put first and added to every value. Raises InvalidInput for no samples.
SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, double dx = 1.0,
                            std::optional<double> initial = std::nullopt);

/// At the abscissae `x` (N). Raises InvalidInput also when x has another length than y or, for three samples or more,
/// is not strictly increasing.
SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                            std::optional<double> initial = std::nullopt);

}  // namespace circlepoint
