#include "give_way.hpp"

namespace circlepoint {

Eigen::VectorXd give_way(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_base,
                         const Eigen::VectorXd& compliance, const Eigen::VectorXd& q) {
  const Eigen::Vector3d sensor = forward_kinematics(chain, q).translation();
  const Eigen::Vector3d gravity = -up_gravity_base;
  Eigen::VectorXd displacement(chain.size());
  RigidTransform pose = RigidTransform::Identity();
  for (Index j = 0; j < chain.size(); ++j) {
    const ScrewAxis& axis = chain.axes[static_cast<std::size_t>(j)];
    const Eigen::Vector3d direction = pose.linear() * axis.line.direction;
    const Eigen::Vector3d load =
        axis.type == JointType::revolute ? Eigen::Vector3d((sensor - pose * axis.line.point).cross(gravity)) : gravity;
    displacement[j] = compliance[j] * direction.dot(load);
    pose = pose * screw_exp(axis, q[j] - chain.reference_configuration[j]);
  }
  return displacement;
}

JointState add_give_way(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_base,
                        const Eigen::VectorXd& compliance, const JointState& commanded) {
  constexpr double h = 1e-3;  // s
  const Eigen::VectorXd forward = commanded.velocity * h;
  const Eigen::VectorXd curved = commanded.position + 0.5 * h * h * commanded.acceleration;
  const Eigen::VectorXd now = give_way(chain, up_gravity_base, compliance, commanded.position);
  const Eigen::VectorXd before = give_way(chain, up_gravity_base, compliance, curved - forward);
  const Eigen::VectorXd after = give_way(chain, up_gravity_base, compliance, curved + forward);
  return {commanded.position + now, commanded.velocity + (after - before) / (2.0 * h),
          commanded.acceleration + (after - 2.0 * now + before) / (h * h)};
}

}  // namespace circlepoint
