#pragma once
// A serial chain as a product of exponentials: T_base_sensor(q) = exp(xi_1 (q_1 - r_1)) ... exp(xi_n (q_n - r_n)) home.
//
// In a calibration result the base frame B is the sensor frame S at the reference configuration r, so home is the
// identity and every axis is a line in the sensor frame (docs/method, section 3).

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

/// Pose of the sensor frame and its time derivatives.
struct FrameMotion {
  RigidTransform T_base_sensor = RigidTransform::Identity();
  Eigen::Vector3d angular_velocity_sensor = Eigen::Vector3d::Zero();      ///< rad/s, in the sensor frame
  Eigen::Vector3d angular_acceleration_sensor = Eigen::Vector3d::Zero();  ///< rad/s^2, in the sensor frame
  Eigen::Vector3d velocity_base = Eigen::Vector3d::Zero();                ///< m/s, of the sensor origin, in the base frame
  Eigen::Vector3d acceleration_base = Eigen::Vector3d::Zero();            ///< m/s^2, of the sensor origin, in the base frame
};

struct ScrewChain {
  std::vector<ScrewAxis> axes;              ///< base to tip, in the base frame at the reference configuration
  Eigen::VectorXd reference_configuration;  ///< (n) rad or m
  RigidTransform home = RigidTransform::Identity();  ///< T_base_sensor at the reference configuration

  [[nodiscard]] Index size() const { return static_cast<Index>(axes.size()); }
};

/// Pose of the sensor frame. Raises InvalidInput when the size of q is not the number of joints.
RigidTransform forward_kinematics(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q);

/// Poses of many configurations, (N, n) -> (N, 16): one row-major 4x4 matrix a row.
SamplesX forward_kinematics_rows(const ScrewChain& chain, const Eigen::Ref<const SamplesX>& q);

/// Pose, velocity and acceleration of the sensor frame.
FrameMotion frame_motion(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::Ref<const Eigen::VectorXd>& q_dot, const Eigen::Ref<const Eigen::VectorXd>& q_ddot);

/// Specific force at the sensor origin, m/s^2, in the sensor frame: R_S_B (p_ddot + up_gravity_base), where
/// up_gravity_base = -g is what an ideal sensor at rest reads in base coordinates.
Eigen::Vector3d specific_force(const FrameMotion& motion, const Eigen::Vector3d& up_gravity_base);

/// The axis of one joint in the sensor frame at configuration q: it depends only on the joints beyond it.
ScrewAxis axis_in_sensor_frame(const ScrewChain& chain, Index joint, const Eigen::Ref<const Eigen::VectorXd>& q);

/// The same chain described at another reference configuration, in base coordinates equal to the sensor frame there.
ScrewChain rebase(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration);

}  // namespace circlepoint
