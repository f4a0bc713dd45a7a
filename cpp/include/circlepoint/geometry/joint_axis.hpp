#pragma once
// An estimated joint axis: a line and the covariance of its four degrees of freedom.
//
// The local coordinates of a line (direction z, nearest point c) are (d1, d2, p1, p2) in the basis [u v] =
// tangent_basis(z):  z' = z + d1 u + d2 v to first order (a rotation of z, exactly), and
// c' = c + p1 u + p2 v (then made orthogonal to z' again). d in rad, p in m. Prismatic axes use d only (p rows are zero).

#include <Eigen/Core>

#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

struct JointAxis {
  ScrewAxis screw;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (d1, d2, p1, p2): rad^2, rad m, m^2

  /// Standard deviation of the direction, rad (the larger principal one).
  [[nodiscard]] double direction_std() const;
  /// Standard deviation of the nearest point, m (the larger principal one).
  [[nodiscard]] double point_std() const;
};

/// The line displaced by local coordinates (d1, d2, p1, p2).
Line retract(const Line& line, const Eigen::Vector4d& local);

/// Local coordinates of `other` at `line`: retract(line, local_coordinates(line, other)) == other.
Eigen::Vector4d local_coordinates(const Line& line, const Line& other);

/// The axis and its covariance given in b-coordinates, in a-coordinates.
JointAxis transform(const RigidTransform& T_a_b, const JointAxis& axis_b);

}  // namespace circlepoint
