#pragma once
// Sample arrays shared by every stage: row-major, one row a sample, the same memory as NumPy's C order.

#include <Eigen/Core>

namespace circlepoint {

using Eigen::Index;

/// (N, 3) samples of a vector quantity.
using Samples3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// (N, channels) samples.
using SamplesX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Conventional standard acceleration of free fall, m/s^2 (3rd CGPM, 1901).
inline constexpr double standard_gravity = 9.80665;

/// Half-open range of sample indices [begin, end).
struct IndexRange {
  Index begin = 0;
  Index end = 0;

  [[nodiscard]] Index size() const { return end - begin; }
  [[nodiscard]] bool operator==(const IndexRange&) const = default;
};

}  // namespace circlepoint
