#include "partial_chain.hpp"

#include <cmath>

namespace circlepoint {
namespace {

// What frame_motion (chain/screw_chain.hpp) tells of one sample, written out for many: no checks, no transforms built up and
// multiplied. `columns` are the joints of the arrays that `chain` has.
Samples3 readings_of(const ScrewChain& chain, const std::vector<Index>& columns, const Eigen::Vector3d& up_gravity,
                     const Eigen::Vector3d& percussion_distance, const Eigen::Ref<const SamplesX>& position,
                     const Eigen::Ref<const SamplesX>& velocity, const Eigen::Ref<const SamplesX>& acceleration) {
  Samples3 readings(position.rows(), 3);
  for (Index i = 0; i < position.rows(); ++i) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    Eigen::Vector3d omega = Eigen::Vector3d::Zero(), omega_dot = omega, linear = omega, linear_dot = omega;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const ScrewAxis& axis = chain.axes[k];
      const Index column = columns[k];
      const double moved = position(i, column) - chain.reference_configuration[static_cast<Index>(k)];
      const double q_dot = velocity(i, column);
      const double q_ddot = acceleration(i, column);
      const Eigen::Vector3d& direction = axis.line.direction;
      const Eigen::Vector3d z = R * direction;
      if (axis.type == JointType::prismatic) {
        linear_dot += z * q_ddot + omega.cross(z) * q_dot;
        linear += z * q_dot;
        p += z * moved;
        continue;
      }
      const Eigen::Vector3d& point = axis.line.point;
      const Eigen::Vector3d moment = (p + R * point).cross(z);
      omega_dot += z * q_ddot + omega.cross(z) * q_dot;
      linear_dot += moment * q_ddot + (omega.cross(moment) + linear.cross(z)) * q_dot;
      omega += z * q_dot;
      linear += moment * q_dot;
      // Rodrigues' formula, column by column: Exp v = v + sin (d x v) + (1 - cos) d x (d x v).
      const double sine = std::sin(moved);
      const double half = std::sin(0.5 * moved);
      const double versine = 2.0 * half * half;
      const Eigen::Vector3d a = sine * direction;
      const Eigen::Vector3d b = versine * direction;
      Eigen::Matrix3d turn;
      turn << 1.0 - versine + b.x() * direction.x(), b.x() * direction.y() - a.z(), b.x() * direction.z() + a.y(),  //
          b.y() * direction.x() + a.z(), 1.0 - versine + b.y() * direction.y(), b.y() * direction.z() - a.x(),      //
          b.z() * direction.x() - a.y(), b.z() * direction.y() + a.x(), 1.0 - versine + b.z() * direction.z();
      p += R * (point - turn * point);
      R = (R * turn).eval();
    }
    const Eigen::Vector3d at_rest_and_moving =
        up_gravity + linear_dot + omega_dot.cross(p) + omega.cross(linear + omega.cross(p));
    const Eigen::Vector3d w = R.transpose() * omega;
    const Eigen::Vector3d centripetal = w.squaredNorm() - w.array().square();
    readings.row(i) = R.transpose() * at_rest_and_moving - percussion_distance.cwiseProduct(centripetal);
  }
  return readings;
}

}  // namespace

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
  return readings_of(known, columns, chain.up_gravity, chain.percussion_distance, position, velocity, acceleration);
}

Samples3 yield_correction(const PartialChain& chain, Index joint, const Eigen::VectorXd& configuration,
                          const Eigen::Ref<const SamplesX>& position, const Eigen::Ref<const SamplesX>& velocity,
                          const Eigen::Ref<const SamplesX>& acceleration) {
  const Samples3 together = predict_readings(chain, position, velocity, acceleration);
  // With the others at rest, the joint carries the sensor about its axis as seen from there.
  RigidTransform before = RigidTransform::Identity();
  RigidTransform after = RigidTransform::Identity();
  for (Index i = 0; i < chain.size(); ++i) {
    if (i != joint && chain.knows(i)) {
      RigidTransform& side = i < joint ? before : after;
      side = side * screw_exp(*chain.axes[static_cast<std::size_t>(i)], configuration[i] - chain.reference_configuration[i]);
    }
  }
  ScrewChain alone;
  std::vector<Index> columns;
  if (chain.knows(joint)) {
    alone.axes.push_back(transform(after.inverse(), *chain.axes[static_cast<std::size_t>(joint)]));
    alone.reference_configuration = chain.reference_configuration.segment(joint, 1);
    columns.push_back(joint);
  }
  const Eigen::Vector3d up_gravity = (before * after).linear().transpose() * chain.up_gravity;
  return together - readings_of(alone, columns, up_gravity, chain.percussion_distance, position, velocity, acceleration);
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
