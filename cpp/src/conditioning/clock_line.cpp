#include "clock_line.hpp"

#include <algorithm>
#include <cmath>

namespace circlepoint::detail {
namespace {

constexpr double tukey = 4.685;             // 95 % efficient for normal errors
constexpr double least_known_scatter = 1e-5;  // s: no delay is known better than this

struct Fit {
  RelativeClock clock;
  double centre = 0.0, level_information = 0.0, rate_information = 0.0;
};

Fit weighted_line(const std::vector<ClockPoint>& points, double scatter, double prior_std) {
  Fit fit;
  double level = 0.0;
  for (const ClockPoint& p : points) {
    const double w = p.weight / (p.std * p.std + scatter * scatter);
    fit.level_information += w;
    fit.centre += w * p.joint;
    level += w * p.sensor;
  }
  fit.centre /= fit.level_information;
  level /= fit.level_information;
  fit.rate_information = 1.0 / (prior_std * prior_std);
  double moment = fit.rate_information * 1.0;
  for (const ClockPoint& p : points) {
    const double w = p.weight / (p.std * p.std + scatter * scatter);
    fit.rate_information += w * (p.joint - fit.centre) * (p.joint - fit.centre);
    moment += w * (p.joint - fit.centre) * (p.sensor - level);
  }
  fit.clock.rate = moment / fit.rate_information;
  fit.clock.shift = level - fit.clock.rate * fit.centre;
  return fit;
}

double chi_square(const std::vector<ClockPoint>& points, double scatter) {
  double sum = 0.0;
  for (const ClockPoint& p : points) {
    sum += p.weight * p.residual * p.residual / (p.std * p.std + scatter * scatter);
  }
  return sum;
}

// The scatter that makes chi square equal to the degrees of freedom.
double added_scatter(const std::vector<ClockPoint>& points) {
  double freedom = -2.0;
  for (const ClockPoint& p : points) {
    freedom += p.weight;
  }
  if (freedom < 0.5 || chi_square(points, least_known_scatter) <= freedom) {
    return least_known_scatter;
  }
  double low = least_known_scatter, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (chi_square(points, middle) > freedom ? low : high) = middle;
  }
  return high;
}

}  // namespace

ClockLine fit_clock_line(std::vector<ClockPoint>& points, double max_rate_deviation) {
  for (ClockPoint& p : points) {
    p.weight = 1.0;
  }
  double scatter = least_known_scatter;
  Fit fit;
  for (int iteration = 0; iteration < 50; ++iteration) {
    fit = weighted_line(points, scatter, max_rate_deviation);
    std::vector<double> normalised;
    for (ClockPoint& p : points) {
      p.residual = p.sensor - fit.clock.sensor(p.joint);
      normalised.push_back(std::abs(p.residual) / std::hypot(p.std, scatter));
    }
    std::vector<double> sorted = normalised;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double scale = std::max(1.0, 1.4826 * sorted[sorted.size() / 2]);
    for (std::size_t i = 0; i < points.size() && points.size() > 3; ++i) {
      const double t = normalised[i] / (tukey * scale);
      points[i].weight = t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
    }
    scatter = added_scatter(points);
  }
  ClockLine line;
  line.clock = fit.clock;
  line.centre = fit.centre;
  double count = 0.0;
  for (const ClockPoint& p : points) {
    count += p.weight;
  }
  // The scatter is estimated from few points: Student's t instead of the normal distribution, by its variance.
  const double freedom = std::max(1.0, count - 2.0);
  const double inflation = freedom > 2.5 ? std::sqrt(freedom / (freedom - 2.0)) : 2.25;
  line.level_std = inflation / std::sqrt(fit.level_information);
  line.rate_std = std::min(max_rate_deviation, inflation / std::sqrt(fit.rate_information));
  line.scatter = scatter;
  const double prior = 1.0 / (max_rate_deviation * max_rate_deviation);
  line.rate_determined = fit.rate_information > 10.0 * prior;
  double squares = 0.0, weights = 0.0;
  for (const ClockPoint& p : points) {
    const double w = p.weight / (p.std * p.std + scatter * scatter);
    squares += w * p.residual * p.residual;
    weights += w;
  }
  line.residual = weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
  return line;
}

}  // namespace circlepoint::detail
