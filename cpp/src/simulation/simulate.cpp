#include "circlepoint/simulation/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "acquire.hpp"
#include "give_way.hpp"
#include "vibration.hpp"

namespace circlepoint {
namespace {

void require_not_negative(double value, const char* name) {
  require(std::isfinite(value) && value >= 0.0,
          std::string(name) + " is " + std::to_string(value) + "; give zero or a positive number");
}

void require_one_a_joint(const Eigen::VectorXd& values, const char* name, Index joints) {
  require(values.size() == 0 || values.size() == joints,
          std::string(name) + " has " + std::to_string(values.size()) + " entries for a chain of " +
              std::to_string(joints) + " joints; give one a joint, or none");
  require(values.allFinite(), std::string(name) + " holds a value that is not finite");
}

void require_shape(const SamplesX& values, const char* name, Index samples, Index joints) {
  require(values.rows() == samples && values.cols() == joints,
          "the trajectory's " + std::string(name) + " is " + std::to_string(values.rows()) + " x " +
              std::to_string(values.cols()) + " for " + std::to_string(samples) + " samples of a chain of " +
              std::to_string(joints) + " joints; give one row a sample, one column a joint");
  require(values.allFinite(), "the trajectory's " + std::string(name) + " holds a value that is not finite");
}

void validate(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_sensor, const JointTrajectory& trajectory,
              const SimulationOptions& options) {
  require(chain.size() > 0, "the chain has no joints; give at least one");
  require(up_gravity_sensor.allFinite(), "up_gravity_sensor holds a value that is not finite");
  require(trajectory.samples() > 0, "the trajectory has no samples");
  require(std::isfinite(trajectory.sample_rate) && trajectory.sample_rate > 0.0,
          "the trajectory's sample_rate is " + std::to_string(trajectory.sample_rate) + " Hz; give a positive number");
  require_shape(trajectory.position, "position", trajectory.samples(), chain.size());
  require_shape(trajectory.velocity, "velocity", trajectory.samples(), chain.size());
  require_shape(trajectory.acceleration, "acceleration", trajectory.samples(), chain.size());
  require_not_negative(options.noise_std, "noise_std");
  require_not_negative(options.range, "range");
  require_one_a_joint(options.encoder_counts_per_revolution, "encoder_counts_per_revolution", chain.size());
  require((options.encoder_counts_per_revolution.array() >= 0.0).all(),
          "encoder_counts_per_revolution holds a negative number; give counts, or 0 for an exact encoder");
  require_one_a_joint(options.compliance, "compliance", chain.size());
  require(options.bias_drift.allFinite(), "bias_drift holds a value that is not finite");
  if (options.temperature) {
    require(std::isfinite(options.temperature->start) && std::isfinite(options.temperature->rise) &&
                std::isfinite(options.temperature->sensor_offset) && options.temperature->time_constant > 0.0,
            "the temperature's start, rise or sensor_offset is not finite, or its time_constant not positive");
    require_not_negative(options.temperature->sensor_noise_std, "the temperature's sensor_noise_std");
  }
  if (options.angular_velocity_noise_std) {
    require_not_negative(*options.angular_velocity_noise_std, "angular_velocity_noise_std");
  }
  if (options.acquisition) {
    validate(*options.acquisition, trajectory.samples(), trajectory.sample_rate);
  }
  const VibrationOptions& vibration = options.vibration;
  require_not_negative(vibration.tangential_amplitude, "vibration tangential_amplitude");
  require_not_negative(vibration.orthogonal_amplitude, "vibration orthogonal_amplitude");
  if (vibration.tangential_amplitude > 0.0 || vibration.orthogonal_amplitude > 0.0) {
    require(std::isfinite(vibration.ramp) && vibration.ramp > 0.0,
            "vibration ramp is " + std::to_string(vibration.ramp) + " s; give a positive time");
    require(vibration.components >= 1,
            "vibration components is " + std::to_string(vibration.components) + "; give at least 1");
    require(vibration.frequency_min > 0.0 && vibration.frequency_max >= vibration.frequency_min &&
                vibration.frequency_max < 0.5 * trajectory.sample_rate,
            "vibration between " + std::to_string(vibration.frequency_min) + " and " +
                std::to_string(vibration.frequency_max) + " Hz cannot be sampled at " +
                std::to_string(trajectory.sample_rate) +
                " Hz; give 0 < frequency_min <= frequency_max < half the sample rate");
  }
}

// Raw encoder values: the nearest count, of the joints that are counted.
void quantise(SamplesX& positions, const ScrewChain& chain, const Eigen::VectorXd& counts) {
  for (Index j = 0; j < counts.size(); ++j) {
    if (counts[j] > 0.0) {
      const bool turns = chain.axes[static_cast<std::size_t>(j)].type == JointType::revolute;
      const double count = (turns ? 2.0 * std::numbers::pi : 1.0) / counts[j];
      positions.col(j) = (positions.col(j).array() / count).round() * count;
    }
  }
}

// Whether an arm at rest stays where it is: the instant before says all of this one.
bool rests_on(const JointTrajectory& trajectory, Index i) {
  return i > 0 && trajectory.position.row(i) == trajectory.position.row(i - 1) &&
         trajectory.velocity.row(i) == trajectory.velocity.row(i - 1) &&
         trajectory.acceleration.row(i) == trajectory.acceleration.row(i - 1);
}

// Everything that happens at the end-point, at every instant of the trajectory.
struct EndPoint {
  AnalogueSignals signals;
  Samples3 angular_velocity;  // rad/s, in the sensor frame
};

EndPoint move(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_sensor, const AccelerometerModel& sensor,
              const JointTrajectory& trajectory, const SimulationOptions& options) {
  const Index samples = trajectory.samples();
  const Eigen::Vector3d up_gravity_base = chain.home.linear() * up_gravity_sensor;
  const bool vibrates = options.vibration.tangential_amplitude > 0.0 || options.vibration.orthogonal_amplitude > 0.0;
  const Eigen::VectorXd envelope =
      vibrates ? motion_envelope(trajectory, options.vibration.ramp) : Eigen::VectorXd::Zero(samples);
  Vibration vibration(options.vibration, derive_seed(options.seed, vibration_stream));
  const JointTrajectory followed = follow(trajectory, options.held_joints);

  EndPoint end_point;
  AnalogueSignals& signals = end_point.signals;
  signals.time = trajectory.time;
  signals.rate = trajectory.sample_rate;
  signals.position.resize(samples, chain.size());
  signals.velocity.resize(samples, chain.size());
  signals.reading.resize(samples, 3);
  signals.temperature.resize(options.temperature ? samples : 0);
  end_point.angular_velocity.resize(samples, 3);
  JointState state;
  FrameMotion motion;
  for (Index i = 0; i < samples; ++i) {
    if (!rests_on(followed, i)) {
      state.position = followed.position.row(i);
      state.velocity = followed.velocity.row(i);
      state.acceleration = followed.acceleration.row(i);
      if (options.compliance.size() > 0) {
        state = add_give_way(chain, up_gravity_base, options.compliance, state);
      }
      motion = frame_motion(chain, state.position, state.velocity, state.acceleration);
    }
    Eigen::Vector3d force = specific_force(motion, up_gravity_base);
    if (vibrates) {
      const Eigen::Vector3d velocity_sensor = motion.T_base_sensor.linear().transpose() * motion.velocity_base;
      force += vibration.at(trajectory.time[i], velocity_sensor, envelope[i]);
    }
    Eigen::Vector3d reading;
    if (options.temperature) {
      signals.temperature[i] = options.temperature->at(trajectory.time[i] - trajectory.time[0]);
      reading = sensor.at(signals.temperature[i]).measure(force, motion.angular_velocity_sensor);
    } else {
      reading = sensor.measure(force, motion.angular_velocity_sensor);
    }
    reading += options.bias_drift * (static_cast<double>(i) / static_cast<double>(std::max<Index>(samples - 1, 1)));
    signals.position.row(i) = state.position;
    signals.velocity.row(i) = state.velocity;
    signals.reading.row(i) = reading;
    end_point.angular_velocity.row(i) = motion.angular_velocity_sensor;
  }
  return end_point;
}

}  // namespace

Recording simulate(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_sensor, const AccelerometerModel& sensor,
                   const JointTrajectory& trajectory, const SimulationOptions& options) {
  validate(chain, up_gravity_sensor, trajectory, options);
  const EndPoint end_point = move(chain, up_gravity_sensor, sensor, trajectory, options);
  // Without a chain of acquisition: one sample an instant, noise after the sensor, and clipping last of all.
  const AcquisitionOptions acquisition = options.acquisition.value_or(AcquisitionOptions{});
  const double sensor_range = options.acquisition ? options.range : 0.0;
  Recording recording = acquire(end_point.signals, acquisition, options.temperature.value_or(TemperatureProfile{}),
                                sensor_range, options.noise_std, options.seed);
  if (!options.acquisition && options.range > 0.0) {
    recording.specific_force = recording.specific_force.cwiseMax(-options.range).cwiseMin(options.range);
  }
  if (options.angular_velocity_noise_std) {
    RandomSource gyroscope(derive_seed(options.seed, gyroscope_stream));
    Samples3 rates = end_point.angular_velocity(Eigen::seqN(0, recording.samples(), acquisition.oversampling), Eigen::all);
    for (double& rate : rates.reshaped<Eigen::RowMajor>()) {
      rate += *options.angular_velocity_noise_std * gyroscope.normal();
    }
    recording.angular_velocity = std::move(rates);
  }
  quantise(recording.joint_positions, chain, options.encoder_counts_per_revolution);
  return recording;
}

}  // namespace circlepoint
