#include "arm_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "arm_encoder_noise.hpp"
#include "arm_offsets.hpp"
#include "arm_smooth.hpp"
#include "arm_yield.hpp"

namespace circlepoint {

namespace {

constexpr Index shortest_stretch = 5;   // rows
constexpr Index longest_stretch = 500;
constexpr Index longest_coarse = 120;    // their covariances are dense
constexpr Index fewest_stretches = 8;    // where there is enough: each is once held out

// The motion of one joint alone through the middle of the range, or -1.
Index single_motion(const Segmentation& segmentation, const IndexRange& range) {
  const Index middle = (range.begin + range.end) / 2;
  for (std::size_t i = 0; i < segmentation.motions.size(); ++i) {
    const SingleJointMotion& motion = segmentation.motions[i];
    if (motion.samples.begin <= middle && middle < motion.samples.end) {
      return static_cast<Index>(i);
    }
  }
  return -1;
}

// The motions of one joint alone that lie in the range, each with what is beside it: up to halfway to the next, where no rest was
// seen between, or to the range's ends.
std::vector<MovingAlone> moving_alone(const Segmentation& segmentation, const IndexRange& range, double rate) {
  constexpr double longest_rest = 1.0;  // s; beyond, other joints may move between two motions
  std::vector<MovingAlone> found;
  for (const SingleJointMotion& motion : segmentation.motions) {
    const Index middle = (motion.samples.begin + motion.samples.end) / 2;
    if (range.begin <= middle && middle < range.end) {
      const auto beside = static_cast<Index>(0.5 * longest_rest * rate);
      const IndexRange around{std::max(range.begin, motion.samples.begin - beside), std::min(range.end, motion.samples.end + beside)};
      found.push_back({around, motion.joint});
    }
  }
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (found[i].samples.begin < found[i - 1].samples.end) {
      found[i].samples.begin = found[i - 1].samples.end = (found[i].samples.begin + found[i - 1].samples.end) / 2;
    }
  }
  return found;
}

Index test_of(const Segmentation& segmentation, Index motion) {
  for (std::size_t i = 0; i < segmentation.tests.size(); ++i) {
    const std::vector<Index>& motions = segmentation.tests[i].motions;
    if (std::find(motions.begin(), motions.end(), motion) != motions.end()) {
      return static_cast<Index>(i);
    }
  }
  return -1;
}

void add_part(ArmRows& rows, const Recording& recording, const Segmentation& segmentation, const SmoothSpan& span,
              const IndexRange& moving, Index step, Index longest, const Eigen::VectorXd& resolution, bool errors) {
  const Index available = (moving.size() + step - 1) / step;
  if (available < shortest_stretch) {
    return;
  }
  const Index motion = single_motion(segmentation, moving);
  const Index alone = motion >= 0 ? segmentation.motions[static_cast<std::size_t>(motion)].joint : -1;
  const Index pieces = (available + longest - 1) / longest;
  constexpr double finest = 1e-5;      // rad: errors of finer counts are next to nothing
  std::vector<std::size_t> smoothing;  // by joint
  std::vector<Eigen::VectorXd> counts; // by joint, of the whole span; empty: its counts make no error worth telling
  const std::vector<bool> movers = moving_joints(span, moving, alone, resolution);
  const std::size_t for_yields = smoothing_for_yields(span, moving, movers);
  for (Index joint = 0; joint < recording.joints(); ++joint) {
    const bool moves = movers[static_cast<std::size_t>(joint)];
    smoothing.push_back(moves ? 0 : for_yields);
    counts.emplace_back();
    if (errors && resolution[joint] > finest) {
      const SamplesX& position = alone >= 0 ? span.sharp.position : span.joints[smoothing.back()].position;
      const auto here = position.col(joint).segment(moving.begin - span.samples.begin, moving.size());
      // One that rests has an error of its own (give_offsets) or is followed (arm_yield), but not where it wanders as nothing says.
      if (moves || here.maxCoeff() - here.minCoeff() > one_rest * resolution[joint]) {
        counts.back() = position.col(joint) / resolution[joint];
      }
    }
  }
  for (Index piece = 0; piece < pieces; ++piece) {
    const Index first = available * piece / pieces;
    const Index last = available * (piece + 1) / pieces;
    const Eigen::ArrayXi index = Eigen::ArrayXi::LinSpaced(
        last - first, static_cast<int>(moving.begin - span.samples.begin + first * step),
        static_cast<int>(moving.begin - span.samples.begin + (last - 1) * step));
    MovingStretch stretch;
    if (motion >= 0) {
      stretch.joint = alone;
      stretch.test = test_of(segmentation, motion);
    }
    stretch.follows.assign(static_cast<std::size_t>(recording.joints()), false);
    stretch.sample = index + static_cast<int>(span.samples.begin);
    stretch.position.resize(last - first, recording.joints());
    stretch.velocity = stretch.acceleration = stretch.jerk = stretch.snap = stretch.position;
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      const SmoothJoints& joints = span.joints[smoothing[static_cast<std::size_t>(joint)]];
      stretch.position.col(joint) = joints.position(index, joint);
      stretch.velocity.col(joint) = joints.derivative(1, joint, index);
      stretch.acceleration.col(joint) = joints.derivative(2, joint, index);
      stretch.jerk.col(joint) = joints.derivative(3, joint, index);
      stretch.snap.col(joint) = joints.derivative(4, joint, index);
    }
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      if (counts[at].size() > 0) {
        const auto size = static_cast<float>(resolution[joint] * resolution[joint]);
        stretch.errors.push_back(
            {joint, size * count_error_covariance(counts[at], index, span.joints[smoothing[at]].cutoff, recording.sample_rate)});
      }
    }
    stretch.reading = span.reading(index, Eigen::all);
    stretch.time = recording.time(stretch.sample);
    rows.stretches.push_back(std::move(stretch));
    rows.samples += (last - first) * step;
  }
}

void add_stretches(ArmRows& rows, const Recording& recording, const Segmentation& segmentation, const SmoothSpan& span,
                   IndexRange moving, Index step, Index longest, const Eigen::VectorXd& resolution, bool errors) {
  moving.begin = std::max(moving.begin, span.usable_begin);
  moving.end = std::min(moving.end, span.usable_end);
  if (moving.size() <= 0) {
    return;
  }
  const std::vector<MovingAlone> alone = errors ? moving_alone(segmentation, moving, recording.sample_rate) : std::vector<MovingAlone>{};
  for (const IndexRange& part : without_steps(span, moving, alone, resolution, recording.sample_rate)) {
    add_part(rows, recording, segmentation, span, part, step, longest, resolution, errors);
  }
}

DwellRow dwell_row(const Recording& recording, const StaticDwell& dwell, const Eigen::VectorXd& resolution, bool gyroscope) {
  DwellRow row;
  const auto count = static_cast<double>(dwell.samples.size());
  row.position = dwell.joint_positions;
  row.follows.assign(static_cast<std::size_t>(row.position.size()), false);
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
  row.samples = dwell.samples;
  return row;
}

// The rest a dwell is the quiet part of: from where all joints come to stand to where one leaves. An arm that has stopped rings on.
// `within`: no farther than to other dwells.
IndexRange whole_rest(const Recording& recording, const IndexRange& within, const StaticDwell& dwell) {
  constexpr double still = 2e-4;  // rad or m
  const auto stands = [&](Index sample) {
    return (recording.joint_positions.row(sample).transpose() - dwell.joint_positions).cwiseAbs().maxCoeff() <= still;
  };
  IndexRange rest = dwell.samples;
  while (rest.begin > within.begin && stands(rest.begin - 1)) {
    --rest.begin;
  }
  while (rest.end < within.end && stands(rest.end)) {
    ++rest.end;
  }
  return rest;
}

// The motions between dwells, by their peak speeds and travels.
struct MotionsSeen {
  double frequency = 0.0;      // Hz, the highest of any
  double needed = 0.0;         // Hz: four times that, or eight times where an arc is long and the readings have harmonics
  Eigen::ArrayXd travel;       // (n) the longest of each joint
  Eigen::ArrayXd acceleration; // (n) rms, the strongest of each joint
};

MotionsSeen motions_seen(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution) {
  constexpr double least_travel = 0.05;  // rad or m
  const auto window = std::max<Index>(1, static_cast<Index>(std::lround(0.1 * recording.sample_rate)));
  MotionsSeen seen{0.0, 0.0, Eigen::ArrayXd::Zero(recording.joints()), Eigen::ArrayXd::Zero(recording.joints())};
  const auto consider = [&](const IndexRange& range) {
    if (range.size() <= 3 * window) {
      return;
    }
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      const Eigen::VectorXd position = recording.joint_positions.col(joint).segment(range.begin, range.size());
      const double travel = position.maxCoeff() - position.minCoeff();
      if (travel > least_travel) {
        const Index count = range.size() - window;
        const double farthest = (position.tail(count) - position.head(count)).cwiseAbs().maxCoeff() - resolution[joint];
        const double fastest = std::max(0.0, farthest) * recording.sample_rate / static_cast<double>(window);
        const double frequency = fastest / (std::numbers::pi * travel);
        seen.frequency = std::max(seen.frequency, frequency);
        seen.needed = std::max(seen.needed, 4.0 * frequency * (1.0 + std::min(1.0, travel * travel)));
        seen.travel[joint] = std::max(seen.travel[joint], travel);
        seen.acceleration[joint] = std::max(seen.acceleration[joint], std::numbers::sqrt2 * fastest * fastest / travel);
      }
    }
  };
  for (const IndexRange& span : recording.spans) {
    Index begin = span.begin;
    for (const StaticDwell& dwell : segmentation.dwells) {
      if (dwell.samples.begin >= span.begin && dwell.samples.end <= span.end) {
        consider({begin, dwell.samples.begin});
        begin = dwell.samples.end;
      }
    }
    consider({begin, span.end});
  }
  return seen;
}

// White noise of counts, differentiated twice and cut at c, has the std count / sqrt(12) sqrt(2 c / rate) (2 pi c)^2 / sqrt(5):
// this times c^2.5.
double rounding_at_one_hertz(double count, double rate) {
  return count / std::sqrt(12.0) * std::sqrt(2.0 / rate) * 4.0 * std::numbers::pi * std::numbers::pi / std::sqrt(5.0);
}

}  // namespace

Index ArmRows::equations() const {
  Index count = static_cast<Index>(dwells.size());
  for (const MovingStretch& stretch : stretches) {
    count += stretch.rows();
  }
  return count * channels;
}

MovingStretch picked(const MovingStretch& stretch, const std::vector<Index>& rows) {
  MovingStretch piece;
  piece.joint = stretch.joint;
  piece.test = stretch.test;
  piece.noise = stretch.noise;
  piece.offsets = stretch.offsets;
  piece.follows = stretch.follows;
  std::vector<Index> of_motion;  // rows for position, velocity, acceleration
  for (Index order = 0; order < 3; ++order) {
    std::transform(rows.begin(), rows.end(), std::back_inserter(of_motion), [&](Index row) { return order * stretch.rows() + row; });
  }
  for (const PositionError& error : stretch.errors) {
    piece.errors.push_back({error.joint, error.covariance(of_motion, of_motion)});
  }
  piece.sample = stretch.sample(rows);
  piece.time = stretch.time(rows);
  piece.position = stretch.position(rows, Eigen::all);
  piece.velocity = stretch.velocity(rows, Eigen::all);
  piece.acceleration = stretch.acceleration(rows, Eigen::all);
  piece.jerk = stretch.jerk(rows, Eigen::all);
  piece.snap = stretch.snap(rows, Eigen::all);
  piece.reading = stretch.reading(rows, Eigen::all);
  if (!stretch.offsets.empty()) {
    piece.shapes.position = stretch.shapes.position(rows, Eigen::all);
    piece.shapes.velocity = stretch.shapes.velocity(rows, Eigen::all);
    piece.shapes.acceleration = stretch.shapes.acceleration(rows, Eigen::all);
  }
  return piece;
}

double choose_common_cutoff(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution) {
  constexpr double widest = 12.0;
  constexpr double narrowest = 4.0;
  const double harmonics = are_coarse(resolution) ? 10.0 : 20.0;
  constexpr double tolerated = 0.1;        // rad/s^2 of differentiated counts
  constexpr double tolerated_share = 0.1;  // of a joint's acceleration
  constexpr double slowest = 1.0;          // Hz
  constexpr double main_travel = 0.2;      // of the longest travel: less is not what the recording was made for
  const MotionsSeen seen = motions_seen(recording, segmentation, resolution);
  double cutoff = std::min(widest, 0.2 * recording.sample_rate);
  if (seen.frequency > 0.0) {
    cutoff = std::min(cutoff, std::max(narrowest, harmonics * seen.frequency));
  }
  const double coarsest = resolution.size() > 0 ? resolution.maxCoeff() : 0.0;
  if (coarsest > 0.0) {
    const double clear = std::pow(tolerated / rounding_at_one_hertz(coarsest, recording.sample_rate), 0.4);
    cutoff = std::min(cutoff, std::max({narrowest, seen.needed, clear}));
  }
  for (Index joint = 0; joint < resolution.size(); ++joint) {
    if (resolution[joint] > 0.0 && seen.travel[joint] > main_travel * seen.travel.maxCoeff()) {
      const double share = tolerated_share * seen.acceleration[joint] / rounding_at_one_hertz(resolution[joint], recording.sample_rate);
      cutoff = std::min(cutoff, std::max({slowest, seen.needed, std::pow(share, 0.4)}));
    }
  }
  return cutoff;
}

double travel(const ArmRows& rows, Index joint) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const MovingStretch& stretch : rows.stretches) {
    lowest = std::min(lowest, stretch.position.col(joint).minCoeff());
    highest = std::max(highest, stretch.position.col(joint).maxCoeff());
  }
  for (const DwellRow& dwell : rows.dwells) {
    lowest = std::min(lowest, dwell.position[joint]);
    highest = std::max(highest, dwell.position[joint]);
  }
  return highest - lowest;
}

Eigen::VectorXd rounding_share(const ArmRows& rows, const Eigen::VectorXd& resolution) {
  constexpr double least_counts = 10.0;  // of travel in a stretch: what joints at rest yield by
  Eigen::VectorXd share = Eigen::VectorXd::Zero(resolution.size());
  for (Index joint = 0; joint < resolution.size() && !rows.stretches.empty(); ++joint) {
    const double noise = rounding_at_one_hertz(resolution[joint], rows.sample_rate) * std::pow(rows.cutoff, 2.5);
    double of_counts = 0.0;
    double all = 0.0;
    for (const MovingStretch& stretch : rows.stretches) {
      const auto position = stretch.position.col(joint);
      const bool follows = stretch.follows[static_cast<std::size_t>(joint)];
      if (!follows && position.maxCoeff() - position.minCoeff() > least_counts * resolution[joint]) {
        of_counts += noise * noise * static_cast<double>(stretch.rows());
        all += stretch.acceleration.col(joint).squaredNorm();
      }
    }
    if (travel(rows, joint) < fewest_counts * resolution[joint]) {
      share[joint] = 1.0;
    } else if (all > 0.0) {
      share[joint] = of_counts / all;
    }
  }
  return share;
}

namespace {

// With `errors`, coarse encoders' errors of moving joints are carried to the readings.
ArmRows make_rows(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution, double cutoff,
                  bool gyroscope, bool errors, const KnownArm* arm) {
  ArmRows rows;
  rows.cutoff = cutoff;
  rows.channels = gyroscope ? 6 : 3;
  rows.middle = 0.5 * (recording.time[0] + recording.time[recording.samples() - 1]);
  const auto step = std::max<Index>(1, static_cast<Index>(std::floor(recording.sample_rate / (2.0 * cutoff))));
  rows.rate = recording.sample_rate / static_cast<double>(step);
  rows.sample_rate = recording.sample_rate;
  const bool coarse = are_coarse(resolution);
  const Index longest = std::clamp<Index>(recording.samples() / step / fewest_stretches, 8 * shortest_stretch,
                                          errors ? longest_coarse : longest_stretch);
  for (const StaticDwell& dwell : segmentation.dwells) {
    rows.dwells.push_back(dwell_row(recording, dwell, resolution, gyroscope));
    rows.samples += dwell.samples.size();
  }
  std::vector<SmoothSpan> spans;
  for (const IndexRange& span : recording.spans) {
    if (span.size() < std::max<Index>(32, shortest_stretch * step)) {
      continue;
    }
    spans.push_back(smooth(recording, span, cutoff, coarse, gyroscope));
    // Rows of a stretch hold noise from half a filter's width around; what a dwell has averaged must not count again.
    const auto apart = static_cast<Index>(std::lround(0.3 * recording.sample_rate / cutoff));
    Index begin = span.begin;
    Index before = span.begin;  // the end of the dwell before
    for (std::size_t i = 0; i < segmentation.dwells.size(); ++i) {
      const StaticDwell& dwell = segmentation.dwells[i];
      if (dwell.samples.begin < span.begin || dwell.samples.end > span.end) {
        continue;
      }
      const Index after = i + 1 < segmentation.dwells.size() ? std::min(span.end, segmentation.dwells[i + 1].samples.begin) : span.end;
      // Coarse encoders do not show when joints stop.
      const IndexRange rest = coarse ? dwell.samples : whole_rest(recording, {before, after}, dwell);
      const Index end = std::min(dwell.samples.begin - apart, rest.begin + apart);
      add_stretches(rows, recording, segmentation, spans.back(), {begin, end}, step, longest, resolution, errors);
      begin = std::max(dwell.samples.end + apart, rest.end - apart);
      before = dwell.samples.end;
    }
    add_stretches(rows, recording, segmentation, spans.back(), {begin, span.end}, step, longest, resolution, errors);
  }
  if (coarse) {
    follow_yields(rows, recording, segmentation, spans, resolution, arm);
  }
  give_offsets(rows, resolution);
  return rows;
}

}  // namespace

ArmRows make_rows(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution, double cutoff,
                  bool gyroscope, const KnownArm* arm) {
  const bool errors = are_coarse(resolution) && !gyroscope;
  ArmRows rows = make_rows(recording, segmentation, resolution, cutoff, gyroscope, errors && arm != nullptr, arm);
  // Where joints at rest yield to loads not known, what the model of that leaves is larger than the counts' errors and looks alike;
  // one fitted spectrum covers both.
  if (errors && arm == nullptr && !rows.yields) {
    ArmRows telling = make_rows(recording, segmentation, resolution, cutoff, gyroscope, true, arm);
    if (!telling.stretches.empty()) {
      rows = std::move(telling);
    }
  }
  return rows;
}

}  // namespace circlepoint
