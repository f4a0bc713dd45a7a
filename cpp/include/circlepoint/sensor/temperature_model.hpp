#pragma once
// How bias and scale factor follow the sensor's temperature: third-order polynomials about a reference temperature T0,
// as a servo accelerometer's calibration sheet gives them, (M14) of docs/method:
//
//   bias_k(T)  = bias_k  + sum_p bias(k, p)  (T - T0)^(p + 1)
//   scale_k(T) = scale_k + sum_p scale(k, p) (T - T0)^(p + 1),      p = 0, 1, 2
//
// T is what the sensor's internal thermometer reads. Outside the range the sheet was fitted over, a cubic is no law of
// nature: the model extrapolates without a word.

#include <Eigen/Core>

namespace circlepoint {

struct TemperatureModel {
  double reference = 25.0;                            ///< degrees Celsius, T0
  Eigen::Matrix3d bias = Eigen::Matrix3d::Zero();     ///< row k channel k: m/s^2 per degC, degC^2, degC^3
  Eigen::Matrix3d scale = Eigen::Matrix3d::Zero();    ///< row k channel k: 1 per degC, degC^2, degC^3

  /// Change of the bias from T0 to `temperature` (degrees Celsius), m/s^2.
  [[nodiscard]] Eigen::Vector3d bias_change(double temperature) const;
  /// Change of the relative scale-factor error from T0 to `temperature`.
  [[nodiscard]] Eigen::Vector3d scale_change(double temperature) const;
};

}  // namespace circlepoint
