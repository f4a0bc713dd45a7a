#pragma once
// Recursive filtering by a cascade of second-order sections, once or forwards and backwards (zero phase).
//
// A section (b0, b1, b2, 1, a1, a2) runs in transposed direct form II,
//   y = b0 x + s0,   s0 <- b1 x - a1 y + s1,   s1 <- b2 x - a2 y,
// all sections in one pass over the samples and all channels side by side; sosfilt rounds as SciPy does. The zero-phase filter
// divides every section by its b0, takes y out of the recursion,
//   y = x + s0,   s0 <- (b1/b0 - a1) x + s1 - a1 s0,   s1 <- (b2/b0 - a2) x - a2 s0,
// and multiplies by the product of all b0 once: half the latency and fewer operations.
// The zero-phase filter extends the signal at both ends, starts each direction in the steady state of its first sample,
// and has the squared magnitude of the cascade and no phase. It fails when the signal is not longer than the extension
// at one end, or when a section has a pole at z = 1 and thus no steady state.
// A signal of 6 times the filter's memory and more (of 5 channels and more, 50 times) is filtered in one pass, both its halves side
// by side: the second half, and backwards each block, starts from where as many samples as the filter remembers lead from any state,
// which leaves out less than 1e-18 of the signal. A value that is not finite spoils its whole channel, as in SciPy.

#include <Eigen/Core>
#include <optional>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

/// (sections, 6) coefficients b0, b1, b2, a0 = 1, a1, a2 of each section, first to last.
using SecondOrderSections = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// How a signal is continued beyond its ends: by its point reflection, its mirror image, its end value, or not at all.
enum class PadType { odd, even, constant, none };

/// Filters each column from rest. Raises InvalidInput for sections with a0 other than 1.
SamplesX sosfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x);

/// (sections, 2) states s0, s1 in which each section answers a unit step with its final value at once.
/// Raises InvalidInput for a section with a pole at z = 1.
Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> sosfilt_zi(const Eigen::Ref<const SecondOrderSections>& sos);

/// Filters each column forwards and backwards. `padlen` samples are added at each end; by default three times the
/// number of taps, 3 (2 sections + 1 - min(sections with b2 = 0, sections with a2 = 0)).
/// Raises InvalidInput for a signal of `padlen` samples or fewer.
SamplesX sosfiltfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x,
                     PadType padtype = PadType::odd, std::optional<Index> padlen = std::nullopt);

}  // namespace circlepoint
