#include "circlepoint/simulation/experiment.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/sensor/calibrated_accelerometer.hpp"

namespace circlepoint {
namespace {

// Children of a repetition's seed.
constexpr std::uint64_t sensor_stream = 0;
constexpr std::uint64_t recording_stream = 1;
constexpr std::uint64_t arm_stream = 2;
constexpr std::uint64_t start_stream = 3;

void require_std(double value, const char* name) {
  require(std::isfinite(value) && value >= 0.0,
          std::string(name) + " is " + std::to_string(value) + "; give zero or a positive number");
}

ScrewChain built(const Experiment& experiment, std::uint64_t seed) {
  require_std(experiment.direction_std, "direction_std");
  require_std(experiment.point_std, "point_std");
  ScrewChain chain = experiment.chain;
  if (experiment.direction_std == 0.0 && experiment.point_std == 0.0) {
    return chain;
  }
  RandomSource random(seed);
  for (ScrewAxis& axis : chain.axes) {
    Eigen::Vector4d local;
    for (Index k = 0; k < 4; ++k) {
      local[k] = (k < 2 ? experiment.direction_std : experiment.point_std) * random.normal();
    }
    axis.line = retract(axis.line, local);
  }
  return chain;
}

JointTrajectory started(const Experiment& experiment, std::uint64_t seed) {
  JointTrajectory trajectory = experiment.trajectory;
  const Eigen::VectorXd& spread = experiment.start_spread;
  require(spread.size() == 0 || spread.size() == trajectory.joints(),
          "start_spread has " + std::to_string(spread.size()) + " entries for a motion of " +
              std::to_string(trajectory.joints()) + " joints; give one a joint, or none");
  require(spread.allFinite(), "start_spread holds a value that is not finite");
  RandomSource random(seed);
  for (Index joint = 0; joint < spread.size(); ++joint) {
    trajectory.position.col(joint).array() += random.uniform(0.0, spread[joint]);
  }
  return trajectory;
}

}  // namespace

SimulatedExperiment simulate_experiment(const Experiment& experiment, std::uint64_t seed) {
  const CalibratedAccelerometer drawn =
      draw_calibrated_accelerometer(experiment.sensor, derive_seed(seed, sensor_stream));
  SimulationOptions options = experiment.simulation;
  options.seed = derive_seed(seed, recording_stream);
  SimulatedExperiment result;
  result.chain = built(experiment, derive_seed(seed, arm_stream));
  result.up_gravity_sensor = experiment.up_gravity_sensor;
  result.sensor = drawn.residual;
  if (options.acquisition) {
    result.sheet = drawn.sheet;
    options.acquisition->sheet.reset();
    if (experiment.corrected) {
      options.acquisition->sheet = drawn.sheet;
    } else {
      result.sensor = drawn.actual;
    }
  }
  result.recording =
      simulate(result.chain, result.up_gravity_sensor, options.acquisition ? drawn.actual : drawn.residual,
               started(experiment, derive_seed(seed, start_stream)), options);
  return result;
}

}  // namespace circlepoint
