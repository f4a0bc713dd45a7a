#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

Eigen::Matrix<double, 6, 1> ScrewAxis::twist() const {
  Eigen::Matrix<double, 6, 1> xi;
  if (type == JointType::revolute) {
    xi << line.direction, line.moment();
  } else {
    xi << Eigen::Vector3d::Zero(), line.direction;
  }
  return xi;
}

RigidTransform screw_exp(const ScrewAxis& axis, double q) {
  RigidTransform motion = RigidTransform::Identity();
  if (axis.type == JointType::revolute) {
    motion.linear() = Eigen::AngleAxisd(q, axis.line.direction).toRotationMatrix();
    motion.translation() = axis.line.point - motion.linear() * axis.line.point;
  } else {
    motion.translation() = q * axis.line.direction;
  }
  return motion;
}

ScrewAxis transform(const RigidTransform& T_a_b, const ScrewAxis& axis_b) {
  return {axis_b.type, transform(T_a_b, axis_b.line)};
}

}  // namespace circlepoint
