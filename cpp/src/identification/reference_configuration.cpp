#include "reference_configuration.hpp"

#include <cmath>

namespace circlepoint {

std::optional<Index> obstacle_between(const std::vector<bool>& known, const Eigen::VectorXd& from, const Eigen::VectorXd& reference,
                                      Index joint, const ArmJoints& arm) {
  const bool slides = arm.types[static_cast<std::size_t>(joint)] == JointType::prismatic;
  for (Index j = joint + 1; j < static_cast<Index>(known.size()); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const bool matters = !slides || arm.types[at] == JointType::revolute;
    if (!known[at] && matters && std::abs(from[j] - reference[j]) > arm.tolerance[j]) {
      return j;
    }
  }
  return std::nullopt;
}

namespace {

Index joints_served(const std::vector<std::optional<Eigen::VectorXd>>& tested, const Eigen::VectorXd& reference,
                    const ArmJoints& arm) {
  std::vector<bool> known(tested.size(), false);
  Index served = 0;
  for (std::size_t i = tested.size(); i-- > 0;) {
    if (tested[i] && !obstacle_between(known, *tested[i], reference, static_cast<Index>(i), arm)) {
      known[i] = true;
      ++served;
    }
  }
  return served;
}

}  // namespace

Eigen::VectorXd choose_reference(const Segmentation& segmentation, const std::vector<std::optional<Eigen::VectorXd>>& tested,
                                 const Eigen::VectorXd& fallback, const ArmJoints& arm) {
  Eigen::VectorXd best = fallback;
  Index best_served = -1;
  Index best_visited = -1;
  for (const StaticDwell& dwell : segmentation.dwells) {
    const Index served = joints_served(tested, dwell.joint_positions, arm);
    if (served < best_served) {
      continue;
    }
    Index visited = 0;
    for (const StaticDwell& other : segmentation.dwells) {
      if (((other.joint_positions - dwell.joint_positions).array().abs() < arm.tolerance.array()).all()) {
        visited += other.samples.size();
      }
    }
    if (served > best_served || visited > best_visited) {
      best = dwell.joint_positions;
      best_served = served;
      best_visited = visited;
    }
  }
  if (best_served < 0) {
    for (const auto& configuration : tested) {
      if (configuration) {
        return *configuration;
      }
    }
  }
  return best;
}

}  // namespace circlepoint
