#include "arm_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"

namespace circlepoint {
namespace {

constexpr int filter_order = 4;
constexpr Index shortest_stretch = 12;  // rows
constexpr Index longest_stretch = 500;

struct SmoothSpan {
  IndexRange samples;
  SamplesX position;
  SamplesX velocity;
  SamplesX acceleration;
  SamplesX jerk;
  SamplesX reading;
  Index usable_begin = 0;  // first and last samples not spoilt by the span's ends, in the recording's indices
  Index usable_end = 0;
};

// Time reversal leaves the model as it is where all joints stand still: a mirrored continuation is then exact, and only a span
// that begins or ends in motion loses a filter length.
SmoothSpan smooth(const Recording& recording, const IndexRange& span, double cutoff, bool gyroscope) {
  const double rate = recording.sample_rate;
  const Index channels = gyroscope ? 6 : 3;
  const Index joints = recording.joints();
  SamplesX both(span.size(), joints + channels);
  both.leftCols(joints) = recording.joint_positions.middleRows(span.begin, span.size());
  both.middleCols(joints, 3) = recording.specific_force.middleRows(span.begin, span.size());
  if (gyroscope) {
    both.rightCols(3) = recording.angular_velocity->middleRows(span.begin, span.size());
  }
  const auto pad = std::min<Index>(span.size() - 1, static_cast<Index>(std::lround(4.0 * rate / cutoff)));
  both = sosfiltfilt(butter(filter_order, cutoff, rate), both, PadType::even, pad);
  SmoothSpan result;
  result.samples = span;
  result.position = both.leftCols(joints);
  result.reading = both.rightCols(channels);
  result.velocity = savgol_filter(result.position, 7, 6, 1, 1.0 / rate);
  result.acceleration = savgol_filter(result.position, 7, 6, 2, 1.0 / rate);
  result.jerk = savgol_filter(result.position, 7, 6, 3, 1.0 / rate);
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
                   IndexRange moving, Index step) {
  moving.begin = std::max(moving.begin, span.usable_begin);
  moving.end = std::min(moving.end, span.usable_end);
  const Index available = (moving.size() + step - 1) / step;
  if (moving.size() <= 0 || available < shortest_stretch) {
    return;
  }
  const Index pieces = (available + longest_stretch - 1) / longest_stretch;
  for (Index piece = 0; piece < pieces; ++piece) {
    const Index first = available * piece / pieces;
    const Index last = available * (piece + 1) / pieces;
    const Eigen::ArrayXi index = Eigen::ArrayXi::LinSpaced(
        last - first, static_cast<int>(moving.begin - span.samples.begin + first * step),
        static_cast<int>(moving.begin - span.samples.begin + (last - 1) * step));
    MovingStretch stretch;
    stretch.joint = moving_joint(segmentation, moving);
    stretch.offsets.assign(static_cast<std::size_t>(recording.joints()), -1);
    stretch.position = span.position(index, Eigen::all);
    stretch.velocity = span.velocity(index, Eigen::all);
    stretch.acceleration = span.acceleration(index, Eigen::all);
    stretch.jerk = span.jerk(index, Eigen::all);
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
  row.offsets.assign(static_cast<std::size_t>(recording.joints()), -1);
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
  const Index joints = resolution.size();
  std::vector<double> std;
  for (Index joint = 0; joint < joints; ++joint) {
    const double count = resolution[joint];
    if (count <= 0.0) {
      continue;
    }
    struct Rest {
      double position;
      std::vector<std::size_t> dwells;
    };
    std::vector<Rest> rests;
    for (std::size_t i = 0; i < rows.dwells.size(); ++i) {
      const double position = rows.dwells[i].position[joint];
      const auto same = std::find_if(rests.begin(), rests.end(),
                                     [&](const Rest& rest) { return std::abs(rest.position - position) < 0.75 * count; });
      if (same == rests.end()) {
        rests.push_back({position, {i}});
      } else {
        same->dwells.push_back(i);
      }
    }
    for (const Rest& rest : rests) {
      std::vector<MovingStretch*> stretches;
      for (MovingStretch& stretch : rows.stretches) {
        if ((stretch.position.col(joint).array() - rest.position).abs().maxCoeff() < 0.75 * count) {
          stretches.push_back(&stretch);
        }
      }
      if (rest.dwells.size() + stretches.size() < 2) {
        continue;
      }
      const auto offset = static_cast<Index>(std.size());
      std.push_back(count / std::sqrt(12.0));
      for (const std::size_t dwell : rest.dwells) {
        rows.dwells[dwell].offsets[static_cast<std::size_t>(joint)] = offset;
        rows.dwells[dwell].position_variance[joint] = 0.0;
      }
      for (MovingStretch* stretch : stretches) {
        stretch->offsets[static_cast<std::size_t>(joint)] = offset;
      }
    }
  }
  rows.offset_std = Eigen::Map<const Eigen::VectorXd>(std.data(), static_cast<Index>(std.size()));
}

}  // namespace

double choose_common_cutoff(const Recording& recording, const Eigen::VectorXd& resolution) {
  constexpr double widest = 20.0;     // Hz
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
  const auto step = std::max<Index>(1, static_cast<Index>(std::floor(recording.sample_rate / (3.0 * cutoff))));
  rows.rate = recording.sample_rate / static_cast<double>(step);
  for (const StaticDwell& dwell : segmentation.dwells) {
    rows.dwells.push_back(dwell_row(recording, dwell, resolution, gyroscope));
    rows.samples += dwell.samples.size();
  }
  for (const IndexRange& span : recording.spans) {
    if (span.size() < std::max<Index>(32, shortest_stretch * step)) {
      continue;
    }
    const SmoothSpan smoothed = smooth(recording, span, cutoff, gyroscope);
    Index begin = span.begin;
    for (const StaticDwell& dwell : segmentation.dwells) {
      if (dwell.samples.begin < span.begin || dwell.samples.end > span.end) {
        continue;
      }
      add_stretches(rows, recording, segmentation, smoothed, {begin, dwell.samples.begin}, step);
      begin = dwell.samples.end;
    }
    add_stretches(rows, recording, segmentation, smoothed, {begin, span.end}, step);
  }
  share_offsets(rows, resolution);
  return rows;
}

}  // namespace circlepoint
