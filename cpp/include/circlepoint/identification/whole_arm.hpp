#pragma once
// One maximum-likelihood estimate of everything a recording says about an arm (docs/method, section 8).
//
// Unknown at once: every joint's line, up-gravity, the sensor's own errors, the delay between encoders and sensor, and on request
// the clocks' rate, the encoders' gains and eccentricities; a gyroscope, where recorded, with its own bias, matrix and delay. Each
// group is fixed, free, or free with a Gaussian prior. The data are the means of static dwells and every moving stretch of
// the recording, single-joint tests or not; no nominal arm is needed.
//
// Readings and encoders pass through the same zero-phase low-pass and are then thinned out. The residuals' noise is found in the
// residuals: per kind of motion, the channels are rotated to uncorrelated ones and each is whitened by an autoregressive
// model, so vibration and the encoders' differentiated counts weigh what they should. Where stretches pull at the estimate
// harder than that noise says, their variance is inflated until they do not, and the covariance is meant. Dwells weigh by the
// scatter of their samples, the encoders' counts and what their residuals show. Knocks are cut out and counted.
//
// Start values come from the single-joint tests where there are some, and from many random starts otherwise. What the data do
// not determine is named: joints that hardly move, and the combinations of parameters along the information matrix's
// weakest directions. For every stretch the residual is also given by an estimate that did not see it (hold-out).
//
// Rests without any motion show directions only: the lines' points and what only motion shows are then no parameters, and no line is
// complete. Fails (NotIdentifiable) where there are too few even of them, or only sliding joints move in them. A joint that never moves is a
// result without a line, as is one vaguer than 20 mrad or 20 mm, whose acceleration its counts drown, or whose mirrored line explains as
// much; where no start leads to a fit, the single-joint results stand alone.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "circlepoint/identification/joint_calibration.hpp"

namespace circlepoint {

/// How one group of parameters is treated.
struct ParameterTreatment {
  bool estimated = true;  ///< false: fixed at its nominal value
  double std = std::numeric_limits<double>::infinity();  ///< of the Gaussian prior about the nominal value; infinite: free
  bool where_evident = false;  ///< encoders' errors: only those that the data show by six standard deviations
};

struct WholeArmOptions {
  AccelerometerSpecification sensor;    ///< prior on the individual sensor: its standard deviations treat bias to second order
  bool sensor_is_known = true;          ///< false: the specification is a guess, and nothing that rests on it alone is given
  ParameterTreatment bias{true, 0.0};                 ///< m/s^2; std 0: the specification's, in this and the next four
  ParameterTreatment scale{true, 0.0};                ///< 1
  ParameterTreatment misalignment{true, 0.0};         ///< rad
  ParameterTreatment percussion_distance{true, 0.0};  ///< m; the channels differ by channel_spread_std at most
  ParameterTreatment second_order{true, 0.0};         ///< s^2/m
  ParameterTreatment gravity{false};                  ///< m/s^2, the local magnitude; its direction is always free
  ParameterTreatment clock_offset{true, 0.005};       ///< s, sensor behind the encoders
  ParameterTreatment clock_rate{false};               ///< 1
  ParameterTreatment encoder_gain{true, 0.05, true};  ///< 1, of the moving joints
  ParameterTreatment eccentricity{true, 0.02, true};  ///< rad, of the moving joints that turn: what is off once a turn
  ParameterTreatment gyroscope_bias{true, 0.1};       ///< rad/s
  ParameterTreatment gyroscope_matrix{true, 0.05};    ///< 1
  ParameterTreatment gyroscope_delay{true, 0.002};    ///< s, gyroscope behind the accelerometer: their filters differ
  bool use_gyroscope = true;            ///< where there is one
  double gravity_magnitude = standard_gravity;  ///< m/s^2
  double cutoff = 0.0;                  ///< Hz, of the common low-pass; 0: chosen from rate, motion and encoders
  int max_passes = 20;                  ///< of estimating parameters and noise in turn, anew whenever an encoder is found to be off
  int random_starts = 200;              ///< where tests do not give start values
  std::uint64_t seed = 0;               ///< of the random starts
  unsigned threads = 0;                 ///< 0: as many as the machine has
  double min_travel = 0.02;             ///< rad or m: joints that travel less have no line
  std::vector<JointType> joint_types;   ///< empty: all revolute
  Eigen::VectorXd encoder_resolution;   ///< (n) rad or m a count; empty: what steps are multiples of, none in still poses
  std::optional<Eigen::VectorXd> reference_configuration;  ///< (n) rad or m
};

/// One estimated number, as calibration.json names it.
struct NamedParameter {
  std::string name;     ///< joint<i>.d1 ... or a sensor's figure
  double value = 0.0;   ///< lines: 0, the coordinates are taken at the estimate
  double std = 0.0;
  double data_std = 0.0;  ///< without priors, all other parameters free; infinite when the data alone do not show it
};

/// A direction in parameter space that the data hardly show.
struct WeakCombination {
  double information_ratio = 0.0;  ///< eigenvalue of the scaled information over the largest
  std::string description;         ///< in words: parameters, numbers, what to record
};

/// Residuals of one moving stretch or of all dwells.
struct StretchResidual {
  std::string name;            ///< "joint 3", "several joints", "dwells"
  double begin = 0.0;          ///< s
  double end = 0.0;            ///< s
  Index samples = 0;           ///< rows
  double residual_rms = 0.0;   ///< m/s^2, low-passed
  double normalized_rms = 0.0; ///< whitened: 1 if model and noise hold
  Index held_out_samples = 0;  ///< rows that were left out once
  double held_out_rms = 0.0;   ///< m/s^2, by estimates that did not see the stretch; NaN without any
  double held_out_normalized_rms = 0.0;
  Index indispensable = 0;     ///< stretches without which the rest determines too little to predict them
};

struct WholeArmCalibration {
  JointCalibration joints;      ///< lines, covariance, up-gravity, sensor and signals in the single-joint methods' form
  std::vector<NamedParameter> parameters;  ///< all estimated ones
  Eigen::MatrixXd covariance;   ///< of `parameters`, in their order
  double clock_offset = 0.0;    ///< s, sensor behind the encoders
  double clock_rate = 1.0;
  Eigen::VectorXd encoder_gain;                            ///< (n), where estimated
  Eigen::Matrix<double, Eigen::Dynamic, 2> eccentricity;   ///< (n, 2) rad, where estimated
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();        ///< rad/s
  Eigen::Matrix3d gyroscope_matrix = Eigen::Matrix3d::Identity();
  double gyroscope_delay = 0.0;                                    ///< s, behind the accelerometer
  bool gyroscope_used = false;
  int rank = 0;                 ///< parameter combinations the data alone determine
  double condition_number = 0.0;
  std::vector<WeakCombination> weak;
  std::vector<StretchResidual> stretches;
  double cutoff = 0.0;          ///< Hz
  double normalized_rms = 0.0;  ///< of all whitened residuals, before the inflation
  double noise_inflation = 1.0; ///< of the motions' noise variance, so that it covers what stretches disagree by (M31)
  Index samples = 0;            ///< used, before thinning
  Index rows = 0;               ///< of the least-squares problem
  Index outliers = 0;           ///< rows left out as knocks
  int starts_tried = 0;
  int iterations = 0;
  double unsettled = 0.0;       ///< standard deviations: a parameter's step in the last pass or what is left to the minimum, the larger
  bool converged = false;
};

/// Raises InvalidInput for options that do not fit the recording and NotIdentifiable where nothing moves, or nothing
/// for long enough without a gap.
WholeArmCalibration calibrate_whole_arm(const Recording& recording, const Segmentation& segmentation,
                                        const WholeArmOptions& options = {});

/// Predicted standard deviation of the sensor's position over configurations (P, n) rad or m, as the joints stand when corrected for
/// what their encoders were found to be off: (P) m, the root of the covariance's trace, of the lines and of those corrections.
/// Raises NotIdentifiable where joints are missing.
Eigen::VectorXd end_point_std(const WholeArmCalibration& calibration, const Eigen::Ref<const SamplesX>& configurations);

}  // namespace circlepoint
