#pragma once
// The uniform clock behind time stamps: whole ticks counted by following the phase, then period and offsets fitted.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint::detail {

using Stamps = Eigen::Ref<const Eigen::VectorXd>;

struct Clock {
  double period = 0.0;
  std::vector<Index> tick;
  std::vector<Index> surplus;
  std::vector<IndexRange> rows;   // of each span
  std::vector<double> offset;     // of each span: time at tick 0
  std::vector<double> residual;   // (N)
  double scatter = 0.0;           // robust standard deviation of the residual
};

/// One period for all spans, an offset each, by least squares without the late stamps. A step of more than `max_filled`
/// missing ticks starts a span.
Clock fit_clock(const Stamps& time, Index max_filled);

/// Median step between stamps over lags long enough to average rounding and bunches out.
double initial_period(const Stamps& time);

/// 1.4826 x the median absolute deviation.
double robust_std(const std::vector<double>& values);

/// [0, n) cut at the given starts.
std::vector<IndexRange> split_at(const std::vector<Index>& starts, Index n);

}  // namespace circlepoint::detail
