#include "vibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

// Below these a joint rests and the sensor has no direction of motion.
constexpr double resting_rate = 1e-9;   // rad/s or m/s, and per second of acceleration
constexpr double resting_speed = 1e-9;  // m/s

double smooth_step(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * c * (10.0 + c * (6.0 * c - 15.0));
}

}  // namespace

Vibration::Vibration(const VibrationOptions& options, std::uint64_t seed) {
  RandomSource random(seed);
  for (std::size_t direction = 0; direction < 3; ++direction) {
    const double amplitude = direction == 0 ? options.tangential_amplitude : options.orthogonal_amplitude;
    double sum_of_squares = 0.0;
    for (Index k = 0; k < options.components; ++k) {
      const double weight = random.uniform(0.5, 1.0);
      const double frequency = random.uniform(options.frequency_min, options.frequency_max);
      const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      components_[direction].push_back({weight, 2.0 * std::numbers::pi * frequency, phase});
      sum_of_squares += weight * weight;
    }
    for (Component& component : components_[direction]) {
      component.amplitude *= amplitude / std::sqrt(sum_of_squares);
    }
    if (amplitude == 0.0) {
      components_[direction].clear();
    }
  }
}

void Vibration::follow(const Eigen::Vector3d& velocity_sensor) {
  const double speed = velocity_sensor.norm();
  if (speed < resting_speed) {
    return;
  }
  const Eigen::Vector3d direction = velocity_sensor / speed;
  tangent_ = direction.dot(tangent_) < 0.0 ? Eigen::Vector3d(-direction) : direction;
  const Eigen::Vector3d carried = normal_ - tangent_ * tangent_.dot(normal_);
  normal_ = carried.norm() > 0.1 ? carried.normalized() : Eigen::Vector3d(tangent_basis(tangent_).col(0));
}

Eigen::Vector3d Vibration::at(double time, const Eigen::Vector3d& velocity_sensor, double envelope) {
  if (envelope == 0.0) {
    return Eigen::Vector3d::Zero();
  }
  follow(velocity_sensor);
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (std::size_t direction = 0; direction < 3; ++direction) {
    for (const Component& component : components_[direction]) {
      along[static_cast<Index>(direction)] +=
          component.amplitude * std::sin(component.angular_frequency * time + component.phase);
    }
  }
  return envelope * (along[0] * tangent_ + along[1] * normal_ + along[2] * tangent_.cross(normal_));
}

Eigen::VectorXd motion_envelope(const JointTrajectory& trajectory, double ramp) {
  const Index samples = trajectory.samples();
  Eigen::VectorXd envelope = Eigen::VectorXd::Zero(samples);
  const auto moves = [&trajectory](Index i) {
    // At a turning point only the acceleration tells that the arm is under way.
    return trajectory.velocity.row(i).lpNorm<Eigen::Infinity>() > resting_rate ||
           trajectory.acceleration.row(i).lpNorm<Eigen::Infinity>() > resting_rate;
  };
  for (Index begin = 0; begin < samples; ++begin) {
    if (!moves(begin)) {
      continue;
    }
    Index end = begin;
    while (end < samples && moves(end)) {
      ++end;
    }
    const double first = trajectory.time[begin];
    const double last = trajectory.time[end - 1];
    const double fade = std::min(ramp, 0.5 * (last - first));
    for (Index i = begin; fade > 0.0 && i < end; ++i) {
      const double t = trajectory.time[i];
      envelope[i] = smooth_step((t - first) / fade) * smooth_step((last - t) / fade);
    }
    begin = end;
  }
  return envelope;
}

}  // namespace circlepoint
