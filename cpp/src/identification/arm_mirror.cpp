#include "arm_mirror.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace circlepoint {
namespace {

constexpr double short_travel = 1.2;    // rad: over more, no other line fits by half
constexpr double least_turn = 0.02;     // rad between the two, below which they are one
constexpr double same = 6.0;            // standard deviations between two that are one
constexpr double told_apart = 16.0;     // by which the sum of squares must be larger: four standard deviations
constexpr int most_iterations = 30;

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

double travel(const ArmRows& rows, Index joint) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  const auto see = [&](double low, double high) {
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
  };
  for (const MovingStretch& stretch : rows.stretches) {
    see(stretch.position.col(joint).minCoeff(), stretch.position.col(joint).maxCoeff());
  }
  for (const DwellRow& dwell : rows.dwells) {
    see(dwell.position[joint], dwell.position[joint]);
  }
  return highest - lowest;
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

}  // namespace

MirrorSearch search_mirrored(const ArmProblem& problem, const ArmState& state, const Eigen::MatrixXd& covariance, double cost,
                             const std::vector<bool>& already) {
  MirrorSearch search;
  search.ambiguous.assign(state.axes.size(), false);
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    const Index column = problem.layout.lines[i];
    if (column < 0 || state.axes[i].type != JointType::revolute) {
      continue;
    }
    const double std = std::sqrt(covariance.diagonal().segment<2>(column).maxCoeff());
    const auto joint = static_cast<Index>(i);
    ArmState start = state;
    start.axes[i].line = mirrored(state, joint, where_it_moves(problem.rows, joint, state.reference));
    const Eigen::Vector3d& direction = state.axes[i].line.direction;
    const auto apart = [&](const Line& line) { return direction.cross(line.direction).norm() > std::max(least_turn, same * std); };
    if (travel(problem.rows, joint) > short_travel || !apart(start.axes[i].line)) {
      continue;
    }
    ArmSolution other = solve(problem, start, most_iterations);
    if (!other.converged || !apart(other.state.axes[i].line)) {
      continue;
    }
    if (!already[i] && other.cost < (search.better ? search.better->cost : cost)) {
      search.better = std::move(other);
      search.joint = i;
    } else {
      search.ambiguous[i] = other.cost < cost + told_apart;
    }
  }
  return search;
}

}  // namespace circlepoint
