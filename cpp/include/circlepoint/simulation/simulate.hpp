#pragma once
// What a real arm and a real sensor would have recorded of a motion.
//
//   reading = clip(sensor(f(theta) + vibration, w) + drift + noise)
//   encoder = round(theta counts / 2 pi) 2 pi / counts
//
// with f and w of the product of exponentials (chain/screw_chain) at the joints' actual positions theta:
//
//   theta_j = q_j + compliance_j z_j . (r_j x g)       (prismatic: compliance_j z_j . g)
//
// q is the commanded trajectory, z_j the axis, r_j the vector from the axis to the sensor and g = -up_gravity: each
// joint gives way to the weight of a unit mass at the sensor, as a position loop without integral action does
// (milliradians). Encoders see theta. Its derivatives follow the trajectory's own: theta is evaluated along
// q + q_dot h + q_ddot h^2 / 2 at h = 0 and +-1 ms and differenced, which is exact up to h^2 / 12 times its fourth
// derivative (1e-7 rad/s^2 for milliradians at 1 Hz), has no edges and does not mix samples across a step of the
// acceleration.
//
// Vibration is what the paper's section 4 adds: sinusoids of random frequency and phase along the sensor's direction of
// motion and along the two directions orthogonal to it, the root sum of squares of the components' amplitudes in each
// direction being the stated amplitude. It fades in when a joint starts to move and out before all rest. Encoders and
// angular velocity do not see it. The direction of motion keeps its sign through a turning point, so that the sinusoids
// keep their phase.
//
// Joints held by a loop follow q late and ring (simulation/held_joints): that motion then takes the place of q.
//
// With `acquisition`, the trajectory is given at the analogue rate, and what lies between the sensor and the log is
// simulated too (simulation/acquisition); noise_std is then white noise per recorded sample from the surroundings.
//
// The same seed gives the same bytes; every kind of noise has a stream of its own, so that switching one on does not
// change another.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/recording/recording.hpp"
#include "circlepoint/sensor/accelerometer.hpp"
#include "circlepoint/simulation/acquisition.hpp"
#include "circlepoint/simulation/excitation.hpp"
#include "circlepoint/simulation/held_joints.hpp"

namespace circlepoint {

struct VibrationOptions {
  double tangential_amplitude = 0.0;  ///< m/s^2, along the sensor's direction of motion (the paper: 0.1)
  double orthogonal_amplitude = 0.0;  ///< m/s^2, along each of the two other directions (the paper: 0.01)
  double frequency_min = 10.0;        ///< Hz
  double frequency_max = 60.0;        ///< Hz, below half the sample rate
  Index components = 5;               ///< sinusoids a direction
  double ramp = 0.1;                  ///< s of fading in and out
};

struct SimulationOptions {
  double noise_std = 0.0;      ///< m/s^2, white, per sample
  double range = 0.0;          ///< m/s^2, readings clip at +-range; 0: no clipping
  Eigen::VectorXd encoder_counts_per_revolution{};  ///< (n), 0: exact; empty: all exact; prismatic are always exact
  Eigen::Vector3d bias_drift = Eigen::Vector3d::Zero();  ///< m/s^2, reached linearly from 0 over the recording
  Eigen::VectorXd compliance{};  ///< (n) rad per m^2/s^2 (prismatic: m per m/s^2); empty: rigid
  VibrationOptions vibration{};
  std::uint64_t seed = 0;
  HeldJoints held_joints{};
  std::optional<TemperatureProfile> temperature{};   ///< of the sensor, recorded; none: at its reference, not recorded
  std::optional<double> angular_velocity_noise_std{};  ///< rad/s, white, per sample of a gyroscope; none: no gyroscope
  std::optional<AcquisitionOptions> acquisition{};
};

/// The recording of a trajectory. `up_gravity_sensor` (m/s^2) is what an ideal sensor reads at rest at the chain's
/// reference configuration. Raises InvalidInput where sizes do not match the chain or an option is out of its range.
Recording simulate(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_sensor, const AccelerometerModel& sensor,
                   const JointTrajectory& trajectory, const SimulationOptions& options = {});

}  // namespace circlepoint
