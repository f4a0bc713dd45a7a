#pragma once
// Motions that make an arm show its geometry, as joint positions with exact derivatives on a uniform clock.
//
// A motion is a sequence of pieces in continuous time, each beginning where the one before ended; it is sampled at
// t_k = k / sample_rate, so a piece's duration need not be a multiple of the sampling period. Derivatives are those of
// the formulas, never differences. Position and velocity are continuous everywhere; acceleration is too, except at both
// ends of a raised cosine (eq. (11) of Canepa 1994 starts and stops with its largest acceleration). A sample at such an
// instant has the mean of the accelerations on both sides, so that its trapezoid integral is the velocity (one side alone
// would cost half a sample of it); the first and the last sample of all have one side only, and take it.
//
// InvalidInput: durations or rates that are not positive, joints that do not exist, values that are not finite, a
// raised cosine of a fractional number of cycles (it would not end at rest).

#include <Eigen/Core>
#include <cstdint>
#include <variant>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct JointTrajectory {
  Eigen::VectorXd time;      ///< (N) s
  SamplesX position;         ///< (N, n) rad or m
  SamplesX velocity;         ///< (N, n) rad/s or m/s
  SamplesX acceleration;     ///< (N, n) rad/s^2 or m/s^2
  double sample_rate = 0.0;  ///< Hz

  [[nodiscard]] Index samples() const { return time.size(); }
  [[nodiscard]] Index joints() const { return position.cols(); }
};

/// All joints rest.
struct Dwell {
  double duration = 1.0;  ///< s
};

/// All joints move to `target` together by the minimum-jerk quintic, rest to rest:
/// s(x) = 10 x^3 - 15 x^4 + 6 x^5 with x = t / duration.
struct PointToPointMove {
  Eigen::VectorXd target{};  ///< (n) rad or m
  double duration = 1.0;   ///< s
};

/// One joint rests at `steps` equally spaced positions from where it is to `span` away, then returns (the static test).
struct SteppedSweep {
  Index joint = 0;
  Index steps = 16;              ///< positions, both ends included; at least 2
  double span = 0.0;             ///< rad or m, signed
  double dwell = 0.8;            ///< s at each position
  double move = 0.6;             ///< s between two positions
  double return_duration = 2.0;  ///< s back to the start; 0: stay at the far end
};

/// theta = theta_0 + span (1 - cos(2 pi frequency t)) / 2 of one joint (eq. (11), the dynamic test): whole cycles.
struct RaisedCosine {
  Index joint = 0;
  double span = 0.0;       ///< rad or m, signed
  double frequency = 0.5;  ///< Hz
  double duration = 6.0;   ///< s, a whole number of cycles
};

/// All joints at once: per joint the mean of `harmonics` sinusoids of random frequency and phase times its amplitude,
/// faded in and out by a minimum-jerk ramp, around where the joints are; it ends where it began.
struct MultiJointMotion {
  double duration = 60.0;       ///< s
  Eigen::VectorXd amplitude{};   ///< (n) rad or m: a joint never leaves +-amplitude
  double frequency_min = 0.1;   ///< Hz
  double frequency_max = 0.5;   ///< Hz
  Index harmonics = 3;          ///< sinusoids a joint
  double ramp = 2.0;            ///< s of fading at each end; at most half the duration
  std::uint64_t seed = 0;
};

using Excitation = std::variant<Dwell, PointToPointMove, SteppedSweep, RaisedCosine, MultiJointMotion>;

/// The pieces in order from `start` (n), sampled; the joints rest for `rest` seconds (0: not at all) before the first,
/// between any two and after the last.
JointTrajectory joint_trajectory(const Eigen::Ref<const Eigen::VectorXd>& start, const std::vector<Excitation>& pieces,
                                 double sample_rate, double rest = 0.0);

/// One sample a pose (rows of `poses`), at rest: a static test whose samples are the means of dwells.
JointTrajectory static_poses(const Eigen::Ref<const SamplesX>& poses, double sample_rate = 1.0);

}  // namespace circlepoint
