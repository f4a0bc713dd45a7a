// Time from a log to an arm: simulation, segmentation, both calibrations of seven joints, and the fits of one test.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/core/types.hpp"
#include "circlepoint/identification/axis_direction.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "circlepoint/identification/joint_regression.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "circlepoint/simulation/simulate.hpp"
#include "seven_joints.hpp"

namespace circlepoint {
namespace {

constexpr double sample_rate = 500.0;

JointTrajectory tests_of_all_joints(Index samples) {
  const auto rounds = static_cast<int>(std::max<Index>(1, samples / 100'000));
  const double seconds_a_joint = static_cast<double>(samples) / sample_rate / static_cast<double>(rounds * joints);
  std::vector<Excitation> pieces;
  for (int round = 0; round < rounds; ++round) {
    for (Index joint = 0; joint < joints; ++joint) {
      const SteppedSweep sweep{.joint = joint, .steps = 12, .span = 2.4, .dwell = 0.6, .move = 0.5, .return_duration = 1.5};
      const double cycles = std::max(1.0, std::floor(0.5 * (seconds_a_joint - 15.5)));
      pieces.emplace_back(sweep);
      pieces.emplace_back(RaisedCosine{.joint = joint, .span = 2.4, .frequency = 0.5, .duration = 2.0 * cycles});
    }
  }
  return joint_trajectory(Eigen::VectorXd::Constant(joints, -1.2), pieces, sample_rate, 0.2);
}

Recording log_of(Index samples) {
  SimulationOptions options;
  options.noise_std = 0.01;
  options.encoder_counts_per_revolution = Eigen::VectorXd::Constant(joints, 262'144.0);
  const Eigen::Vector3d up = standard_gravity * Eigen::Vector3d(0.48, -0.6, 0.64);
  return simulate(seven_joints(), up, {}, tests_of_all_joints(samples), options);
}

void report(benchmark::State& state, Index samples) {
  state.counters["samples"] = static_cast<double>(samples);
  state.SetItemsProcessed(state.iterations() * samples);
}

void simulate_seven_joints(benchmark::State& state) {
  Index samples = 0;
  for (auto _ : state) {
    const Recording recording = log_of(state.range(0));
    samples = recording.samples();
  }
  report(state, samples);
}

void segment_seven_joints(benchmark::State& state) {
  const Recording recording = log_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(segment(recording));
  }
  report(state, recording.samples());
}

void calibrate_joints_of_seven(benchmark::State& state) {
  const Recording recording = log_of(state.range(0));
  const Segmentation segmentation = segment(recording);
  for (auto _ : state) {
    benchmark::DoNotOptimize(calibrate_joints(recording, segmentation));
  }
  report(state, recording.samples());
}

void calibrate_whole_arm_of_seven(benchmark::State& state) {
  const Recording recording = log_of(state.range(0));
  const Segmentation segmentation = segment(recording);
  WholeArmOptions options;
  options.threads = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(calibrate_whole_arm(recording, segmentation, options));
  }
  report(state, recording.samples());
}

// End to end: the log in memory to the arm.
void log_to_whole_arm(benchmark::State& state) {
  const Recording recording = log_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(calibrate_whole_arm(recording, segment(recording)));
  }
  report(state, recording.samples());
}

void fit_axis_direction_of_poses(benchmark::State& state) {
  Samples3 poses(state.range(0), 3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (Index i = 0; i < poses.rows(); ++i) {
    const double angle = 2.0 * static_cast<double>(i) / static_cast<double>(poses.rows());
    poses.row(i) << 9.0 * std::cos(angle) + noise(random), 3.0 + noise(random), 9.0 * std::sin(angle) + noise(random);
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_axis_direction(poses));
  }
}

struct Motion {
  Eigen::VectorXd angle, rate, acceleration;
  Samples3 readings;

  explicit Motion(Index samples)
      : angle(3.0 * Eigen::VectorXd::Random(samples)), rate(Eigen::VectorXd::Random(samples)),
        acceleration(Eigen::VectorXd::Random(samples)), readings(Samples3::Random(samples, 3)) {}
};

void joint_statistics_fused(benchmark::State& state) {
  const Motion motion(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(joint_statistics(motion.angle, motion.rate, motion.acceleration, motion.readings));
  }
  report(state, state.range(0));
  state.SetBytesProcessed(state.iterations() * state.range(0) * 48);
}

void joint_statistics_of_regressors(benchmark::State& state) {
  const Motion motion(state.range(0));
  const Regressors regressors = joint_regressors(motion.angle, motion.rate, motion.acceleration);
  for (auto _ : state) {
    RegressionStatistics statistics;
    statistics.add(regressors, motion.readings);
    benchmark::DoNotOptimize(statistics);
  }
  report(state, state.range(0));
  state.SetBytesProcessed(state.iterations() * state.range(0) * 64);
}

BENCHMARK(fit_axis_direction_of_poses)->Arg(16)->Arg(150)->Unit(benchmark::kMicrosecond);
BENCHMARK(joint_statistics_fused)->Arg(5'000)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(joint_statistics_of_regressors)->Arg(5'000)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(simulate_seven_joints)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(segment_seven_joints)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrate_joints_of_seven)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrate_whole_arm_of_seven)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(log_to_whole_arm)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace circlepoint
