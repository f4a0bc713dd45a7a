#pragma once
// An estimated joint axis: a line and the covariance of its four degrees of freedom.
//
// The local coordinates of a line (direction z, nearest point c) are (d1, d2, p1, p2) in the basis [u v] =
// tangent_basis(z):  z' = z + d1 u + d2 v to first order (a rotation of z, exactly), and
// the displaced line passes through c + p1 u + p2 v. d in rad, p in m. Prismatic axes use d only (their p rows and columns
// are zero). The chart covers every line but those at right angles to z.

#include <Eigen/Core>

#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

struct JointAxis {
  ScrewAxis screw;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (d1, d2, p1, p2): rad^2, rad m, m^2; infinite: nothing is known

  /// Standard deviation of the direction, rad (the larger principal one).
  [[nodiscard]] double direction_std() const;
  /// Standard deviation of the nearest point, m (the larger principal one).
  [[nodiscard]] double point_std() const;
};

/// The line displaced by local coordinates (d1, d2, p1, p2).
Line retract(const Line& line, const Eigen::Vector4d& local);

/// Local coordinates of `other` at `line`: retract(line, local_coordinates(line, other)) == other. Raises InvalidInput
/// for lines at right angles.
Eigen::Vector4d local_coordinates(const Line& line, const Line& other);

/// Derivative of the local coordinates in a-coordinates by those in b-coordinates, at the axis:
/// d_a = Q d_b and p_a = Q (p_b - (z_a . t) d_b), with t the translation of T_a_b and Q the 2x2 rotation between the two
/// tangent bases. Rows and columns p of a prismatic axis are zero.
Eigen::Matrix4d local_coordinates_jacobian(const RigidTransform& T_a_b, const ScrewAxis& axis_b);

/// The axis and its covariance given in b-coordinates, in a-coordinates.
JointAxis transform(const RigidTransform& T_a_b, const JointAxis& axis_b);

}  // namespace circlepoint
