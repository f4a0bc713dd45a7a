#include "circlepoint/simulation/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "give_way.hpp"
#include "vibration.hpp"

namespace circlepoint {
namespace {

enum Stream : std::uint64_t { noise_stream, vibration_stream };

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

}  // namespace

Recording simulate(const ScrewChain& chain, const Eigen::Vector3d& up_gravity_sensor, const AccelerometerModel& sensor,
                   const JointTrajectory& trajectory, const SimulationOptions& options) {
  validate(chain, up_gravity_sensor, trajectory, options);
  const Index samples = trajectory.samples();
  const Eigen::Vector3d up_gravity_base = chain.home.linear() * up_gravity_sensor;
  const bool vibrates = options.vibration.tangential_amplitude > 0.0 || options.vibration.orthogonal_amplitude > 0.0;
  const Eigen::VectorXd envelope =
      vibrates ? motion_envelope(trajectory, options.vibration.ramp) : Eigen::VectorXd::Zero(samples);
  RandomSource noise(derive_seed(options.seed, noise_stream));
  Vibration vibration(options.vibration, derive_seed(options.seed, vibration_stream));

  Recording recording;
  recording.time = trajectory.time;
  recording.sample_rate = trajectory.sample_rate;
  recording.spans = {{0, samples}};
  recording.joint_positions.resize(samples, chain.size());
  recording.specific_force.resize(samples, 3);
  JointState state;
  for (Index i = 0; i < samples; ++i) {
    state.position = trajectory.position.row(i);
    state.velocity = trajectory.velocity.row(i);
    state.acceleration = trajectory.acceleration.row(i);
    if (options.compliance.size() > 0) {
      state = add_give_way(chain, up_gravity_base, options.compliance, state);
    }
    const FrameMotion motion = frame_motion(chain, state.position, state.velocity, state.acceleration);
    Eigen::Vector3d force = specific_force(motion, up_gravity_base);
    if (vibrates) {
      const Eigen::Vector3d velocity_sensor = motion.T_base_sensor.linear().transpose() * motion.velocity_base;
      force += vibration.at(trajectory.time[i], velocity_sensor, envelope[i]);
    }
    Eigen::Vector3d reading = sensor.measure(force, motion.angular_velocity_sensor);
    reading += options.bias_drift * (static_cast<double>(i) / static_cast<double>(std::max<Index>(samples - 1, 1)));
    if (options.noise_std > 0.0) {
      for (Index k = 0; k < 3; ++k) {
        reading[k] += options.noise_std * noise.normal();
      }
    }
    if (options.range > 0.0) {
      reading = reading.cwiseMax(-options.range).cwiseMin(options.range);
    }
    recording.joint_positions.row(i) = state.position;
    recording.specific_force.row(i) = reading;
  }
  quantise(recording.joint_positions, chain, options.encoder_counts_per_revolution);
  return recording;
}

}  // namespace circlepoint
