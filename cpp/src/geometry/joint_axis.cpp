#include "circlepoint/geometry/joint_axis.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace circlepoint {
namespace {

double principal_std(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace

double JointAxis::direction_std() const { return principal_std(covariance.topLeftCorner<2, 2>()); }

double JointAxis::point_std() const { return principal_std(covariance.bottomRightCorner<2, 2>()); }

Line retract(const Line& line, const Eigen::Vector4d& local) {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(line.direction);
  const Eigen::Vector3d shift = basis * local.head<2>();
  const Eigen::Vector3d direction = rotation_exp(line.direction.cross(shift)) * line.direction;
  return make_line(direction, line.point + basis * local.tail<2>());
}

Eigen::Vector4d local_coordinates(const Line& line, const Line& other) {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(line.direction);
  const Eigen::Vector3d cross = line.direction.cross(other.direction);
  const double sine = cross.norm();
  const double cosine = line.direction.dot(other.direction);
  const double angle = std::atan2(sine, cosine);
  const Eigen::Vector3d rotation =
      sine > 1e-300 ? Eigen::Vector3d(cross * (angle / sine))
                    : Eigen::Vector3d(cosine > 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(angle * basis.col(1)));
  // The point of `other` in the plane through line.point spanned by the basis, which is where retract starts from.
  const double along = line.direction.dot(line.point - other.point) / line.direction.dot(other.direction);
  const Eigen::Vector3d point = other.point + along * other.direction;
  Eigen::Vector4d local;
  local << basis.transpose() * rotation.cross(line.direction), basis.transpose() * (point - line.point);
  return local;
}

JointAxis transform(const RigidTransform& T_a_b, const JointAxis& axis_b) {
  JointAxis axis_a;
  axis_a.screw = transform(T_a_b, axis_b.screw);
  Eigen::Matrix4d jacobian;
  constexpr double step = 1e-6;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector4d nudge = step * Eigen::Vector4d::Unit(k);
    const Line plus = transform(T_a_b, retract(axis_b.screw.line, nudge));
    const Line minus = transform(T_a_b, retract(axis_b.screw.line, -nudge));
    jacobian.col(k) = (local_coordinates(axis_a.screw.line, plus) - local_coordinates(axis_a.screw.line, minus)) / (2.0 * step);
  }
  axis_a.covariance = jacobian * axis_b.covariance * jacobian.transpose();
  return axis_a;
}

}  // namespace circlepoint
