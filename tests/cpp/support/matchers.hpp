#pragma once
// What tests compare, with the difference in the message. Distances in m and rad.

#include <gmock/gmock.h>

#include <Eigen/Core>

#include "circlepoint/geometry/line.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"

namespace circlepoint::support {

/// Matrices and vectors: largest entry of the difference.
MATCHER_P2(EntriesNear, expected, tolerance, "has entries near the expected ones") {
  const double difference = (arg - expected).cwiseAbs().maxCoeff();
  *result_listener << "largest difference " << difference;
  return difference <= tolerance;
}

/// Rigid transforms: largest entry of the difference of the matrices.
MATCHER_P2(PoseNear, expected, tolerance, "is a pose near the expected one") {
  const double difference = (arg.matrix() - expected.matrix()).cwiseAbs().maxCoeff();
  *result_listener << "largest difference " << difference;
  return difference <= tolerance;
}

/// Directed lines: direction and nearest point.
MATCHER_P2(LineNear, expected, tolerance, "is a line near the expected one") {
  const double direction = (arg.direction - expected.direction).norm();
  const double point = (arg.point - expected.point).norm();
  *result_listener << "direction differs by " << direction << ", point by " << point;
  return direction <= tolerance && point <= tolerance;
}

}  // namespace circlepoint::support
