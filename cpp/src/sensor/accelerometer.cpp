#include "circlepoint/sensor/accelerometer.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// D_k (|w|^2 - w_k^2): centripetal acceleration between the origin and each channel's centre of percussion.
Eigen::Vector3d percussion_term(const AccelerometerModel& model, const Eigen::Vector3d& w) {
  return model.percussion_distance.cwiseProduct(
      Eigen::Vector3d(w.y() * w.y() + w.z() * w.z(), w.x() * w.x() + w.z() * w.z(), w.x() * w.x() + w.y() * w.y()));
}

struct NoInverse {
  Index channel;
  double value;
};

// The reading without bias, scale and second-order error: u of the header, or the channel that has none.
std::optional<NoInverse> undo_channels(const AccelerometerModel& model, const Eigen::Vector3d& reading,
                                       Eigen::Vector3d& u) {
  for (Index k = 0; k < 3; ++k) {
    const double gain = 1.0 + model.scale[k];
    const double v = reading[k] - model.bias[k];
    const double discriminant = gain * gain + 4.0 * model.second_order[k] * v;
    if (!(gain > 0.0) || discriminant < 0.0) {
      return NoInverse{k, reading[k]};
    }
    u[k] = 2.0 * v / (gain + std::sqrt(discriminant));
  }
  return std::nullopt;
}

std::string no_inverse_message(const NoInverse& failure, const AccelerometerModel& model, const std::string& where) {
  return "no specific force gives the reading " + std::to_string(failure.value) + " m/s^2 of channel " +
         std::to_string(failure.channel) + where + " with scale " + std::to_string(model.scale[failure.channel]) +
         " and second_order " + std::to_string(model.second_order[failure.channel]) +
         " s^2/m; check the units of the readings and of the sensor's model";
}

void require_same_rows(const Eigen::Ref<const Samples3>& samples, const char* name,
                       const Eigen::Ref<const Samples3>& angular_velocity) {
  if (samples.rows() != angular_velocity.rows()) {
    throw InvalidInput(std::string(name) + " has " + std::to_string(samples.rows()) +
                       " samples and angular_velocity has " + std::to_string(angular_velocity.rows()) +
                       "; give one angular velocity a sample");
  }
}

void require_temperatures(Index samples, const Eigen::Ref<const Eigen::VectorXd>& temperature) {
  require(temperature.size() == samples, "temperature has " + std::to_string(temperature.size()) + " values for " +
                                             std::to_string(samples) + " samples; give one a sample");
  for (Index i = 0; i < samples; ++i) {
    require(std::isfinite(temperature[i]), "temperature of row " + std::to_string(i) + " is " +
                                               std::to_string(temperature[i]) + "; give degrees Celsius");
  }
}

void require_scale_factor(double current_scale_factor) {
  require(std::isfinite(current_scale_factor) && current_scale_factor > 0.0,
          "current_scale_factor is " + std::to_string(current_scale_factor) + " A s^2/m; give a positive number");
}

}  // namespace

AccelerometerModel AccelerometerModel::at(double degrees) const {
  require(std::isfinite(degrees), "the temperature is " + std::to_string(degrees) + "; give degrees Celsius");
  AccelerometerModel held = *this;
  held.bias += temperature.bias_change(degrees);
  held.scale += temperature.scale_change(degrees);
  held.temperature = TemperatureModel{.reference = degrees};
  return held;
}

Eigen::Matrix3d AccelerometerModel::misalignment_matrix() const {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(1, 0) = misalignment[0];
  matrix(2, 0) = misalignment[1];
  matrix(2, 1) = misalignment[2];
  return matrix;
}

Eigen::Vector3d AccelerometerModel::measure(const Eigen::Vector3d& specific_force,
                                            const Eigen::Vector3d& angular_velocity) const {
  const Eigen::Vector3d u = misalignment_matrix() * (specific_force - percussion_term(*this, angular_velocity));
  return u + scale.cwiseProduct(u) + second_order.cwiseProduct(u.cwiseAbs2()) + bias;
}

Eigen::Vector3d AccelerometerModel::correct(const Eigen::Vector3d& reading,
                                            const Eigen::Vector3d& angular_velocity) const {
  Eigen::Vector3d u;
  if (const auto failure = undo_channels(*this, reading, u)) {
    throw InvalidInput(no_inverse_message(*failure, *this, ""));
  }
  const Eigen::Vector3d aligned = misalignment_matrix().triangularView<Eigen::UnitLower>().solve(u);
  return aligned + percussion_term(*this, angular_velocity);
}

Samples3 measure(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& specific_force,
                 const Eigen::Ref<const Samples3>& angular_velocity) {
  require_same_rows(specific_force, "specific_force", angular_velocity);
  Samples3 reading(specific_force.rows(), 3);
  for (Index i = 0; i < reading.rows(); ++i) {
    reading.row(i) = model.measure(specific_force.row(i), angular_velocity.row(i));
  }
  return reading;
}

Samples3 correct(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& reading,
                 const Eigen::Ref<const Samples3>& angular_velocity) {
  require_same_rows(reading, "reading", angular_velocity);
  Samples3 specific_force(reading.rows(), 3);
  const Eigen::Matrix3d alignment = model.misalignment_matrix().inverse();
  for (Index i = 0; i < reading.rows(); ++i) {
    Eigen::Vector3d u;
    if (const auto failure = undo_channels(model, reading.row(i), u)) {
      throw InvalidInput(no_inverse_message(*failure, model, ", row " + std::to_string(i) + ","));
    }
    specific_force.row(i) = alignment * u + percussion_term(model, angular_velocity.row(i));
  }
  return specific_force;
}

Samples3 measure(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& specific_force,
                 const Eigen::Ref<const Samples3>& angular_velocity,
                 const Eigen::Ref<const Eigen::VectorXd>& temperature) {
  require_same_rows(specific_force, "specific_force", angular_velocity);
  require_temperatures(specific_force.rows(), temperature);
  Samples3 reading(specific_force.rows(), 3);
  for (Index i = 0; i < reading.rows(); ++i) {
    reading.row(i) = model.at(temperature[i]).measure(specific_force.row(i), angular_velocity.row(i));
  }
  return reading;
}

Samples3 correct(const AccelerometerModel& model, const Eigen::Ref<const Samples3>& reading,
                 const Eigen::Ref<const Samples3>& angular_velocity,
                 const Eigen::Ref<const Eigen::VectorXd>& temperature) {
  require_same_rows(reading, "reading", angular_velocity);
  require_temperatures(reading.rows(), temperature);
  Samples3 specific_force(reading.rows(), 3);
  for (Index i = 0; i < reading.rows(); ++i) {
    Eigen::Vector3d u;
    const AccelerometerModel held = model.at(temperature[i]);
    if (const auto failure = undo_channels(held, reading.row(i), u)) {
      throw InvalidInput(no_inverse_message(*failure, held, ", row " + std::to_string(i) + ","));
    }
    specific_force.row(i) = held.misalignment_matrix().triangularView<Eigen::UnitLower>().solve(u) +
                            percussion_term(held, angular_velocity.row(i));
  }
  return specific_force;
}

Samples3 output_current(const Eigen::Ref<const Samples3>& reading, double current_scale_factor) {
  require_scale_factor(current_scale_factor);
  return reading * current_scale_factor;
}

Samples3 reading_from_current(const Eigen::Ref<const Samples3>& current, double current_scale_factor) {
  require_scale_factor(current_scale_factor);
  return current / current_scale_factor;
}

AccelerometerModel draw_accelerometer(const AccelerometerSpecification& specification, std::uint64_t seed) {
  const auto require_std = [](double value, const char* name) {
    require(std::isfinite(value) && value >= 0.0,
            std::string(name) + " is " + std::to_string(value) + "; a standard deviation is finite and not negative");
  };
  require_std(specification.bias_std, "bias_std");
  require_std(specification.scale_std, "scale_std");
  require_std(specification.misalignment_std, "misalignment_std");
  require_std(specification.percussion_distance_std, "percussion_distance_std");
  require_std(specification.second_order_std, "second_order_std");
  RandomSource random(seed);
  const auto draw = [&random](double nominal, double std) {
    Eigen::Vector3d value;
    for (Index k = 0; k < 3; ++k) {
      value[k] = nominal + std * random.normal();
    }
    return value;
  };
  AccelerometerModel model;
  model.bias = draw(0.0, specification.bias_std);
  model.scale = draw(0.0, specification.scale_std);
  model.misalignment = draw(0.0, specification.misalignment_std);
  model.percussion_distance = draw(specification.percussion_distance, specification.percussion_distance_std);
  model.second_order = draw(0.0, specification.second_order_std);
  return model;
}

}  // namespace circlepoint
