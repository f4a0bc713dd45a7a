#pragma once
// How the whole-arm residuals scatter: per kind of motion, uncorrelated channels each with an autoregressive model; dwells by
// their samples' scatter, the encoders' counts and one common excess.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "arm_rows.hpp"
#include "circlepoint/conditioning/autoregressive.hpp"

namespace circlepoint {

// Channels (3 accelerometer, then 3 gyroscope) rotated within each triad, then whitened.
struct MotionNoise {
  std::vector<Eigen::Matrix3d> rotation;           // a triad each: rows are the uncorrelated channels
  std::vector<AutoregressiveModel> channels;       // 3 or 6
  double factor = 1.0;                             // of the variance, that the channels' innovations hold beyond their fit
};

struct ArmNoise {
  std::vector<MotionNoise> kinds;
  double inflation = 1.0;        // of the kinds' variances, above what their residuals scatter by
  std::vector<Eigen::MatrixXd> encoder;  // a stretch each: Cholesky factor of I + the encoders' errors, whitened; empty: none
  Eigen::VectorXd dwell_excess;  // (3) or (6) m/s^2 or rad/s: added to a dwell's own standard deviation, in squares
};

// Residuals of one stretch: rows (M, channels).
using StretchResiduals = std::vector<Eigen::MatrixXd>;

// White noise of the given size, before any residual is known.
ArmNoise white_noise(const ArmRows& rows, double moving_std, double dwell_std, double rate_std);

// From residuals of the moving stretches and of the dwells (D, channels); `dwell_variance` (D, channels) is what the dwells'
// own scatter and the encoders explain; parameters: how many were fitted; inflation of the stretches' variance, by their scores;
// encoders: covariance of what they make of each stretch, or empty; before: the noise so far, where the search goes on from it, or, once
// settled, ends; without encoders the models' orders are then held, which criterion and parameters could drive to and fro for ever.
ArmNoise estimate_noise(const ArmRows& rows, const StretchResiduals& moving, const Eigen::MatrixXd& dwells,
                        const Eigen::MatrixXd& dwell_variance, double parameters, double inflation,
                        const std::vector<Eigen::MatrixXd>& encoders, const ArmNoise* before, bool settled);

// Takes the encoders' errors, as above, into the whitening.
void include_encoders(ArmNoise& noise, const ArmRows& rows, const std::vector<Eigen::MatrixXd>& encoders);

// Finds, pass by pass, the inflation at which the stretches' scores are as large as they should be (M31). Where other data outweigh
// the motions, their residuals grow with the inflation, and the ratio falls with its square: to multiply by the ratio would swing
// for ever, so the slope is taken from the last two passes.
class InflationSearch {
 public:
  // What to try after `inflation` has given `ratio`; 1 at least.
  double next(double inflation, double ratio);

 private:
  struct Tried {
    double inflation;  // logarithms
    double ratio;
  };
  std::optional<Tried> before_;
};

// Whitens a stretch in place: `columns` (M * channels, k), channel-major within (channel c: rows c M ... (c + 1) M - 1).
void whiten_stretch(const MotionNoise& noise, Index rows, Eigen::Ref<Eigen::MatrixXd> columns);

// The same with the encoders' errors of stretch `index`.
void whiten_stretch(const ArmNoise& noise, const ArmRows& rows, std::size_t index, Eigen::Ref<Eigen::MatrixXd> columns);

// Kinds of motion: each joint alone, and all others; a kind too short for a noise model of its own joins the others.
void name_kinds(ArmRows& rows, Index joints);

// Leaves out the rows around whitened residuals beyond six standard deviations, and such dwells; how many. Where too many lie
// there the model is wrong and none is left out.
Index cut_knocks(ArmRows& rows, const StretchResiduals& whitened_residuals, const Eigen::MatrixXd& dwells_normalized);

}  // namespace circlepoint
