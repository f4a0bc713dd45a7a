#pragma once
// Derivatives of equally spaced samples, down the columns.
//
// `gradient`: central differences (y_i+1 - y_i-1) / (2 dx) inside, one-sided differences of first or second order at
// the ends; noise of standard deviation s becomes s / (sqrt(2) dx).
// `savgol_filter`: in each window of samples the least-squares polynomial, evaluated or differentiated at the window's
// centre (Savitzky and Golay 1964); within half a window of the ends, the polynomial of the first or last full window.
// Exact for polynomials up to `polyorder`, no phase. The windows are odd: an even one has no centre sample.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

/// First derivative. Raises InvalidInput for fewer than edge_order + 1 samples, an edge order other than 1 or 2, or a
/// spacing that is zero or not finite.
SamplesX gradient(const Eigen::Ref<const SamplesX>& y, double dx = 1.0, int edge_order = 1);

/// Smoothed samples (deriv = 0) or their derivative of order `deriv`, with spacing `delta`.
/// Raises InvalidInput for a window that is even or longer than the signal, polyorder >= window_length, or deriv < 0.
SamplesX savgol_filter(const Eigen::Ref<const SamplesX>& x, Index window_length, int polyorder, int deriv = 0,
                       double delta = 1.0);

}  // namespace circlepoint
