#include "circlepoint/geometry/rigid_transform.hpp"

#include <cmath>

namespace circlepoint {

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
