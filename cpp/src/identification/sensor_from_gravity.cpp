#include "circlepoint/identification/sensor_from_gravity.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using Vector = Eigen::Matrix<double, sensor_errors, 1>;

struct Posterior {
  Vector mean;
  SensorErrorMatrix covariance;
  double log_evidence;
};

// Posterior of the errors under prior standard deviations and noise, in coordinates scaled by the prior.
Posterior posterior_of(const SensorErrorMatrix& information, const Vector& score, double squares, Index count, const Vector& prior_std,
                       double noise_std) {
  const SensorErrorMatrix scaled = prior_std.asDiagonal() * information * prior_std.asDiagonal() / (noise_std * noise_std);
  const SensorErrorMatrix precision = SensorErrorMatrix::Identity() + scaled;
  const Eigen::LLT<SensorErrorMatrix> llt(precision);
  const Vector scaled_score = prior_std.cwiseProduct(score) / (noise_std * noise_std);
  const Vector mean = llt.solve(scaled_score);
  const SensorErrorMatrix lower = llt.matrixL();
  const double log_determinant = 2.0 * lower.diagonal().array().log().sum();
  Posterior posterior;
  posterior.mean = prior_std.cwiseProduct(mean);
  posterior.covariance = prior_std.asDiagonal() * llt.solve(SensorErrorMatrix::Identity()) * prior_std.asDiagonal();
  posterior.log_evidence = -0.5 * (squares / (noise_std * noise_std) - scaled_score.dot(mean)) - 0.5 * log_determinant -
                           static_cast<double>(count) * std::log(noise_std);
  return posterior;
}

}  // namespace

SensorFromGravity fit_sensor_from_gravity(const Eigen::Ref<const Samples3>& dwell_specific_force,
                                          const AccelerometerSpecification& specification, double gravity, bool adapt_prior,
                                          double dwell_noise_std) {
  require(dwell_noise_std >= 0.0, "dwell_noise_std is " + std::to_string(dwell_noise_std) + " m/s^2; give 0 or more");
  require(gravity > 0.0, "gravity is " + std::to_string(gravity) + " m/s^2; give the local magnitude, about 9.8");
  Vector prior;
  prior << Eigen::Vector3d::Constant(specification.bias_std), Eigen::Vector3d::Constant(specification.scale_std),
      Eigen::Vector3d::Constant(specification.misalignment_std), Eigen::Vector3d::Constant(specification.second_order_std);
  const Index count = dwell_specific_force.rows();
  SensorErrorMatrix information = SensorErrorMatrix::Zero();
  Vector score = Vector::Zero();
  double squares = 0.0;
  for (Index i = 0; i < count; ++i) {
    const Eigen::Vector3d y = dwell_specific_force.row(i);
    const double magnitude = y.norm();
    require(std::isfinite(magnitude) && magnitude > 0.0,
            "dwell " + std::to_string(i) + " has specific force magnitude " + std::to_string(magnitude) + " m/s^2; leave it out");
    const Eigen::Vector3d u = y / magnitude;
    Vector row;
    row << u, gravity * u.cwiseAbs2(), gravity * u.x() * u.y(), gravity * u.x() * u.z(), gravity * u.y() * u.z(),
        gravity * gravity * u.array().cube().matrix();
    information += row * row.transpose();
    score += row * (magnitude - gravity);
    squares += (magnitude - gravity) * (magnitude - gravity);
  }
  SensorFromGravity result;
  result.covariance = prior.cwiseAbs2().asDiagonal();
  result.noise_std = specification.noise_std;
  if (count == 0 || prior.maxCoeff() <= 0.0) {
    return result;
  }
  const Vector floor_std = prior.cwiseMax(1e-12);
  double best = -std::numeric_limits<double>::infinity();
  Posterior posterior;
  // A quarter of a percent in evidence is not worth a finer grid: steps of 12 % in both figures.
  const int factor_steps = adapt_prior ? 60 : 1;
  for (int i = 0; i < factor_steps; ++i) {
    const double factor = adapt_prior ? 0.003 * std::pow(10.0, 0.05 * i) : 1.0;
    for (int j = 0; j <= 80; ++j) {
      const double noise = std::max(1e-5, dwell_noise_std) * std::pow(10.0, 0.05 * j);
      const Posterior candidate = posterior_of(information, score, squares, count, factor * floor_std, noise);
      if (candidate.log_evidence > best) {
        best = candidate.log_evidence;
        posterior = candidate;
        result.prior_factor = factor;
        result.noise_std = noise;
      }
    }
  }
  result.sensor.bias = posterior.mean.head<3>();
  result.sensor.scale = posterior.mean.segment<3>(3);
  result.sensor.misalignment = posterior.mean.segment<3>(6);
  result.sensor.second_order = posterior.mean.tail<3>();
  result.covariance = posterior.covariance;
  const double residual = squares - 2.0 * score.dot(posterior.mean) + posterior.mean.dot(information * posterior.mean);
  result.residual_rms = std::sqrt(std::max(0.0, residual) / static_cast<double>(count));
  return result;
}

}  // namespace circlepoint
