#pragma once
// The delay of one stretch of motion: y(t) = X(t - delay) b with unknown b (K, 3), profiled over the delay.

#include <Eigen/Core>
#include <optional>

#include "activity_correlation.hpp"
#include "uniform_stream.hpp"

namespace circlepoint::detail {

/// Regressors of the joint that moves alone; further columns describe what the others yield.
constexpr Index own_regressors = 5;

/// A stretch of the joint stream within one span, and the regressors of its motion, low-pass filtered, on those rows.
struct MotionModel {
  Index joint = -1;     // the one that moves alone; -1: several along one path
  IndexRange rows;      // of the joint stream, with the rest around the motion
  IndexRange moving;    // of the joint stream
  SamplesX regressors;  // (rows.size(), K)
  double squared_frequency = 0.0;  // 1/s^2: mean squared acceleration over mean squared speed
};

/// The sensor's samples of a stretch under a clock, low-pass filtered.
class DelayProfile {
 public:
  /// Only the first `most_regressors` are used. Empty where fewer than 8 + K sensor samples lie in the stretch,
  /// `range` (s) inside its ends.
  static std::optional<DelayProfile> make(const MotionModel& model, const UniformStream& joints,
      const UniformStream& sensor,
                                          const SamplesX& smooth_sensor, const RelativeClock& clock, double range,
                                              double margin, Index most_regressors);

  /// Residual sum of squares at a delay (s, joint time) within +- range.
  [[nodiscard]] double cost(double delay) const;

  struct Estimate {
    double delay = 0.0;           // s, joint time
    double std = 0.0;             // s
    double centre = 0.0;          // s, relative joint time: centroid of the information
    double model_residual = 0.0;  // m/s^2 rms
    bool interior = false;        // a minimum inside the range
  };
  /// The minimum, searched on a grid of `steps` on each side of zero (0: none) and refined by Gauss-Newton steps.
  /// `unseen` (m/s^2 rms) is added to the standard deviation as an error that may follow the sensitivity in full.
  [[nodiscard]] Estimate minimise(Index steps, double unseen) const;

  /// Independent residuals in the stretch, for a signal of bandwidth `cutoff` (Hz).
  [[nodiscard]] double effective_samples(double cutoff) const;

 private:
  [[nodiscard]] Eigen::MatrixXd regressors_at(double delay) const;

  Eigen::MatrixXd regressors_;  // (rows, K), columns scaled to unit size, the first one constant
  double row_period_ = 0.0, row_start_ = 0.0, range_ = 0.0, period_ = 0.0;
  Eigen::VectorXd instants_;    // (M) relative joint time of the sensor samples under the clock
  Eigen::MatrixXd readings_;    // (M, 3)
};

}  // namespace circlepoint::detail
