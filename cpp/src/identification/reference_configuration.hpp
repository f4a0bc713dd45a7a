#pragma once
// Where the lines of a calibration are given.

#include <optional>
#include <vector>

#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/geometry/line.hpp"

namespace circlepoint {

// The first unknown joint beyond `joint` that stands elsewhere in its test than at the reference; none: it can be carried.
std::optional<Index> obstacle_between(const std::vector<std::optional<Line>>& lines, const Eigen::VectorXd& from,
                                      const Eigen::VectorXd& reference, Index joint, double tolerance);

// The configuration of the dwell at which most joints' lines can be given; among equals the one visited longest, then the
// earliest. `tested`: each joint's test configuration, absent without one. Without dwells: the first test's, else `fallback`.
Eigen::VectorXd choose_reference(const Segmentation& segmentation, const std::vector<std::optional<Eigen::VectorXd>>& tested,
                                 const Eigen::VectorXd& fallback, double tolerance);

}  // namespace circlepoint
