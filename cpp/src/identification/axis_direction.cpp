#include "circlepoint/identification/axis_direction.hpp"

#include <ceres/ceres.h>

#include <Eigen/LU>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "circlepoint/identification/gravity_model.hpp"

namespace circlepoint {
namespace {

struct Scatter {
  Eigen::Vector3d mean;
  Eigen::Matrix3d moment;       // of the weighted mean square about the mean
  Eigen::Vector3d eigenvalues;  // ascending
  Eigen::Matrix3d eigenvectors;
};

// weight(i) of row i; `total` their sum.
template <typename Weight>
Scatter scatter_of(const Eigen::Ref<const Samples3>& f, const Weight& weight, double total) {
  Scatter scatter;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Index i = 0; i < f.rows(); ++i) {
    sum += weight(i) * f.row(i).transpose();
  }
  scatter.mean = sum / total;
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  for (Index i = 0; i < f.rows(); ++i) {
    const double x = f(i, 0) - scatter.mean.x(), y = f(i, 1) - scatter.mean.y(), z = f(i, 2) - scatter.mean.z();
    const double wx = weight(i) * x, wy = weight(i) * y;
    xx += wx * x;
    xy += wx * y;
    xz += wx * z;
    yy += wy * y;
    yz += wy * z;
    zz += weight(i) * z * z;
  }
  scatter.moment << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  scatter.moment /= total;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter.moment);
  scatter.eigenvalues = solver.eigenvalues().cwiseMax(0.0);
  scatter.eigenvectors = solver.eigenvectors();
  return scatter;
}

Scatter scatter_of(const Eigen::Ref<const Samples3>& f) {
  return scatter_of(f, [](Index) { return 1.0; }, static_cast<double>(f.rows()));
}

Scatter scatter_of(const Eigen::Ref<const Samples3>& f, const Eigen::VectorXd& weights) {
  return scatter_of(f, [&](Index i) { return weights[i]; }, weights.sum());
}

void validate(const Eigen::Ref<const Samples3>& f) {
  if (f.rows() < 3) {
    throw InvalidInput("an axis direction needs at least 3 static poses, got " + std::to_string(f.rows()) +
                       "; hold the joint still at more angles");
  }
  for (Index i = 0; i < f.rows(); ++i) {
    if (!f.row(i).allFinite()) {
      throw InvalidInput("specific_force row " + std::to_string(i) + " is not finite; remove or repair that pose");
    }
  }
}

// The samples must spread in two directions clearly more than along the axis.
void require_plane(const Scatter& scatter, Index poses) {
  const Eigen::Vector3d spread = scatter.eigenvalues.cwiseSqrt();
  if (!(spread[1] > 4.0 * spread[0]) || spread[1] < 1e-9) {
    throw NotIdentifiable("the " + std::to_string(poses) + " static poses do not spread over a plane (rms " +
                          std::to_string(spread[0]) + ", " + std::to_string(spread[1]) + ", " + std::to_string(spread[2]) +
                          " m/s^2 along the scatter's axes): the joint axis is nearly parallel to gravity or the joint turned "
                          "too little; tilt the arm by another joint or turn the joint further");
  }
}

// Information of the direction in its tangent plane, per unit noise variance.
AxisDirectionFit describe(const Scatter& scatter, const Eigen::VectorXd& weights) {
  AxisDirectionFit fit;
  fit.direction = scatter.eigenvectors.col(0);
  fit.offset = fit.direction.dot(scatter.mean);
  fit.spread = scatter.eigenvalues.cwiseSqrt();
  fit.weights = weights;
  const double total = weights.sum();
  const double dof = std::max(1.0, total - 3.0);
  fit.residual_std = std::sqrt(scatter.eigenvalues[0] * total / dof);
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(fit.direction);
  const Eigen::Matrix2d information = total * (basis.transpose() * scatter.moment * basis);
  fit.covariance = fit.residual_std * fit.residual_std * information.inverse();
  return fit;
}

// z . f - c of every pose in one residual block: at this size one block costs a third of one a pose.
struct PlaneResidual {
  const Eigen::Ref<const Samples3>& f;
  const Eigen::VectorXd& root_weights;

  template <typename T>
  bool operator()(const T* z, const T* c, T* residuals) const {
    for (Index i = 0; i < f.rows(); ++i) {
      residuals[i] = root_weights[i] * (z[0] * f(i, 0) + z[1] * f(i, 1) + z[2] * f(i, 2) - c[0]);
    }
    return true;
  }
};

// The same in the paper's chart; a step out of it is refused.
struct HemisphereResidual {
  PlaneResidual plane;

  template <typename T>
  bool operator()(const T* lm, const T* c, T* residuals) const {
    using std::sqrt;
    const T square = 1.0 - lm[0] * lm[0] - lm[1] * lm[1];
    if (!(square > 0.0)) {
      return false;
    }
    const T z[3] = {lm[0], lm[1], sqrt(square)};
    return plane(z, c, residuals);
  }
};

// Moves z and c to the weighted minimum; false where the solver stopped short of it.
bool solve(const Eigen::Ref<const Samples3>& f, const Eigen::VectorXd& root_weights, AxisChart chart, Eigen::Vector3d& z,
           double& c) {
  const PlaneResidual plane{f, root_weights};
  const int poses = static_cast<int>(f.rows());
  Eigen::Vector2d lm = z.head<2>();
  ceres::Problem problem;
  if (chart == AxisChart::sphere) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PlaneResidual, ceres::DYNAMIC, 3, 1>(new PlaneResidual(plane), poses), nullptr,
        z.data(), &c);
    problem.SetManifold(z.data(), new ceres::SphereManifold<3>);
  } else {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<HemisphereResidual, ceres::DYNAMIC, 2, 1>(new HemisphereResidual{plane}, poses),
        nullptr, lm.data(), &c);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-15;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (chart == AxisChart::hemisphere) {
    z << lm, std::sqrt(std::max(0.0, 1.0 - lm.squaredNorm()));
  }
  return summary.termination_type == ceres::CONVERGENCE;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

AxisDirectionFit fit_axis_direction(const Eigen::Ref<const Samples3>& specific_force) {
  validate(specific_force);
  const Scatter scatter = scatter_of(specific_force);
  require_plane(scatter, specific_force.rows());
  return describe(scatter, Eigen::VectorXd::Ones(specific_force.rows()));
}

AxisDirectionFit fit_axis_direction_robust(const Eigen::Ref<const Samples3>& specific_force, const RobustOptions& options) {
  validate(specific_force);
  require(options.loss_scale > 0.0, "loss_scale is " + std::to_string(options.loss_scale) +
                                        "; give a positive number, or infinity for plain least squares");
  const Index poses = specific_force.rows();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(poses);
  AxisDirectionFit fit = describe(scatter_of(specific_force, weights), weights);
  Eigen::Vector3d z = fit.direction;
  double c = fit.offset;
  if (options.chart == AxisChart::hemisphere) {
    z = Eigen::Vector3d::UnitZ();
    c = specific_force.col(2).mean();
  }
  bool converged = false;
  int iteration = 0;
  for (; iteration < options.max_iterations && !converged; ++iteration) {
    std::vector<double> magnitudes(static_cast<std::size_t>(poses));
    for (Index i = 0; i < poses; ++i) {
      magnitudes[static_cast<std::size_t>(i)] = std::abs(specific_force.row(i).dot(z) - c);
    }
    // 1.4826: the median absolute deviation of a normal variable in standard deviations.
    const double scale = std::max(options.loss_scale * 1.4826 * median(magnitudes), 1e-12);
    for (Index i = 0; i < poses; ++i) {
      const double ratio = magnitudes[static_cast<std::size_t>(i)] / scale;
      weights[i] = 1.0 / (1.0 + ratio * ratio);
    }
    const Eigen::VectorXd root_weights = weights.cwiseSqrt();
    const Eigen::Vector3d previous = z;
    const bool solved = solve(specific_force, root_weights, options.chart, z, c);
    converged = solved && (z - previous).norm() < 1e-10;
  }
  const Scatter scatter = scatter_of(specific_force, weights);
  require_plane(scatter, poses);
  fit = describe(scatter, weights);
  // At the chart's edge the solver stops without having arrived; the scatter of the same weights knows the minimum.
  const bool arrived = z.cross(fit.direction).norm() < 1e-6;
  fit.direction = z.dot(fit.direction) >= 0.0 ? z : Eigen::Vector3d(-z);
  fit.offset = z.dot(fit.direction) >= 0.0 ? c : -c;
  fit.iterations = iteration;
  fit.converged = converged && arrived;
  return fit;
}

Eigen::Vector3d orient_axis(const Eigen::Vector3d& direction, const Eigen::Ref<const Eigen::VectorXd>& angle,
                            const Eigen::Ref<const Samples3>& specific_force) {
  // A vector fixed in the base turns by -angle about z in the sensor frame: f(angle) = A + P cos(angle) - z x P sin(angle).
  // The triple product of z, P and the sine coefficient is negative for the right sign.
  const GravityModel model = fit_gravity_model(angle, specific_force);
  return direction.dot(model.cosine.cross(model.sine)) <= 0.0 ? direction : Eigen::Vector3d(-direction);
}

}  // namespace circlepoint
