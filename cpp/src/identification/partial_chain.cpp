#include "partial_chain.hpp"

namespace circlepoint {

ScrewChain PartialChain::known(std::vector<Index>& columns) const {
  ScrewChain chain;
  columns.clear();
  for (Index i = 0; i < size(); ++i) {
    if (knows(i)) {
      chain.axes.push_back(*axes[static_cast<std::size_t>(i)]);
      columns.push_back(i);
    }
  }
  chain.reference_configuration = reference_configuration(columns);
  return chain;
}

Samples3 predict_readings(const PartialChain& chain, const Eigen::Ref<const SamplesX>& position,
                          const Eigen::Ref<const SamplesX>& velocity, const Eigen::Ref<const SamplesX>& acceleration) {
  std::vector<Index> columns;
  const ScrewChain known = chain.known(columns);
  Samples3 readings(position.rows(), 3);
  Eigen::VectorXd q(known.size());
  Eigen::VectorXd q_dot(known.size());
  Eigen::VectorXd q_ddot(known.size());
  for (Index i = 0; i < position.rows(); ++i) {
    for (Index k = 0; k < known.size(); ++k) {
      const Index column = columns[static_cast<std::size_t>(k)];
      q[k] = position(i, column);
      q_dot[k] = velocity(i, column);
      q_ddot[k] = acceleration(i, column);
    }
    const FrameMotion motion = frame_motion(known, q, q_dot, q_ddot);
    const Eigen::Vector3d& w = motion.angular_velocity_sensor;
    const Eigen::Vector3d centripetal = w.squaredNorm() - w.array().square();
    readings.row(i) = specific_force(motion, chain.up_gravity) - chain.percussion_distance.cwiseProduct(centripetal);
  }
  return readings;
}

Samples3 yield_correction(const PartialChain& chain, Index joint, const Eigen::VectorXd& configuration,
                          const Eigen::Ref<const SamplesX>& position, const Eigen::Ref<const SamplesX>& velocity,
                          const Eigen::Ref<const SamplesX>& acceleration) {
  SamplesX alone = configuration.transpose().replicate(position.rows(), 1);
  SamplesX alone_velocity = SamplesX::Zero(position.rows(), position.cols());
  SamplesX alone_acceleration = alone_velocity;
  alone.col(joint) = position.col(joint);
  alone_velocity.col(joint) = velocity.col(joint);
  alone_acceleration.col(joint) = acceleration.col(joint);
  return predict_readings(chain, position, velocity, acceleration) -
         predict_readings(chain, alone, alone_velocity, alone_acceleration);
}

RigidTransform carry_to_reference(const PartialChain& chain, Index joint, const Eigen::VectorXd& from) {
  RigidTransform carry = RigidTransform::Identity();
  for (Index i = chain.size() - 1; i > joint; --i) {
    if (chain.knows(i)) {
      carry = screw_exp(*chain.axes[static_cast<std::size_t>(i)], from[i] - chain.reference_configuration[i]) * carry;
    }
  }
  return carry;
}

}  // namespace circlepoint
