#pragma once
// An estimate held against the truth it was simulated from.
//
// The truth is carried to the estimate's reference configuration. A line's error is estimate minus truth in the local
// coordinates (d1, d2, p1, p2) of geometry/joint_axis, and both error and standard deviations are given in the true line's
// tangent basis, which does not jump between trials as the estimate's might. Normalised estimation error squared:
//
//   nees = e^T C^-1 e / k,     k = 4 (revolute), 2 (prismatic: d1, d2 alone),
//
// with the mean 1 where the covariance C is honest. For lines more than 84 degrees apart, where the chart ends, d is the
// rotation that takes the true direction to the estimated one.

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "circlepoint/identification/joint_calibration.hpp"

namespace circlepoint {

/// What is said of a figure there is no estimate of.
inline constexpr double not_compared = std::numeric_limits<double>::quiet_NaN();

/// One line against the truth; NaN where there is no estimate.
struct LineComparison {
  Eigen::Vector4d error = Eigen::Vector4d::Constant(not_compared);  ///< (d1, d2, p1, p2), rad and m: estimate minus truth
  Eigen::Vector4d std = Eigen::Vector4d::Constant(not_compared);    ///< predicted
  double nees = not_compared;  ///< per degree of freedom; NaN where the covariance is singular
};

/// Names of a sensor's figures, in the order of SensorComparison: bias_x ... second_order_z.
const std::vector<std::string>& sensor_figure_names();
inline constexpr int sensor_figures = 15;

/// A sensor's figures against the truth, in SI units.
struct SensorComparison {
  using Figures = Eigen::Matrix<double, sensor_figures, 1>;
  Figures error = Figures::Constant(not_compared);  ///< estimate minus truth
  Figures std = Figures::Constant(not_compared);    ///< predicted; 0 where a figure was taken as known
};

/// The lines' errors, base to tip. `truth` may be at any reference configuration. Raises InvalidInput where it has another
/// number of joints.
std::vector<LineComparison> compare_lines(const JointCalibration& calibration, const ScrewChain& truth);

/// The sensor's errors; the percussion distance is each channel's.
SensorComparison compare_sensor(const JointCalibration& calibration, const AccelerometerModel& truth);

/// Root mean square distance, m, between estimated and true sensor position over configurations (P, n), both seen from the
/// sensor's frame at the estimate's reference configuration. Raises InvalidInput for numbers of joints that differ, and
/// for no configuration.
double end_point_error(const ScrewChain& estimate, const ScrewChain& truth,
                       const Eigen::Ref<const SamplesX>& configurations);

}  // namespace circlepoint
