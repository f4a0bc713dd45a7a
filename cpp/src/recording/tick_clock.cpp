#include "tick_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "circlepoint/core/error.hpp"

namespace circlepoint::detail {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Ticks {
  std::vector<Index> tick;     // (N)
  std::vector<Index> surplus;  // rows that have no tick of their own
};

// Counts clock ticks by following the phase. A bunch of late stamps first jumps ahead and then stands still; going back
// from its end gives every row a tick of its own. Rows for which that would reach too far back are surplus.
Ticks count_ticks(const Stamps& time, double period, Index max_filled) {
  constexpr double gain = 0.05;     // of the phase tracker
  constexpr Index longest_bunch = 50;
  constexpr std::size_t most_surplus = 100;  // enough to say that the log is wrong
  const Index n = time.size();
  Ticks ticks{std::vector<Index>(static_cast<std::size_t>(n), 0), {}};
  auto tick = [&](Index i) -> Index& { return ticks.tick[static_cast<std::size_t>(i)]; };
  double phase = time(0);
  for (Index i = 1; i < n; ++i) {
    const double step = std::round((time(i) - phase) / period);
    const bool pause = time(i) - time(i - 1) > (static_cast<double>(max_filled) + 1.5) * period;
    const bool bunched = i + 1 < n && time(i + 1) - time(i) < 0.5 * period;
    tick(i) = tick(i - 1) + std::max<Index>(0, static_cast<Index>(step));
    phase += period * std::max(0.0, step);
    phase = pause && !bunched ? time(i) : phase + gain * std::clamp(time(i) - phase, -0.5 * period, 0.5 * period);
  }
  for (Index i = n - 2; i >= 0; --i) {
    if (tick(i) < tick(i + 1)) {
      continue;
    }
    Index first = i;
    Index target = tick(i + 1) - 1;
    while (first >= 0 && tick(first) > target) {
      --first;
      --target;
    }
    if (i - first > (first < 0 ? 8 : longest_bunch)) {
      ticks.surplus.push_back(i + 1);
      if (ticks.surplus.size() == most_surplus) {
        break;
      }
      const Index shift = 1 + tick(i) - tick(i + 1);
      for (Index k = i + 1; k < n; ++k) {
        tick(k) += shift;
      }
    } else {
      for (Index k = first + 1; k <= i; ++k) {
        tick(k) = tick(i + 1) - (i + 1 - k);
      }
    }
  }
  std::reverse(ticks.surplus.begin(), ticks.surplus.end());
  return ticks;
}

}  // namespace

double robust_std(const std::vector<double>& values) {
  const double centre = median(values);
  std::vector<double> deviation(values.size());
  std::transform(values.begin(), values.end(), deviation.begin(), [&](double v) { return std::abs(v - centre); });
  return 1.4826 * median(std::move(deviation));
}

double initial_period(const Stamps& time) {
  const Index lag = std::clamp<Index>((time.size() - 1) / 2, 1, 64);
  std::vector<double> steps;
  for (Index i = lag; i < time.size(); ++i) {
    steps.push_back((time(i) - time(i - lag)) / static_cast<double>(lag));
  }
  return median(std::move(steps));
}

std::vector<IndexRange> split_at(const std::vector<Index>& starts, Index n) {
  std::vector<IndexRange> ranges;
  Index begin = 0;
  for (const Index start : starts) {
    ranges.push_back({begin, start});
    begin = start;
  }
  ranges.push_back({begin, n});
  return ranges;
}

Clock fit_clock(const Stamps& time, Index max_filled) {
  const Index n = time.size();
  Clock clock;
  clock.period = initial_period(time);
  require(clock.period > 0.0, "time does not advance: the median step between samples is not positive");
  std::vector<char> used(static_cast<std::size_t>(n), 1);
  for (int pass = 0; pass < 4; ++pass) {
    Ticks ticks = count_ticks(time, clock.period, max_filled);
    clock.tick = std::move(ticks.tick);
    clock.surplus = std::move(ticks.surplus);
    std::vector<Index> starts;
    for (Index i = 1; i < n; ++i) {
      if (clock.tick[static_cast<std::size_t>(i)] - clock.tick[static_cast<std::size_t>(i - 1)] > max_filled + 1) {
        starts.push_back(i);
      }
    }
    clock.rows = split_at(starts, n);
    for (int trim = 0; trim < 3; ++trim) {
      double covariance = 0.0, variance = 0.0;
      std::vector<std::pair<double, double>> means;
      for (const IndexRange& rows : clock.rows) {
        double count = 0.0, mean_tick = 0.0, mean_time = 0.0;
        const bool any = std::any_of(used.begin() + rows.begin, used.begin() + rows.end, [](char u) { return u != 0; });
        const auto counts = [&](Index i) { return !any || used[static_cast<std::size_t>(i)] != 0; };
        for (Index i = rows.begin; i < rows.end; ++i) {
          if (counts(i)) {
            count += 1.0;
            mean_tick += (static_cast<double>(clock.tick[static_cast<std::size_t>(i)]) - mean_tick) / count;
            mean_time += (time(i) - mean_time) / count;
          }
        }
        for (Index i = rows.begin; i < rows.end; ++i) {
          if (counts(i)) {
            const double k = static_cast<double>(clock.tick[static_cast<std::size_t>(i)]) - mean_tick;
            covariance += k * (time(i) - mean_time);
            variance += k * k;
          }
        }
        means.emplace_back(mean_tick, mean_time);
      }
      if (variance > 0.0) {
        clock.period = covariance / variance;
      }
      clock.offset.clear();
      clock.residual.assign(static_cast<std::size_t>(n), 0.0);
      for (std::size_t s = 0; s < clock.rows.size(); ++s) {
        clock.offset.push_back(means[s].second - clock.period * means[s].first);
        for (Index i = clock.rows[s].begin; i < clock.rows[s].end; ++i) {
          const double k = static_cast<double>(clock.tick[static_cast<std::size_t>(i)]) - means[s].first;
          clock.residual[static_cast<std::size_t>(i)] = (time(i) - means[s].second) - clock.period * k;
        }
      }
      clock.scatter = robust_std(clock.residual);
      const double limit = std::max(4.0 * clock.scatter, 1e-6 * clock.period);
      std::transform(clock.residual.begin(), clock.residual.end(), used.begin(),
                     [&](double e) { return static_cast<char>(std::abs(e) <= limit); });
    }
  }
  return clock;
}

}  // namespace circlepoint::detail
