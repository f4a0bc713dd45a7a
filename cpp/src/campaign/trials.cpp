#include "circlepoint/campaign/trials.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

// By any method; one that goes joint by joint gives the lines of `found` alone.
struct Estimate {
  WholeArmCalibration found;
  bool estimates_sensor = true;
};

Segmentation segment_for(const Recording& recording, const std::vector<JointType>& types) {
  SegmentationOptions options;
  options.joint_types = types;
  return segment(recording, options);
}

Estimate estimate(const Recording& recording, const JointCalibrationOptions& options) {
  Estimate result{{}, options.method == CalibrationMethod::joint};
  JointCalibration& joints = result.found.joints;
  joints = calibrate_joints(recording, segment_for(recording, options.joint_types), options);
  result.found.converged = joints.converged && std::ranges::all_of(joints.fits, &TestFit::converged);
  result.found.iterations = joints.passes;
  return result;
}

Estimate estimate(const Recording& recording, const WholeArmOptions& options) {
  WholeArmOptions alone = options;
  alone.threads = 1;
  return {calibrate_whole_arm(recording, segment_for(recording, options.joint_types), alone)};
}

TrialResult nothing(Index joints) {
  TrialResult result;
  result.lines.resize(static_cast<std::size_t>(joints));
  return result;
}

void compare(const Estimate& estimate, const SimulatedExperiment& truth, const SamplesX& configurations,
             TrialResult& result) {
  const JointCalibration& joints = estimate.found.joints;
  result.converged = estimate.found.converged;
  result.iterations = estimate.found.iterations;
  result.lines = compare_lines(joints, truth.chain);
  if (estimate.estimates_sensor) {
    result.sensor = compare_sensor(joints, truth.sensor);
  }
  result.outcome = joints.complete() ? TrialOutcome::complete : TrialOutcome::incomplete;
  if (result.outcome == TrialOutcome::incomplete) {
    const auto missing = std::ranges::find_if(joints.joints, [](const auto& joint) { return !joint.axis; });
    result.reason = "joint " + std::to_string(missing->joint + 1) + ": " + missing->reason;
  } else if (configurations.rows() > 0) {
    result.end_point_error = end_point_error(joints.chain(), truth.chain, configurations);
    const Eigen::VectorXd std = end_point_std(estimate.found, configurations);
    result.end_point_std = std::sqrt(std.squaredNorm() / static_cast<double>(std.size()));
  }
}

// What the threads share.
struct Progress {
  std::mutex mutex;
  std::condition_variable changed;
  Index done = 0;
  unsigned running = 0;
  std::exception_ptr failure;
  std::atomic<bool> stop = false;
};

void work(const TrialConditions& conditions, const std::vector<std::uint64_t>& seeds, std::atomic<std::size_t>& next,
          std::vector<TrialResult>& results, Progress& shared) {
  while (!shared.stop) {
    const std::size_t trial = next++;
    if (trial >= seeds.size()) {
      break;
    }
    std::exception_ptr failure;
    try {
      results[trial] = run_trial(conditions, seeds[trial]);
    } catch (...) {
      failure = std::current_exception();
      shared.stop = true;
    }
    const std::lock_guard lock(shared.mutex);
    ++shared.done;
    if (failure && !shared.failure) {
      shared.failure = failure;
    }
    shared.changed.notify_one();
  }
  const std::lock_guard lock(shared.mutex);
  --shared.running;
  shared.changed.notify_one();
}

void watch(Progress& shared, const std::function<void(Index)>& progress) {
  Index told = 0;
  std::unique_lock lock(shared.mutex);
  for (;;) {
    shared.changed.wait(lock, [&] { return shared.running == 0 || shared.done != told; });
    if (shared.done == told) {
      return;  // all workers have ended and every trial has been told of
    }
    told = shared.done;
    if (progress && !shared.failure) {
      lock.unlock();
      try {
        progress(told);
      } catch (...) {
        shared.stop = true;
        throw;
      }
      lock.lock();
    }
  }
}

TrialResults in_columns(const std::vector<TrialResult>& results, Index joints) {
  const auto trials = static_cast<Index>(results.size());
  TrialResults columns;
  columns.line_error.resize(trials, 4 * joints);
  columns.line_std.resize(trials, 4 * joints);
  columns.line_nees.resize(trials, joints);
  columns.sensor_error.resize(trials, sensor_figures);
  columns.sensor_std.resize(trials, sensor_figures);
  columns.end_point_error.resize(trials);
  columns.end_point_std.resize(trials);
  for (Index i = 0; i < trials; ++i) {
    const TrialResult& result = results[static_cast<std::size_t>(i)];
    columns.outcome.push_back(result.outcome);
    columns.reason.push_back(result.reason);
    columns.converged.push_back(result.converged);
    columns.iterations.push_back(result.iterations);
    for (Index joint = 0; joint < joints; ++joint) {
      const LineComparison& line = result.lines[static_cast<std::size_t>(joint)];
      columns.line_error.row(i).segment<4>(4 * joint) = line.error;
      columns.line_std.row(i).segment<4>(4 * joint) = line.std;
      columns.line_nees(i, joint) = line.nees;
    }
    columns.sensor_error.row(i) = result.sensor.error;
    columns.sensor_std.row(i) = result.sensor.std;
    columns.end_point_error[i] = result.end_point_error;
    columns.end_point_std[i] = result.end_point_std;
  }
  return columns;
}

}  // namespace

TrialResult run_trial(const TrialConditions& conditions, std::uint64_t seed) {
  const SimulatedExperiment truth = simulate_experiment(conditions.experiment, seed);
  TrialResult result = nothing(truth.chain.size());
  try {
    const Estimate found =
        std::visit([&](const auto& options) { return estimate(truth.recording, options); }, conditions.method);
    compare(found, truth, conditions.configurations, result);
  } catch (const Error& error) {
    result = nothing(truth.chain.size());
    result.reason = error.what();
  }
  return result;
}

TrialResults run_trials(const TrialConditions& conditions, const std::vector<std::uint64_t>& seeds, unsigned threads,
                        const std::function<void(Index)>& progress) {
  require(threads >= 1, "threads is 0; give one at least");
  std::vector<TrialResult> results(seeds.size());
  std::atomic<std::size_t> next = 0;
  Progress shared;
  {
    std::vector<std::jthread> workers;
    shared.running = static_cast<unsigned>(std::min<std::size_t>(threads, seeds.size()));
    for (unsigned i = shared.running; i > 0; --i) {
      workers.emplace_back(work, std::cref(conditions), std::cref(seeds), std::ref(next), std::ref(results),
                           std::ref(shared));
    }
    watch(shared, progress);
  }
  if (shared.failure) {
    std::rethrow_exception(shared.failure);
  }
  return in_columns(results, conditions.experiment.chain.size());
}

}  // namespace circlepoint
