#include "prismatic_fit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "circlepoint/identification/center_of_rotation.hpp"
#include "regression_noise.hpp"

namespace circlepoint {
namespace {

constexpr int parameters = 6;  // direction 2, length 1, constant 3

std::string two_digits(double value) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.2g", value)));
  return text;
}

double spread(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

// Everything that follows from A and E.
FittedTest describe(const TestSamples& samples, const TestRegression& regression, const Eigen::Vector3d& constant,
                    const Eigen::Vector3d& slope, double gravity) {
  FittedTest fitted;
  TestFit& fit = fitted.fit;
  JointModel model;
  model.axis = slope.normalized();
  model.constant = constant;
  Matrix53 coefficients = Matrix53::Zero();
  coefficients.row(0) = constant;
  coefficients.row(3) = slope;
  record_fit(fit, samples, regression, model, coefficients);
  fit.type = JointType::prismatic;
  fit.acceleration_rms = spread(regression.dynamic_regressors.col(3));
  fit.acceleration_scale = slope.norm();
  fit.dynamic_noise_std = std::max(residual_rms(fit.measured - fit.modelled, parameters), 1e-6);
  fit.static_noise_std = std::max(residual_rms(fit.dwell_measured - fit.dwell_modelled, 3.0), samples.dwell_floor);
  fit.gravity_share = std::min(1.0, (constant - constant.dot(model.axis) * model.axis).norm() / gravity);
  fit.parameters = parameters;
  fit.rank = parameters;
  fit.converged = true;
  return fitted;
}

// Of E by the sensor's errors, where the acceleration averages out: readings are linear in them.
Eigen::Matrix<double, 3, sensor_errors> slope_by_sensor(const Eigen::Vector3d& constant, const Eigen::Vector3d& slope) {
  Eigen::Matrix<double, 3, sensor_errors> derivative = Eigen::Matrix<double, 3, sensor_errors>::Zero();
  derivative.middleCols<3>(3).diagonal() = -slope;
  derivative(1, 6) = -slope.x();
  derivative(2, 7) = -slope.x();
  derivative(2, 8) = -slope.y();
  derivative.rightCols<3>().diagonal() = -2.0 * constant.cwiseProduct(slope);
  return derivative;
}

void set_sensor_jacobian(FittedTest& fitted, const Eigen::Matrix<double, 3, sensor_errors>& by_sensor) {
  const Eigen::Vector3d& z = fitted.fit.model.axis;
  fitted.sensor_jacobian.topRows<2>() = tangent_basis(z).transpose() * by_sensor / fitted.fit.acceleration_scale;
  fitted.acceleration_scale_jacobian = z.transpose() * by_sensor;
}

const char* what_to_record = "move this joint alone and briskly, for example 0.5 Hz over 0.3 m for 6 s (eq. (11): 1.5 m/s^2)";

}  // namespace

FittedTest fit_prismatic(const TestSamples& samples, const TestRegression& regression, const TestNoise& noise,
                         const JointCalibrationOptions& options) {
  if (samples.motions.empty()) {
    throw NotIdentifiable(std::string("only still poses of it were found, no motion, and at rest a sliding joint changes "
                                      "nothing the sensor reads; ") + what_to_record);
  }
  SamplesX x(regression.dynamic_regressors.rows(), 2);
  x << regression.dynamic_regressors.col(0), regression.dynamic_regressors.col(3);
  Samples3 y = regression.dynamic_readings;
  double kept_share = 1.0;
  if (noise.kept.size() == x.rows()) {
    x.array().colwise() *= noise.kept.array();
    y.array().colwise() *= noise.kept.array();
    kept_share = noise.kept.mean();
  }
  const Eigen::Matrix2d information = x.transpose() * x;
  const double independent = information.determinant() / (information(0, 0) * information(1, 1));
  if (!(independent > 1e-9)) {
    throw NotIdentifiable(std::string("it hardly accelerated in its motions; ") + what_to_record);
  }
  const Eigen::Matrix2d inverse = information.inverse();
  const Eigen::Matrix<double, 2, 3> score = x.transpose() * y;
  const Eigen::Matrix<double, 2, 3> coefficients = inverse * score;
  const Eigen::Vector3d slope = coefficients.row(1);
  const Samples3 residual = y - x * coefficients;

  const Eigen::MatrixXd scatter = score_covariance(x, residual, regression.sample_rate);
  Eigen::Matrix3d covariance;
  for (Index k = 0; k < 3; ++k) {
    for (Index l = 0; l < 3; ++l) {
      covariance(k, l) = inverse.row(1) * scatter.block<2, 2>(2 * k, 2 * l) * inverse.col(1);
    }
  }
  FittedTest fitted = describe(samples, regression, coefficients.row(0), slope, options.gravity);
  TestFit& fit = fitted.fit;
  fit.dynamic_noise_std = std::max(residual_rms(residual, parameters) / std::sqrt(kept_share), 1e-6);
  if (slope.squaredNorm() < 25.0 * covariance.trace()) {
    throw NotIdentifiable("too little acceleration, " + two_digits(fit.acceleration_rms) + " m/s^2 rms, against " +
                          two_digits(fit.dynamic_noise_std) + " m/s^2 of noise; " + what_to_record);
  }
  const Eigen::Vector3d& z = fit.model.axis;
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(z);
  fit.noise_covariance.topLeftCorner<2, 2>() = basis.transpose() * covariance * basis / slope.squaredNorm();
  fit.acceleration_scale_std = std::sqrt(z.dot(covariance * z));
  const double root = std::sqrt(1.0 - independent);
  fit.condition_number = (1.0 + root) / (1.0 - root);
  fit.iterations = 1;
  fit.knocks = static_cast<Index>(std::lround((1.0 - kept_share) * static_cast<double>(residual.rows())));
  fit.correlation_factor = correlation_factor(scatter, information, fit.dynamic_noise_std * fit.dynamic_noise_std);
  fitted.noise = {fit.static_noise_std, fit.dynamic_noise_std, fit.correlation_factor,
                  without_knocks(fit.measured - fit.modelled,
                                 static_cast<Index>(std::lround(0.5 * regression.sample_rate / samples.cutoff)))};

  const Eigen::MatrixXd by_sensor = score_by_sensor(information, score, x.transpose() * y.cwiseAbs2());
  Eigen::Matrix<double, 3, sensor_errors> slope_by_error;
  for (Index k = 0; k < 3; ++k) {
    slope_by_error.row(k) = inverse.row(1) * by_sensor.middleRows<2>(2 * k);
  }
  set_sensor_jacobian(fitted, slope_by_error);
  return fitted;
}

FittedTest fit_prismatic_by_paper(const TestSamples& samples, const TestRegression& regression, double sample_rate,
                                  const JointCalibrationOptions& options) {
  if (samples.motions.empty() || samples.dwell_force.rows() == 0) {
    throw NotIdentifiable(std::string(samples.motions.empty() ? "no motion of this joint alone was found; "
                                                              : "it never rests, and the reading at rest is subtracted; ") +
                          what_to_record + (samples.motions.empty() ? "" : ", with 1 s of rest before it"));
  }
  const bool twice = options.method == CalibrationMethod::position;
  const MotionSamples& motion = widest_motion(samples);
  const double dt = 1.0 / sample_rate;
  const Eigen::RowVector3d constant = samples.dwell_force.colwise().mean();
  const Samples3 dynamic = motion.specific_force.rowwise() - constant;
  Samples3 path = sosfiltfilt(butter(options.filter_order, samples.cutoff, sample_rate), dynamic);
  path = cumulative_trapezoid(path, dt, 0.0);
  Index used = path.rows();
  if (twice) {
    // As the circle of a revolute joint: what is left of the bias grows with t^2.
    path = cumulative_trapezoid(path, dt, 0.0);
    used = std::min<Index>(used, static_cast<Index>(std::lround(CenterOptions{}.position_window * sample_rate)) + 1);
  }
  const Eigen::VectorXd by_encoder = (twice ? motion.position : motion.velocity).col(samples.joint).head(used);
  const Samples3 centred = path.topRows(used).rowwise() - path.topRows(used).colwise().mean();
  const Eigen::VectorXd along_encoder = by_encoder.array() - by_encoder.mean();
  if (!(along_encoder.squaredNorm() > 0.0)) {
    throw NotIdentifiable(std::string("it hardly moved; ") + what_to_record);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(Eigen::Matrix3d(centred.transpose() * centred));
  Eigen::Vector3d z = solver.eigenvectors().col(2);
  const double across = std::max(0.0, solver.eigenvalues()[0] + solver.eigenvalues()[1]);
  const double along = solver.eigenvalues()[2];
  const double slope = along_encoder.dot(centred * z) / along_encoder.squaredNorm();
  z *= slope < 0.0 ? -1.0 : 1.0;
  if (!(along > 4.0 * across)) {
    throw NotIdentifiable("the integrated readings do not follow a straight line (" +
                          two_digits(std::sqrt(across / std::max(along, 1e-300))) + " of their extent lies across it); " +
                          what_to_record);
  }
  FittedTest fitted = describe(samples, regression, constant.transpose(), std::abs(slope) * z, options.gravity);
  // The distance from the line taken as fully correlated, a cautious figure.
  fitted.fit.noise_covariance.topLeftCorner<2, 2>() = 0.5 * across / along * Eigen::Matrix2d::Identity();
  fitted.fit.acceleration_scale_std = std::sqrt(across / along);
  fitted.fit.iterations = 1;
  set_sensor_jacobian(fitted, slope_by_sensor(constant.transpose(), std::abs(slope) * z));
  return fitted;
}

}  // namespace circlepoint
