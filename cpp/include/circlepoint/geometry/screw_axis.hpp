#pragma once
// A one-degree-of-freedom joint as a screw axis: rotation about a line or translation along a direction.
// Twists are (angular, linear): xi = (z, -z x c) revolute, (0, z) prismatic; exp(xi q) is the joint's motion.

#include <Eigen/Core>

#include "circlepoint/geometry/line.hpp"

namespace circlepoint {

enum class JointType { revolute, prismatic };

struct ScrewAxis {
  JointType type = JointType::revolute;
  Line line;  ///< prismatic: only the direction acts

  /// (angular, linear) twist of unit joint rate.
  [[nodiscard]] Eigen::Matrix<double, 6, 1> twist() const;
};

/// exp(xi q): the displacement of everything beyond the joint when it moves by q (rad or m).
RigidTransform screw_exp(const ScrewAxis& axis, double q);

/// The axis given in b-coordinates, in a-coordinates.
ScrewAxis transform(const RigidTransform& T_a_b, const ScrewAxis& axis_b);

}  // namespace circlepoint
