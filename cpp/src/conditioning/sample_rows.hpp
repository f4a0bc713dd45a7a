#pragma once
// Rows of samples in memory, for the kernels.

#include <cstddef>

namespace circlepoint::detail {

/// `step` is the distance between rows and may be negative (backwards in time).
struct ConstRows {
  const double* first;
  std::ptrdiff_t step;
};
struct Rows {
  double* first;
  std::ptrdiff_t step;
};

/// Of rows that go through all channels and all sections while in the first-level cache.
constexpr std::ptrdiff_t cached_rows(std::ptrdiff_t channels) {
  constexpr std::ptrdiff_t values = 2048;
  const std::ptrdiff_t rows = values / (channels > 0 ? channels : 1);
  return rows > 32 ? rows : 32;
}

}  // namespace circlepoint::detail
