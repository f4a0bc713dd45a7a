#include "circlepoint/conditioning/butterworth.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;

struct ZerosPolesGain {
  Roots zeros, poles;
  double gain = 1.0;

  [[nodiscard]] std::size_t relative_degree() const { return poles.size() - zeros.size(); }
};

void require_between_zero_and_nyquist(double cutoff, double sample_rate) {
  const double nyquist = 0.5 * sample_rate;
  require(cutoff > 0.0 && cutoff < nyquist,
          "cut-off frequency " + std::to_string(cutoff) + " Hz is outside (0, " + std::to_string(nyquist) +
              ") Hz, the open interval up to the Nyquist frequency of " + std::to_string(sample_rate) +
              " samples per second; choose a cut-off between them");
}

void require_order_and_rate(int order, double sample_rate) {
  require(order >= 1, "filter order is " + std::to_string(order) + "; give 1 or more");
  require(std::isfinite(sample_rate) && sample_rate > 0.0,
          "sample rate is " + std::to_string(sample_rate) + " Hz; give a positive, finite rate");
}

// The bilinear transform below runs at two samples per second, as SciPy's does.
constexpr double bilinear_rate = 4.0;

double prewarped(double cutoff, double sample_rate) {
  return bilinear_rate * std::tan(std::numbers::pi * cutoff / sample_rate);
}

ZerosPolesGain prototype(int order) {
  ZerosPolesGain filter;
  for (int m = 1 - order; m < order; m += 2) {
    filter.poles.push_back(m == 0 ? Complex(-1.0, 0.0) : -std::polar(1.0, std::numbers::pi * m / (2.0 * order)));
  }
  return filter;
}

ZerosPolesGain to_lowpass(ZerosPolesGain filter, double warped) {
  filter.gain *= std::pow(warped, static_cast<double>(filter.relative_degree()));
  for (Complex& pole : filter.poles) {
    pole *= warped;
  }
  return filter;
}

// The prototype has no zeros, its poles multiply to +-1 and -p to 1: the gain stays.
ZerosPolesGain to_highpass(ZerosPolesGain filter, double warped) {
  filter.zeros.assign(filter.poles.size(), Complex(0.0, 0.0));
  for (Complex& pole : filter.poles) {
    pole = warped / pole;
  }
  return filter;
}

// Each pole becomes the two roots of s^2 - 2 half s + center^2.
Roots split(const Roots& halves, double center) {
  Roots both;
  for (const int sign : {1, -1}) {
    for (const Complex& half : halves) {
      both.push_back(half + static_cast<double>(sign) * std::sqrt(half * half - center * center));
    }
  }
  return both;
}

ZerosPolesGain to_bandpass(ZerosPolesGain filter, double center, double bandwidth) {
  const std::size_t degree = filter.relative_degree();
  filter.gain *= std::pow(bandwidth, static_cast<double>(degree));
  for (Complex& pole : filter.poles) {
    pole *= 0.5 * bandwidth;
  }
  filter.poles = split(filter.poles, center);
  filter.zeros.assign(degree, Complex(0.0, 0.0));
  return filter;
}

ZerosPolesGain to_bandstop(ZerosPolesGain filter, double center, double bandwidth) {
  const std::size_t degree = filter.relative_degree();
  for (Complex& pole : filter.poles) {
    pole = 0.5 * bandwidth / pole;
  }
  filter.poles = split(filter.poles, center);
  filter.zeros.assign(degree, Complex(0.0, center));
  filter.zeros.insert(filter.zeros.end(), degree, Complex(0.0, -center));
  return filter;
}

ZerosPolesGain bilinear(ZerosPolesGain filter) {
  const std::size_t degree = filter.relative_degree();
  Complex ratio(1.0, 0.0);
  for (Complex& zero : filter.zeros) {
    ratio *= bilinear_rate - zero;
    zero = (bilinear_rate + zero) / (bilinear_rate - zero);
  }
  Complex below(1.0, 0.0);
  for (Complex& pole : filter.poles) {
    below *= bilinear_rate - pole;
    pole = (bilinear_rate + pole) / (bilinear_rate - pole);
  }
  filter.gain *= std::real(ratio / below);
  filter.zeros.insert(filter.zeros.end(), degree, Complex(-1.0, 0.0));
  return filter;
}

// One of each conjugate pair, then the real roots; each group in order of the real part, then of |imaginary part|.
Roots without_conjugates(Roots roots) {
  constexpr double tolerance = 100.0 * std::numeric_limits<double>::epsilon();
  Roots upper, real;
  for (const Complex& root : roots) {
    if (std::abs(root.imag()) <= tolerance * std::abs(root)) {
      real.emplace_back(root.real(), 0.0);
    } else if (root.imag() > 0.0) {
      upper.push_back(root);
    }
  }
  std::stable_sort(real.begin(), real.end(), [](const Complex& a, const Complex& b) { return a.real() < b.real(); });
  std::stable_sort(upper.begin(), upper.end(), [](const Complex& a, const Complex& b) {
    const bool same_real = std::abs(a.real() - b.real()) <= tolerance * std::abs(a);
    return same_real ? a.imag() < b.imag() : a.real() < b.real();
  });
  upper.insert(upper.end(), real.begin(), real.end());
  return upper;
}

bool is_real(const Complex& root) { return root.imag() == 0.0; }
bool is_any(const Complex&) { return true; }
bool is_complex(const Complex& root) { return root.imag() != 0.0; }

// Removes and returns the allowed root of the least measure, the first of equals.
template <typename Measure>
Complex take_least(Roots& roots, bool (*allowed)(const Complex&), const Measure& measure) {
  auto best = roots.end();
  for (auto root = roots.begin(); root != roots.end(); ++root) {
    if (allowed(*root) && (best == roots.end() || measure(*root) < measure(*best))) {
      best = root;
    }
  }
  const Complex taken = *best;
  roots.erase(best);
  return taken;
}

Complex take_nearest(Roots& roots, bool (*allowed)(const Complex&), const Complex& to) {
  return take_least(roots, allowed, [&](const Complex& root) { return std::abs(root - to); });
}

Complex take_nearest_unit_circle(Roots& roots, bool (*allowed)(const Complex&)) {
  return take_least(roots, allowed, [](const Complex& root) { return std::abs(1.0 - std::abs(root)); });
}

std::array<double, 3> polynomial(const Complex& first, const Complex& second) {
  return {1.0, -(first + second).real(), (first * second).real()};
}

// Pairs the poles nearest the unit circle with their nearest zeros and puts them last.
SecondOrderSections to_sections(ZerosPolesGain filter) {
  if (filter.poles.size() % 2 == 1) {
    filter.poles.emplace_back(0.0, 0.0);
    filter.zeros.emplace_back(0.0, 0.0);
  }
  const Index section_count = static_cast<Index>(filter.poles.size() / 2);
  Roots zeros = without_conjugates(std::move(filter.zeros));
  Roots poles = without_conjugates(std::move(filter.poles));
  SecondOrderSections sos(section_count, 6);
  for (Index i = section_count - 1; i >= 0; --i) {
    const Complex pole1 = take_nearest_unit_circle(poles, is_any);
    const Complex pole2 = is_real(pole1) ? take_nearest_unit_circle(poles, is_real) : std::conj(pole1);
    const bool one_real_pole = std::count_if(poles.begin(), poles.end(), is_real) == 1;
    const bool one_real_zero = std::count_if(zeros.begin(), zeros.end(), is_real) == 1;
    const bool leave_the_real = !is_real(pole1) && one_real_pole && one_real_zero && poles.size() + 1 == zeros.size();
    const Complex zero1 = take_nearest(zeros, leave_the_real ? is_complex : is_any, pole1);
    const Complex zero2 = is_real(zero1) ? take_nearest(zeros, is_real, pole1) : std::conj(zero1);
    const auto [b0, b1, b2] = polynomial(zero1, zero2);
    const auto [a0, a1, a2] = polynomial(pole1, pole2);
    sos.row(i) << b0, b1, b2, a0, a1, a2;
  }
  sos.row(0).head<3>() *= filter.gain;
  return sos;
}

}  // namespace

SecondOrderSections butter(int order, double cutoff, double sample_rate, BandType btype) {
  require_order_and_rate(order, sample_rate);
  require(btype == BandType::lowpass || btype == BandType::highpass,
          "a band-pass or band-stop filter has two cut-off frequencies, not the one " + std::to_string(cutoff) +
              " Hz; give the lower and the upper one");
  require_between_zero_and_nyquist(cutoff, sample_rate);
  const double warped = prewarped(cutoff, sample_rate);
  return to_sections(bilinear(btype == BandType::lowpass ? to_lowpass(prototype(order), warped)
                                                         : to_highpass(prototype(order), warped)));
}

SecondOrderSections butter(int order, const std::array<double, 2>& cutoff, double sample_rate, BandType btype) {
  require_order_and_rate(order, sample_rate);
  require(btype == BandType::bandpass || btype == BandType::bandstop,
          "a low-pass or high-pass filter has one cut-off frequency, not two; give one number");
  require_between_zero_and_nyquist(cutoff[0], sample_rate);
  require_between_zero_and_nyquist(cutoff[1], sample_rate);
  require(cutoff[0] < cutoff[1], "lower cut-off frequency " + std::to_string(cutoff[0]) +
                                     " Hz is not below the upper one, " + std::to_string(cutoff[1]) +
                                     " Hz; give the lower one first");
  const double lower = prewarped(cutoff[0], sample_rate);
  const double upper = prewarped(cutoff[1], sample_rate);
  const double center = std::sqrt(lower * upper);
  return to_sections(bilinear(btype == BandType::bandpass ? to_bandpass(prototype(order), center, upper - lower)
                                                          : to_bandstop(prototype(order), center, upper - lower)));
}

}  // namespace circlepoint
