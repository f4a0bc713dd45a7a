#pragma once
// Offset and rate from the delays of several motions.

#include <vector>

#include "activity_correlation.hpp"

namespace circlepoint::detail {

struct ClockPoint {
  double joint = 0.0;   // s, relative joint time
  double sensor = 0.0;  // s, relative sensor time
  double std = 0.0;     // s, of sensor
  double residual = 0.0;
  double weight = 0.0;  // robust, 0 to 1
};

struct ClockLine {
  RelativeClock clock;
  double centre = 0.0;      // s, relative joint time where level and rate are uncorrelated
  double level_std = 0.0;   // s, of the sensor time there
  double rate_std = 0.0;
  double scatter = 0.0;     // s, added to every point's standard deviation
  double residual = 0.0;    // s, weighted rms
  bool rate_determined = false;
};

/// Weighted robust (Tukey) line with the rate's prior 1 +- max_rate_deviation; the points' residuals and weights are
/// filled in.
ClockLine fit_clock_line(std::vector<ClockPoint>& points, double max_rate_deviation);

}  // namespace circlepoint::detail
