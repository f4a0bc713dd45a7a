#include "circlepoint/identification/circle_fit.hpp"

#include <Eigen/LU>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {

CircleFit fit_circle(const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>& points) {
  const Eigen::Index count = points.rows();
  require(count >= 3, "a circle needs at least 3 points, got " + std::to_string(count));
  require(points.allFinite(), "circle points are not all finite; remove the samples that are not");
  const Eigen::RowVector2d mean = points.colwise().mean();
  const Eigen::Matrix<double, Eigen::Dynamic, 2> p = points.rowwise() - mean;
  const Eigen::Matrix2d scatter = p.transpose() * p;
  const Eigen::Vector2d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvalues();
  if (!(spread[0] > 1e-12 * spread[1])) {
    throw NotIdentifiable("the " + std::to_string(count) + " points lie on a line: no circle; turn the joint over a longer arc");
  }
  // Kasa: |p|^2 = 2 p . centre + (r^2 - |centre|^2), centred points.
  const Eigen::VectorXd squared = p.rowwise().squaredNorm();
  CircleFit fit;
  fit.center = scatter.ldlt().solve(p.transpose() * (squared.array() - squared.mean()).matrix()) / 2.0;
  fit.radius = std::sqrt(squared.mean() + fit.center.squaredNorm());
  constexpr int max_iterations = 100;
  Eigen::Matrix3d normal;
  for (fit.iterations = 0; fit.iterations < max_iterations && !fit.converged; ++fit.iterations) {
    const Eigen::Matrix<double, Eigen::Dynamic, 2> from_center = p.rowwise() - fit.center.transpose();
    const Eigen::VectorXd distance = from_center.rowwise().norm().cwiseMax(1e-300);
    Eigen::Matrix<double, Eigen::Dynamic, 3> jacobian(count, 3);
    jacobian.leftCols<2>() = -(from_center.array().colwise() / distance.array()).matrix();
    jacobian.col(2).setConstant(-1.0);
    const Eigen::VectorXd residual = distance.array() - fit.radius;
    normal = jacobian.transpose() * jacobian;
    const Eigen::Vector3d step = -normal.ldlt().solve(jacobian.transpose() * residual);
    fit.center += step.head<2>();
    fit.radius += step[2];
    fit.converged = step.norm() <= 1e-13 * std::max(1e-9, fit.radius);
    fit.rms = std::sqrt(residual.squaredNorm() / static_cast<double>(count));
  }
  fit.covariance = (fit.rms * fit.rms * normal.inverse()).topLeftCorner<2, 2>();
  fit.center += mean.transpose();
  fit.radius = std::abs(fit.radius);
  return fit;
}

}  // namespace circlepoint
