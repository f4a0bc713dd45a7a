// From acceleration to displacement: a zero-phase filter removes vibration, integrating makes much of a bias.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/conditioning/sosfilt.hpp"

namespace cp = circlepoint;

int main() {
  const double rate = 500.0, span = 0.4, omega = 2.0 * std::numbers::pi * 0.5;
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(2001, 0.0, 2000.0 / rate);
  const Eigen::ArrayXd displacement = span * (1.0 - (omega * t).cos()) / 2.0;
  const cp::SamplesX acceleration = span / 2.0 * omega * omega * (omega * t).cos();
  const cp::SamplesX vibration = 0.1 * (2.0 * std::numbers::pi * 35.0 * t).sin();
  const cp::SecondOrderSections low_pass = cp::butter(4, 10.0, rate);

  std::puts("bias mm/s^2   vibration left mm/s^2   displacement error after 2 s, 4 s, mm");
  for (const double bias : {0.0, 0.005}) {
    const cp::SamplesX reading = (acceleration + vibration).array() + bias;
    const cp::SamplesX filtered = cp::sosfiltfilt(low_pass, reading);
    const Eigen::ArrayXd left = (filtered - cp::sosfiltfilt(low_pass, acceleration)).array() - bias;
    const cp::SamplesX velocity = cp::cumulative_trapezoid(filtered, 1.0 / rate, 0.0);
    const Eigen::ArrayXd error = cp::cumulative_trapezoid(velocity, 1.0 / rate, 0.0).array() - displacement;
    std::printf("%11.1f   %21.3f   %10.2f %10.2f\n", 1e3 * bias, 1e3 * left.segment(500, 1000).abs().maxCoeff(),
                1e3 * error[1000], 1e3 * error[2000]);
  }
}
