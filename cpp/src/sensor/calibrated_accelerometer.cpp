#include "circlepoint/sensor/calibrated_accelerometer.hpp"

#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr std::uint64_t sheet_stream = 1;

void require_stds(const Eigen::Ref<const Eigen::VectorXd>& values, const char* name) {
  require(values.allFinite() && (values.array() >= 0.0).all(),
          std::string(name) + " holds a value that is negative or not finite; a standard deviation is neither");
}

Eigen::Vector3d draw(RandomSource& random, double std) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return std * Eigen::Vector3d(x, y, z);
}

}  // namespace

CalibratedAccelerometer draw_calibrated_accelerometer(const AccelerometerSpecification& specification,
                                                      std::uint64_t seed) {
  const UncorrectedErrors& errors = specification.uncorrected;
  require_stds(Eigen::Vector2d(errors.bias_std, errors.scale_std), "bias_std or scale_std of the uncorrected errors");
  require_stds(errors.bias_temperature_std, "bias_temperature_std");
  require_stds(errors.scale_temperature_std, "scale_temperature_std");
  require(std::isfinite(errors.reference_temperature),
          "reference_temperature is " + std::to_string(errors.reference_temperature) + "; give degrees Celsius");

  CalibratedAccelerometer sensor;
  sensor.residual = draw_accelerometer(specification, seed);
  RandomSource random(derive_seed(seed, sheet_stream));
  AccelerometerModel& sheet = sensor.sheet;
  sheet.bias = draw(random, errors.bias_std);
  sheet.scale = draw(random, errors.scale_std);
  sheet.temperature.reference = errors.reference_temperature;
  for (Index power = 0; power < 3; ++power) {
    sheet.temperature.bias.col(power) = draw(random, errors.bias_temperature_std[power]);
    sheet.temperature.scale.col(power) = draw(random, errors.scale_temperature_std[power]);
  }

  const Eigen::Array3d gain = 1.0 + sheet.scale.array();
  sensor.actual = sensor.residual;
  sensor.actual.bias = sheet.bias.array() + gain * sensor.residual.bias.array();
  sensor.actual.scale = gain * (1.0 + sensor.residual.scale.array()) - 1.0;
  sensor.actual.second_order = gain * sensor.residual.second_order.array();
  sensor.actual.temperature = sheet.temperature;
  sensor.residual.temperature.reference = errors.reference_temperature;
  return sensor;
}

}  // namespace circlepoint
