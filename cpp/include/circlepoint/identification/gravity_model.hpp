#pragma once
// What the resting sensor reads as one joint turns: f(angle) = A + B cos(angle) + C sin(angle), per channel.
//
// It is up-gravity (-g) plus bias, so subtracting it from dynamic samples removes both (paper eq. 4-5 with the erratum of
// docs/method). Linear least squares; needs three distinct angles.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct GravityModel {
  Eigen::Vector3d constant = Eigen::Vector3d::Zero();  ///< A, m/s^2
  Eigen::Vector3d cosine = Eigen::Vector3d::Zero();    ///< B, m/s^2
  Eigen::Vector3d sine = Eigen::Vector3d::Zero();      ///< C, m/s^2
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (A, B, C) of one channel, (m/s^2)^2
  double residual_std = 0.0;                             ///< m/s^2

  /// Specific force at each angle (rad), (N, 3) m/s^2.
  [[nodiscard]] Samples3 evaluate(const Eigen::Ref<const Eigen::VectorXd>& angle) const;
};

/// angle: (N) rad; specific_force: (N, 3) m/s^2, means of static dwells. Raises InvalidInput on unequal lengths and
/// NotIdentifiable with fewer than three distinct angles.
GravityModel fit_gravity_model(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force);

}  // namespace circlepoint
