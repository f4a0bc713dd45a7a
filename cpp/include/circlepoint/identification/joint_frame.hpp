#pragma once
// The frame O_w of a joint (paper, section 2.1): z_w along the joint axis, x_w the part of the sensor's x axis orthogonal to
// it (of the sensor's y axis where x is nearly parallel to it), y_w = z_w x x_w. Eq. (1): R_a = [x_w y_w z_w].

#include <Eigen/Core>

namespace circlepoint {

/// R_sensor_joint, (3, 3): its columns are x_w, y_w, z_w in the sensor frame. Raises InvalidInput for a zero direction.
Eigen::Matrix3d joint_frame(const Eigen::Vector3d& axis_direction);

}  // namespace circlepoint
