#pragma once
// Triaxial accelerometer: one model, used to simulate and to correct.
//
//   y = (1 + scale) * M (f - D (|w|^2 - w_k^2)) + second_order * (.)^2 + bias + noise
//
// f: specific force at the frame's origin (m/s^2), w: angular velocity (rad/s), both in the sensor frame. Channel k
// measures at distance D_k along its own axis (centre of percussion; the centripetal term is eq. (10) of Canepa 1994 with
// its sign, the tangential term vanishes). M is unit lower triangular (misalignment: yx, zx, zy), which fixes the frame:
// x along the first sensitive axis, y in the plane of the first two.

#include <Eigen/Core>
#include <cstdint>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct AccelerometerModel {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();                 ///< m/s^2
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();                ///< relative scale-factor error, 1
  Eigen::Vector3d misalignment = Eigen::Vector3d::Zero();         ///< (yx, zx, zy), rad
  Eigen::Vector3d percussion_distance = Eigen::Vector3d::Zero();  ///< m, along each channel's axis
  Eigen::Vector3d second_order = Eigen::Vector3d::Zero();         ///< s^2/m

  /// M, unit lower triangular.
  [[nodiscard]] Eigen::Matrix3d misalignment_matrix() const;
  /// What the sensor reads, without noise.
  [[nodiscard]] Eigen::Vector3d measure(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& angular_velocity) const;
  /// The specific force that was read: the inverse of measure (one fixed-point pass for the second-order term).
  [[nodiscard]] Eigen::Vector3d correct(const Eigen::Vector3d& reading, const Eigen::Vector3d& angular_velocity) const;
};

/// What a data sheet says of a sensor's kind: standard deviations of the individual errors around nominal values.
/// It is the estimators' prior and the simulator's source of individual sensors.
struct AccelerometerSpecification {
  double bias_std = 0.0;                 ///< m/s^2
  double scale_std = 0.0;                ///< 1
  double misalignment_std = 0.0;         ///< rad
  double percussion_distance = 0.0;      ///< m, nominal
  double percussion_distance_std = 0.0;  ///< m
  double second_order_std = 0.0;         ///< s^2/m
  double noise_std = 0.0;                ///< m/s^2 per sample
  double range = 0.0;                    ///< m/s^2, readings clip at +-range; 0: no clipping
};

/// One individual sensor of a kind, drawn with the given seed.
AccelerometerModel draw_accelerometer(const AccelerometerSpecification& specification, std::uint64_t seed);

}  // namespace circlepoint
