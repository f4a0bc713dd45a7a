#pragma once
// Fitting the test of a revolute joint, by the regression or by the paper's methods.

#include "circlepoint/identification/joint_calibration.hpp"
#include "test_regression.hpp"
#include "test_samples.hpp"

namespace circlepoint {

using SensorJacobian = Eigen::Matrix<double, 4, sensor_errors>;
using PercussionJacobian = Eigen::Matrix<double, 3, sensor_errors>;

// Noise found in the residuals; carried from pass to pass.
struct TestNoise {
  double static_std = 0.0;         // m/s^2, of a dwell's mean; 0: not known yet
  double dynamic_std = 0.0;        // m/s^2, of a filtered sample; 0: not known yet
  double correlation_factor = 1.0;
  Eigen::VectorXd kept;            // (M) 1, or 0 for dynamic samples left out as knocks; empty: all kept
};

struct FittedTest {
  TestFit fit;
  TestNoise noise;
  SensorJacobian sensor_jacobian = SensorJacobian::Zero();  // of the line's local coordinates by the sensor's static errors
  Eigen::Matrix<double, 1, sensor_errors> acceleration_scale_jacobian =
      Eigen::Matrix<double, 1, sensor_errors>::Zero();  // of a prismatic joint's acceleration scale by the same
  PercussionJacobian percussion_jacobian = PercussionJacobian::Zero();  // of the percussion distances by the same
};

// Regression with the given noise. Raises NotIdentifiable where there is no motion.
FittedTest fit_by_regression(const TestSamples& samples, const TestRegression& regression, const JointModelPrior& prior,
                             const TestNoise& noise);

// The paper's axis by plane fit and centre by position or velocity.
FittedTest fit_by_paper(const TestSamples& samples, const TestRegression& regression, CalibrationMethod method,
                        double sample_rate, const JointCalibrationOptions& options);

// Signals, residual figures and the model itself into the fit.
void record_fit(TestFit& fit, const TestSamples& samples, const TestRegression& regression, const JointModel& model,
                const Matrix53& coefficients);

}  // namespace circlepoint
