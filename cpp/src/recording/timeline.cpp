#include "circlepoint/recording/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "circlepoint/core/error.hpp"
#include "circlepoint/recording/interpolate.hpp"
#include "tick_clock.hpp"

namespace circlepoint {
namespace {

using namespace detail;

// Largest decimal step of which all stamps are multiples; the stamps' own floating-point error is allowed for.
double find_resolution(const Stamps& time) {
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * time.cwiseAbs().maxCoeff();
  for (const double step : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4, 1e-5, 1e-6}) {
    const double tolerance = 1e-4 * step + rounding;
    if (tolerance < 0.1 * step &&
        std::all_of(time.begin(), time.end(),
                    [&](double t) { return std::abs(std::remainder(t, step)) <= tolerance; })) {
      return step;
    }
  }
  return 0.0;
}

// A rate that is a round number but for floating-point error is that number.
double tidy_rate(double rate) {
  const double rounded = std::round(rate * 1e6) / 1e6;
  return std::abs(rounded - rate) < 1e-10 * rate ? rounded : rate;
}

struct Knots {
  Eigen::VectorXd time;
  SamplesX values;
};

// Rows whose stamps bunch are one, at their mean: a spline through samples at nearly one instant swings by their
// difference over their distance.
Knots merge_bunches(const Eigen::Ref<const Eigen::VectorXd>& time, const Eigen::Ref<const SamplesX>& values, double rate) {
  constexpr double closest = 0.1;  // of a period
  Knots knots{Eigen::VectorXd(time.size()), SamplesX(values.rows(), values.cols())};
  Index count = 0;
  for (Index begin = 0; begin < time.size(); ++count) {
    Index end = begin + 1;
    while (end < time.size() && (time(end) - time(end - 1)) * rate < closest) {
      ++end;
    }
    knots.time(count) = time.segment(begin, end - begin).mean();
    knots.values.row(count) = values.middleRows(begin, end - begin).colwise().mean();
    begin = end;
  }
  knots.time.conservativeResize(count);
  knots.values.conservativeResize(count, Eigen::NoChange);
  return knots;
}

void describe(TimelineReport& report) {
  const auto say = [&](auto&&... parts) {
    std::ostringstream text;
    text.precision(6);
    (text << ... << parts);
    report.notes.push_back(text.str());
  };
  if (report.sample_rate < 50.0) {
    say("the sample rate is ", report.sample_rate, " Hz, below the 50 Hz this method expects");
  } else if (report.sample_rate > 10000.0) {
    say("the sample rate is ", report.sample_rate, " Hz, above the 10 kHz this method expects");
  }
  if (report.rule == StampRule::believed) {
    say("stamps jitter by ", 1e3 * report.jitter_std,
        " ms (standard deviation): samples were interpolated at a uniform ",
        report.sample_rate, " Hz");
  } else if (report.jitter_std > 1e-3 / report.sample_rate) {
    say("stamps are rounded to ", 1e3 * report.resolution, " ms: replaced by a uniform clock at ", report.sample_rate,
        " Hz");
  }
  if (report.late > 0) {
    say(report.late, " late stamps (by up to ", 1e3 * report.jitter_max, " ms) moved to their place on the clock");
  }
  if (report.filled > 0) {
    say(report.filled, " missing samples in ", std::count_if(report.gaps.begin(), report.gaps.end(),
        [](const auto& g) { return g.filled; }),
        " short gaps were interpolated");
  }
  for (const TimelineGap& gap : report.gaps) {
    if (!gap.filled) {
      say("a gap of ", gap.length, " s after t = ", gap.start, " s (", gap.missing,
          " samples missing): a new span starts");
    }
  }
}

void find_disorder(const Stamps& time, TimelineReport& report) {
  for (Index i = 1; i < time.size(); ++i) {
    if (time(i) <= time(i - 1)) {
      (time(i) < time(i - 1) ? report.backwards : report.repeated).push_back({i, time(i - 1), time(i)});
    }
  }
}

void add_gap(TimelineReport& report, const Stamps& time, Index row, Index missing, bool filled) {
  report.gaps.push_back({row, time(row - 1), time(row) - time(row - 1), missing, filled});
  report.filled += filled ? missing : 0;
}

// The grid of a span whose rows have ticks.
void lay_ticks(const Clock& clock, Timeline& timeline, std::vector<double>& grid) {
  const bool regular = timeline.report.rule == StampRule::regularised;
  const double period = 1.0 / timeline.report.sample_rate;
  for (std::size_t s = 0; s < clock.rows.size(); ++s) {
    const IndexRange rows = clock.rows[s];
    const Index first = clock.tick[static_cast<std::size_t>(rows.begin)];
    const double start = clock.offset[s] + clock.period * static_cast<double>(first);
    const Index count = clock.tick[static_cast<std::size_t>(rows.end - 1)] - first + 1;
    const Index begin = static_cast<Index>(grid.size());
    for (Index k = 0; k < count; ++k) {
      grid.push_back(start + period * static_cast<double>(k));
    }
    for (Index i = rows.begin; i < rows.end; ++i) {
      const Index k = clock.tick[static_cast<std::size_t>(i)] - first;
      const bool late = clock.residual[static_cast<std::size_t>(i)] > std::max(0.5 * clock.period, 5.0 * clock.scatter);
      timeline.report.late += late ? 1 : 0;
      const double off_clock = std::clamp(clock.residual[static_cast<std::size_t>(i)], -0.45 * period, 0.45 * period);
      timeline.row_time(i) = start + period * static_cast<double>(k) + (regular || late ? 0.0 : off_clock);
      timeline.row_sample[static_cast<std::size_t>(i)] = regular ? begin + k : -1;
    }
    timeline.spans.push_back({begin, begin + count});
  }
}

// The grid of spans whose stamps jitter too much to be counted: it runs from each span's first stamp to its last.
void lay_free(const Stamps& time, Timeline& timeline, std::vector<double>& grid) {
  timeline.row_time = time;
  std::fill(timeline.row_sample.begin(), timeline.row_sample.end(), -1);
  const double rate = timeline.report.sample_rate;
  for (const IndexRange& rows : timeline.rows) {
    const Index begin = static_cast<Index>(grid.size());
    const auto count = static_cast<Index>(std::floor((time(rows.end - 1) - time(rows.begin)) * rate + 1e-9)) + 1;
    for (Index k = 0; k < count; ++k) {
      grid.push_back(time(rows.begin) + static_cast<double>(k) / rate);
    }
    timeline.spans.push_back({begin, begin + count});
  }
}

Timeline build(const Stamps& stamps, const TimelineOptions& options) {
  require(stamps.size() >= 8, "a recording needs at least 8 samples, got " + std::to_string(stamps.size()));
  for (Index i = 0; i < stamps.size(); ++i) {
    require(std::isfinite(stamps(i)), "time in row " + std::to_string(i + 1)
        + " is not finite: remove or repair the row");
  }
  Timeline timeline;
  TimelineReport& report = timeline.report;
  const double epoch = stamps(0);
  const Eigen::VectorXd time = stamps.array() - epoch;  // small numbers: sums over them keep their digits
  report.samples = time.size();
  report.duration = time(time.size() - 1) - time(0);
  find_disorder(stamps, report);
  if (!report.backwards.empty()) {
    return timeline;
  }
  report.resolution = find_resolution(stamps);
  const Clock clock = fit_clock(time, options.max_filled);
  report.sample_rate = tidy_rate(1.0 / clock.period);
  const bool rounded = clock.scatter <= std::max(0.6 * report.resolution, 1e-3 * clock.period);
  // Rounding is bounded; jitter is not, and four of its standard deviations must stay within half a period.
  const bool countable = clock.scatter < (rounded ? 0.25 : 0.12) * clock.period;
  report.rule = countable && rounded ? StampRule::regularised : StampRule::believed;
  timeline.row_time.resize(time.size());
  timeline.row_sample.resize(static_cast<std::size_t>(time.size()));
  std::vector<double> grid;
  double sum = 0.0;
  for (const double e : clock.residual) {
    sum += e * e;
    report.jitter_max = std::max(report.jitter_max, std::abs(e));
  }
  report.jitter_std = std::sqrt(sum / static_cast<double>(time.size()));
  if (countable) {
    timeline.rows = clock.rows;
    for (const Index row : clock.surplus) {
      report.surplus.push_back({row, stamps(row - 1), stamps(row)});
    }
    for (Index i = 1; i < time.size(); ++i) {
      const Index missing = clock.tick[static_cast<std::size_t>(i)] - clock.tick[static_cast<std::size_t>(i - 1)] - 1;
      if (missing > 0) {
        add_gap(report, stamps, i, missing, missing <= options.max_filled);
      }
    }
    lay_ticks(clock, timeline, grid);
  } else {
    report.surplus = report.repeated;
    report.sample_rate = tidy_rate(1.0 / initial_period(time));
    const double period = 1.0 / report.sample_rate;
    std::vector<double> steps;
    for (Index i = 1; i < time.size(); ++i) {
      steps.push_back(time(i) - time(i - 1));
    }
    const double scatter = robust_std(steps);
    report.jitter_std = scatter / std::numbers::sqrt2;  // a step holds the jitter of two stamps
    report.jitter_max = 0.0;
    std::vector<Index> starts;
    for (Index i = 1; i < time.size(); ++i) {
      const double step = steps[static_cast<std::size_t>(i - 1)];
      if (step > options.gap_threshold * period + 3.0 * scatter) {
        const bool split = step > (static_cast<double>(options.max_filled) + 1.5) * period + 3.0 * scatter;
        add_gap(report, stamps, i, std::max<Index>(1, static_cast<Index>(std::round(step / period)) - 1), !split);
        if (split) {
          starts.push_back(i);
        }
      } else {
        report.jitter_max = std::max(report.jitter_max, std::abs(step - period));
      }
    }
    timeline.rows = split_at(starts, time.size());
    lay_free(time, timeline, grid);
  }
  timeline.time = Eigen::Map<const Eigen::VectorXd>(grid.data(), static_cast<Index>(grid.size())).array() + epoch;
  timeline.row_time.array() += epoch;
  describe(report);
  return timeline;
}

std::string order_message(const char* what, const StampOrder& order, const char* remedy) {
  std::ostringstream text;
  text.precision(12);
  text << what << " in row " << order.index + 1 << ": t = " << order.value << " s after " << order.previous <<
      " s; " << remedy;
  return text.str();
}

}  // namespace

TimelineReport analyse_timeline(const Eigen::Ref<const Eigen::VectorXd>& time, const TimelineOptions& options) {
  return build(time, options).report;
}

Timeline make_timeline(const Eigen::Ref<const Eigen::VectorXd>& time, const TimelineOptions& options) {
  Timeline timeline = build(time, options);
  const TimelineReport& report = timeline.report;
  if (!report.backwards.empty()) {
    throw InvalidInput(order_message("time runs backwards", report.backwards.front(),
                                     "sort the rows, or give recordings that restart their clock as separate files"));
  }
  if (!report.surplus.empty()) {
    throw InvalidInput(order_message("time does not advance as samples do", report.surplus.front(),
                                     "remove rows written twice, or write the stamps with more digits"));
  }
  return timeline;
}

SamplesX regularise(const Timeline& timeline, const Eigen::Ref<const SamplesX>& values) {
  require(values.rows() == timeline.row_time.size(), "values have " + std::to_string(values.rows())
      + " rows, the timeline " +
                                                         std::to_string(timeline.row_time.size()));
  SamplesX regular(timeline.time.size(), values.cols());
  for (std::size_t s = 0; s < timeline.spans.size(); ++s) {
    const IndexRange span = timeline.spans[s];
    const IndexRange rows = timeline.rows[s];
    const bool complete = span.size() == rows.size() && timeline.row_sample[static_cast<std::size_t>(rows.begin)] >= 0;
    if (!complete) {
      const Knots knots = merge_bunches(timeline.row_time.segment(rows.begin, rows.size()),
                                        values.middleRows(rows.begin, rows.size()), timeline.report.sample_rate);
      regular.middleRows(span.begin, span.size()) =
          interpolate_cubic(knots.time, knots.values, timeline.time.segment(span.begin, span.size()));
    }
    for (Index i = rows.begin; i < rows.end; ++i) {
      const Index k = timeline.row_sample[static_cast<std::size_t>(i)];
      if (k >= 0) {
        regular.row(k) = values.row(i);
      }
    }
  }
  return regular;
}

}  // namespace circlepoint
