#pragma once
// Autoregressive models of coloured noise, and whitening with them.
//
//   x_t = a_1 x_t-1 + ... + a_p x_t-p + e_t,   e white with variance s_p^2.
//
// Coefficients come from the sample autocovariance by the Levinson-Durbin recursion (Yule-Walker equations), pooled over
// segments that do not touch. Each lag is divided by its own number of pairs: dividing by all samples would keep it positive
// definite, but taper it, and short segments would then seem quieter at low frequency than they are. Where a lag's estimate
// leaves the positive definite ones the recursion ends one order lower, so the model is stable. The recursion passes through all lower orders: the first p samples of a segment are whitened by the predictors of order
// 0 to p - 1, so whitening is exact for a stationary process from the first sample on, none is lost, and the whitened
// segment has the Gaussian likelihood of the original.
//
// Fails for segments without power: a zero signal has no model (InvalidInput).

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct AutoregressiveModel {
  Eigen::MatrixXd coefficients;        ///< (p + 1, p): row k holds the predictor of order k, a_1 ... a_k
  Eigen::VectorXd innovation_std;      ///< (p + 1) of order 0 ... p, in the signal's unit

  [[nodiscard]] Index order() const { return coefficients.cols(); }
};

/// Model of order `order` at most: less where the segments are shorter or the recursion is exhausted (a signal that a
/// lower order predicts exactly).
/// Where the segments are expectations, `more` (order + 1) is the sum over all pairs at each lag of what they are expected to
/// covary by about them; empty: nothing.
AutoregressiveModel fit_autoregressive(const std::vector<Eigen::VectorXd>& segments, Index order, const Eigen::VectorXd& more = {});

/// Model of a process with the given autocovariance, at lags 0, 1 ... p; of lower order where the recursion is exhausted.
AutoregressiveModel autoregressive_of(const Eigen::VectorXd& autocovariance);

/// Model of what `second` leaves white once `first` has whitened it: their orders add up.
AutoregressiveModel in_series(const AutoregressiveModel& first, const AutoregressiveModel& second);

/// Each column of one segment whitened to unit variance, in place: (N, columns).
void whiten(const AutoregressiveModel& model, Eigen::Ref<Eigen::MatrixXd> columns);

}  // namespace circlepoint
