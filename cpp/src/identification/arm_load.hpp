#pragma once
// What a rigid arm's resting joints bear while one joint moves, in arm_yield's functions.
//
// With joint i alone moving, joint j's torque by gravity and motion is linear in the ten inertial parameters of all that is rigid
// beyond the outer one of the two: mass, first moment and inertia about the origin, at home. All pairs of joints with one outer
// joint share them.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/core/types.hpp"

namespace circlepoint {

constexpr Index load_functions = 8;     // cos, sin; alpha, alpha cos, alpha sin; omega^2, omega^2 cos, omega^2 sin of the moving joint
constexpr Index load_parameters = 10;   // m; m c (3); I_xx, I_yy, I_zz, I_xy, I_xz, I_yz

// The lines as far as they are known, with gravity, in the sensor frame at the reference configuration.
struct KnownArm {
  ScrewChain chain;
  std::vector<bool> known;  // of each line
  Eigen::Vector3d up_gravity = Eigen::Vector3d::Zero();
};

// The same with the sensor frame at home.
struct ArmAtHome {
  std::vector<ScrewAxis> axes;   // base to tip
  std::vector<bool> known;       // of each axis, and that it is revolute
  Eigen::VectorXd position;      // (n) rad
  Eigen::Vector3d up_gravity = Eigen::Vector3d::Zero();
};

ArmAtHome at_home(const KnownArm& arm, const Eigen::VectorXd& position);

// Coefficients (functions, parameters) of the torque on `resting` while `moving` moves, in the functions of its position (encoder's,
// home included) and motion. The constant is left out.
Eigen::MatrixXd load_coefficients(const ArmAtHome& arm, Index moving, Index resting);

}  // namespace circlepoint
