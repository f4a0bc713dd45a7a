#include "circlepoint/sensor/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {

std::complex<double> SecondOrderResponse::at(double frequency) const {
  const double x = frequency / natural_frequency;
  return 1.0 / std::complex<double>(1.0 - x * x, 2.0 * damping * x);
}

double used_tolerance(const SecondOrderResponse& response, const std::vector<ResponseBand>& bands) {
  constexpr int points = 200;
  double most = 0.0;
  for (const ResponseBand& band : bands) {
    for (int i = 0; i <= points; ++i) {
      const double frequency = band.low + (band.high - band.low) * i / points;
      most = std::max(most, std::abs(std::abs(response.at(frequency)) - 1.0) / band.tolerance);
    }
  }
  return most;
}

SecondOrderResponse draw_response(const std::vector<ResponseBand>& bands, std::uint64_t seed) {
  require(!bands.empty(), "there are no response bands to draw a sensor's response within; give at least one");
  double top = 0.0;
  for (const ResponseBand& band : bands) {
    require(std::isfinite(band.high) && band.low >= 0.0 && band.high > band.low && band.tolerance > 0.0,
            "response band from " + std::to_string(band.low) + " to " + std::to_string(band.high) +
                " Hz with tolerance " + std::to_string(band.tolerance) +
                " is empty; give 0 <= low < high and a positive tolerance");
    top = std::max(top, band.high);
  }
  RandomSource random(seed);
  for (int trial = 0; trial < 1000; ++trial) {
    const double frequency = random.uniform(top, 5.0 * top);
    const double damping = random.uniform(0.4, 1.0);
    const SecondOrderResponse response{frequency, damping};
    if (used_tolerance(response, bands) <= 1.0) {
      return response;
    }
  }
  throw InvalidInput("no second-order response with a natural frequency up to " + std::to_string(5.0 * top) +
                     " Hz was found within the bands; their tolerances are too tight for this model");
}

Eigen::Matrix<double, 1, 6> response_section(const SecondOrderResponse& response, double sample_rate,
                                             double exact_at) {
  require(exact_at > 0.0 && exact_at < 0.5 * sample_rate,
          "a response cannot be exact at " + std::to_string(exact_at) + " Hz when sampled at " +
              std::to_string(sample_rate) + " Hz; give a frequency below half the sample rate");
  // s -> c (z - 1) / (z + 1), s in units of the natural frequency, c so that exact_at maps to itself.
  const double c = (exact_at / response.natural_frequency) / std::tan(std::numbers::pi * exact_at / sample_rate);
  const double a0 = 1.0 + 2.0 * response.damping * c + c * c;
  Eigen::Matrix<double, 1, 6> section;
  section << 1.0 / a0, 2.0 / a0, 1.0 / a0, 1.0, 2.0 * (1.0 - c * c) / a0, (1.0 - 2.0 * response.damping * c + c * c) / a0;
  return section;
}

}  // namespace circlepoint
