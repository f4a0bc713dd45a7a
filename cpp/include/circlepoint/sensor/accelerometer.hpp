#pragma once
// Triaxial accelerometer: one model, used to simulate and to correct.
//
//   y_k = (1 + scale_k) u_k + second_order_k u_k^2 + bias_k (+ noise),      u = M (f - D (|w|^2 - w_k^2))
//
// f: specific force at the frame's origin (m/s^2), w: angular velocity (rad/s), both in the sensor frame; the bracket is
// taken channel by channel. Channel k measures at distance D_k along its own axis (centre of percussion; the centripetal
// term is eq. (10) of Canepa 1994 with its sign, the tangential term vanishes). M is unit lower triangular
// (misalignment: yx, zx, zy), which fixes the frame: x along the first sensitive axis, y in the plane of the first two.
// Bias and scale are those at the temperature model's reference and follow its polynomials elsewhere
// (sensor/temperature_model); without a temperature the sensor is at its reference.
//
// `correct` is the exact inverse on the branch through zero: u_k = 2 v / (g + sqrt(g^2 + 4 second_order v)) with
// g = 1 + scale_k > 0 and v = y_k - bias_k. It fails where the parabola never reaches the reading, which no instrument's
// second-order term does within its range (QA700: 5e-6 s^2/m against 1 / 300 s^2/m), and for a channel with g <= 0.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/sensor/band_noise.hpp"
#include "circlepoint/sensor/frequency_response.hpp"
#include "circlepoint/sensor/temperature_model.hpp"

namespace circlepoint {

struct AccelerometerModel {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();                 ///< m/s^2
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();                ///< relative scale-factor error, 1
  Eigen::Vector3d misalignment = Eigen::Vector3d::Zero();         ///< (yx, zx, zy), rad
  Eigen::Vector3d percussion_distance = Eigen::Vector3d::Zero();  ///< m, along each channel's axis
  Eigen::Vector3d second_order = Eigen::Vector3d::Zero();         ///< s^2/m
  TemperatureModel temperature{};                                 ///< of bias and scale

  /// The same sensor held at a temperature (degrees Celsius), which becomes its reference: bias and scale are those
  /// there. Raises InvalidInput for a temperature that is not finite.
  [[nodiscard]] AccelerometerModel at(double degrees) const;
  /// M, unit lower triangular.
  [[nodiscard]] Eigen::Matrix3d misalignment_matrix() const;
  /// What the sensor reads, without noise.
  [[nodiscard]] Eigen::Vector3d measure(const Eigen::Vector3d& specific_force,
                                        const Eigen::Vector3d& angular_velocity) const;
  /// The specific force that was read: the inverse of measure. Raises InvalidInput where there is none.
  [[nodiscard]] Eigen::Vector3d correct(const Eigen::Vector3d& reading, const Eigen::Vector3d& angular_velocity) const;
};

/// What the sensor reads at every sample, without noise: (N, 3) m/s^2 from specific force and angular velocity (N, 3).
/// Raises InvalidInput when the two have different numbers of samples.
Samples3 measure(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& specific_force,
                 const Eigen::Ref<const Samples3>& angular_velocity);

/// The specific force behind every reading. Raises InvalidInput for different numbers of samples and for a reading that
/// the model cannot produce (named by its row).
Samples3 correct(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& reading,
                 const Eigen::Ref<const Samples3>& angular_velocity);

/// The same at a temperature (N) in degrees Celsius for each sample. Raises InvalidInput as above, for another number of
/// temperatures, and for one that is not finite.
Samples3 measure(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& specific_force,
                 const Eigen::Ref<const Samples3>& angular_velocity, const Eigen::Ref<const Eigen::VectorXd>& temperature);
Samples3 correct(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& reading,
                 const Eigen::Ref<const Samples3>& angular_velocity, const Eigen::Ref<const Eigen::VectorXd>& temperature);

/// The current (A) a servo accelerometer gives out, reading x current_scale_factor (A s^2/m), and the reading (m/s^2)
/// behind a current. Both raise InvalidInput unless the scale factor is positive.
Samples3 output_current(const Eigen::Ref<const Samples3>& reading, double current_scale_factor);
Samples3 reading_from_current(const Eigen::Ref<const Samples3>& current, double current_scale_factor);

/// Standard deviations of what a sensor's own calibration sheet corrects: the errors before it is applied.
struct UncorrectedErrors {
  double bias_std = 0.0;                                                  ///< m/s^2
  double scale_std = 0.0;                                                 ///< 1, of the current scale factor
  Eigen::Vector3d bias_temperature_std = Eigen::Vector3d::Zero();         ///< m/s^2 per degC, degC^2, degC^3
  Eigen::Vector3d scale_temperature_std = Eigen::Vector3d::Zero();        ///< 1 per degC, degC^2, degC^3
  double reference_temperature = 25.0;                                    ///< degC
};

/// What a data sheet says of a sensor's kind: standard deviations of the individual errors around nominal values, after
/// the correction by the sensor's own calibration sheet. The first eight figures are the estimators' prior; all are the
/// simulator's source of individual sensors.
struct AccelerometerSpecification {
  double bias_std = 0.0;                 ///< m/s^2
  double scale_std = 0.0;                ///< 1
  double misalignment_std = 0.0;         ///< rad
  double percussion_distance = 0.0;      ///< m, nominal
  double percussion_distance_std = 0.0;  ///< m
  double second_order_std = 0.0;         ///< s^2/m
  double noise_std = 0.0;                ///< m/s^2 per sample
  double range = 0.0;                    ///< m/s^2, readings clip at +-range; 0: no clipping
  double resolution = 0.0;               ///< m/s^2, the smallest change that shows; 0: any
  double current_scale_factor = 0.0;     ///< A s^2/m, nominal; 0: no current output
  UncorrectedErrors uncorrected{};
  std::vector<NoiseBand> noise_bands{};        ///< of the sensor itself
  std::vector<ResponseBand> response_bands{};  ///< of its gain
};

/// One individual sensor of a kind, drawn with the given seed: the same seed draws the same sensor everywhere.
/// Raises InvalidInput for a standard deviation that is negative or not finite.
AccelerometerModel draw_accelerometer(const AccelerometerSpecification& specification, std::uint64_t seed);

}  // namespace circlepoint
