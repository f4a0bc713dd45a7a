#pragma once
// Extremum over every window of a fixed length, in three comparisons a sample (van Herk 1992, Gil and Werman 1993):
// blocks of the window's length, running extrema from both ends of each block.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

/// pick(values[s .. s + window)) for every s; values.size() - window + 1 results, none where the window is longer.
template <typename Pick>
std::vector<double> sliding_extremum(const double* values, Index size, Index window, Pick pick) {
  if (window < 1 || size < window) {
    return {};
  }
  std::vector<double> suffix(values, values + size);
  for (Index k = size - 2; k >= 0; --k) {
    if ((k + 1) % window != 0) {
      const auto at = static_cast<std::size_t>(k);
      suffix[at] = pick(suffix[at], suffix[at + 1]);
    }
  }
  std::vector<double> result(static_cast<std::size_t>(size - window + 1));
  double prefix = values[0];
  for (Index k = 0; k < size; ++k) {
    prefix = k % window == 0 ? values[k] : pick(prefix, values[k]);
    if (const Index start = k - window + 1; start >= 0) {
      const auto at = static_cast<std::size_t>(start);
      result[at] = pick(suffix[at], prefix);
    }
  }
  return result;
}

}  // namespace circlepoint
