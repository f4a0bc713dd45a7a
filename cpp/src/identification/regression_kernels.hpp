#pragma once
// The sums over a joint test's samples, one set of loops for each instruction set. No Eigen here (core/vector_pack.hpp).

#include <cstddef>

namespace circlepoint::detail {

/// Upper triangles row by row.
struct RegressionSums {
  double information[15];  ///< sum x x^T, x of five
  double score[15];        ///< sum x y^T, [regressor][channel]
  double squares[6];       ///< sum y y^T, y of three
};

struct RegressionKernels {
  /// x = 1, cos(angle), sin(angle), acceleration, rate^2 of each of `samples`; y the rows of `readings`, three adjacent.
  void (*add_motion)(const double* angle, const double* rate, const double* acceleration, const double* readings,
                     std::ptrdiff_t samples, RegressionSums* sums);
  /// x the rows of `regressors`, five adjacent; rows begin `step` doubles apart.
  void (*add_rows)(const double* regressors, std::ptrdiff_t regressors_step, const double* readings, std::ptrdiff_t readings_step,
                   std::ptrdiff_t samples, RegressionSums* sums);
};

extern const RegressionKernels regression_kernels_baseline;
extern const RegressionKernels regression_kernels_avx2;
extern const RegressionKernels regression_kernels_avx512;

/// Those of the instruction set in use.
const RegressionKernels& regression_kernels();

}  // namespace circlepoint::detail
