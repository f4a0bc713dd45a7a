#pragma once
// Joints held by a proportional-derivative loop: they follow their command late and ring after every step.
//
// Assumption: each joint is an inertia on the spring and damper of its loop, which act on the difference e between the
// actual and the commanded position, without feedforward, (M22):
//
//   e'' + 2 c e' + w0^2 e = -q'',   w0 = 2 pi natural_frequency,   c = 4 / settling_time,
//
// so oscillations decay to 2 % in the settling time (the paper waits 3 s for them). It is solved exactly for an
// acceleration that is linear between samples, from rest. Coupling between joints is not in it; their sag under gravity
// is SimulationOptions::compliance, and `joint_compliance` gives that for a loop's stiffness.

#include <Eigen/Core>

#include "circlepoint/simulation/excitation.hpp"

namespace circlepoint {

struct HeldJoints {
  Eigen::VectorXd natural_frequency{};  ///< (n) Hz, 0: follows exactly; empty: all do
  double settling_time = 3.0;           ///< s, until oscillations are below 2 %
};

/// The motion the joints make of a commanded one. Raises InvalidInput for a frequency below zero or without
/// oscillation (natural_frequency x settling_time below 2 / pi), or another number of joints.
JointTrajectory follow(const JointTrajectory& commanded, const HeldJoints& joints);

/// How far a joint of `stiffness` (n) N m/rad (prismatic: N/m) gives way, as SimulationOptions::compliance, when the load
/// at the sensor is `mass` kg. Raises InvalidInput for a stiffness that is not positive or a negative mass.
Eigen::VectorXd joint_compliance(const Eigen::Ref<const Eigen::VectorXd>& stiffness, double mass);

}  // namespace circlepoint
