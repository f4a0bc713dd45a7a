#include "reference_configuration.hpp"

#include <cmath>

namespace circlepoint {

std::optional<Index> obstacle_between(const std::vector<std::optional<Line>>& lines, const Eigen::VectorXd& from,
                                      const Eigen::VectorXd& reference, Index joint, double tolerance) {
  for (Index j = joint + 1; j < static_cast<Index>(lines.size()); ++j) {
    if (!lines[static_cast<std::size_t>(j)] && std::abs(from[j] - reference[j]) > tolerance) {
      return j;
    }
  }
  return std::nullopt;
}

namespace {

Index joints_served(const std::vector<std::optional<Eigen::VectorXd>>& tested, const Eigen::VectorXd& reference, double tolerance) {
  std::vector<std::optional<Line>> lines(tested.size());
  Index served = 0;
  for (std::size_t i = tested.size(); i-- > 0;) {
    if (tested[i] && !obstacle_between(lines, *tested[i], reference, static_cast<Index>(i), tolerance)) {
      lines[i] = Line{};
      ++served;
    }
  }
  return served;
}

}  // namespace

Eigen::VectorXd choose_reference(const Segmentation& segmentation, const std::vector<std::optional<Eigen::VectorXd>>& tested,
                                 const Eigen::VectorXd& fallback, double tolerance) {
  Eigen::VectorXd best = fallback;
  Index best_served = -1;
  Index best_visited = -1;
  for (const StaticDwell& dwell : segmentation.dwells) {
    const Index served = joints_served(tested, dwell.joint_positions, tolerance);
    if (served < best_served) {
      continue;
    }
    Index visited = 0;
    for (const StaticDwell& other : segmentation.dwells) {
      if ((other.joint_positions - dwell.joint_positions).cwiseAbs().maxCoeff() < tolerance) {
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
