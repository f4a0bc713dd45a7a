#pragma once
// The regression problem of one joint's test: dwell means as they are, motions through the same low-pass as their regressors.

#include "circlepoint/identification/joint_regression.hpp"
#include "partial_chain.hpp"
#include "test_samples.hpp"

namespace circlepoint {

struct TestRegression {
  Regressors static_regressors;   // (K, 5)
  Samples3 static_readings;       // (K, 3)
  Regressors dynamic_regressors;  // (M, 5), filtered
  Samples3 dynamic_readings;      // (M, 3), filtered
  Eigen::VectorXd time;           // (M)
  Eigen::VectorXd position;       // (M)
  double sample_rate = 0.0;
};

// All other joints taken to be at rest.
TestRegression make_regression(const TestSamples& samples, int filter_order);

// The same with the readings corrected for the other joints' yielding, as `chain` predicts it from their encoders. The filter is
// linear: what it makes of the correction is all there is to subtract.
TestRegression without_yielding(const TestRegression& regression, const TestSamples& samples, const PartialChain& chain,
                                int filter_order);

}  // namespace circlepoint
