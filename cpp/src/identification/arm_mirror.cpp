#include "arm_mirror.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "arm_solve.hpp"

namespace circlepoint {
namespace {

constexpr double short_travel = 1.2;    // rad: over more, no other line fits by half
constexpr double least_turn = 0.02;     // rad between the two, below which they are one
constexpr double same = 6.0;            // standard deviations between two that are one
constexpr double told_apart = 16.0;     // by which the misfit must be larger: four standard deviations
constexpr int enough_to_tell = 15;      // iterations, whether there is another minimum
constexpr double hopeless = 10.0;       // times the sum of squares, with the noise as it is

// (n) The mean of the joints' positions while the joint moves.
Eigen::VectorXd where_it_moves(const ArmRows& rows, Index joint, const Eigen::VectorXd& otherwise) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(otherwise.size());
  double weight = 0.0;
  for (const MovingStretch& stretch : rows.stretches) {
    const double squares = stretch.velocity.col(joint).squaredNorm();
    mean += squares * stretch.position.colwise().mean().transpose();
    weight += squares;
  }
  return weight > 0.0 ? Eigen::VectorXd(mean / weight) : otherwise;
}

// Mirrored at the horizontal plane where the joint moves; with the point that leaves the acceleration at the sensor least changed.
Line mirrored(const ArmState& state, Index joint, const Eigen::VectorXd& position) {
  Eigen::Vector3d up = state.up_gravity.normalized();
  for (Index k = 0; k < joint; ++k) {
    const ScrewAxis& axis = state.axes[static_cast<std::size_t>(k)];
    if (axis.type == JointType::revolute) {
      up = Eigen::AngleAxisd(state.reference[k] - position[k], axis.line.direction) * up;
    }
  }
  const Line& line = state.axes[static_cast<std::size_t>(joint)].line;
  const Eigen::Vector3d moment = line.direction.cross(line.point);
  const Eigen::Vector3d direction = (line.direction - 2.0 * line.direction.dot(up) * up).normalized();
  return {direction, moment.cross(direction)};
}

// Of directions, 2 where they are opposite: an axis along gravity is its mirror image reversed.
double apart(const Line& one, const Line& other) { return (one.direction - other.direction).norm(); }

// From the joint's mirrored line; nothing where that leads back or explains far less.
std::optional<ArmFit> mirrored_fit(const ArmFit& fit, const ArmProblem& fresh, std::size_t i, const std::vector<bool>& moves,
                                   const WholeArmOptions& options) {
  const Line& before = fit.state.axes[i].line;
  ArmState start = fit.state;
  const auto joint = static_cast<Index>(i);
  start.axes[i].line = mirrored(fit.state, joint, where_it_moves(fit.problem.rows, joint, fit.state.reference));
  if (apart(start.axes[i].line, before) < least_turn) {
    return std::nullopt;
  }
  const ArmSolution first = solve(fit.problem, start, enough_to_tell);
  if (apart(first.state.axes[i].line, before) < least_turn || first.cost > hopeless * fit.data.cost) {
    return std::nullopt;
  }
  ArmFit rival{fresh, first.state};
  rival.problem.layout = fit.problem.layout;  // encoders' errors that were found have columns for both
  rival.problem.prior = fit.problem.prior;
  settle(rival, moves, options);
  const double std = std::sqrt(rival.covariance.diagonal().segment<2>(rival.problem.layout.lines[i]).maxCoeff());
  if (apart(rival.state.axes[i].line, before) < std::max(least_turn, same * std)) {
    return std::nullopt;
  }
  return rival;
}

// Puts the first better rival in the fit's place; whether there was one. `ambiguous` of those that are about as good.
bool improve(ArmFit& fit, const ArmProblem& fresh, const std::vector<std::size_t>& candidates, const std::vector<bool>& moves,
             const WholeArmOptions& options, std::vector<bool>& ambiguous) {
  ambiguous.assign(fit.state.axes.size(), false);
  for (const std::size_t i : candidates) {
    std::optional<ArmFit> rival = mirrored_fit(fit, fresh, i, moves, options);
    if (!rival) {
      continue;
    }
    fit.iterations += rival->iterations;
    const double worse = misfit(*rival) - misfit(fit);
    if (worse < 0.0) {
      rival->iterations = fit.iterations;
      fit = std::move(*rival);
      return true;
    }
    ambiguous[i] = worse < told_apart;
  }
  return false;
}

}  // namespace

std::vector<bool> settle_among_mirrored(ArmFit& fit, const std::vector<bool>& moves, const WholeArmOptions& options) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < fit.state.axes.size() && fit.problem.layout.points; ++i) {
    if (fit.problem.layout.lines[i] >= 0 && fit.state.axes[i].type == JointType::revolute &&
        travel(fit.problem.rows, static_cast<Index>(i)) < short_travel) {
      candidates.push_back(i);
    }
  }
  const ArmProblem fresh = candidates.empty() ? ArmProblem{} : fit.problem;
  settle(fit, moves, options);
  std::vector<bool> ambiguous;
  std::size_t better = 0;  // after each, the others' rivals were another fit's
  while (improve(fit, fresh, candidates, moves, options, ambiguous) && better < candidates.size()) {
    ++better;
  }
  return ambiguous;
}

}  // namespace circlepoint
