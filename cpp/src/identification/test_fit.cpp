#include "test_fit.hpp"

#include <Eigen/LU>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "circlepoint/core/error.hpp"
#include "regression_noise.hpp"

namespace circlepoint {
namespace {

// Residual of the unconstrained regression: the noise to start from, before any model is fitted.
double linear_residual(const Eigen::Ref<const Regressors>& x, const Eigen::Ref<const Samples3>& y, int columns) {
  if (x.rows() == 0) {
    return 0.0;
  }
  const Eigen::MatrixXd used = x.leftCols(columns);
  const Eigen::MatrixXd readings = y;
  const Eigen::MatrixXd coefficients = used.colPivHouseholderQr().solve(readings);
  return residual_rms(readings - used * coefficients, 3.0 * columns);
}

// Rank and condition of the information in units of each parameter's own standard deviation.
void describe_information(TestFit& fit, const Eigen::MatrixXd& information) {
  const Eigen::VectorXd root = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled = root.cwiseInverse().asDiagonal() * information * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
  fit.parameters = joint_model_parameters;
  fit.rank = static_cast<int>((eigenvalues.array() > 1e-12 * eigenvalues[joint_model_parameters - 1]).count());
  fit.condition_number = eigenvalues[joint_model_parameters - 1] / std::max(eigenvalues[0], 1e-300);
}

}  // namespace

void record_fit(TestFit& fit, const TestSamples& samples, const TestRegression& regression, const JointModel& model,
                const Matrix53& coefficients) {
  fit.joint = samples.joint;
  fit.test = samples.test;
  fit.configuration = samples.configuration;
  fit.cutoff = samples.cutoff;
  fit.model = model;
  fit.samples = regression.static_readings.rows() + regression.dynamic_readings.rows();
  fit.time = regression.time;
  fit.position = regression.position;
  fit.measured = regression.dynamic_readings;
  fit.modelled = regression.dynamic_regressors * coefficients;
  fit.dwell_positions = samples.dwell_positions.col(samples.joint);
  fit.dwell_measured = regression.static_readings;
  fit.dwell_modelled = regression.static_regressors * coefficients;
  fit.dwell_noise_std = samples.dwell_floor;
  fit.static_noise_std = std::max(residual_rms(fit.dwell_measured - fit.dwell_modelled, 7.0), samples.dwell_floor);
  fit.dynamic_noise_std = std::max(residual_rms(fit.measured - fit.modelled, 12.0), 1e-6);
}

FittedTest fit_by_regression(const TestSamples& samples, const TestRegression& whole, const JointModelPrior& prior,
                             const TestNoise& noise) {
  if (samples.motions.empty()) {
    throw NotIdentifiable("only still poses of it were found, no motion: they show the axis' direction but not its place; "
                          "record a motion of this joint alone, for example 0.5 Hz over 150 degrees for 6 s");
  }
  TestRegression problem = whole;
  if (noise.kept.size() == problem.dynamic_readings.rows()) {
    problem.dynamic_regressors.array().colwise() *= noise.kept.array();
    problem.dynamic_readings.array().colwise() *= noise.kept.array();
  }
  TestNoise used = noise;
  if (used.static_std <= 0.0) {
    used.static_std = linear_residual(problem.static_regressors, problem.static_readings, 3);
  }
  if (used.dynamic_std <= 0.0) {
    used.dynamic_std = linear_residual(problem.dynamic_regressors, problem.dynamic_readings, 5);
    used.correlation_factor = problem.sample_rate / (4.0 * samples.cutoff);
  }
  used.static_std = std::max({used.static_std, samples.dwell_floor, 1e-6});
  used.dynamic_std = std::max(used.dynamic_std, 1e-6);

  RegressionStatistics at_rest;
  at_rest.add(problem.static_regressors, problem.static_readings);
  RegressionStatistics moving;
  moving.add(problem.dynamic_regressors, problem.dynamic_readings);
  const double static_weight = 1.0 / (used.static_std * used.static_std);
  const double dynamic_weight = 1.0 / (used.dynamic_std * used.dynamic_std * used.correlation_factor);
  RegressionStatistics weighted = at_rest.scaled(static_weight);
  weighted += moving.scaled(dynamic_weight);

  const JointModelFit solution = fit_joint_model(weighted, prior);
  FittedTest fitted;
  record_fit(fitted.fit, samples, whole, solution.model, solution.model.coefficients());
  const Samples3 residual = problem.dynamic_readings - problem.dynamic_regressors * solution.model.coefficients();
  const double kept_share = noise.kept.size() > 0 ? noise.kept.mean() : 1.0;
  fitted.fit.dynamic_noise_std = std::max(residual_rms(residual, 12.0) / std::sqrt(kept_share), 1e-6);
  fitted.fit.knocks = static_cast<Index>(std::lround((1.0 - kept_share) * static_cast<double>(residual.rows())));
  fitted.fit.iterations = solution.iterations;
  fitted.fit.converged = solution.converged;
  describe_information(fitted.fit, solution.data_information);
  fitted.fit.gravity_share = solution.model.gravity.norm() / prior.gravity;

  // Sandwich: static part and prior as assumed, dynamic part as its residuals show. Matrices of dynamic size: written out for
  // twelve and fifteen columns each product takes the compiler seconds and saves nothing.
  const Eigen::MatrixXd jacobian = solution.jacobian;
  const Eigen::MatrixXd score = score_covariance(problem.dynamic_regressors, residual, problem.sample_rate);
  const double variance = fitted.fit.dynamic_noise_std * fitted.fit.dynamic_noise_std;
  fitted.noise = {fitted.fit.static_noise_std, fitted.fit.dynamic_noise_std,
                  correlation_factor(score, moving.information, variance),
                  without_knocks(fitted.fit.measured - fitted.fit.modelled,
                                 static_cast<Index>(std::lround(0.5 * problem.sample_rate / samples.cutoff)))};
  fitted.fit.correlation_factor = fitted.noise.correlation_factor;
  Eigen::MatrixXd excess = dynamic_weight * dynamic_weight * score;  // of the scores, above what was assumed
  for (int channel = 0; channel < 3; ++channel) {
    excess.block<5, 5>(5 * channel, 5 * channel) -= dynamic_weight * moving.information;
  }
  const Eigen::MatrixXd information = solution.information;
  const Eigen::MatrixXd inverse = information.inverse();
  const Eigen::MatrixXd meat = information + jacobian.transpose() * excess * jacobian;
  const Eigen::MatrixXd covariance = inverse * meat * inverse;
  const Eigen::MatrixXd selector = JointModelFit::line_selector();
  fitted.fit.noise_covariance = selector * covariance * selector.transpose();
  fitted.fit.percussion_distance_std = covariance.diagonal().tail<3>().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd square_score =
      static_weight * problem.static_regressors.transpose() * problem.static_readings.cwiseAbs2() +
      dynamic_weight * problem.dynamic_regressors.transpose() * problem.dynamic_readings.cwiseAbs2();
  const Eigen::MatrixXd by_sensor =
      inverse * jacobian.transpose() * score_by_sensor(weighted.information, weighted.score, square_score);
  fitted.sensor_jacobian = selector * by_sensor;
  fitted.percussion_jacobian = by_sensor.bottomRows<3>();
  return fitted;
}

}  // namespace circlepoint
