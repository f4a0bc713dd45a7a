#pragma once
// The noise of one kind of motion, found in its stretches' residuals: uncorrelated channels, each with an autoregressive model beyond
// what the common low-pass makes of white noise.

#include <Eigen/Core>
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

// Residuals of one stretch: rows (M, channels).
using StretchResiduals = std::vector<Eigen::MatrixXd>;

// The common low-pass leaves white noise neither white nor, once thinned out, well said by few coefficients: at low frequency,
// where the arm shows itself, there is a tenth more than on average. What the filter does is known, and costs no coefficient.
AutoregressiveModel filtered_white(const ArmRows& rows);

// By the stretches `members`. With `before`, its channels and their orders stay;
// else the channels are uncorrelated, and the orders those whose coefficients the samples pay for.
MotionNoise fit_motion_noise(const StretchResiduals& moving, const std::vector<std::size_t>& members, Index channels,
                             const AutoregressiveModel& filter, const MotionNoise* before);

// The sensor's own noise where coarse encoders add theirs, of known covariance: one step of expectation and maximisation for the
// spectrum's shape, one of scoring for each channel's size, which expectation alone is slow to find.
MotionNoise fit_beside_encoders(const StretchResiduals& moving, const std::vector<std::size_t>& members,
                                const std::vector<Eigen::MatrixXd>& encoders, const MotionNoise& before,
                                const AutoregressiveModel& filter);

// The quietest channel's noise in all: where encoders add theirs, what a search for the sensor's own begins with.
MotionNoise quietest(const MotionNoise& noise);

// Whitens a stretch in place: `columns` (M * channels, k), channel-major within (channel c: rows c M ... (c + 1) M - 1).
void whiten_stretch(const MotionNoise& noise, Index rows, Eigen::Ref<Eigen::MatrixXd> columns);

}  // namespace circlepoint
