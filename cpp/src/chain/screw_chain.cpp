#include "circlepoint/chain/screw_chain.hpp"

#include <string>

#include "circlepoint/core/error.hpp"
#include "pose_rows.hpp"

namespace circlepoint {
namespace {

// The message is built only when it is needed: this runs once a sample.
void require_size(const ScrewChain& chain, Index size, const char* name) {
  if (size != chain.size()) {
    throw InvalidInput(std::string(name) + " has " + std::to_string(size) + " entries for a chain of " +
                       std::to_string(chain.size()) + " joints; give one per joint, base to tip");
  }
  if (chain.reference_configuration.size() != chain.size()) {
    throw InvalidInput("reference_configuration has " + std::to_string(chain.reference_configuration.size()) +
                       " entries for a chain of " + std::to_string(chain.size()) +
                       " joints; give one per joint, base to tip");
  }
}

}  // namespace

RigidTransform forward_kinematics(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q) {
  require_size(chain, q.size(), "q");
  RigidTransform pose = chain.home;
  for (Index i = chain.size() - 1; i >= 0; --i) {
    pose = screw_exp(chain.axes[static_cast<std::size_t>(i)], q[i] - chain.reference_configuration[i]) * pose;
  }
  return pose;
}

SamplesX forward_kinematics_rows(const ScrewChain& chain, const Eigen::Ref<const SamplesX>& q) {
  return pose_rows(chain, q);
}

FrameMotion frame_motion(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::Ref<const Eigen::VectorXd>& q_dot, const Eigen::Ref<const Eigen::VectorXd>& q_ddot) {
  require_size(chain, q.size(), "q");
  require_size(chain, q_dot.size(), "q_dot");
  require_size(chain, q_ddot.size(), "q_ddot");
  // Base to tip: `pose` is T_base_link before the joint, so each axis is carried to where it is now. The state is the
  // spatial twist and its derivative: angular part, and linear velocity / acceleration of the body point at the base origin.
  RigidTransform pose = RigidTransform::Identity();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega_dot = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear_dot = Eigen::Vector3d::Zero();
  for (Index i = 0; i < chain.size(); ++i) {
    const ScrewAxis& axis = chain.axes[static_cast<std::size_t>(i)];
    Eigen::Vector3d angular_part = Eigen::Vector3d::Zero();
    Eigen::Vector3d linear_part = pose.linear() * axis.line.direction;
    if (axis.type == JointType::revolute) {
      angular_part = linear_part;
      linear_part = (pose * axis.line.point).cross(angular_part);
    }
    // Derivative of the moving spatial axis: the Lie bracket of the twist of its carrier with the axis.
    omega_dot += angular_part * q_ddot[i] + omega.cross(angular_part) * q_dot[i];
    linear_dot += linear_part * q_ddot[i] + (omega.cross(linear_part) + linear.cross(angular_part)) * q_dot[i];
    omega += angular_part * q_dot[i];
    linear += linear_part * q_dot[i];
    pose = pose * screw_exp(axis, q[i] - chain.reference_configuration[i]);
  }
  FrameMotion motion;
  motion.T_base_sensor = pose * chain.home;
  const Eigen::Vector3d position = motion.T_base_sensor.translation();
  motion.velocity_base = linear + omega.cross(position);
  motion.acceleration_base = linear_dot + omega_dot.cross(position) + omega.cross(motion.velocity_base);
  const Eigen::Matrix3d R_sensor_base = motion.T_base_sensor.linear().transpose();
  motion.angular_velocity_sensor = R_sensor_base * omega;
  motion.angular_acceleration_sensor = R_sensor_base * omega_dot;
  return motion;
}

Eigen::Vector3d specific_force(const FrameMotion& motion, const Eigen::Vector3d& up_gravity_base) {
  return motion.T_base_sensor.linear().transpose() * (motion.acceleration_base + up_gravity_base);
}

ScrewAxis axis_in_sensor_frame(const ScrewChain& chain, Index joint, const Eigen::Ref<const Eigen::VectorXd>& q) {
  require_size(chain, q.size(), "q");
  if (joint < 0 || joint >= chain.size()) {
    throw InvalidInput("joint index " + std::to_string(joint) + " is outside 0.." + std::to_string(chain.size() - 1) +
                       "; joints count from 0 at the base");
  }
  RigidTransform beyond = chain.home;
  for (Index i = chain.size() - 1; i > joint; --i) {
    beyond = screw_exp(chain.axes[static_cast<std::size_t>(i)], q[i] - chain.reference_configuration[i]) * beyond;
  }
  return transform(beyond.inverse(), chain.axes[static_cast<std::size_t>(joint)]);
}

ScrewChain rebase(const ScrewChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration) {
  require_size(chain, reference_configuration.size(), "reference_configuration");
  ScrewChain moved;
  moved.reference_configuration = reference_configuration;
  for (Index i = 0; i < chain.size(); ++i) {
    moved.axes.push_back(axis_in_sensor_frame(chain, i, reference_configuration));
  }
  return moved;
}

}  // namespace circlepoint
