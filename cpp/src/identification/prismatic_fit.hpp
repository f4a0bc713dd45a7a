#pragma once
// Fitting the test of a prismatic joint: while it alone moves by s the sensor does not turn, and reads
//   y = A + E s_ddot,
// with A up-gravity plus bias and E the direction. The length of E is one but for the encoder's scale, the sensor's, and a
// delay between the two: it is left free, so that none of them reaches the direction, and reported as a check. Rests add
// nothing: A is the same everywhere.

#include "test_fit.hpp"

namespace circlepoint {

// Least squares of filtered readings on the acceleration through the same filter; sandwich covariance. Raises
// NotIdentifiable where the acceleration does not show in the readings.
FittedTest fit_prismatic(const TestSamples& samples, const TestRegression& regression, const TestNoise& noise,
                         const JointCalibrationOptions& options);

// As the paper would: the mean reading at rest subtracted, integrated once (velocity) or twice (position), and a straight
// line fitted to what comes of it.
FittedTest fit_prismatic_by_paper(const TestSamples& samples, const TestRegression& regression, double sample_rate,
                                  const JointCalibrationOptions& options);

}  // namespace circlepoint
