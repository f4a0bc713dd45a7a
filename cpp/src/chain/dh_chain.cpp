#include "circlepoint/chain/dh_chain.hpp"

#include <string>

#include "circlepoint/core/error.hpp"
#include "pose_rows.hpp"

namespace circlepoint {
namespace {

/// Rotation about and translation along one coordinate axis: a row is one such screw about z and one about x.
RigidTransform axis_screw(const Eigen::Vector3d& axis, double angle, double distance) {
  RigidTransform screw = RigidTransform::Identity();
  screw.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  screw.translation() = distance * axis;
  return screw;
}

RigidTransform joint_screw(const DhRow& row, JointType type, double q) {
  return type == JointType::revolute ? axis_screw(Eigen::Vector3d::UnitZ(), row.theta + q, row.d)
                                     : axis_screw(Eigen::Vector3d::UnitZ(), row.theta, row.d + q);
}

template <class DhChain>
void require_size(const DhChain& chain, Index size) {
  if (size != chain.size()) {
    throw InvalidInput("q has " + std::to_string(size) + " entries for a chain of " + std::to_string(chain.size()) +
                       " joints; give one per joint, base to tip");
  }
  if (chain.types.size() != chain.rows.size()) {
    throw InvalidInput("DH chain has " + std::to_string(chain.rows.size()) + " rows and " +
                       std::to_string(chain.types.size()) + " joint types; give one type per row");
  }
}

template <class DhChain, class RowTransform>
RigidTransform product(const DhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q, RowTransform row_transform) {
  require_size(chain, q.size());
  RigidTransform pose = chain.base;
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    pose = pose * row_transform(chain.rows[i], chain.types[i], q[static_cast<Index>(i)]);
  }
  return pose * chain.tool;
}

}  // namespace

RigidTransform standard_dh_transform(const DhRow& row, JointType type, double q) {
  return joint_screw(row, type, q) * axis_screw(Eigen::Vector3d::UnitX(), row.alpha, row.a);
}

RigidTransform modified_dh_transform(const DhRow& row, JointType type, double q) {
  return axis_screw(Eigen::Vector3d::UnitX(), row.alpha, row.a) * joint_screw(row, type, q);
}

RigidTransform forward_kinematics(const StandardDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q) {
  return product(chain, q, standard_dh_transform);
}

RigidTransform forward_kinematics(const ModifiedDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q) {
  return product(chain, q, modified_dh_transform);
}

SamplesX forward_kinematics_rows(const StandardDhChain& chain, const Eigen::Ref<const SamplesX>& q) {
  return pose_rows(chain, q);
}

SamplesX forward_kinematics_rows(const ModifiedDhChain& chain, const Eigen::Ref<const SamplesX>& q) {
  return pose_rows(chain, q);
}

}  // namespace circlepoint
