#pragma once
// A directed line in space: unit direction and the point of it nearest the origin (4 degrees of freedom).
// Pluecker coordinates are (direction, moment) with moment = point x direction.

#include <Eigen/Core>

#include "circlepoint/geometry/rigid_transform.hpp"

namespace circlepoint {

struct Line {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< m, the point nearest the origin: orthogonal to direction

  [[nodiscard]] Eigen::Vector3d moment() const { return point.cross(direction); }
};

/// Line through any point along any non-zero direction. Raises InvalidInput for a zero or non-finite direction.
Line make_line(const Eigen::Vector3d& direction, const Eigen::Vector3d& point_on_line);

/// Line from Pluecker coordinates; the part of the moment along the direction is dropped.
Line line_from_pluecker(const Eigen::Vector3d& direction, const Eigen::Vector3d& moment);

/// The line given in b-coordinates, in a-coordinates.
Line transform(const RigidTransform& T_a_b, const Line& line_b);

/// The common normal of two lines: what the Denavit-Hartenberg parameters are read from.
struct CommonNormal {
  Eigen::Vector3d foot_first;   ///< m, its foot on the first line
  Eigen::Vector3d foot_second;  ///< m, its foot on the second line
  Eigen::Vector3d direction;    ///< unit, from first to second (lines nearer than 1e-12 m: first x second direction)
  double distance = 0.0;        ///< m, along direction
  double angle = 0.0;           ///< rad, from first to second direction about `direction`, in (-pi, pi]
  bool parallel = false;        ///< the feet are a choice: nearest `foot_hint`
};

/// Common normal. Lines whose directions enclose less than `parallel_tolerance` (rad, or as much less than pi) count as
/// parallel: their angle is then 0 or pi exactly, the feet are taken at the projection of `foot_hint` (m) on the first
/// line, and for coincident lines `direction` is the first column of tangent_basis(first direction).
CommonNormal common_normal(const Line& first, const Line& second, const Eigen::Vector3d& foot_hint,
                           double parallel_tolerance = 1e-9);

}  // namespace circlepoint
