#include "circlepoint/conditioning/static_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "circlepoint/core/error.hpp"
#include "sliding_extremum.hpp"

namespace circlepoint {
namespace {

// A rest may drift by this many bands before it is judged with a longer window; a turning point leaves it by fewer.
constexpr double bands = 5.0;

void check(const Recording& recording, const StaticIntervalOptions& options) {
  const auto positive = [](double value, const char* name) {
    require(std::isfinite(value) && value > 0.0,
            std::string(name) + " is " + std::to_string(value) + "; it must be positive and finite");
  };
  positive(recording.sample_rate, "the recording's sample_rate");
  positive(options.min_dwell, "min_dwell");
  positive(options.min_velocity, "min_velocity");
  positive(options.rest_window, "rest_window");
  positive(options.metres_per_radian, "metres_per_radian");
  require(options.settle >= 0.0 && options.quiet_ratio >= 0.0 && options.quiet_std >= 0.0,
          "settle, quiet_ratio and quiet_std must not be negative");
  const Index samples = recording.samples();
  require(recording.joint_positions.rows() == samples && recording.specific_force.rows() == samples,
          "the recording has " + std::to_string(samples) + " time stamps, " +
              std::to_string(recording.joint_positions.rows()) + " rows of joint positions and " +
              std::to_string(recording.specific_force.rows()) + " of specific force; the three must agree");
  for (const IndexRange& span : recording.spans) {
    require(span.begin >= 0 && span.begin <= span.end && span.end <= samples,
            "the span [" + std::to_string(span.begin) + ", " + std::to_string(span.end) + ") is not within the " +
                std::to_string(samples) + " samples of the recording");
  }
  require(recording.joint_positions.allFinite() && recording.specific_force.allFinite(),
          "the recording has values that are not finite; leave those rows out (a gap) before segmenting");
}

Index samples_of(double duration, double sample_rate, Index least) {
  return std::max(least, static_cast<Index>(std::llround(duration * sample_rate)));
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value - values.front();
  }
  return values.front() + sum / static_cast<double>(values.size());
}

std::span<const double> part(std::span<const double> values, Index begin, Index end) {
  return values.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
}

bool is_turning_point(std::span<const double> positions, IndexRange span, IndexRange rest, double band) {
  const Index half = rest.size() / 2;
  const Index before = rest.begin - half;
  const Index after = rest.end - 1 + half;
  if (before < span.begin || after >= span.end) {
    return false;
  }
  const Index third = rest.size() / 3;
  const double middle = mean_of(part(positions, rest.begin + third, rest.end - third));
  const double edges = 0.5 * (mean_of(part(positions, rest.begin, rest.begin + third)) +
                              mean_of(part(positions, rest.end - third, rest.end)));
  const double sign = edges > middle ? 1.0 : -1.0;
  const double left = sign * (positions[static_cast<std::size_t>(before)] - middle);
  const double right = sign * (positions[static_cast<std::size_t>(after)] - middle);
  // A parabola that just fills the band differs by 0.44 bands between its middle third and the outer ones.
  return std::abs(edges - middle) > 0.2 * band && std::min(left, right) > band && std::max(left, right) < bands * band;
}

/// The rests of one joint in one span.
class RestSearch {
 public:
  RestSearch(std::span<const double> positions, IndexRange span, double step, const StaticIntervalOptions& options,
             double sample_rate)
      : positions_(positions), span_(span), min_velocity_(options.min_velocity), sample_rate_(sample_rate),
        least_band_(std::max(1.5 * step, rest_band(step, options) / 8.0)) {}

  /// Runs in which some window of this length stays within the band; drifting ones are judged more strictly.
  void find(IndexRange piece, Index window, double band, std::vector<IndexRange>& rests) const {
    const double* first = positions_.data() + piece.begin;
    const auto high = sliding_extremum(first, piece.size(), window, [](double a, double b) { return std::max(a, b); });
    const auto low = sliding_extremum(first, piece.size(), window, [](double a, double b) { return std::min(a, b); });
    IndexRange run;
    for (std::size_t k = 0; k < high.size(); ++k) {
      if (high[k] - low[k] > band) {
        continue;
      }
      const Index start = piece.begin + static_cast<Index>(k);
      if (start >= run.end) {
        close(run, window, band, rests);
        run.begin = start;
      }
      run.end = start + window;
    }
    close(run, window, band, rests);
  }

 private:
  void close(IndexRange run, Index window, double band, std::vector<IndexRange>& rests) const {
    if (run.size() == 0) {
      return;
    }
    const auto values = part(positions_, run.begin, run.end);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const bool drifts = *most - *least > bands * band;
    if (drifts && band > least_band_) {
      find(run, window, std::max(least_band_, 0.5 * band), rests);
    } else if (drifts && band * sample_rate_ > min_velocity_ * static_cast<double>(window)) {
      find(run, 2 * window, band, rests);
    } else if (!is_turning_point(positions_, span_, run, band)) {
      rests.push_back(run);
    }
  }

  std::span<const double> positions_;
  IndexRange span_;
  double min_velocity_;
  double sample_rate_;
  double least_band_;
};

std::vector<IndexRange> intersection(const std::vector<IndexRange>& a, const std::vector<IndexRange>& b) {
  std::vector<IndexRange> both;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const IndexRange overlap{std::max(a[i].begin, b[k].begin), std::min(a[i].end, b[k].end)};
    if (overlap.size() > 0) {
      both.push_back(overlap);
    }
    a[i].end < b[k].end ? ++i : ++k;
  }
  return both;
}

/// Samples of an interval about their medians, glitches clipped.
Samples3 clipped(const Recording& recording, IndexRange interval) {
  Samples3 samples = recording.specific_force.middleRows(interval.begin, interval.size());
  std::vector<double> scratch(static_cast<std::size_t>(interval.size()));
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  for (Index channel = 0; channel < 3; ++channel) {
    auto column = samples.col(channel);
    std::copy(column.begin(), column.end(), scratch.begin());
    std::nth_element(scratch.begin(), middle, scratch.end());
    column.array() -= *middle;
    std::transform(column.begin(), column.end(), scratch.begin(), [](double value) { return std::abs(value); });
    std::nth_element(scratch.begin(), middle, scratch.end());
    if (const double limit = 6.0 * 1.4826 * *middle; limit > 0.0) {
      column = column.cwiseMax(-limit).cwiseMin(limit).eval();
    }
  }
  return samples;
}

/// Number of leading batches to drop: the marginal standard error rule on variance of samples and of batch means.
Index truncation(const Eigen::MatrixXd& means, const Eigen::VectorXd& within, Index batch, Index least) {
  const Index batches = means.rows();
  const auto weight = static_cast<double>(batch);
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double squares = 0.0;
  double scatter = 0.0;
  double best = std::numeric_limits<double>::infinity();
  Index first = 0;
  for (Index k = batches - 1; k >= 0; --k) {
    sum += means.row(k);
    squares += means.row(k).squaredNorm();
    scatter += within[k];
    const auto count = static_cast<double>(batches - k);
    const double between = std::max(0.0, squares / count - (sum / count).squaredNorm());
    const double cost = ((1.0 + weight) * between + scatter / count) / count;
    if (batches - k >= least && cost <= best) {
      best = cost;
      first = k;
    }
  }
  return first;
}

IndexRange settled(const Recording& recording, IndexRange interval, Index batch, Index least) {
  const Index batches = interval.size() / batch;
  interval.begin = interval.end - batches * batch;
  const Samples3 samples = clipped(recording, interval);
  Eigen::MatrixXd means(batches, 3);
  Eigen::VectorXd within(batches);
  for (Index k = 0; k < batches; ++k) {
    const auto block = samples.middleRows(k * batch, batch);
    means.row(k) = block.colwise().mean();
    within[k] = (block.rowwise() - means.row(k)).squaredNorm() / static_cast<double>(batch);
  }
  const Index least_batches = std::min(batches, (least + batch - 1) / batch);
  Index begin = truncation(means, within, batch, least_batches);
  const Index kept = batches - begin;
  const Index dropped = truncation(means.bottomRows(kept).colwise().reverse(), within.tail(kept).reverse(), batch,
                                   least_batches);
  const Index end = batches - dropped;
  begin = truncation(means.topRows(end), within.head(end), batch, least_batches);
  return {interval.begin + begin * batch, interval.begin + end * batch};
}

double scatter_of(const Samples3& samples) {
  return std::sqrt((samples.rowwise() - samples.colwise().mean()).squaredNorm() /
                   static_cast<double>(samples.size()));
}

/// Sensor scatter in the quietest quarter of the short blocks in which all joints rest.
double rest_noise(const Recording& recording, const std::vector<IndexRange>& intervals, Index block) {
  std::vector<double> scatters;
  for (const IndexRange& interval : intervals) {
    for (Index k = interval.begin; k + block <= interval.end; k += block) {
      scatters.push_back(scatter_of(recording.specific_force.middleRows(k, block)));
    }
  }
  if (scatters.empty()) {
    return 0.0;
  }
  const auto quarter = scatters.begin() + static_cast<std::ptrdiff_t>(scatters.size() / 4);
  std::nth_element(scatters.begin(), quarter, scatters.end());
  return *quarter;
}

}  // namespace

Eigen::VectorXd threshold_units(const StaticIntervalOptions& options, Index joints) {
  Eigen::VectorXd units = Eigen::VectorXd::Ones(joints);
  if (options.joint_types.empty()) {
    return units;
  }
  require(static_cast<Index>(options.joint_types.size()) == joints,
          "joint_types has " + std::to_string(options.joint_types.size()) + " entries for " + std::to_string(joints) +
              " joints; give one per joint, base to tip, or none");
  for (Index joint = 0; joint < joints; ++joint) {
    if (options.joint_types[static_cast<std::size_t>(joint)] == JointType::prismatic) {
      units[joint] = options.metres_per_radian;
    }
  }
  return units;
}

double encoder_step(const Eigen::Ref<const Eigen::VectorXd>& positions) {
  constexpr double same = 1e-9;
  double step = std::numeric_limits<double>::infinity();
  double held = std::numeric_limits<double>::quiet_NaN();
  for (Index k = 1; k < positions.size(); ++k) {
    if (std::abs(positions[k] - positions[k - 1]) > same) {
      continue;
    }
    if (const double difference = std::abs(positions[k] - held); difference > same) {
      step = std::min(step, difference);
    }
    held = positions[k];
  }
  return step <= max_encoder_step * (1.0 + 1e-6) ? step : 0.0;
}

double rest_band(double encoder_step, const StaticIntervalOptions& options) {
  return std::max(1.5 * encoder_step, options.min_velocity * options.rest_window);
}

std::vector<std::vector<IndexRange>> joint_rests(const Recording& recording, const StaticIntervalOptions& options) {
  check(recording, options);
  const Index window = samples_of(options.rest_window, recording.sample_rate, 3);
  const Eigen::VectorXd units = threshold_units(options, recording.joints());
  std::vector<std::vector<IndexRange>> rests(static_cast<std::size_t>(recording.joints()));
  for (Index joint = 0; joint < recording.joints(); ++joint) {
    const Eigen::VectorXd column = recording.joint_positions.col(joint) / units[joint];
    const std::span<const double> positions(column.data(), static_cast<std::size_t>(column.size()));
    const double step = encoder_step(column);
    for (const IndexRange& span : recording.spans) {
      RestSearch(positions, span, step, options, recording.sample_rate)
          .find(span, window, rest_band(step, options), rests[static_cast<std::size_t>(joint)]);
    }
  }
  return rests;
}

std::vector<IndexRange> static_intervals(const Recording& recording, const StaticIntervalOptions& options) {
  return static_intervals(recording, joint_rests(recording, options), options);
}

std::vector<IndexRange> static_intervals(const Recording& recording, const std::vector<std::vector<IndexRange>>& rests,
                                         const StaticIntervalOptions& options) {
  check(recording, options);
  require(static_cast<Index>(rests.size()) == recording.joints(),
          "rests of " + std::to_string(rests.size()) + " joints for a recording of " +
              std::to_string(recording.joints()) + "; pass joint_rests of the same recording");
  std::vector<IndexRange> intervals = recording.spans;
  for (const auto& of_joint : rests) {
    intervals = intersection(intervals, of_joint);
  }
  const Index window = samples_of(options.rest_window, recording.sample_rate, 3);
  const Index batch = std::max<Index>(1, window / 10);
  const Index settle = samples_of(options.settle, recording.sample_rate, 0);
  const Index least = samples_of(options.min_dwell, recording.sample_rate, 2);
  const double noise = rest_noise(recording, intervals, std::max<Index>(5, window / 2));
  const double limit = std::max(options.quiet_std, options.quiet_ratio * noise);
  std::vector<IndexRange> found;
  for (const IndexRange& interval : intervals) {
    if (interval.size() < settle + least) {
      continue;
    }
    const IndexRange dwell = settled(recording, {interval.begin + settle, interval.end}, batch, least);
    if (scatter_of(clipped(recording, dwell)) <= limit) {
      found.push_back(dwell);
    }
  }
  return found;
}

}  // namespace circlepoint
