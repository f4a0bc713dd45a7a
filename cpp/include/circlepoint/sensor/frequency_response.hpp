#pragma once
// An accelerometer's gain over frequency, stated by band: "0-10 Hz 0.1 %, 10-200 Hz 5 %, 200-300 Hz 10 %".
//
// Assumption: the sensor is a mass on a damped spring (or a servo loop that acts like one), (M16)
//
//   H(f) = 1 / (1 - x^2 + 2 j damping x),    x = f / natural_frequency,
//
// with unit gain at rest, and an individual's natural frequency and damping are whatever keeps | |H| - 1 | within the
// tolerance of every band. Sampled, it is the bilinear transform made exact at rest and at one chosen frequency.

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct ResponseBand {
  double low = 0.0;        ///< Hz
  double high = 0.0;       ///< Hz, above low
  double tolerance = 0.0;  ///< of the gain, relative: 0.05 is +-5 %

  [[nodiscard]] bool operator==(const ResponseBand&) const = default;
};

struct SecondOrderResponse {
  double natural_frequency = 1000.0;  ///< Hz
  double damping = 0.7;               ///< of critical

  /// H at `frequency` (Hz).
  [[nodiscard]] std::complex<double> at(double frequency) const;
};

/// The largest part of a band's tolerance that | |H| - 1 | uses, over 200 frequencies a band: at most 1 when H keeps
/// within all.
double used_tolerance(const SecondOrderResponse& response, const std::vector<ResponseBand>& bands);

/// One individual's response, drawn uniformly (natural frequency over 1 to 5 times the last band's end, damping 0.4 to
/// 1) among those within the bands. Raises InvalidInput for no bands, a band that is empty or has no tolerance, and where a
/// thousand draws find none.
SecondOrderResponse draw_response(const std::vector<ResponseBand>& bands, std::uint64_t seed);

/// The sampled response as one second-order section (b0, b1, b2, 1, a1, a2), exact at 0 and at `exact_at` Hz. Raises
/// InvalidInput unless 0 < exact_at < sample_rate / 2.
Eigen::Matrix<double, 1, 6> response_section(const SecondOrderResponse& response, double sample_rate, double exact_at);

}  // namespace circlepoint
