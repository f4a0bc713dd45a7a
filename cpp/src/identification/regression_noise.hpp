#pragma once
// What the residuals of a test's regression say of its noise, and what the sensor's static errors do to its normal equations.
// P regressors, three channels; stacked quantities hold the P coefficients of channel x, then y, then z.

#include "circlepoint/identification/sensor_from_gravity.hpp"

namespace circlepoint {

// Root mean square with that many parameters fitted to the residuals.
double residual_rms(const Eigen::Ref<const Samples3>& residual, double parameters);

// Covariance (3P, 3P) of the stacked sum x r^T from sums over blocks: residuals may be correlated within a block of 0.25 s
// and across channels.
Eigen::MatrixXd score_covariance(const Eigen::Ref<const SamplesX>& x, const Eigen::Ref<const Samples3>& residual, double sample_rate);

// How much wider sums of these residuals are than white noise of the same variance would make them.
double correlation_factor(const Eigen::MatrixXd& score_covariance, const Eigen::MatrixXd& information, double variance);

// 1 for samples to keep, 0 around knocks: residuals beyond six robust standard deviations of their channel, and `margin`
// samples either side. Where more than a fifth would go they are no knocks but the model's failure, and all are kept.
Eigen::VectorXd without_knocks(const Eigen::Ref<const Samples3>& residual, Index margin);

// Derivative (3P, sensor_errors) of the stacked score sum x y^T by the sensor's bias, scale, misalignment and second-order
// errors: the readings are linear in them. `square_score` is sum x y_k^2, weighted alike; the first regressor is 1.
Eigen::MatrixXd score_by_sensor(const Eigen::MatrixXd& information, const Eigen::MatrixXd& score, const Eigen::MatrixXd& square_score);

}  // namespace circlepoint
