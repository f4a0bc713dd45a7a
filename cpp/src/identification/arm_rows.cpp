#include "arm_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"

namespace circlepoint {
namespace {

constexpr int filter_order = 4;
constexpr double slowest_cutoff = 1.0;   // Hz
constexpr double coarse_count = 1e-4;    // rad: finer encoders see what their joints yield
constexpr double few_counts = 50.0;
constexpr Index shortest_stretch = 12;  // rows
constexpr Index longest_stretch = 500;
constexpr Index fewest_stretches = 8;    // where there is enough: each is once held out

struct SmoothJoints {
  double cutoff = 0.0;  // Hz
  SamplesX position;
  SamplesX velocity;
  SamplesX acceleration;
  SamplesX jerk;
};

struct SmoothSpan {
  IndexRange samples;
  std::vector<SmoothJoints> joints;  // by falling cut-off, the common one first
  SamplesX reading;
  Index usable_begin = 0;  // first and last samples not spoilt by the span's ends, in the recording's indices
  Index usable_end = 0;
};

SamplesX low_pass(const Eigen::Ref<const SamplesX>& samples, double cutoff, double rate) {
  const auto pad = std::min<Index>(samples.rows() - 1, static_cast<Index>(std::lround(4.0 * rate / cutoff)));
  return sosfiltfilt(butter(filter_order, cutoff, rate), samples, PadType::even, pad);
}

// Time reversal leaves the model as it is where all joints stand still: a mirrored continuation is then exact, and only a span
// that begins or ends in motion loses a filter length.
SmoothSpan smooth(const Recording& recording, const IndexRange& span, double cutoff, bool coarse, bool gyroscope) {
  const double rate = recording.sample_rate;
  SmoothSpan result;
  result.samples = span;
  const SamplesX position = recording.joint_positions.middleRows(span.begin, span.size());
  for (double mine = cutoff; mine > (coarse ? slowest_cutoff : 0.99 * cutoff); mine *= 0.7) {
    SmoothJoints joints{mine, low_pass(position, mine, rate), {}, {}, {}};
    joints.velocity = savgol_filter(joints.position, 7, 6, 1, 1.0 / rate);
    joints.acceleration = savgol_filter(joints.position, 7, 6, 2, 1.0 / rate);
    joints.jerk = savgol_filter(joints.position, 7, 6, 3, 1.0 / rate);
    result.joints.push_back(std::move(joints));
  }
  SamplesX reading(span.size(), gyroscope ? 6 : 3);
  reading.leftCols(3) = recording.specific_force.middleRows(span.begin, span.size());
  if (gyroscope) {
    reading.rightCols(3) = recording.angular_velocity->middleRows(span.begin, span.size());
  }
  result.reading = low_pass(reading, cutoff, rate);
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

// A joint that only yields shows as a staircase of few counts, and its steps differentiated twice are worse than nothing: what it
// really does follows the joints that do move, at a few times their frequency. Chooses the smoothing that passes that and no more.
std::size_t choose_smoothing(const SmoothSpan& span, const IndexRange& moving, Index joint, const Eigen::VectorXd& resolution) {
  const Index begin = moving.begin - span.samples.begin;
  const SmoothJoints& widest = span.joints.front();
  const auto range = [&](Index j) {
    const auto column = widest.position.col(j).segment(begin, moving.size());
    return column.maxCoeff() - column.minCoeff();
  };
  if (range(joint) > few_counts * resolution[joint]) {
    return 0;
  }
  double frequency = 0.0;
  for (Index j = 0; j < resolution.size(); ++j) {
    const double travel = range(j);
    if (travel > few_counts * resolution[j]) {
      const double fastest = widest.velocity.col(j).segment(begin, moving.size()).cwiseAbs().maxCoeff();
      frequency = std::max(frequency, fastest / (std::numbers::pi * travel));
    }
  }
  std::size_t chosen = 0;
  while (chosen + 1 < span.joints.size() && span.joints[chosen + 1].cutoff > 4.0 * frequency) {
    ++chosen;
  }
  return chosen;
}

// The joint that moves alone through the middle of the range, or -1.
Index moving_joint(const Segmentation& segmentation, const IndexRange& range) {
  const Index middle = (range.begin + range.end) / 2;
  for (const SingleJointMotion& motion : segmentation.motions) {
    if (motion.samples.begin <= middle && middle < motion.samples.end) {
      return motion.joint;
    }
  }
  return -1;
}

void add_stretches(ArmRows& rows, const Recording& recording, const Segmentation& segmentation, const SmoothSpan& span,
                   IndexRange moving, Index step, Index longest, const Eigen::VectorXd& resolution) {
  moving.begin = std::max(moving.begin, span.usable_begin);
  moving.end = std::min(moving.end, span.usable_end);
  const Index available = (moving.size() + step - 1) / step;
  if (moving.size() <= 0 || available < shortest_stretch) {
    return;
  }
  const Index pieces = (available + longest - 1) / longest;
  for (Index piece = 0; piece < pieces; ++piece) {
    const Index first = available * piece / pieces;
    const Index last = available * (piece + 1) / pieces;
    const Eigen::ArrayXi index = Eigen::ArrayXi::LinSpaced(
        last - first, static_cast<int>(moving.begin - span.samples.begin + first * step),
        static_cast<int>(moving.begin - span.samples.begin + (last - 1) * step));
    MovingStretch stretch;
    stretch.joint = moving_joint(segmentation, moving);
    stretch.position.resize(last - first, recording.joints());
    stretch.velocity = stretch.acceleration = stretch.jerk = stretch.position;
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      const SmoothJoints& joints = span.joints[choose_smoothing(span, moving, joint, resolution)];
      stretch.position.col(joint) = joints.position(index, joint);
      stretch.velocity.col(joint) = joints.velocity(index, joint);
      stretch.acceleration.col(joint) = joints.acceleration(index, joint);
      stretch.jerk.col(joint) = joints.jerk(index, joint);
    }
    stretch.reading = span.reading(index, Eigen::all);
    stretch.time = recording.time(index + static_cast<int>(span.samples.begin));
    rows.stretches.push_back(std::move(stretch));
    rows.samples += (last - first) * step;
  }
}

DwellRow dwell_row(const Recording& recording, const StaticDwell& dwell, const Eigen::VectorXd& resolution, bool gyroscope) {
  DwellRow row;
  const auto count = static_cast<double>(dwell.samples.size());
  row.position = dwell.joint_positions;
  // A joint that shows a single count is anywhere within it.
  row.position_variance = resolution.cwiseAbs2() / 12.0;
  const Index channels = gyroscope ? 6 : 3;
  row.reading.resize(channels);
  row.variance.resize(channels);
  row.reading.head<3>() = dwell.specific_force;
  row.variance.head<3>() = dwell.specific_force_std.cwiseAbs2() / count;
  if (gyroscope) {
    const auto rate = recording.angular_velocity->middleRows(dwell.samples.begin, dwell.samples.size());
    row.reading.tail<3>() = rate.colwise().mean();
    row.variance.tail<3>() = (rate.rowwise() - rate.colwise().mean()).colwise().squaredNorm() / (count * count);
  }
  row.time = 0.5 * (recording.time[dwell.samples.begin] + recording.time[dwell.samples.end - 1]);
  row.samples = dwell.samples.size();
  return row;
}

// Which rows share a rest: the same joint on the same count.
void share_offsets(ArmRows& rows, const Eigen::VectorXd& resolution) {
  std::vector<double> std;
  for (Index joint = 0; joint < resolution.size(); ++joint) {
    const double count = resolution[joint];
    if (count <= 0.0) {
      continue;
    }
    struct Rest {
      double position = 0.0;
      std::vector<DwellRow*> dwells;
      std::vector<MovingStretch*> stretches;
    };
    std::vector<Rest> rests;
    for (DwellRow& dwell : rows.dwells) {
      const auto same = std::find_if(rests.begin(), rests.end(), [&](const Rest& rest) {
        return std::abs(rest.position - dwell.position[joint]) < 0.75 * count;
      });
      Rest& rest = same == rests.end() ? rests.emplace_back(Rest{dwell.position[joint], {}, {}}) : *same;
      rest.dwells.push_back(&dwell);
    }
    for (Rest& rest : rests) {
      for (MovingStretch& stretch : rows.stretches) {
        if ((stretch.position.col(joint).array() - rest.position).abs().maxCoeff() < 0.75 * count) {
          rest.stretches.push_back(&stretch);
        }
      }
      if (rest.dwells.size() + rest.stretches.size() < 2) {
        continue;
      }
      const OffsetTerm term{joint, static_cast<Index>(std.size())};
      std.push_back(count / std::sqrt(12.0));
      for (DwellRow* dwell : rest.dwells) {
        dwell->offsets.push_back(term);
        dwell->position_variance[joint] = 0.0;
      }
      for (MovingStretch* stretch : rest.stretches) {
        stretch->offsets.push_back(term);
      }
    }
  }
  rows.offset_std = Eigen::Map<const Eigen::VectorXd>(std.data(), static_cast<Index>(std.size()));
}

}  // namespace

double choose_common_cutoff(const Recording& recording, const Eigen::VectorXd& resolution) {
  constexpr double widest = 10.0;     // Hz, the paper's choice; arms begin to bend and ring above it
  constexpr double tolerated = 0.1;   // rad/s^2 of differentiated counts
  double cutoff = std::min(widest, 0.2 * recording.sample_rate);
  const double coarsest = resolution.size() > 0 ? resolution.maxCoeff() : 0.0;
  if (coarsest > 0.0) {
    // White quantisation noise of coarsest / sqrt(12), differentiated twice and cut at c:
    // std = coarsest / sqrt(12) sqrt(2 c / rate) (2 pi c)^2 / sqrt(5).
    const double per_unit = coarsest / std::sqrt(12.0) * std::sqrt(2.0 / recording.sample_rate) * 4.0 * std::numbers::pi *
                            std::numbers::pi / std::sqrt(5.0);
    cutoff = std::min(cutoff, std::max(4.0, std::pow(tolerated / per_unit, 0.4)));
  }
  return cutoff;
}

ArmRows make_rows(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution, double cutoff,
                  bool gyroscope) {
  ArmRows rows;
  rows.cutoff = cutoff;
  rows.channels = gyroscope ? 6 : 3;
  rows.middle = 0.5 * (recording.time[0] + recording.time[recording.samples() - 1]);
  const auto step = std::max<Index>(1, static_cast<Index>(std::floor(recording.sample_rate / (2.0 * cutoff))));
  rows.rate = recording.sample_rate / static_cast<double>(step);
  const Index longest = std::clamp<Index>(recording.samples() / step / fewest_stretches, 4 * shortest_stretch, longest_stretch);
  for (const StaticDwell& dwell : segmentation.dwells) {
    rows.dwells.push_back(dwell_row(recording, dwell, resolution, gyroscope));
    rows.samples += dwell.samples.size();
  }
  for (const IndexRange& span : recording.spans) {
    if (span.size() < std::max<Index>(32, shortest_stretch * step)) {
      continue;
    }
    const SmoothSpan smoothed = smooth(recording, span, cutoff, resolution.maxCoeff() > coarse_count, gyroscope);
    Index begin = span.begin;
    for (const StaticDwell& dwell : segmentation.dwells) {
      if (dwell.samples.begin < span.begin || dwell.samples.end > span.end) {
        continue;
      }
      add_stretches(rows, recording, segmentation, smoothed, {begin, dwell.samples.begin}, step, longest, resolution);
      begin = dwell.samples.end;
    }
    add_stretches(rows, recording, segmentation, smoothed, {begin, span.end}, step, longest, resolution);
  }
  share_offsets(rows, resolution);
  return rows;
}

}  // namespace circlepoint
