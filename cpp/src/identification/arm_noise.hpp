#pragma once
// How the whole-arm residuals scatter: per kind of motion, uncorrelated channels each with an autoregressive model; dwells by
// their samples' scatter, the encoders' counts and one common excess.

#include <Eigen/Core>
#include <vector>

#include "arm_motion_noise.hpp"
#include "arm_rows.hpp"

namespace circlepoint {

struct ArmNoise {
  std::vector<MotionNoise> kinds;
  double inflation = 1.0;        // of the kinds' variances, above what their residuals scatter by
  std::vector<Eigen::MatrixXd> encoder;  // a stretch each: Cholesky factor of I + the encoders' errors, whitened; empty: none
  Eigen::VectorXd dwell_excess;  // (3) or (6) m/s^2 or rad/s: added to a dwell's own standard deviation, in squares
};

// White noise of the given size, before any residual is known.
ArmNoise white_noise(const ArmRows& rows, double moving_std, double dwell_std, double rate_std);

// From residuals of the moving stretches and of the dwells (D, channels); `dwell_covariance` (D) (channels, channels) is what the dwells'
// own scatter and the encoders explain; parameters: how many were fitted; inflation of the stretches' variance, by their scores;
// encoders: covariance of what they make of each stretch, or empty; before: the noise so far, where the search goes on from it, or, once
// settled, ends; without encoders its channels and orders then stay, which criterion and parameters could drive to and fro for ever.
ArmNoise estimate_noise(const ArmRows& rows, const StretchResiduals& moving, const Eigen::MatrixXd& dwells,
                        const std::vector<Eigen::MatrixXd>& dwell_covariance, double parameters, double inflation,
                        const std::vector<Eigen::MatrixXd>& encoders, const ArmNoise* before, bool settled);

// Takes the encoders' errors, as above, into the whitening.
void include_encoders(ArmNoise& noise, const ArmRows& rows, const std::vector<Eigen::MatrixXd>& encoders);

// Whitens stretch `index` in place, the encoders' errors included; `columns` as for its MotionNoise.
void whiten_stretch(const ArmNoise& noise, const ArmRows& rows, std::size_t index, Eigen::Ref<Eigen::MatrixXd> columns);

// The logarithm of the determinant of what the whitening of stretch `index` undoes: half that of its noise's covariance.
double log_root_determinant(const ArmNoise& noise, const ArmRows& rows, std::size_t index);

}  // namespace circlepoint
