#pragma once
// The sensor's static errors from the magnitude of gravity: no orientation needs to be known.
//
// At rest |f| = g whatever the pose, so each dwell gives, to first order with u the unit reading,
//   |y| - g = u . bias + g sum_k scale_k u_k^2 + g (m_yx u_x u_y + m_zx u_x u_z + m_zy u_y u_z)
//             + g^2 sum_k second_order_k u_k^3 + noise.
// Linear in twelve unknowns with a Gaussian prior from the sensor's specification. With `adapt_prior` the prior's common
// factor, and always the dwells' own noise, are set by the evidence (empirical Bayes): a quiet reading of |f| = g at many
// attitudes means a good sensor, and its intervals shrink; few attitudes leave the prior in place. What the attitudes
// do not reach stays as wide as the prior says.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"
#include "circlepoint/sensor/accelerometer.hpp"

namespace circlepoint {

/// Static errors of a sensor: bias, scale, misalignment, second order; three each, in this order.
inline constexpr int sensor_errors = 12;
using SensorErrorMatrix = Eigen::Matrix<double, sensor_errors, sensor_errors>;

struct SensorFromGravity {
  AccelerometerModel sensor;  ///< bias, scale, misalignment and second-order estimates
  SensorErrorMatrix covariance = SensorErrorMatrix::Zero();  ///< of (bias, scale, misalignment, second order)
  double prior_factor = 1.0;                ///< of the specification's standard deviations
  double noise_std = 0.0;                   ///< m/s^2, of a dwell's magnitude
  double residual_rms = 0.0;                ///< m/s^2
};

/// dwell_specific_force: (K, 3) m/s^2, means of dwells. gravity: m/s^2. Zero dwells return the prior.
/// dwell_noise_std: m/s^2, noise of a dwell's mean by the scatter of its own samples; the evidence may find more than it,
/// never less: hardly more dwells than unknowns fit any noise, none at all included.
SensorFromGravity fit_sensor_from_gravity(const Eigen::Ref<const Samples3>& dwell_specific_force,
                                          const AccelerometerSpecification& specification, double gravity, bool adapt_prior,
                                          double dwell_noise_std = 0.0);

}  // namespace circlepoint
