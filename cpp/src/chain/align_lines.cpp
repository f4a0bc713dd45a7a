#include "circlepoint/chain/align_lines.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/joint_axis.hpp"

namespace circlepoint {
namespace {

// Rotation that turns the source directions onto the target's; products of pairs fix what parallel sums would leave.
Eigen::Matrix3d fit_rotation(const std::vector<Line>& target, const std::vector<Line>& source) {
  if (target.size() == 1) {
    return Eigen::Quaterniond::FromTwoVectors(source[0].direction, target[0].direction).toRotationMatrix();
  }
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) {
    moment += target[i].direction * source[i].direction.transpose();
    for (std::size_t j = 0; j < i; ++j) {
      moment += target[i].direction.cross(target[j].direction) * source[i].direction.cross(source[j].direction).transpose();
    }
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Eigen::VectorXd residual_of(const std::vector<Line>& target, const std::vector<Line>& source, const RigidTransform& pose,
                            double length, const std::vector<JointType>& types) {
  Eigen::VectorXd residual(4 * static_cast<Index>(target.size()));
  for (std::size_t i = 0; i < target.size(); ++i) {
    Eigen::Vector4d local = local_coordinates(target[i], transform(pose, source[i]));
    local.head<2>() *= length;
    if (!types.empty() && types[i] == JointType::prismatic) {
      local.tail<2>().setZero();
    }
    residual.segment<4>(4 * static_cast<Index>(i)) = local;
  }
  return residual;
}

RigidTransform displaced(const RigidTransform& pose, const Eigen::Matrix<double, 6, 1>& step) {
  RigidTransform moved = pose;
  moved.linear() = rotation_exp(step.head<3>()) * pose.linear();
  moved.translation() += step.tail<3>();
  return moved;
}

}  // namespace

RigidTransform align_lines(const std::vector<Line>& target, const std::vector<Line>& source, double length,
                           const std::vector<JointType>& types) {
  require(!target.empty() && target.size() == source.size(),
          "align_lines got " + std::to_string(target.size()) + " target and " + std::to_string(source.size()) +
              " source lines; give one source line for each target line, at least one");
  require(types.empty() || types.size() == target.size(), "align_lines got " + std::to_string(types.size()) + " joint types for " +
                                                              std::to_string(target.size()) + " lines; give one a line, or none");
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = fit_rotation(target, source);
  constexpr double step = 1e-6;
  constexpr int max_iterations = 50;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::MatrixXd jacobian(4 * static_cast<Index>(target.size()), 6);
    for (int k = 0; k < 6; ++k) {
      const Eigen::Matrix<double, 6, 1> nudge = step * Eigen::Matrix<double, 6, 1>::Unit(k);
      jacobian.col(k) = (residual_of(target, source, displaced(pose, nudge), length, types) -
                         residual_of(target, source, displaced(pose, -nudge), length, types)) /
                        (2.0 * step);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-7);
    solver.compute(jacobian);
    const Eigen::Matrix<double, 6, 1> move = -solver.solve(residual_of(target, source, pose, length, types));
    pose = displaced(pose, move);
    if (move.norm() < 1e-12) {
      break;
    }
  }
  return pose;
}

}  // namespace circlepoint
