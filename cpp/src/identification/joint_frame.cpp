#include "circlepoint/identification/joint_frame.hpp"

#include "circlepoint/geometry/line.hpp"

namespace circlepoint {

Eigen::Matrix3d joint_frame(const Eigen::Vector3d& axis_direction) {
  const Eigen::Vector3d z = make_line(axis_direction, Eigen::Vector3d::Zero()).direction;
  Eigen::Matrix3d R_sensor_joint;
  R_sensor_joint << tangent_basis(z), z;
  return R_sensor_joint;
}

}  // namespace circlepoint
