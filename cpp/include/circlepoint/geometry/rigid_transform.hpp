#pragma once
// Rigid transforms and rotations.
//
// T_a_b maps b-coordinates to a:  p_a = T_a_b p_b.  Rotations are matrices; rotation vectors appear only as
// increments. The exponential maps are exact to rounding for every angle, zero included (Taylor series below 1e-4).

#include <Eigen/Geometry>

namespace circlepoint {

using RigidTransform = Eigen::Isometry3d;

/// Rigid transform from a homogeneous 4x4 matrix. Raises InvalidInput when an entry is not finite, the last row is not
/// (0, 0, 0, 1), or the rotation part is not a proper rotation to within `tolerance` (largest entry of R R^T - I).
RigidTransform make_rigid_transform(const Eigen::Matrix4d& matrix, double tolerance = 1e-9);

/// Skew-symmetric matrix of v: skew(v) u = v x u.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation matrix of a rotation vector (axis times angle, rad).
Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& rotation_vector);

/// Rotation vector (rad, norm at most pi) of a proper rotation matrix.
Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);

/// Two unit vectors (columns) that complete the unit vector z to a right-handed frame [u v z].
/// The choice is the project-wide basis of every tangent-plane coordinate: u is the part of e_x orthogonal to z, or of
/// e_y where |z . e_x| > 0.9; v = z x u.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& z);

}  // namespace circlepoint
