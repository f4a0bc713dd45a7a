#pragma once
// Noise stated by band, as data sheets do: "0-10 Hz < 80 um/s^2 rms, 10-500 Hz < 800 um/s^2 rms".
//
// Assumption: Gaussian, and flat within each band, so a band [low, high] of rms s has the one-sided density
// S = s^2 / (high - low), (M17). It is made in the frequency domain: every bin of a transform at least twice as long as
// the signal gets a complex normal number whose variance is S averaged over the bin, so the expected power of each band
// is exactly the stated one whatever the length. What lies above half the sample rate folds back, as sampling does.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct NoiseBand {
  double low = 0.0;   ///< Hz
  double high = 0.0;  ///< Hz, above low
  double rms = 0.0;   ///< m/s^2, of the noise within the band

  [[nodiscard]] bool operator==(const NoiseBand&) const = default;
};

/// Three independent channels (samples, 3) of noise with these bands; overlapping bands add in power. The same seed
/// gives the same noise. Raises InvalidInput for a band that is not 0 <= low < high, an rms below zero, no samples or a
/// rate that is not positive.
Samples3 band_noise(const std::vector<NoiseBand>& bands, Index samples, double sample_rate, std::uint64_t seed);

}  // namespace circlepoint
