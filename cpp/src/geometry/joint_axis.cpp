#include "circlepoint/geometry/joint_axis.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

double principal_std(const Eigen::Matrix2d& covariance) {
  if (!covariance.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
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
  if (std::abs(cosine) < 1e-12) {
    throw InvalidInput("local coordinates of a line at right angles to the one they are taken at (cosine " +
                       std::to_string(cosine) + "); take them at a nearer line");
  }
  const double angle = std::atan2(sine, cosine);
  const Eigen::Vector3d rotation =
      sine > 1e-300 ? Eigen::Vector3d(cross * (angle / sine))
                    : Eigen::Vector3d(cosine > 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(angle * basis.col(1)));
  // The point of `other` in the plane through line.point spanned by the basis, which is where retract starts from.
  const double along = line.direction.dot(line.point - other.point) / cosine;
  const Eigen::Vector3d point = other.point + along * other.direction;
  Eigen::Vector4d local;
  local << basis.transpose() * rotation.cross(line.direction), basis.transpose() * (point - line.point);
  return local;
}

Eigen::Matrix4d local_coordinates_jacobian(const RigidTransform& T_a_b, const ScrewAxis& axis_b) {
  const Eigen::Vector3d z_a = T_a_b.linear() * axis_b.line.direction;
  const Eigen::Matrix2d turn =
      tangent_basis(z_a).transpose() * T_a_b.linear() * tangent_basis(axis_b.line.direction);
  Eigen::Matrix4d jacobian = Eigen::Matrix4d::Zero();
  jacobian.topLeftCorner<2, 2>() = turn;
  if (axis_b.type == JointType::revolute) {
    jacobian.bottomLeftCorner<2, 2>() = -z_a.dot(T_a_b.translation()) * turn;
    jacobian.bottomRightCorner<2, 2>() = turn;
  }
  return jacobian;
}

JointAxis transform(const RigidTransform& T_a_b, const JointAxis& axis_b) {
  const Eigen::Matrix4d jacobian = local_coordinates_jacobian(T_a_b, axis_b.screw);
  return {transform(T_a_b, axis_b.screw), jacobian * axis_b.covariance * jacobian.transpose()};
}

}  // namespace circlepoint
