#pragma once
// Monte-Carlo trials: simulate, calibrate, compare with the truth; many of them, in threads.
//
// A trial is its conditions and its seed and nothing else, so any number of threads, processes or machines gives the same
// bits. Conditions that cannot be simulated are the caller's error and raise. What goes wrong afterwards is a result: an
// estimate that fails, or that misses joints, says why.

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "circlepoint/campaign/comparison.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "circlepoint/simulation/experiment.hpp"

namespace circlepoint {

/// What is common to the trials of one cell of a campaign.
struct TrialConditions {
  Experiment experiment;
  std::variant<JointCalibrationOptions, WholeArmOptions> method;  ///< each trial runs in one thread
  SamplesX configurations;  ///< (P, n) rad or m, the workspace over which the end-point is compared; none: it is not
};

enum class TrialOutcome {
  complete,    ///< every joint has its line
  incomplete,  ///< some joints have none
  failed,      ///< no estimate
};

struct TrialResult {
  TrialOutcome outcome = TrialOutcome::failed;
  std::string reason;      ///< why it failed, or the first joint without a line and why
  bool converged = false;
  int iterations = 0;      ///< of the method: passes of the joints' fits, or iterations of the whole-arm estimate
  std::vector<LineComparison> lines;  ///< base to tip
  SensorComparison sensor;            ///< NaN where the method does not estimate the sensor
  double end_point_error = not_compared;  ///< m, rms over the configurations; NaN unless complete
  double end_point_std = not_compared;    ///< m, the same as predicted
};

/// One trial. Raises InvalidInput for conditions that cannot be simulated.
TrialResult run_trial(const TrialConditions& conditions, std::uint64_t seed);

/// Many trials, a row each; NaN where there is no figure.
struct TrialResults {
  std::vector<TrialOutcome> outcome;
  std::vector<std::string> reason;
  std::vector<bool> converged;
  std::vector<int> iterations;
  SamplesX line_error;    ///< (N, 4 n): d1, d2, p1, p2 of the first joint, of the second, ...; rad and m
  SamplesX line_std;      ///< (N, 4 n)
  SamplesX line_nees;     ///< (N, n)
  SamplesX sensor_error;  ///< (N, 15) in the order of sensor_figure_names()
  SamplesX sensor_std;    ///< (N, 15)
  Eigen::VectorXd end_point_error;  ///< (N) m
  Eigen::VectorXd end_point_std;    ///< (N) m
};

/// The trials of these seeds on a number of threads (at least 1). `progress`, where given, is called on the calling thread
/// with the number of trials done, at every change; what it throws stops the trials not yet begun and is passed on.
/// Raises InvalidInput as run_trial does.
TrialResults run_trials(const TrialConditions& conditions, const std::vector<std::uint64_t>& seeds, unsigned threads = 1,
                        const std::function<void(Index)>& progress = {});

}  // namespace circlepoint
