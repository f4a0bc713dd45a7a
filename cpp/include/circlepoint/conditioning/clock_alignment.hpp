#pragma once
// Two clocks: joints and sensor logged by two machines, sensor_time = offset + rate * joint_time.
//
// No kinematic model is used. Where one joint moves alone by theta, an accelerometer anywhere on the arm reads
//   y = A + B cos(theta) + C sin(theta) + E alpha + F w^2
// with five constant 3-vectors, so that given the delay everything else is linear: the residual is profiled over the
// delay and its minimum gives the delay of that motion. Both sides go through the same zero-phase low-pass. The
// standard deviation is the score's, sqrt(sum_k gamma(k) c(k)) / H, with gamma the residual's autocovariance, c the
// sensitivity's autocorrelation sum and H the curvature: residuals of a rigid model are not white. Delays of several
// motions give offset and rate by a robust weighted line; scatter about the line beyond the delays' own standard
// deviations is added to each. The search starts from the correlation of the joints' speed with the specific force's
// rate of change, over all offsets and all rates within `max_rate_deviation`; epochs do not matter.
// Joints that should rest yield under the moving one's load, in phase with it: as far as the encoders show it, their
// positions and accelerations are regressors too; what an encoder step of yielding would do is added to the standard
// deviation for what they do not show.
// Where no joint moves alone but several move along one path q(s), the same holds with a polynomial in s in place of
// the harmonics, approximately; failing that, the correlation is refined in each window. Both are poorer (a delay is
// not taken for better known than 5 and 10 ms), and the result says so (`single_joint` false).
// Failure: no motion, or none the sensor notices -> NotIdentifiable. One short motion alone leaves the rate to the
// range searched: `rate_determined` is false and rate_std says the same.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

/// A stretch of motion whose delay was measured.
struct DelayTest {
  Index joint = -1;             ///< 0-based joint that moved alone; -1 where several moved
  double joint_start = 0.0;     ///< s, joint clock
  double joint_end = 0.0;       ///< s, joint clock
  double joint_time = 0.0;      ///< s, joint clock: where the delay is measured (centroid of the information)
  double sensor_time = 0.0;     ///< s, sensor clock: the same instant
  double std = 0.0;             ///< s, of sensor_time, from this stretch alone
  double residual = 0.0;        ///< s, sensor_time minus the fitted clock
  double weight = 0.0;          ///< in the fit, 0 (outlier) to 1
  double model_residual = 0.0;  ///< m/s^2, rms of what the motion does not explain after the low-pass
};

struct ClockAlignmentOptions {
  double max_rate_deviation = 0.01;  ///< rates searched: 1 +- this
  double cutoff = 5.0;               ///< Hz, -3 dB of the low-pass both sides go through
  double min_velocity = 0.02;        ///< rad/s or m/s: slower is at rest
  double min_travel = 0.05;          ///< rad or m: shorter motions are ignored
  double others_ratio = 0.1;         ///< others may move at this fraction of the moving joint's speed and travel
};

struct ClockAlignment {
  double offset = 0.0;      ///< s
  double rate = 1.0;        ///< sensor seconds a joint second
  double offset_std = 0.0;  ///< s
  double rate_std = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (offset, rate)
  double reference_time = 0.0;   ///< s, joint clock: where the alignment is best known
  double reference_std = 0.0;    ///< s, of the sensor time there
  std::vector<DelayTest> tests;
  bool single_joint = false;     ///< measured on single-joint motions
  bool rate_determined = false;  ///< by the data; otherwise by the range searched
  bool converged = false;
  double residual = 0.0;           ///< s, weighted rms of the tests about the fitted clock
  std::vector<std::string> notes;  ///< what was used and what falls short, a sentence each

  [[nodiscard]] ClockModel clock() const { return {offset, rate}; }
};

/// Offset and rate between the clock of joint positions (N, n; rad or m) and that of specific force (M, 3; m/s^2).
/// Raises InvalidInput for data that cannot be used and NotIdentifiable where no motion shows the delay.
ClockAlignment align_clocks(const Eigen::Ref<const Eigen::VectorXd>& joint_time,
                            const Eigen::Ref<const SamplesX>& joint_positions,
                            const Eigen::Ref<const Eigen::VectorXd>& sensor_time,
                            const Eigen::Ref<const Samples3>& specific_force, const ClockAlignmentOptions& options =
                                {});

}  // namespace circlepoint
