#include "arm_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "arm_solve.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr Index rows_for_starting = 600;
constexpr double noise = 0.3;           // m/s^2, by which all is weighted
constexpr double explained = 0.15;      // m/s^2 rms: what bias and vibration may leave of the right arm, and
constexpr double explained_share = 0.02;  // of what the readings vary by
constexpr int enough_repeats = 3;       // of the smallest cost
constexpr int many_repeats = 12;        // where it explains little

// Every k-th row of every stretch and all dwells (at most as many), weighted alike.
ArmRows thin(const ArmRows& rows) {
  ArmRows thinned = rows;
  thinned.stretches.clear();
  Index total = 0;
  for (const MovingStretch& stretch : rows.stretches) {
    total += stretch.rows();
  }
  const Index step = std::max<Index>(1, total / rows_for_starting);
  Index offset = 0;
  for (const MovingStretch& stretch : rows.stretches) {
    std::vector<Index> keep;
    for (Index i = offset; i < stretch.rows(); i += step) {
      keep.push_back(i);
    }
    offset = keep.empty() ? offset - stretch.rows() : keep.back() + step - stretch.rows();
    if (keep.empty()) {
      continue;
    }
    thinned.stretches.push_back(picked(stretch, keep));
  }
  const std::size_t dwell_step = std::max<std::size_t>(1, rows.dwells.size() / 100);
  thinned.dwells.clear();
  for (std::size_t i = 0; i < rows.dwells.size(); i += dwell_step) {
    thinned.dwells.push_back(rows.dwells[i]);
  }
  return thinned;
}

// m/s^2, standard deviation of the rows' readings.
double variation(const ArmRows& rows) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double squares = 0.0;
  Index count = 0;
  const auto add = [&](const auto& readings) {
    sum += readings.colwise().sum();
    squares += readings.squaredNorm();
    count += readings.rows();
  };
  for (const MovingStretch& stretch : rows.stretches) {
    add(stretch.reading.leftCols<3>());
  }
  for (const DwellRow& dwell : rows.dwells) {
    add(dwell.reading.head<3>().transpose());
  }
  const double all = std::max(1.0, static_cast<double>(count));
  return std::sqrt(std::max(0.0, (squares - sum.squaredNorm() / all) / (3.0 * all)));
}

Eigen::Vector3d random_direction(RandomSource& random) {
  const Eigen::Vector3d v(random.normal(), random.normal(), random.normal());
  return v.normalized();
}

}  // namespace

ArmStart find_start(const ArmProblem& problem, const ArmState& known_state, const std::vector<bool>& known,
                    const std::vector<bool>& moves, int random_starts, std::uint64_t seed) {
  ArmStart best;
  best.state = known_state;
  std::vector<std::size_t> unknown;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i] && !known[i]) {
      unknown.push_back(i);
    }
  }
  if (unknown.empty()) {
    best.found = true;
    return best;
  }
  ArmProblem small;
  small.rows = thin(problem.rows);
  small.prior.gravity = problem.prior.gravity;
  small.prior.gravity_std = 0.1;
  small.noise = white_noise(small.rows, noise, noise, 0.1 * noise);
  small.offsets = Eigen::VectorXd::Zero(small.rows.offset_covariance.rows());
  small.threads = problem.threads;
  small.layout.points = problem.layout.points;
  small.layout.claim_lines(known_state.axes, moves);
  small.layout.up_gravity = small.layout.claim(3);

  double best_cost = std::numeric_limits<double>::infinity();
  int repeats = 0;
  const double rms = std::min(explained, explained_share * variation(small.rows));
  const double well = std::pow(rms / noise, 2) * static_cast<double>(small.rows.equations());
  for (int trial = 0; trial < random_starts && repeats < (best_cost < well ? enough_repeats : many_repeats); ++trial) {
    RandomSource random(derive_seed(seed, static_cast<std::uint64_t>(trial)));
    ArmState start = known_state;
    for (const std::size_t joint : unknown) {
      start.axes[joint].line = Line{random_direction(random), Eigen::Vector3d::Zero()};
    }
    if (start.up_gravity.norm() < 1.0) {
      start.up_gravity = problem.prior.gravity * random_direction(random);
    }
    ArmSolution solution = solve(small, start, 60);
    ++best.tried;
    if (!std::isfinite(solution.cost)) {
      continue;
    }
    if (solution.cost < 0.98 * best_cost) {
      best_cost = solution.cost;
      best.state = solution.state;
      repeats = 1;
    } else if (solution.cost < 1.02 * best_cost) {
      ++repeats;
    }
  }
  best.found = repeats > 1;
  return best;
}

}  // namespace circlepoint
