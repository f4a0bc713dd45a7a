#pragma once
// A log on its own uniform clock, time relative to its first sample, and Gaussian smoothing of it: zero phase, the same
// frequency response at any sample rate, and derivatives of the smoothed signal from the kernel's own.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint::detail {

struct UniformStream {
  double start = 0.0;  // s, added to `time` gives the log's clock
  double period = 0.0;  // s
  Eigen::VectorXd time;
  SamplesX values;
  std::vector<IndexRange> spans;

  [[nodiscard]] double duration() const { return time(time.size() - 1); }
};

/// Stamps and values by the rules of recording/timeline.hpp, averaged in blocks down to about `enough_rate` (Hz).
UniformStream make_stream(const Eigen::Ref<const Eigen::VectorXd>& time, const Eigen::Ref<const SamplesX>& values,
                          double enough_rate);

/// Values convolved with the derivative of given order (0, 1, 2) of a Gaussian (sigma in s), span by span, mirrored at
/// ends.
SamplesX smooth(const UniformStream& stream, const SamplesX& values, double sigma, int order);

/// Standard deviation (s) of the Gaussian with its -3 dB point at `cutoff` (Hz).
double gaussian_sigma(double cutoff);

}  // namespace circlepoint::detail
