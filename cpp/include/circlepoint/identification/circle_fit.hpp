#pragma once
// Circle through points of a plane: the paper's "circle interpolation" (section 4, method 1).
//
// Start: the algebraic fit (Kasa), linear. Then geometric least squares, min sum (|p_i - centre| - r)^2, by Gauss-Newton;
// the algebraic fit alone is biased towards small circles on short arcs.

#include <Eigen/Core>

namespace circlepoint {

struct CircleFit {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0.0;
  double rms = 0.0;                                       ///< of the distances to the circle
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();   ///< of the centre, for independent point errors
  int iterations = 0;
  bool converged = false;
};

/// points: (N, 2), any unit. Raises InvalidInput for fewer than 3 points and NotIdentifiable when they lie on a line.
CircleFit fit_circle(const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>& points);

}  // namespace circlepoint
