#include "circlepoint/sensor/temperature_model.hpp"

namespace circlepoint {
namespace {

Eigen::Vector3d polynomial(const Eigen::Matrix3d& coefficients, double x) {
  return x * (coefficients.col(0) + x * (coefficients.col(1) + x * coefficients.col(2)));
}

}  // namespace

Eigen::Vector3d TemperatureModel::bias_change(double temperature) const {
  return polynomial(bias, temperature - reference);
}

Eigen::Vector3d TemperatureModel::scale_change(double temperature) const {
  return polynomial(scale, temperature - reference);
}

}  // namespace circlepoint
