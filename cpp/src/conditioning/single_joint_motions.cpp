#include "single_joint_motions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sliding_extremum.hpp"

namespace circlepoint {
namespace {

/// The parts of a span that no rest covers.
std::vector<IndexRange> moving(IndexRange span, const std::vector<IndexRange>& rests) {
  std::vector<IndexRange> runs;
  Index begin = span.begin;
  for (const IndexRange& rest : rests) {
    if (rest.end <= span.begin || rest.begin >= span.end) {
      continue;
    }
    if (rest.begin > begin) {
      runs.push_back({begin, rest.begin});
    }
    begin = rest.end;
  }
  if (begin < span.end) {
    runs.push_back({begin, span.end});
  }
  return runs;
}

/// |velocity| from the means of the window's two halves: a count of the encoder makes 2 counts / window of it.
Eigen::VectorXd speed_of(const Eigen::Ref<const Eigen::VectorXd>& positions, Index half, double sample_rate) {
  const Index size = positions.size();
  Eigen::VectorXd speed = Eigen::VectorXd::Zero(size);
  if (size < 2 * half) {
    return speed;
  }
  const double scale = sample_rate / static_cast<double>(half * half);
  double before = (positions.head(half).array() - positions[0]).sum();
  double after = (positions.segment(half, half).array() - positions[0]).sum();
  for (Index k = half;; ++k) {
    speed[k] = std::abs(after - before) * scale;
    if (k + half == size) {
      break;
    }
    before += positions[k] - positions[k - half];
    after += positions[k + half] - positions[k];
  }
  speed.head(half).setConstant(speed[half]);
  speed.tail(half).setConstant(speed[size - half]);
  return speed;
}

/// Largest value within `reach` samples on either side.
Eigen::VectorXd neighbourhood_maximum(const Eigen::Ref<const Eigen::VectorXd>& values, Index reach) {
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(values.size() + 2 * reach);
  padded.segment(reach, values.size()) = values;
  const auto maxima =
      sliding_extremum(padded.data(), padded.size(), 2 * reach + 1, [](double a, double b) { return std::max(a, b); });
  return Eigen::Map<const Eigen::VectorXd>(maxima.data(), values.size());
}

class SpanSearch {
 public:
  /// Positions are taken in radians of the thresholds: prismatic joints divided by their `units`.
  SpanSearch(const Recording& recording, const std::vector<std::vector<IndexRange>>& rests, IndexRange span,
             const Eigen::VectorXd& units, const Eigen::VectorXd& bands, const SegmentationOptions& options)
      : rests_(rests), span_(span), units_(units), bands_(bands), options_(options), rate_(recording.sample_rate),
        half_(std::max<Index>(1, std::llround(0.5 * options.rest_window * rate_))),
        positions_(recording.joint_positions.middleRows(span.begin, span.size()) * units.cwiseInverse().asDiagonal()),
        speed_(span.size(), bands.size()) {
    for (Index joint = 0; joint < bands.size(); ++joint) {
      speed_.col(joint) = speed_of(positions_.col(joint), half_, rate_);
    }
  }

  void collect(std::vector<SingleJointMotion>& motions) const {
    for (Index joint = 0; joint < bands_.size(); ++joint) {
      for (const IndexRange& run : moving(span_, rests_[static_cast<std::size_t>(joint)])) {
        const IndexRange local{run.begin - span_.begin, run.end - span_.begin};
        const double travel = range_of(joint, local);
        if (travel < options_.min_travel) {
          continue;
        }
        if (others_stay(joint, local, travel)) {
          add(joint, local, local, motions);
        } else {
          for (const IndexRange& part : alone(joint, local)) {
            add(joint, local, part, motions);
          }
        }
      }
    }
  }

 private:
  double range_of(Index joint, IndexRange local) const {
    const auto values = positions_.col(joint).segment(local.begin, local.size());
    return values.maxCoeff() - values.minCoeff();
  }

  bool others_stay(Index joint, IndexRange local, double travel) const {
    const double yield = std::min(options_.others_travel, options_.others_ratio * travel);
    for (Index other = 0; other < bands_.size(); ++other) {
      if (other != joint && range_of(other, local) > std::max(2.0 * bands_[other], yield)) {
        return false;
      }
    }
    return true;
  }

  /// Parts of a run in which every other joint is slow against this one's peak speed of the time.
  std::vector<IndexRange> alone(Index joint, IndexRange run) const {
    const auto own = speed_.col(joint).segment(run.begin, run.size());
    const Eigen::VectorXd allowed = options_.others_ratio * neighbourhood_maximum(own, 10 * half_);
    std::vector<std::uint8_t> blocked(static_cast<std::size_t>(run.size()), 0);
    for (Index other = 0; other < bands_.size(); ++other) {
      if (other == joint) {
        continue;
      }
      const auto theirs = speed_.col(other).segment(run.begin, run.size());
      const double floor = 2.0 * bands_[other] / options_.rest_window;
      // A joint that exceeds the allowance has been moving since it last was slower than the floor.
      for (Index k = 0; k < run.size();) {
        if (theirs[k] <= floor) {
          ++k;
          continue;
        }
        Index end = k;
        bool joins = false;
        for (; end < run.size() && theirs[end] > floor; ++end) {
          joins = joins || theirs[end] > allowed[end];
        }
        if (joins) {
          std::fill(blocked.begin() + k, blocked.begin() + end, std::uint8_t{1});
        }
        k = end;
      }
    }
    std::vector<IndexRange> parts;
    for (Index k = 0; k < run.size();) {
      Index end = k;
      while (end < run.size() && blocked[static_cast<std::size_t>(end)] == 0) {
        ++end;
      }
      if (end > k) {
        parts.push_back({run.begin + k, run.begin + end});
      }
      k = end + 1;
    }
    return parts;
  }

  /// Adds a run, or a part of it, if it is a motion of this joint alone and long enough.
  void add(Index joint, IndexRange run, IndexRange part, std::vector<SingleJointMotion>& motions) const {
    SingleJointMotion motion;
    motion.joint = joint;
    motion.from_rest = part.begin == run.begin && run.begin > 0;
    motion.to_rest = part.end == run.end && run.end < positions_.rows();
    const auto shortest = static_cast<Index>(std::ceil(options_.min_partial * rate_));
    if (part.size() < (motion.from_rest && motion.to_rest ? 2 : shortest)) {
      return;
    }
    const double travel = range_of(joint, part);
    if (travel < options_.min_travel || !others_stay(joint, part, travel)) {
      return;
    }
    const IndexRange whole = with_rest(joint, part, motion.from_rest, motion.to_rest);
    motion.samples = {span_.begin + whole.begin, span_.begin + whole.end};
    motion.travel = units_[joint] * range_of(joint, whole);
    motion.peak_velocity = units_[joint] * speed_.col(joint).segment(whole.begin, whole.size()).maxCoeff();
    motion.joint_positions = positions_.middleRows(whole.begin, whole.size()).colwise().mean();
    motion.joint_positions.array() *= units_.array();
    motions.push_back(std::move(motion));
  }

  /// The band hides a motion's first and last moments: half a window of the rests on either side brings them back.
  IndexRange with_rest(Index joint, IndexRange part, bool before, bool after) const {
    IndexRange whole = part;
    for (const IndexRange& rest : rests_[static_cast<std::size_t>(joint)]) {
      const Index share = std::min(half_, rest.size() / 2);
      if (before && rest.end == span_.begin + part.begin) {
        whole.begin = part.begin - share;
      }
      if (after && rest.begin == span_.begin + part.end) {
        whole.end = part.end + share;
      }
    }
    return whole;
  }

  const std::vector<std::vector<IndexRange>>& rests_;
  IndexRange span_;
  const Eigen::VectorXd& units_;
  const Eigen::VectorXd& bands_;
  const SegmentationOptions& options_;
  double rate_;
  Index half_;
  Eigen::MatrixXd positions_;
  Eigen::MatrixXd speed_;
};

}  // namespace

std::vector<SingleJointMotion> single_joint_motions(const Recording& recording,
                                                    const std::vector<std::vector<IndexRange>>& rests,
                                                    const SegmentationOptions& options) {
  const Eigen::VectorXd units = threshold_units(options, recording.joints());
  Eigen::VectorXd bands(recording.joints());
  for (Index joint = 0; joint < bands.size(); ++joint) {
    bands[joint] = rest_band(encoder_step(recording.joint_positions.col(joint) / units[joint]), options);
  }
  std::vector<SingleJointMotion> motions;
  for (const IndexRange& span : recording.spans) {
    SpanSearch(recording, rests, span, units, bands, options).collect(motions);
  }
  std::stable_sort(motions.begin(), motions.end(),
                   [](const auto& a, const auto& b) { return a.samples.begin < b.samples.begin; });
  return motions;
}

}  // namespace circlepoint
