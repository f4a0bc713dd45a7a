#pragma once
// Joints that give way to gravity (simulation/simulate.hpp).

#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

/// Joint state: positions and their first two derivatives, (n) each.
struct JointState {
  Eigen::VectorXd position, velocity, acceleration;
};

/// How far every joint gives way at commanded positions q: compliance_j z_j . (r_j x g); a prismatic joint
/// compliance_j z_j . g.
Eigen::VectorXd give_way(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_base,
                         const Eigen::VectorXd& compliance, const Eigen::VectorXd& q);

/// The actual state behind a commanded one.
JointState add_give_way(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_base,
                        const Eigen::VectorXd& compliance, const JointState& commanded);

}  // namespace circlepoint
