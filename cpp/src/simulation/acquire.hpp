#pragma once
// The acquisition chain behind the sensor (simulation/acquisition.hpp).

#include <cstdint>

#include "circlepoint/recording/recording.hpp"
#include "circlepoint/simulation/acquisition.hpp"

namespace circlepoint {

/// Random streams of a simulation, each a child of its seed.
enum SimulationStream : std::uint64_t {
  noise_stream,
  vibration_stream,
  sensor_noise_stream,
  response_stream,
  cable_stream,
  pickup_stream,
  encoder_stream,
  thermometer_stream,
  gyroscope_stream
};

/// What there is to record, at the analogue rate.
struct AnalogueSignals {
  Eigen::VectorXd time;         // (N) s
  double rate = 0.0;            // Hz
  SamplesX position, velocity;  // (N, n) of the joints
  Samples3 reading;             // (N, 3) m/s^2, the sensor without dynamics and noise
  Eigen::VectorXd temperature;  // (N) degrees Celsius, or empty
};

/// InvalidInput for options out of their range.
void validate(const AcquisitionOptions& options, Index instants, double rate);

/// time, joint positions (not yet counted), specific force and temperature of the recording. `range` (0: none) is the
/// sensor's, `noise_std` white noise per sample from the surroundings.
Recording acquire(const AnalogueSignals& signals, const AcquisitionOptions& options,
                  const TemperatureProfile& thermometer, double range, double noise_std, std::uint64_t seed);

}  // namespace circlepoint
