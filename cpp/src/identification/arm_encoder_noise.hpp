#pragma once
// What a coarse encoder makes of a moving joint's position, velocity and acceleration, as noise of known covariance.
//
// A reading's error is what is left of the position beyond whole counts: a sawtooth of the position, known but for where in its
// count the encoder's zero lies. Taken as anywhere, two errors covary by the sawtooth's autocorrelation at the positions' difference:
//   cov = count^2 (1/12 - x (1 - x) / 2),  x the fraction of a count in the difference.
// That is white where a joint is fast, and one unknown number where it creeps, moves by whole counts a sample, or passes a place
// again. Low-passed and differentiated as the positions are, it is carried to the readings, a dense covariance a stretch: it rises
// with the fourth power of the frequency, through decades within the pass band, which no short autoregressive model holds.

#include <Eigen/Core>
#include <vector>

#include "arm_rows.hpp"

namespace circlepoint {

struct ArmProblem;
struct ArmState;

// Covariances (3 M, 3 M), channel-major, of what a stretch's PositionErrors make of its readings; empty where there are none.
std::vector<Eigen::MatrixXd> encoder_covariances(const ArmProblem& problem, const ArmState& state);

// Covariance (3 M, 3 M), counts, of a joint's smoothed position and its first and second derivative at some rows of a span: position
// (N) counts of the whole span, smoothed to and fro (Butterworth of order 4) with the cut-off.
Eigen::MatrixXf count_error_covariance(const Eigen::Ref<const Eigen::VectorXd>& position, const Eigen::ArrayXi& rows, double cutoff,
                                       double rate);

// Autocovariance of white noise of unit variance a sample, smoothed likewise, at lags 0, step, 2 step ... of samples at the rate.
Eigen::VectorXd smoothed_autocovariance(double cutoff, double rate, Index step, Index lags);

}  // namespace circlepoint
