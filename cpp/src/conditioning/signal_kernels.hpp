#pragma once
// The inner loops over long signals, one table of them for each instruction set. No Eigen here (core/vector_pack.hpp).

#include <cstddef>

namespace circlepoint::detail {

struct Section {
  double b0, b1, b2, a1, a2;
};

/// Rows of samples in memory: `step` is the distance between rows and may be negative (backwards in time).
struct ConstRows {
  const double* first;
  std::ptrdiff_t step;
};
struct Rows {
  double* first;
  std::ptrdiff_t step;
};

/// Widths of the intervals: differences of the abscissae `x`, or where there are none `dx`.
struct Intervals {
  const double* x;
  double dx;
};

struct SignalKernels {
  using Filter = void(const Section* sections, std::ptrdiff_t section_count, double* state, ConstRows in, Rows out,
                      std::ptrdiff_t rows, std::ptrdiff_t channels);
  using Integrate = void(ConstRows y, Rows integral, std::ptrdiff_t samples, std::ptrdiff_t channels, Intervals intervals,
                         double* sums, double offset);

  /// Runs all sections over `rows` rows of `channels` adjacent values; `out` may be `in`. `state` holds s0 and s1 of each
  /// section, [section][2][channel], and is left as it is after the last row. Rounds as SciPy's sosfilt.
  Filter* filter_rows;
  /// The same with s0 <- (b1 - a1 b0) x + s1 - a1 s0 and s1 <- (b2 - a2 b0) x - a2 s0: a sample's answer is then not on the
  /// way to the next one's, which halves the latency of the recursion.
  Filter* filter_rows_short;
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
