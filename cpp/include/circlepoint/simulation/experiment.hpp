#pragma once
// An experiment as often as one likes: each time another individual of the sensor's kind, on another individual of the arm.
//
// What is the same every time: the arm as drawn, the kind of sensor, the motion, the amounts of noise. What a seed draws:
//
//   stream 0   the sensor: its errors, and its calibration sheet (sensor/calibrated_accelerometer)
//   stream 1   the recording's noise, vibration and what else `simulate` draws
//   stream 2   the arm: every line displaced by normal local coordinates of these standard deviations, (d1, d2, p1, p2)
//   stream 3   where within `start_spread` each joint's motion begins: encoders then round differently every time
//
// Without an acquisition the readings are those already corrected by the sheet. With one, they are the individual's own, and
// corrected in the program where `corrected` says so.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "circlepoint/sensor/accelerometer.hpp"
#include "circlepoint/simulation/simulate.hpp"

namespace circlepoint {

/// What is common to all repetitions.
struct Experiment {
  ScrewChain chain;                  ///< as drawn; base frame = sensor frame at the reference configuration
  Eigen::Vector3d up_gravity_sensor = Eigen::Vector3d(0.0, 0.0, standard_gravity);  ///< m/s^2, at rest there
  AccelerometerSpecification sensor;  ///< the kind
  JointTrajectory trajectory;
  SimulationOptions simulation;      ///< its seed and its acquisition's sheet are drawn anew
  bool corrected = true;             ///< with an acquisition: readings corrected by the sensor's sheet
  double direction_std = 0.0;        ///< rad, of each of a built arm's lines in d1 and in d2
  double point_std = 0.0;            ///< m, of each of a built arm's lines in p1 and in p2
  Eigen::VectorXd start_spread{};    ///< (n) rad or m, joints start up to this beyond the trajectory; empty: where it says
};

/// One repetition: what was recorded, and what is true of it.
struct SimulatedExperiment {
  Recording recording;
  ScrewChain chain;                          ///< of the arm as built
  Eigen::Vector3d up_gravity_sensor;         ///< m/s^2, at rest at the chain's reference configuration
  AccelerometerModel sensor;                 ///< as its readings are recorded
  std::optional<AccelerometerModel> sheet;   ///< its calibration sheet, with an acquisition
};

/// The repetition a seed stands for: the same seed gives the same bytes. Raises InvalidInput as `simulate` does, for standard
/// deviations below zero, and for a start_spread that is not one a joint.
SimulatedExperiment simulate_experiment(const Experiment& experiment, std::uint64_t seed);

}  // namespace circlepoint
