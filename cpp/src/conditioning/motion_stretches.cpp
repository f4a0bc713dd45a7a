#include "motion_stretches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace circlepoint::detail {
namespace {

constexpr double speed_smoothing = 0.05;  // s, of the speeds that tell motion from rest
constexpr double rest_kept = 0.75;        // s, at most, on both sides of a motion
constexpr double window = 0.3;            // s, over which the fastest joint sets the threshold for the others
constexpr double longest = 20.0;          // s, longer stretches are cut where the joint rests
constexpr double on_one_path = 0.999;     // of the variance along the path's chord

// Which joint moves at each sample: its index, rest or several.
constexpr Index rest = -1;
constexpr Index several = -2;

std::vector<Index> who_moves(const UniformStream& joints, const ClockAlignmentOptions& options) {
  const SamplesX speed = smooth(joints, joints.values, speed_smoothing, 1).cwiseAbs();
  const Eigen::VectorXd fastest = speed.rowwise().maxCoeff();
  const auto half = static_cast<Index>(window / joints.period);
  std::vector<Index> state(static_cast<std::size_t>(speed.rows()), rest);
  for (const IndexRange& span : joints.spans) {
    for (Index i = span.begin; i < span.end; ++i) {
      const Index from = std::max(span.begin, i - half), to = std::min(span.end, i + half + 1);
      const double threshold = std::max(options.min_velocity, options.others_ratio * fastest.segment(from, to - from).maxCoeff());
      Index& moving = state[static_cast<std::size_t>(i)];
      for (Index j = 0; j < speed.cols(); ++j) {
        if (speed(i, j) > threshold) {
          moving = moving == rest ? j : several;
        }
      }
    }
  }
  return state;
}

Eigen::VectorXd travel(const UniformStream& joints, IndexRange rows) {
  const auto block = joints.values.middleRows(rows.begin, rows.size());
  return (block.colwise().maxCoeff() - block.colwise().minCoeff()).transpose();
}

// Runs of samples accepted by `same`, joined across rest, cut where they would get too long.
template <typename Same>
std::vector<std::pair<Index, IndexRange>> runs(const UniformStream& joints, const std::vector<Index>& state, Same same) {
  std::vector<std::pair<Index, IndexRange>> found;
  const auto too_long = static_cast<Index>(longest / joints.period);
  const auto long_rest = static_cast<Index>(rest_kept / joints.period);
  for (const IndexRange& span : joints.spans) {
    bool open = false;
    for (Index i = span.begin; i < span.end; ++i) {
      const Index who = state[static_cast<std::size_t>(i)];
      if (who == rest) {
        continue;
      }
      if (open && same(found.back().first, who)) {
        IndexRange& run = found.back().second;
        const bool rested = i - run.end > long_rest;
        if (!(rested && i - run.begin > too_long)) {
          run.end = i + 1;
          continue;
        }
      }
      found.push_back({who, {i, i + 1}});
      open = true;
    }
  }
  return found;
}

// The rows of a motion with the rest around it.
IndexRange with_rest(const UniformStream& joints, const std::vector<Index>& state, IndexRange moving) {
  const auto span = std::find_if(joints.spans.begin(), joints.spans.end(),
                                 [&](const IndexRange& s) { return moving.begin >= s.begin && moving.end <= s.end; });
  const auto most = static_cast<Index>(rest_kept / joints.period);
  IndexRange rows = moving;
  while (rows.begin > span->begin && moving.begin - rows.begin < most && state[static_cast<std::size_t>(rows.begin - 1)] == rest) {
    --rows.begin;
  }
  while (rows.end < span->end && rows.end - moving.end < most && state[static_cast<std::size_t>(rows.end)] == rest) {
    ++rows.end;
  }
  return rows;
}

// Acceleration through the low-pass; squared speed of the half-smoothed position, then through the low-pass.
void add_dynamics(const UniformStream& joints, const SamplesX& position, double sigma, SamplesX& regressors) {
  regressors.col(regressors.cols() - 2) = smooth(joints, position, sigma, 2);
  const SamplesX speed = smooth(joints, position, 0.5 * sigma, 1);
  regressors.rightCols(1) = smooth(joints, speed.cwiseAbs2(), sigma, 0);
}

}  // namespace

std::vector<MotionModel> single_joint_stretches(const UniformStream& joints, const ClockAlignmentOptions& options) {
  const std::vector<Index> state = who_moves(joints, options);
  const double sigma = gaussian_sigma(options.cutoff);
  std::vector<SamplesX> of_joint(static_cast<std::size_t>(joints.values.cols()));
  std::vector<MotionModel> stretches;
  for (const auto& [joint, moving] : runs(joints, state, [](Index a, Index b) { return a == b; })) {
    if (joint == several) {
      continue;
    }
    const Eigen::VectorXd range = travel(joints, moving);
    Eigen::VectorXd others = range;
    others(joint) = 0.0;
    if (range(joint) < options.min_travel || others.maxCoeff() > options.others_ratio * range(joint)) {
      continue;
    }
    SamplesX& all = of_joint[static_cast<std::size_t>(joint)];
    if (all.size() == 0) {
      const SamplesX angle = joints.values.col(joint);
      all.resize(angle.rows(), 5);
      all.col(0).setOnes();
      all.col(1) = smooth(joints, angle.array().cos().matrix(), sigma, 0);
      all.col(2) = smooth(joints, angle.array().sin().matrix(), sigma, 0);
      add_dynamics(joints, angle, sigma, all);
    }
    const IndexRange rows = with_rest(joints, state, moving);
    stretches.push_back({joint, rows, moving, all.middleRows(rows.begin, rows.size())});
  }
  return stretches;
}

std::vector<MotionModel> path_stretches(const UniformStream& joints, const ClockAlignmentOptions& options) {
  std::vector<Index> state = who_moves(joints, options);
  for (Index& who : state) {
    who = who == rest ? rest : several;
  }
  const double sigma = gaussian_sigma(options.cutoff);
  std::vector<MotionModel> stretches;
  const auto enough_rest = static_cast<Index>(0.1 / joints.period);
  std::vector<IndexRange> moves;
  for (const IndexRange& span : joints.spans) {
    for (Index i = span.begin; i < span.end; ++i) {
      if (state[static_cast<std::size_t>(i)] == rest) {
        continue;
      }
      if (!moves.empty() && moves.back().begin >= span.begin && i - moves.back().end < enough_rest) {
        moves.back().end = i + 1;
      } else {
        moves.push_back({i, i + 1});
      }
    }
  }
  for (const IndexRange& moving : moves) {
    const SamplesX block = joints.values.middleRows(moving.begin, moving.size());
    const Eigen::RowVectorXd mean = block.colwise().mean();
    const Eigen::MatrixXd centred = block.rowwise() - mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(centred.transpose() * centred);
    const Index last = joints.values.cols() - 1;
    const double total = principal.eigenvalues().sum();
    if (travel(joints, moving).maxCoeff() < options.min_travel || principal.eigenvalues()(last) < on_one_path * total) {
      continue;
    }
    const IndexRange rows = with_rest(joints, state, moving);
    UniformStream piece;
    piece.period = joints.period;
    piece.spans = {{0, rows.size()}};
    const SamplesX along =
        (joints.values.middleRows(rows.begin, rows.size()).rowwise() - mean) * principal.eigenvectors().col(last);
    const double scale = travel(joints, moving).norm();
    SamplesX regressors(rows.size(), 7);
    regressors.col(0).setOnes();
    for (int power = 1; power <= 4; ++power) {
      regressors.col(power) = smooth(piece, (along.array() / scale).pow(power).matrix(), sigma, 0);
    }
    add_dynamics(piece, along, sigma, regressors);
    stretches.push_back({-1, rows, moving, std::move(regressors)});
  }
  return stretches;
}

}  // namespace circlepoint::detail
