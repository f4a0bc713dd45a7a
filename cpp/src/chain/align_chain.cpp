#include "circlepoint/chain/align_chain.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "circlepoint/chain/align_lines.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

struct Placement {
  RigidTransform T_target_source = RigidTransform::Identity();
  Eigen::VectorXd offsets;

  /// Moved by (rotation, translation, offsets of the joints but the first and the last).
  [[nodiscard]] Placement moved(const Eigen::VectorXd& step) const {
    Placement result = *this;
    result.T_target_source.linear() = rotation_exp(step.head<3>()) * T_target_source.linear();
    result.T_target_source.translation() += step.segment<3>(3);
    result.offsets.segment(1, step.size() - 6) += step.tail(step.size() - 6);
    return result;
  }
};

/// Six numbers an axis: length-weighted difference of directions, then the gap at the target's point.
Eigen::VectorXd residual_of(const ScrewChain& target, const ScrewChain& source, const Placement& at, double length) {
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(6 * target.size());
  RigidTransform before = at.T_target_source;
  for (Index i = 0; i < target.size(); ++i) {
    const ScrewAxis& goal = target.axes[static_cast<std::size_t>(i)];
    const ScrewAxis& axis = source.axes[static_cast<std::size_t>(i)];
    const Line line = transform(before, axis.line);
    residual.segment<3>(6 * i) = length * (line.direction - goal.line.direction);
    if (goal.type == JointType::revolute) {
      const Eigen::Vector3d gap = line.point - goal.line.point;
      residual.segment<3>(6 * i + 3) = gap - line.direction.dot(gap) * line.direction;
    }
    before = before * screw_exp(axis, at.offsets[i]);
  }
  return residual;
}

Placement start(const ScrewChain& target, const ScrewChain& source) {
  std::vector<Line> goals;
  std::vector<Line> lines;
  for (std::size_t i = 0; i < target.axes.size(); ++i) {
    goals.push_back(make_line(target.axes[i].line.direction, Eigen::Vector3d::Zero()));
    lines.push_back(make_line(source.axes[i].line.direction, Eigen::Vector3d::Zero()));
  }
  Placement result;
  result.T_target_source.linear() = align_lines(goals, lines).linear();
  result.offsets = Eigen::VectorXd::Zero(target.size());
  return result;
}

void require_comparable(const ScrewChain& target, const ScrewChain& source, double length) {
  require(target.size() > 0 && target.size() == source.size(),
          "align_chain got " + std::to_string(target.size()) + " target and " + std::to_string(source.size()) +
              " source joints; give chains of the same joints, at least one");
  require(length > 0.0, "length is " + std::to_string(length) + " m; give a positive length");
  for (std::size_t i = 0; i < target.axes.size(); ++i) {
    require(target.axes[i].type == source.axes[i].type,
            "joint " + std::to_string(i) + " (from 0) is of another type in the source chain; the types must agree");
  }
  const Index n = target.size();
  require(target.reference_configuration.size() == n && source.reference_configuration.size() == n &&
              (target.reference_configuration - source.reference_configuration).cwiseAbs().maxCoeff() < 1e-9,
          "the chains have different reference configurations; rebase one to the other's");
}

}  // namespace

ChainAlignment align_chain(const ScrewChain& target, const ScrewChain& source, double length) {
  require_comparable(target, source, length);
  const Index n = target.size();
  const Index unknowns = 6 + std::max<Index>(n - 2, 0);
  constexpr double nudge = 1e-6;
  constexpr int max_iterations = 100;
  ChainAlignment result;
  Placement at = start(target, source);
  for (int iteration = 0; iteration < max_iterations && !result.converged; ++iteration) {
    Eigen::MatrixXd jacobian(6 * n, unknowns);
    for (Index k = 0; k < unknowns; ++k) {
      const Eigen::VectorXd step = nudge * Eigen::VectorXd::Unit(unknowns, k);
      jacobian.col(k) =
          (residual_of(target, source, at.moved(step), length) - residual_of(target, source, at.moved(-step), length)) /
          (2.0 * nudge);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-4);  // what the lines see by less than this is a choice, not a measurement
    solver.compute(jacobian);
    const Eigen::VectorXd step = -solver.solve(residual_of(target, source, at, length));
    at = at.moved(step);
    result.converged = step.norm() < 1e-11;
  }
  result.T_target_source = at.T_target_source;
  result.joint_offsets = at.offsets;
  const Eigen::VectorXd residual = residual_of(target, source, at, 1.0);
  double distance = 0.0;
  double direction = 0.0;
  Index revolute = 0;
  for (Index i = 0; i < n; ++i) {
    direction += residual.segment<3>(6 * i).squaredNorm();
    distance += residual.segment<3>(6 * i + 3).squaredNorm();
    revolute += target.axes[static_cast<std::size_t>(i)].type == JointType::revolute ? 1 : 0;
  }
  result.direction_rms = std::sqrt(direction / static_cast<double>(n));
  result.distance_rms = revolute > 0 ? std::sqrt(distance / static_cast<double>(revolute)) : 0.0;
  return result;
}

}  // namespace circlepoint
