#pragma once
// What a coarse encoder makes of a moving joint's position, velocity and acceleration, as noise of known covariance.
//
// A joint that crosses counts errs by a count's uniform scatter at every sample, white; low-passed and differentiated it is a
// stationary process whose covariance follows from the filter alone. It rises with the fourth power of the frequency, through many
// decades within the pass band: no short autoregressive model holds that, and the motion's own frequency, where it is least, is
// where the arm shows itself. So it is carried to the readings exactly, a dense covariance a stretch.

#include <Eigen/Core>
#include <vector>

#include "arm_rows.hpp"

namespace circlepoint {

struct ArmProblem;
struct ArmState;

// Covariances (3 M, 3 M), channel-major, of what a stretch's PositionErrors make of its readings; empty where there are none.
std::vector<Eigen::MatrixXd> encoder_covariances(const ArmProblem& problem, const ArmState& state);

// Derivatives 0 to 4 (a column each) by time of the autocovariance of white noise of unit variance a sample, low-passed to and fro
// (Butterworth of order 4) with the cut-off, at lags 0, step, 2 step ... of samples at the rate.
Eigen::MatrixXd smoothed_autocovariance(double cutoff, double rate, Index step, Index lags);

}  // namespace circlepoint
