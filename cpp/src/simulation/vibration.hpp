#pragma once
// Structural vibration of the end-point while the arm moves (simulation/simulate.hpp).

#include <array>
#include <cstdint>
#include <vector>

#include "circlepoint/simulation/simulate.hpp"

namespace circlepoint {

class Vibration {
 public:
  Vibration(const VibrationOptions& options, std::uint64_t seed);

  /// Acceleration in the sensor frame, m/s^2. Call in order of time: the direction of motion is followed.
  Eigen::Vector3d at(double time, const Eigen::Vector3d& velocity_sensor, double envelope);

 private:
  struct Component {
    double amplitude, angular_frequency, phase;
  };
  void follow(const Eigen::Vector3d& velocity_sensor);

  std::array<std::vector<Component>, 3> components_;  // tangential and the two orthogonal directions
  Eigen::Vector3d tangent_ = Eigen::Vector3d::UnitX();
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitY();
};

/// (N) between 0 (all joints rest) and 1, by minimum-jerk ramps inside every stretch of motion.
Eigen::VectorXd motion_envelope(const JointTrajectory& trajectory, double ramp);

}  // namespace circlepoint
