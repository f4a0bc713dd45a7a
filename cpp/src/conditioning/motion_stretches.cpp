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
constexpr double longest = 40.0;          // s, longer stretches are cut where the joint rests
constexpr double half_smoothing = 0.5;    // of the low-pass, of what is multiplied before it
constexpr double spare_per_regressor = 4.0;  // independent samples for each regressor of the others' yielding
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
      const double threshold = std::max(options.min_velocity, options.others_ratio * fastest.segment(from,
          to - from).maxCoeff());
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
std::vector<std::pair<Index, IndexRange>> runs(const UniformStream& joints, const std::vector<Index>& state,
    Same same) {
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
  while (rows.begin > span->begin && moving.begin - rows.begin < most
      && state[static_cast<std::size_t>(rows.begin - 1)] == rest) {
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
  const SamplesX speed = smooth(joints, position, half_smoothing * sigma, 1);
  regressors.rightCols(1) = smooth(joints, speed.cwiseAbs2(), sigma, 0);
}

// 1, cos, sin, acceleration and squared speed of the moving joint; then, as far as the stretch is long enough to tell
// them apart, what the others yield under its load: their positions and accelerations, each times 1, cos and sin.
SamplesX single_joint_regressors(const UniformStream& joints, IndexRange rows, Index joint, Eigen::VectorXd others,
                                 double cutoff) {
  constexpr Index each = 6;
  const double sigma = gaussian_sigma(cutoff);
  UniformStream piece;
  piece.period = joints.period;
  piece.spans = {{0, rows.size()}};
  const SamplesX angle = joints.values.block(rows.begin, joint, rows.size(), 1);
  SamplesX harmonics(rows.size(), 3);
  harmonics.col(0).setOnes();
  harmonics.col(1) = angle.array().cos();
  harmonics.col(2) = angle.array().sin();
  const double independent = 2.0 * cutoff * joints.period * static_cast<double>(rows.size());
  const auto affordable = static_cast<Index>(independent / (spare_per_regressor * static_cast<double>(each)));
  const Index yielding = std::min(affordable, static_cast<Index>((others.array() > 0.0).count()));
  SamplesX regressors(rows.size(), own_regressors + each * yielding);
  regressors.leftCols(3) = smooth(piece, harmonics, sigma, 0);
  SamplesX dynamics(rows.size(), 2);
  add_dynamics(piece, angle, sigma, dynamics);
  regressors.middleCols(3, 2) = dynamics;
  for (Index k = 0; k < yielding; ++k) {
    Index other = 0;
    others.maxCoeff(&other);
    others(other) = 0.0;
    SamplesX position = joints.values.block(rows.begin, other, rows.size(), 1);
    position.array() -= position.mean();
    const SamplesX acceleration = smooth(piece, position, half_smoothing * sigma, 2);
    SamplesX products(rows.size(), each);
    products.leftCols(3) = harmonics.array().colwise() * position.col(0).array();
    products.rightCols(3) = harmonics.array().colwise() * acceleration.col(0).array();
    regressors.middleCols(own_regressors + each * k, each) = smooth(piece, products, sigma, 0);
  }
  return regressors;
}

}  // namespace

std::vector<MotionModel> single_joint_stretches(const UniformStream& joints, const ClockAlignmentOptions& options) {
  const std::vector<Index> state = who_moves(joints, options);
  std::vector<MotionModel> stretches;
  for (const auto& [joint, moving] : runs(joints, state, [](Index a, Index b) { return a == b; })) {
    if (joint == several) {
      continue;
    }
    const Eigen::VectorXd range = travel(joints, moving);
    Eigen::VectorXd others = range;
    others(joint) = 0.0;
    if (range(joint) >= options.min_travel && others.maxCoeff() <= options.others_ratio * range(joint)) {
      const IndexRange rows = with_rest(joints, state, moving);
      SamplesX regressors = single_joint_regressors(joints, rows, joint, others, options.cutoff);
      const double squared_frequency = regressors.col(3).squaredNorm() / std::max(1e-12, regressors.col(4).sum());
      stretches.push_back({joint, rows, moving, std::move(regressors), squared_frequency});
    }
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
    stretches.push_back({-1, rows, moving, std::move(regressors), 0.0});
  }
  return stretches;
}

}  // namespace circlepoint::detail
