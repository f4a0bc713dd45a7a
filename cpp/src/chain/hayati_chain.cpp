#include "circlepoint/chain/hayati_chain.hpp"

#include <cstddef>
#include <string>

#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/core/error.hpp"
#include "pose_rows.hpp"

namespace circlepoint {

RigidTransform hayati_transform(const HayatiRow& row, JointType type, double q) {
  RigidTransform pose = standard_dh_transform({row.a, row.alpha, row.d, row.theta}, type, q);
  pose.linear() = pose.linear() * rotation_exp(row.beta * Eigen::Vector3d::UnitY());
  return pose;
}

RigidTransform forward_kinematics(const HayatiChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q) {
  require(q.size() == chain.size(), "q has " + std::to_string(q.size()) + " entries for a chain of " +
                                        std::to_string(chain.size()) + " joints; give one per joint, base to tip");
  require(chain.types.size() == chain.rows.size(), "Hayati chain has " + std::to_string(chain.rows.size()) + " rows and " +
                                                       std::to_string(chain.types.size()) +
                                                       " joint types; give one type per row");
  RigidTransform pose = chain.base;
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    pose = pose * hayati_transform(chain.rows[i], chain.types[i], q[static_cast<Index>(i)]);
  }
  return pose * chain.tool;
}

SamplesX forward_kinematics_rows(const HayatiChain& chain, const Eigen::Ref<const SamplesX>& q) { return pose_rows(chain, q); }

}  // namespace circlepoint
