#include "circlepoint/conditioning/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using Complex = std::complex<double>;

// Periodic, so that overlapping windows add up evenly.
Eigen::VectorXd window_values(Window window, Index size) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(size);
  if (window == Window::hann) {
    const double step = 2.0 * std::numbers::pi / static_cast<double>(size);
    for (Index i = 0; i < size && size > 1; ++i) {
      values[i] = 0.5 - 0.5 * std::cos(step * static_cast<double>(i));
    }
  }
  return values;
}

}  // namespace

PowerSpectrum welch(const Eigen::Ref<const SamplesX>& x, double sample_rate, const WelchOptions& options) {
  const Index n = x.rows();
  require(n > 0, "no samples to analyse; give at least one");
  require(std::isfinite(sample_rate) && sample_rate > 0.0,
          "sample rate is " + std::to_string(sample_rate) + " Hz; give a positive, finite rate");
  const Index nperseg = options.nperseg.value_or(std::min<Index>(256, n));
  require(nperseg >= 1 && nperseg <= n, "nperseg is " + std::to_string(nperseg) + ", the signal has " +
                                            std::to_string(n) + " samples; give a segment of 1 to that many samples");
  const Index noverlap = options.noverlap.value_or(nperseg / 2);
  require(noverlap >= 0 && noverlap < nperseg, "noverlap is " + std::to_string(noverlap) + ", nperseg " +
                                                   std::to_string(nperseg) + "; give an overlap from 0 to nperseg - 1");
  const Index hop = nperseg - noverlap;
  const Index segments = (n - noverlap) / hop;
  const Index bins = nperseg / 2 + 1;
  const Eigen::VectorXd window = window_values(options.window, nperseg);

  PowerSpectrum result;
  result.frequencies = Eigen::VectorXd::LinSpaced(bins, 0.0, static_cast<double>(bins - 1)) *
                       (sample_rate / static_cast<double>(nperseg));
  result.power = SamplesX::Zero(bins, x.cols());

  // Two real segments go through one complex transform, as its real and imaginary part: the sum of their powers at bin
  // k is (|Z_k|^2 + |Z_-k|^2) / 2.
  Eigen::FFT<double> fft;
  Eigen::VectorXcd pair(nperseg);
  Eigen::VectorXcd transform(nperseg);
  const auto fill = [&](Index segment, Index channel, bool imaginary) {
    const auto samples = x.col(channel).segment(segment * hop, nperseg);
    const double offset = options.detrend == Detrend::constant ? samples.mean() : 0.0;
    for (Index i = 0; i < nperseg; ++i) {
      const double value = window[i] * (samples[i] - offset);
      pair[i] = imaginary ? Complex(pair[i].real(), value) : Complex(value, 0.0);
    }
  };
  for (Index channel = 0; channel < x.cols(); ++channel) {
    Eigen::VectorXd power = Eigen::VectorXd::Zero(bins);
    for (Index segment = 0; segment < segments; segment += 2) {
      fill(segment, channel, false);
      if (segment + 1 < segments) {
        fill(segment + 1, channel, true);
      }
      fft.fwd(transform.data(), pair.data(), nperseg);
      for (Index k = 0; k < bins; ++k) {
        power[k] += 0.5 * (std::norm(transform[k]) + std::norm(transform[k == 0 ? 0 : nperseg - k]));
      }
    }
    result.power.col(channel) = power;
  }

  const double scale = options.scaling == SpectrumScaling::density ? 1.0 / (sample_rate * window.squaredNorm())
                                                                   : 1.0 / (window.sum() * window.sum());
  result.power *= scale / static_cast<double>(segments);
  const Index doubled = nperseg % 2 == 0 ? bins - 2 : bins - 1;  // a negative frequency of their own
  if (doubled > 0) {
    result.power.middleRows(1, doubled) *= 2.0;
  }
  return result;
}

}  // namespace circlepoint
