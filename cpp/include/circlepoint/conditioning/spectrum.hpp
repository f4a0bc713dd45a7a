#pragma once
// Power spectral density by Welch's method: the average of the periodograms of overlapping windowed segments.
//
// One-sided: P(f) = 2 |FFT(w (x - mean))|^2 / (sample_rate sum w^2), without the factor 2 at zero and at half the
// sample rate; the integral of P over f is the power of the signal (Parseval). Each of the K segments' estimates has a
// standard deviation of P itself, so the average has about P / sqrt(K), somewhat more for overlapping segments. Samples
// after the last full segment are not used.

#include <Eigen/Core>
#include <optional>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

enum class Window { hann, boxcar };
enum class Detrend { constant, none };
enum class SpectrumScaling { density, spectrum };

struct PowerSpectrum {
  Eigen::VectorXd frequencies;  ///< (F) Hz, from 0 to half the sample rate
  SamplesX power;               ///< (F, channels) unit^2/Hz (density) or unit^2 (spectrum)
};

struct WelchOptions {
  Window window = Window::hann;
  std::optional<Index> nperseg = {};   ///< samples a segment; by default 256, or the whole signal when it is shorter
  std::optional<Index> noverlap = {};  ///< samples shared by neighbouring segments; by default half a segment
  Detrend detrend = Detrend::constant;
  SpectrumScaling scaling = SpectrumScaling::density;
};

/// Raises InvalidInput for an empty signal, a segment longer than the signal, an overlap of a whole segment or more, or
/// a sample rate that is not positive.
PowerSpectrum welch(const Eigen::Ref<const SamplesX>& x, double sample_rate, const WelchOptions& options = {});

}  // namespace circlepoint
