#pragma once
// Arms and the recordings of their tests, from the simulator.

#include <vector>

#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/recording/recording.hpp"
#include "circlepoint/simulation/excitation.hpp"
#include "circlepoint/simulation/simulate.hpp"

namespace circlepoint::support {

/// What the sensor of `four_joints` reads at rest: no axis is near it.
inline const Eigen::Vector3d up_gravity_four_joints = standard_gravity * Eigen::Vector3d(0.48, -0.6, 0.64);

/// Four revolute joints whose sensor frame at zero is the base frame, no two axes parallel, up to 0.7 m away.
inline ScrewChain four_joints() {
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line({0.9, 0.1, 0.3}, {0.1, 0.6, -0.3})},
                {JointType::revolute, make_line({0.0, 0.2, 1.0}, {-0.5, 0.1, 0.1})},
                {JointType::revolute, make_line({0.2, 1.0, 0.3}, {0.2, 0.0, 0.3})},
                {JointType::revolute, make_line({1.0, -0.3, 0.1}, {0.0, 0.12, 0.05})}};
  chain.reference_configuration = Eigen::Vector4d::Zero();
  return chain;
}

/// A stepped sweep and eq. (11) of one joint.
inline void append_joint_test(std::vector<Excitation>& pieces, Index joint) {
  pieces.emplace_back(SteppedSweep{.joint = joint, .steps = 12, .span = 2.4, .dwell = 0.6, .move = 0.5, .return_duration = 1.5});
  pieces.emplace_back(RaisedCosine{.joint = joint, .span = 2.4, .frequency = 0.5, .duration = 4.0});
}

inline std::vector<Excitation> joint_tests(const std::vector<Index>& joints) {
  std::vector<Excitation> pieces;
  for (const Index joint : joints) {
    append_joint_test(pieces, joint);
  }
  return pieces;
}

/// The recording of these pieces at 200 Hz, from rest at -1.2 rad of every joint.
inline Recording record_tests(const ScrewChain& chain, const Eigen::Vector3d& up_gravity, const std::vector<Excitation>& pieces,
                              const AccelerometerModel& sensor = {}, const SimulationOptions& options = {}) {
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(chain.size(), -1.2);
  return simulate(chain, up_gravity, sensor, joint_trajectory(start, pieces, 200.0, 0.6), options);
}

}  // namespace circlepoint::support
