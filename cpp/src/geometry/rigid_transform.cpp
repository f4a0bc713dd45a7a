#include "circlepoint/geometry/rigid_transform.hpp"

#include <cmath>
#include <sstream>

#include "circlepoint/core/error.hpp"

namespace circlepoint {

RigidTransform make_rigid_transform(const Eigen::Matrix4d& matrix, double tolerance) {
  require(matrix.allFinite(), "rigid transform has an entry that is not finite; give a finite 4x4 matrix");
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double last_row = (matrix.row(3) - Eigen::RowVector4d::UnitW()).cwiseAbs().maxCoeff();
  const double orthogonality = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = rotation.determinant();
  if (last_row > tolerance || orthogonality > tolerance || determinant < 0.0) {
    std::ostringstream message;
    message << "not a rigid transform: last row is off (0, 0, 0, 1) by " << last_row
            << ", rotation part off orthogonality by " << orthogonality << " with determinant " << determinant
            << " (tolerance " << tolerance << "); give [[R, p], [0, 1]] with a proper rotation R";
    throw InvalidInput(message.str());
  }
  RigidTransform transform;
  transform.matrix() = matrix;
  transform.makeAffine();
  return transform;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& rotation_vector) {
  const double angle_squared = rotation_vector.squaredNorm();
  const double angle = std::sqrt(angle_squared);
  const bool small = angle < 1e-4;
  const double a = small ? 1.0 - angle_squared / 6.0 : std::sin(angle) / angle;
  const double half_sine = std::sin(0.5 * angle);
  const double b = small ? 0.5 - angle_squared / 24.0 : 2.0 * half_sine * half_sine / angle_squared;
  const Eigen::Matrix3d k = skew(rotation_vector);
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  // By way of the quaternion, which is well conditioned at every angle including pi.
  Eigen::Quaterniond quaternion(rotation);
  quaternion.normalize();
  if (quaternion.w() < 0.0) {
    quaternion.coeffs() = -quaternion.coeffs();
  }
  const double sine = quaternion.vec().norm();
  const double factor = sine < 1e-8 ? 2.0 / quaternion.w() : 2.0 * std::atan2(sine, quaternion.w()) / sine;
  return factor * quaternion.vec();
}

Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& z) {
  const Eigen::Vector3d seed = std::abs(z.x()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = (seed - seed.dot(z) * z).normalized();
  basis.col(1) = z.cross(basis.col(0));
  return basis;
}

}  // namespace circlepoint
