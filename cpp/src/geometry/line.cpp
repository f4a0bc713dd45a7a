#include "circlepoint/geometry/line.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

/// Distance, m, below which two lines count as intersecting: their common normal then takes its sign from the directions.
constexpr double intersecting_distance = 1e-12;

void require_direction(const Eigen::Vector3d& direction, double norm) {
  if (!std::isfinite(norm) || norm <= 0.0) {
    std::ostringstream message;
    message << "line direction is (" << direction.transpose() << ") with norm " << norm
            << "; give a finite, non-zero vector";
    throw InvalidInput(message.str());
  }
}

}  // namespace

Line make_line(const Eigen::Vector3d& direction, const Eigen::Vector3d& point_on_line) {
  const double norm = direction.norm();
  require_direction(direction, norm);
  if (!point_on_line.allFinite()) {
    throw InvalidInput("line point is not finite; give three finite coordinates in metres");
  }
  Line line;
  line.direction = direction / norm;
  line.point = point_on_line - point_on_line.dot(line.direction) * line.direction;
  return line;
}

Line line_from_pluecker(const Eigen::Vector3d& direction, const Eigen::Vector3d& moment) {
  const double norm = direction.norm();
  require_direction(direction, norm);
  return make_line(direction, direction.cross(moment) / (norm * norm));
}

Line transform(const RigidTransform& T_a_b, const Line& line_b) {
  return make_line(T_a_b.linear() * line_b.direction, T_a_b * line_b.point);
}

CommonNormal common_normal(const Line& first, const Line& second, const Eigen::Vector3d& foot_hint,
                           double parallel_tolerance) {
  const Eigen::Vector3d& z1 = first.direction;
  const Eigen::Vector3d& z2 = second.direction;
  const Eigen::Vector3d cross = z1.cross(z2);
  const double sine = cross.norm();
  CommonNormal normal;
  normal.parallel = sine < parallel_tolerance;
  if (normal.parallel) {
    normal.foot_first = first.point + z1.dot(foot_hint - first.point) * z1;
    normal.foot_second = second.point + z2.dot(normal.foot_first - second.point) * z2;
    const Eigen::Vector3d gap = normal.foot_second - normal.foot_first;
    normal.distance = gap.norm();
    const bool coincident = normal.distance <= intersecting_distance;
    normal.direction = coincident ? Eigen::Vector3d(tangent_basis(z1).col(0)) : Eigen::Vector3d(gap / normal.distance);
    normal.distance = gap.dot(normal.direction);
    normal.angle = z1.dot(z2) > 0.0 ? 0.0 : std::numbers::pi;
    return normal;
  }
  // Feet p1 + s z1 and p2 + t z2 with the gap orthogonal to both directions.
  const Eigen::Vector3d between = second.point - first.point;
  const double squared = sine * sine;
  const double s = between.cross(z2).dot(cross) / squared;
  const double t = between.cross(z1).dot(cross) / squared;
  normal.foot_first = first.point + s * z1;
  normal.foot_second = second.point + t * z2;
  normal.direction = cross / sine;
  normal.distance = between.dot(normal.direction);
  normal.angle = std::atan2(sine, z1.dot(z2));
  if (normal.distance < -intersecting_distance) {
    normal.direction = -normal.direction;
    normal.distance = -normal.distance;
    normal.angle = -normal.angle;
  }
  return normal;
}

}  // namespace circlepoint
