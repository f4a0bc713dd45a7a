#pragma once
// Butterworth filters as second-order sections.
//
// The analogue prototype of order n has its poles equally spaced on the left half of the unit circle and is flat at
// both ends of the spectrum; cut-off frequencies are prewarped, f -> 4 tan(pi f / sample_rate), and the bilinear
// transform makes it digital, so the gain at each cut-off is exactly 1/sqrt(2). Poles nearest the unit circle are paired with
// their nearest zeros and put last; the gain is in the first section: the same sections SciPy returns. (When a band is
// centred exactly on a quarter of the sample rate, pairs of poles are equally near the circle and the order is open.)
// It fails when a cut-off is not between zero and half the sample rate.

#include <array>

#include "circlepoint/conditioning/sosfilt.hpp"

namespace circlepoint {

enum class BandType { lowpass, highpass, bandpass, bandstop };

/// Low-pass or high-pass filter with its half-power frequency `cutoff` (Hz).
/// Raises InvalidInput for an order below 1, a cut-off outside (0, sample_rate / 2), or a band type that needs two.
SecondOrderSections butter(int order, double cutoff, double sample_rate, BandType btype = BandType::lowpass);

/// Band-pass or band-stop filter with its half-power frequencies `cutoff` (Hz), the lower one first.
/// Raises InvalidInput as above, or when the lower cut-off is not below the upper one.
SecondOrderSections butter(int order, const std::array<double, 2>& cutoff, double sample_rate, BandType btype);

}  // namespace circlepoint
