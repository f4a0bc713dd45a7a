#pragma once
// The inner loops of cumulative integrals and smoothing, one table of them for each instruction set. No Eigen here (core/vector_pack.hpp).

#include <cstddef>

#include "sample_rows.hpp"

namespace circlepoint::detail {

/// Widths of the intervals: differences of the abscissae `x`, or where there are none `dx`.
struct Intervals {
  const double* x;
  double dx;
};

struct SignalKernels {
  using Integrate = void(ConstRows y, Rows integral, std::ptrdiff_t samples, std::ptrdiff_t channels, Intervals intervals,
                         double* sums, double offset);

  /// Cumulative integrals without their initial row; `sums` has `channels` zeros, the integrals begin there.
  Integrate* trapezoids;
  Integrate* parabolas;  ///< three samples or more
  /// y[i] = w[0] x[i] + sum_j w[j] (x[i + j step] +- x[i - j step]), j = 1 ... half, over a flat array; + if `symmetric`.
  void (*correlate)(const double* x, double* y, std::ptrdiff_t values, const double* weights, std::ptrdiff_t half,
                    std::ptrdiff_t step, bool symmetric);
};

extern const SignalKernels signal_kernels_baseline;
extern const SignalKernels signal_kernels_avx2;
extern const SignalKernels signal_kernels_avx512;

/// Those of the instruction set in use.
const SignalKernels& signal_kernels();

}  // namespace circlepoint::detail
