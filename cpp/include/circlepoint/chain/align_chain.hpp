#pragma once
// Placing a nominal arm on the calibrated one: where its base is, and how far its encoders' zeros are off.
//
// Lines of two chains at one reference configuration are brought closest over a rigid transform and offsets of the joints,
// min sum (length angle)^2 + distance^2, the distance measured between the lines at the target's point (revolute joints
// only: a prismatic axis has a direction). Without the offsets (chain/align_lines) an encoder zero that is off by 1 degree
// looks like centimetres of every axis beyond. The first and the last joint's offset move no line relative to the others:
// they stay zero, as the base and the tool frame are a choice. So does any other combination the lines do not determine.
//
// Gauss-Newton from the rotation that fits the directions; meant for arms near their drawing (offsets below about 0.5 rad).

#include <Eigen/Core>

#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

struct ChainAlignment {
  RigidTransform T_target_source = RigidTransform::Identity();
  Eigen::VectorXd joint_offsets;  ///< (n) rad or m; source at reference + offsets is nearest target at reference
  double direction_rms = 0.0;     ///< rad, left between the axes
  double distance_rms = 0.0;      ///< m, left between the revolute axes
  bool converged = false;
};

/// Aligns the source chain with the target. `length` (m) weighs a radian of direction against a metre. Raises InvalidInput
/// for chains without joints, of different sizes, joint types or reference configurations.
ChainAlignment align_chain(const ScrewChain& target, const ScrewChain& source, double length = 0.5);

}  // namespace circlepoint
