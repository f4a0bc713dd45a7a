#pragma once
// Fitting the test of a revolute joint, by the regression or by the paper's methods.

#include "circlepoint/identification/joint_calibration.hpp"
#include "partial_chain.hpp"
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

// Regression with the given noise; `chain` (null in the first pass) corrects for yielding joints.
FittedTest fit_by_regression(const TestSamples& samples, const PartialChain* chain, const JointModelPrior& prior,
                             const TestNoise& noise, int filter_order);

// The paper's axis by plane fit and centre by position or velocity.
FittedTest fit_by_paper(const TestSamples& samples, CalibrationMethod method, double sample_rate,
                        const JointCalibrationOptions& options);

// The regression problem of a test: dwell means as they are, motions through the same low-pass as their regressors.
struct TestRegression {
  Regressors static_regressors;   // (K, 5)
  Samples3 static_readings;       // (K, 3)
  Regressors dynamic_regressors;  // (M, 5), filtered
  Samples3 dynamic_readings;      // (M, 3), filtered
  Eigen::VectorXd time;           // (M)
  Eigen::VectorXd position;       // (M)
  double sample_rate = 0.0;
};

TestRegression make_regression(const TestSamples& samples, const PartialChain* chain, int filter_order);

// Signals, residual figures and the model itself into the fit.
void record_fit(TestFit& fit, const TestSamples& samples, const TestRegression& regression, const JointModel& model,
                const Matrix53& coefficients);

}  // namespace circlepoint
