#pragma once
// The inner loop of the section cascade. No Eigen here: this file may be compiled for several instruction sets.

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

/// Runs all sections over `rows` rows of `channels` adjacent values; `out` may be `in`. `state` holds s0 and s1 of each
/// section, [section][2][channel], and is left as it is after the last row.
void filter_rows(const Section* sections, std::ptrdiff_t section_count, double* state, ConstRows in, Rows out,
                 std::ptrdiff_t rows, std::ptrdiff_t channels);

}  // namespace circlepoint::detail
