#include "arm_smooth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"

namespace circlepoint {
namespace {

constexpr int filter_order = 4;
constexpr double slowest_cutoff = 1.0;  // Hz
constexpr double few_counts = 50.0;
constexpr double slow_crossings = 5.0;  // counts in the filter's time, 1 / cutoff
constexpr double finest_resolution = 1e-9;  // rad or m, of encoders taken as exact

// Derivatives are those of the sixth-degree polynomial through seven samples: two-point differences would shrink them by
// (2 pi f / rate)^2 / 6.
constexpr Index window = 7;
constexpr Index half_window = window / 2;
using Weights = std::array<double, window>;
constexpr std::array<Weights, 4> centre_weights{
    Weights{-1.0 / 60.0, 3.0 / 20.0, -3.0 / 4.0, 0.0, 3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0},
    Weights{1.0 / 90.0, -3.0 / 20.0, 3.0 / 2.0, -49.0 / 18.0, 3.0 / 2.0, -3.0 / 20.0, 1.0 / 90.0},
    Weights{1.0 / 8.0, -1.0, 13.0 / 8.0, 0.0, -13.0 / 8.0, 1.0, -1.0 / 8.0},
    Weights{-1.0 / 6.0, 2.0, -13.0 / 2.0, 28.0 / 3.0, -13.0 / 2.0, 2.0, -1.0 / 6.0}};

}  // namespace

SamplesX low_passed(const Eigen::Ref<const SamplesX>& samples, double cutoff, double rate) {
  const auto pad = std::min<Index>(samples.rows() - 1, static_cast<Index>(std::lround(4.0 * rate / cutoff)));
  return sosfiltfilt(butter(filter_order, cutoff, rate), samples, PadType::even, pad);
}

SamplesX differentiated(const Eigen::Ref<const SamplesX>& samples, int order, double rate) {
  return savgol_filter(samples, window, window - 1, order, 1.0 / rate);
}

Eigen::VectorXd SmoothJoints::derivative(int order, Index joint, Index begin, Index count) const {
  const Index first = std::clamp<Index>(begin - window, 0, std::max<Index>(0, position.rows() - window));
  const Index last = std::min(position.rows(), std::max(begin + count + window, first + window));
  const SamplesX around = position.col(joint).segment(first, last - first);
  return differentiated(around, order, rate).col(0).segment(begin - first, count);
}

Eigen::VectorXd SmoothJoints::derivative(int order, Index joint, const Eigen::ArrayXi& rows) const {
  const Weights& weights = centre_weights[static_cast<std::size_t>(order - 1)];
  const double scale = std::pow(rate, order);
  Eigen::VectorXd result(rows.size());
  for (Index i = 0; i < rows.size(); ++i) {
    const Index row = rows[i];
    if (row < half_window || row + half_window >= position.rows()) {
      result[i] = derivative(order, joint, row, 1)[0];
      continue;
    }
    double sum = 0.0;
    for (Index k = 0; k < window; ++k) {
      sum += weights[static_cast<std::size_t>(k)] * position(row - half_window + k, joint);
    }
    result[i] = scale * sum;
  }
  return result;
}

SmoothSpan smooth(const Recording& recording, const IndexRange& span, double cutoff, bool coarse, bool gyroscope) {
  const double rate = recording.sample_rate;
  SmoothSpan result;
  result.samples = span;
  const SamplesX position = recording.joint_positions.middleRows(span.begin, span.size());
  double mine = cutoff;
  do {
    result.joints.push_back({mine, rate, low_passed(position, mine, rate)});
    mine *= 0.7;
  } while (coarse && mine > slowest_cutoff);
  if (coarse) {
    const double sharper = std::max(cutoff, std::min(1.6 * cutoff, 0.4 * rate));
    result.sharp = {sharper, rate, low_passed(position, sharper, rate)};
  }
  SamplesX reading(span.size(), gyroscope ? 6 : 3);
  reading.leftCols(3) = recording.specific_force.middleRows(span.begin, span.size());
  if (gyroscope) {
    reading.rightCols(3) = recording.angular_velocity->middleRows(span.begin, span.size());
  }
  result.reading = low_passed(reading, cutoff, rate);
  const auto run_in = std::min<Index>(span.size() / 4, static_cast<Index>(std::lround(2.5 * rate / cutoff)));
  const auto still = [&](Index from) {
    const auto edge = recording.joint_positions.middleRows(from, run_in);
    const double seconds = static_cast<double>(run_in) / rate;
    const double moved = (edge.row(run_in - 1) - edge.row(0)).cwiseAbs().maxCoeff();
    return moved < 0.02 * seconds;
  };
  result.usable_begin = span.begin + (run_in > 1 && still(span.begin) ? 3 : run_in);
  result.usable_end = span.end - (run_in > 1 && still(span.end - run_in) ? 3 : run_in);
  return result;
}

namespace {

double range(const SmoothSpan& span, const IndexRange& moving, Index joint) {
  const auto column = span.joints.front().position.col(joint).segment(moving.begin - span.samples.begin, moving.size());
  return column.maxCoeff() - column.minCoeff();
}

}  // namespace

std::vector<bool> moving_joints(const SmoothSpan& span, const IndexRange& moving, Index alone, const Eigen::VectorXd& resolution) {
  Eigen::ArrayXd counts(resolution.size());
  for (Index joint = 0; joint < resolution.size(); ++joint) {
    counts[joint] = range(span, moving, joint) / std::max(resolution[joint], finest_resolution);
  }
  const double enough = std::min(few_counts, 0.5 * counts.maxCoeff());
  std::vector<bool> movers;
  for (Index joint = 0; joint < resolution.size(); ++joint) {
    movers.push_back(joint == alone || (alone < 0 && counts[joint] > enough) || counts[joint] > few_counts);
  }
  return movers;
}

std::size_t smoothing_for_yields(const SmoothSpan& span, const IndexRange& moving, const std::vector<bool>& movers) {
  if (span.joints.size() == 1) {
    return 0;
  }
  double frequency = 0.0;
  for (std::size_t j = 0; j < movers.size(); ++j) {
    const auto joint = static_cast<Index>(j);
    const double travel = range(span, moving, joint);
    if (movers[j] && travel > 0.0) {
      const Eigen::VectorXd velocity = span.joints.front().derivative(1, joint, moving.begin - span.samples.begin, moving.size());
      frequency = std::max(frequency, velocity.cwiseAbs().maxCoeff() / (std::numbers::pi * travel));
    }
  }
  std::size_t chosen = 0;
  while (chosen + 1 < span.joints.size() && span.joints[chosen + 1].cutoff > 4.0 * frequency) {
    ++chosen;
  }
  return chosen;
}

namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

// The same and all within the margin of it.
Mask widened(const Mask& mask, Index margin) {
  Mask wide = Mask::Constant(mask.size(), false);
  for (Index i = 0; i < mask.size(); ++i) {
    if (mask[i]) {
      const Index first = std::max<Index>(0, i - margin);
      wide.segment(first, std::min(mask.size(), i + margin + 1) - first).setConstant(true);
    }
  }
  return wide;
}

// Only what lasts for as many samples.
Mask runs(const Mask& mask, Index shortest) {
  Mask kept = Mask::Constant(mask.size(), false);
  Index from = 0;
  for (Index i = 0; i <= mask.size(); ++i) {
    if (i < mask.size() && mask[i]) {
      continue;
    }
    if (i - from >= shortest || from == 0 || i == mask.size()) {
      kept.segment(from, i - from).setConstant(true);
    }
    from = i + 1;
  }
  return kept;
}

}  // namespace

std::vector<IndexRange> without_steps(const SmoothSpan& span, const IndexRange& moving, const std::vector<MovingAlone>& alone,
                                      const Eigen::VectorXd& resolution, double rate) {
  constexpr double beyond = 3.0;      // eq. (11) inside reaches 1, a minimum-jerk move 2.3, a step of acceleration 5 and more
  constexpr double unlikely = 4.0;    // standard deviations of the counts' noise
  constexpr double likely = 2.0;      // where a motion may begin from rest, with a step
  constexpr double one_count = 0.13;  // of the pass band's cube: the jerk of a single count by itself is 1 / (3 pi)
  constexpr double too_many = 0.2;    // share of a range that is then a motion of its own kind, not steps
  const SmoothJoints& joints = span.joints.front();
  const bool coarse = are_coarse(resolution);
  const SmoothJoints& sharp = coarse ? span.sharp : joints;
  const Index begin = moving.begin - span.samples.begin;
  const auto reach = static_cast<Index>(std::lround((coarse ? 1.6 : 0.5) * rate / joints.cutoff));
  // Motion may begin with a step before the range does, which rings on where the cut-off is low.
  const Index before = coarse ? reach : 0;
  const IndexRange seen{std::max<Index>(0, begin - before), std::min(span.samples.size(), begin + moving.size() + before)};
  Mask step = Mask::Constant(seen.size(), false);
  // Jerk by a count: white noise, thrice differentiated and cut there, has the std. Where a motion may begin from rest a step is no
  // surprise.
  Eigen::ArrayXd of_counts = Eigen::ArrayXd::Zero(seen.size());
  double of_one = 0.0;
  if (coarse) {
    const double pass = 2.0 * std::numbers::pi * sharp.cutoff;
    const double std = std::sqrt(2.0 * sharp.cutoff / (12.0 * 7.0 * rate)) * pass * pass * pass;
    of_one = one_count * pass * pass * pass;
    of_counts.setConstant(unlikely * std);
    of_counts.head(std::min(seen.size(), begin - seen.begin + reach)).setConstant(likely * std);
    of_counts.tail(std::min(seen.size(), seen.end - begin - moving.size() + reach)).setConstant(likely * std);
  }
  for (Index j = 0; j < resolution.size(); ++j) {
    const double travel = range(span, moving, j);
    if (travel <= few_counts * resolution[j] || travel <= 0.0) {
      continue;
    }
    const Eigen::ArrayXd speed = joints.derivative(1, j, begin, moving.size()).array().abs();
    const double fastest = speed.maxCoeff();
    const double own = std::pow(2.0 * fastest / travel, 2) * fastest;
    Eigen::ArrayXd noise = of_counts;
    if (coarse) {  // inside, a joint that turns round crosses its counts one by one
      for (Index i = reach; i + reach < moving.size(); ++i) {
        if (speed[i] < slow_crossings * joints.cutoff * resolution[j]) {
          double& here = noise[begin - seen.begin + i];
          here = std::max(here, of_one);
        }
      }
    }
    step = step || sharp.derivative(3, j, seen.begin, seen.size()).array().abs() > beyond * own + resolution[j] * noise;
  }
  Mask left_out = Mask::Constant(moving.size(), false);
  if (static_cast<double>(step.segment(begin - seen.begin, moving.size()).count()) <= too_many * static_cast<double>(moving.size())) {
    left_out = widened(step, reach).segment(begin - seen.begin, moving.size());
  }
  if (coarse) {
    // Where a joint dwells on each count for longer than a few of what the filter averages over, its error is one number, not noise.
    const auto margin = static_cast<Index>(std::lround(0.3 * rate / joints.cutoff));
    Mask creeping = Mask::Constant(moving.size(), false);
    for (const MovingAlone& motion : alone) {
      const double slow = slow_crossings * joints.cutoff * resolution[motion.joint];
      const Index size = motion.samples.size();
      creeping.segment(motion.samples.begin - moving.begin, size) =
          joints.derivative(1, motion.joint, motion.samples.begin - span.samples.begin, size).array().abs() < slow;
    }
    left_out = left_out || widened(runs(creeping, margin), margin);
  }
  std::vector<IndexRange> parts;
  Index from = 0;
  for (Index i = 0; i <= moving.size(); ++i) {
    if (i == moving.size() || left_out[i]) {
      if (i > from) {
        parts.push_back({moving.begin + from, moving.begin + i});
      }
      from = i + 1;
    }
  }
  return parts;
}

}  // namespace circlepoint
