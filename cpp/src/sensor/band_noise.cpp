#include "circlepoint/sensor/band_noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <string>
#include <unsupported/Eigen/FFT>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// Power (one-sided) of the bands within [from, to], negative frequencies counting as positive ones.
double power_between(const std::vector<NoiseBand>& bands, double from, double to) {
  double power = 0.0;
  for (const NoiseBand& band : bands) {
    const double density = band.rms * band.rms / (band.high - band.low);
    const double above = std::min(to, band.high) - std::max(from, band.low);
    const double below = std::min(to, -band.low) - std::max(from, -band.high);
    power += density * (std::max(above, 0.0) + std::max(below, 0.0));
  }
  return power;
}

void validate(const std::vector<NoiseBand>& bands, Index samples, double sample_rate) {
  require(samples > 0, "noise of " + std::to_string(samples) + " samples was asked for; give at least one");
  require(std::isfinite(sample_rate) && sample_rate > 0.0,
          "sample rate is " + std::to_string(sample_rate) + " Hz; give a positive, finite rate");
  for (const NoiseBand& band : bands) {
    const std::string name = "noise band from " + std::to_string(band.low) + " to " + std::to_string(band.high) + " Hz";
    require(std::isfinite(band.high) && band.low >= 0.0 && band.high > band.low,
            name + " is empty; give 0 <= low < high");
    require(std::isfinite(band.rms) && band.rms >= 0.0,
            name + " has an rms of " + std::to_string(band.rms) + " m/s^2; give zero or a positive number");
  }
}

}  // namespace

Samples3 band_noise(const std::vector<NoiseBand>& bands, Index samples, double sample_rate, std::uint64_t seed) {
  validate(bands, samples, sample_rate);
  Samples3 noise = Samples3::Zero(samples, 3);
  double highest = 0.0;
  for (const NoiseBand& band : bands) {
    highest = std::max(highest, band.high);
  }
  if (highest == 0.0) {
    return noise;
  }
  const auto size = static_cast<Index>(std::bit_ceil(static_cast<std::uint64_t>(std::max<Index>(2 * samples, 64))));
  const double step = sample_rate / static_cast<double>(size);
  const auto folds = static_cast<Index>(std::ceil(highest / sample_rate)) + 1;
  Eigen::VectorXd amplitude(size);
  for (Index k = 0; k < size; ++k) {
    double power = 0.0;
    for (Index fold = -folds; fold <= folds; ++fold) {
      const double centre = (static_cast<double>(k) + static_cast<double>(fold * size)) * step;
      power += power_between(bands, centre - 0.5 * step, centre + 0.5 * step);
    }
    amplitude[k] = std::sqrt(0.5 * power);
  }
  // The real and the imaginary part of one complex signal are two independent channels of the same spectrum.
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  RandomSource random(seed);
  Eigen::VectorXcd spectrum(size);
  Eigen::VectorXcd signal(size);
  for (Index pair = 0; pair < 2; ++pair) {
    for (Index k = 0; k < size; ++k) {
      const double real = random.normal();
      const double imaginary = random.normal();
      spectrum[k] = amplitude[k] * std::complex<double>(real, imaginary);
    }
    fft.inv(signal.data(), spectrum.data(), size);
    noise.col(2 * pair) = signal.head(samples).real();
    if (pair == 0) {
      noise.col(1) = signal.head(samples).imag();
    }
  }
  return noise;
}

}  // namespace circlepoint
