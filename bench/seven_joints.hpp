#pragma once
// The arm that is timed.

#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

inline constexpr Index joints = 7;

// Revolute joints, neighbouring axes across one another, 0.15 m apart.
inline ScrewChain seven_joints() {
  ScrewChain chain;
  for (Index i = 0; i < joints; ++i) {
    const double height = 0.15 * static_cast<double>(i - joints);
    const Eigen::Vector3d direction = i % 2 == 0 ? Eigen::Vector3d(0.1, 0.2, 1.0) : Eigen::Vector3d(0.2, 1.0, -0.1);
    chain.axes.push_back({JointType::revolute, make_line(direction.normalized(), {0.05, 0.1, height})});
  }
  chain.reference_configuration = Eigen::VectorXd::Zero(joints);
  return chain;
}

}  // namespace circlepoint
