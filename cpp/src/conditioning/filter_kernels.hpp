#pragma once
// The recursions of the filters, one table of them for each instruction set. No Eigen here (core/vector_pack.hpp).

#include <cstddef>

#include "sample_rows.hpp"

namespace circlepoint::detail {

struct Section {
  double b0, b1, b2, a1, a2;
};

/// One run over rows of samples. `state` holds s0 and s1 of each section, [section][2][channel], and is left as it is after the
/// last row. What some sections leave for the others goes through `work`, which may be `out`, or `in` where that may be lost.
struct FilterRun {
  double* state;
  ConstRows in;
  Rows work, out;
};

/// Rows with room: behind each row's channels, up to the next multiple of this, a run may read and write.
constexpr std::ptrdiff_t row_room = 4;

struct FilterKernels {
  /// Runs all sections over `rows` rows of `channels` adjacent values. Rounds as SciPy's sosfilt.
  void (*direct)(const Section* sections, std::ptrdiff_t section_count, const FilterRun& run, std::ptrdiff_t rows,
                 std::ptrdiff_t channels);

  /// One or two runs of equal length side by side, so that one works while the other waits for its own last answer. All
  /// sections but the first have b0 = 1, the first's multiplies its input, and b1 and b2 of each are relative to b0:
  ///   y = x + s0,   s0 <- ((b1 - a1) x + s1) - a1 s0,   s1 <- (b2 - a2) x - a2 s0;
  /// an answer is then not on the way to the next one. Rows of `in` and `work` have room.
  using Paired = void(const Section* sections, std::ptrdiff_t section_count, const FilterRun* runs, std::ptrdiff_t run_count,
                      std::ptrdiff_t rows, std::ptrdiff_t channels);
  Paired* monic_to_room;  ///< rows of `out` have room
  Paired* monic;          ///< they have none
};

extern const FilterKernels filter_kernels_baseline;
extern const FilterKernels filter_kernels_avx2;
extern const FilterKernels filter_kernels_avx512;

/// Those of the instruction set in use.
const FilterKernels& filter_kernels();

}  // namespace circlepoint::detail
