#pragma once
// Where the lines of a calibration are given.

#include <optional>
#include <vector>

#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

// The joints' types, and how far (n, rad or m) each may stand off a configuration and still count as standing there.
struct ArmJoints {
  std::vector<JointType> types;
  Eigen::VectorXd tolerance;
};

// The first unknown joint beyond `joint` that stands elsewhere in its test than at the reference; none: it can be carried.
// One that slides is no obstacle to a sliding joint's direction.
std::optional<Index> obstacle_between(const std::vector<bool>& known, const Eigen::VectorXd& from, const Eigen::VectorXd& reference,
                                      Index joint, const ArmJoints& arm);

// The configuration of the dwell at which most joints' lines can be given; among equals the one visited longest, then the
// earliest. `tested`: each joint's test configuration, absent without one. Without dwells: the first test's, else `fallback`.
Eigen::VectorXd choose_reference(const Segmentation& segmentation, const std::vector<std::optional<Eigen::VectorXd>>& tested,
                                 const Eigen::VectorXd& fallback, const ArmJoints& arm);

}  // namespace circlepoint
