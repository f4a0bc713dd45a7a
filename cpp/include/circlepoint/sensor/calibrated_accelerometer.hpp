#pragma once
// A sensor as it is delivered: the individual, and the calibration sheet that came with it.
//
// The sheet states bias, scale and their third-order temperature models. Correcting with it leaves what the data sheet
// calls residual errors, (M15): with sheet bias b and scale s and residual bias b' and scale s',
//
//   bias = b + (1 + s) b',   1 + scale = (1 + s)(1 + s'),   second order = (1 + s) K2',
//
// so that correct(sheet, reading) is exactly what a sensor with the residual errors alone reads at the reference
// temperature, and at others to the product of s' and the change of scale (1e-6 of the reading for the QA700 at 50 degC
// from it). Misalignment and percussion distance are no part of the sheet.

#include <cstdint>

#include "circlepoint/sensor/accelerometer.hpp"

namespace circlepoint {

struct CalibratedAccelerometer {
  AccelerometerModel actual;    ///< what the individual does
  AccelerometerModel sheet;     ///< what its calibration sheet says: bias, scale and temperature
  AccelerometerModel residual;  ///< what is left once readings are corrected by the sheet
};

/// One individual of a kind with its sheet; `residual` is draw_accelerometer(specification, seed), and the uncorrected
/// errors come from a stream of their own. Raises InvalidInput for a standard deviation that is negative or not finite.
CalibratedAccelerometer draw_calibrated_accelerometer(const AccelerometerSpecification& specification,
                                                      std::uint64_t seed);

}  // namespace circlepoint
