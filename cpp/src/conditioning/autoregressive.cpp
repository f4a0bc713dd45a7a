#include "circlepoint/conditioning/autoregressive.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {

AutoregressiveModel fit_autoregressive(const std::vector<Eigen::VectorXd>& segments, Index order, const Eigen::VectorXd& more) {
  require(order >= 0, "order is " + std::to_string(order) + "; give 0 (white) or more");
  Index count = 0;
  Index longest = 0;
  for (const Eigen::VectorXd& segment : segments) {
    count += segment.size();
    longest = std::max(longest, segment.size());
  }
  order = std::min(order, std::max<Index>(0, longest - 1));
  Eigen::VectorXd covariance = Eigen::VectorXd::Zero(order + 1);
  Eigen::VectorXd pairs = Eigen::VectorXd::Zero(order + 1);
  for (const Eigen::VectorXd& segment : segments) {
    for (Index lag = 0; lag <= std::min(order, segment.size() - 1); ++lag) {
      pairs[lag] += static_cast<double>(segment.size() - lag);
      covariance[lag] += segment.head(segment.size() - lag).dot(segment.tail(segment.size() - lag));
    }
  }
  if (more.size() > 0) {
    covariance += more.head(order + 1);
  }
  require(count > 0 && covariance[0] > 0.0 && std::isfinite(covariance[0]),
          "the segments have " + std::to_string(count) + " samples and power " + std::to_string(covariance[0]) +
              "; an autoregressive model needs finite, non-zero ones");
  return autoregressive_of(covariance.cwiseQuotient(pairs.cwiseMax(1.0)));
}

AutoregressiveModel autoregressive_of(const Eigen::VectorXd& covariance) {
  const Index order = covariance.size() - 1;
  AutoregressiveModel model;
  model.coefficients = Eigen::MatrixXd::Zero(order + 1, order);
  model.innovation_std = Eigen::VectorXd::Zero(order + 1);
  double variance = covariance[0];
  model.innovation_std[0] = std::sqrt(variance);
  for (Index k = 1; k <= order; ++k) {
    const Eigen::VectorXd before = model.coefficients.row(k - 1).head(k - 1);
    const double reflection = (covariance[k] - before.dot(covariance.segment(1, k - 1).reverse())) / variance;
    const double next = variance * (1.0 - reflection * reflection);
    if (!(next > 1e-12 * covariance[0])) {
      model.coefficients.conservativeResize(k, k - 1);
      model.innovation_std.conservativeResize(k);
      return model;
    }
    model.coefficients.row(k).head(k - 1) = before - reflection * before.reverse();
    model.coefficients(k, k - 1) = reflection;
    variance = next;
    model.innovation_std[k] = std::sqrt(variance);
  }
  return model;
}

AutoregressiveModel in_series(const AutoregressiveModel& first, const AutoregressiveModel& second) {
  const Index p = first.order();
  const Index q = second.order();
  // Prediction-error filters multiply: 1, -a_1, ... -a_p.
  const auto filter = [](const AutoregressiveModel& model, Index order) {
    Eigen::VectorXd taps(order + 1);
    taps[0] = 1.0;
    taps.tail(order) = -model.coefficients.row(order).head(order);
    return taps;
  };
  const Eigen::VectorXd one = filter(first, p);
  const Eigen::VectorXd other = filter(second, q);
  Eigen::VectorXd both = Eigen::VectorXd::Zero(p + q + 1);
  for (Index k = 0; k <= q; ++k) {
    both.segment(k, p + 1) += other[k] * one;
  }
  AutoregressiveModel model;
  model.coefficients = Eigen::MatrixXd::Zero(p + q + 1, p + q);
  model.innovation_std.resize(p + q + 1);
  model.coefficients.row(p + q) = -both.tail(p + q);
  model.innovation_std[p + q] = first.innovation_std[p] * second.innovation_std[q];
  // Lower orders by the recursion run backwards.
  for (Index k = p + q; k > 0; --k) {
    const Eigen::VectorXd here = model.coefficients.row(k).head(k);
    const double reflection = here[k - 1];
    const double left = 1.0 - reflection * reflection;
    model.coefficients.row(k - 1).head(k - 1) = (here.head(k - 1) + reflection * here.head(k - 1).reverse()) / left;
    model.innovation_std[k - 1] = model.innovation_std[k] / std::sqrt(left);
  }
  return model;
}

void whiten(const AutoregressiveModel& model, Eigen::Ref<Eigen::MatrixXd> columns) {
  const Index head = std::min(model.order(), columns.rows());
  const Index steady = columns.rows() - head;
  Eigen::VectorXd rest(steady);
  for (Index column = 0; column < columns.cols(); ++column) {
    auto x = columns.col(column);
    rest = x.tail(steady);
    const auto predicted = [&](Index lag) { return model.coefficients(head, lag - 1) * x.segment(head - lag, steady); };
    Index next = 1;
    for (; next + 3 <= head; next += 4) {  // four at once: one pass over the memory
      rest -= (predicted(next) + predicted(next + 1)) + (predicted(next + 2) + predicted(next + 3));
    }
    for (; next <= head; ++next) {
      rest -= predicted(next);
    }
    // The first samples by the predictors of lower order, from the last on, so that each still finds its predecessors as they were.
    for (Index t = head; t-- > 0;) {
      double prediction = 0.0;
      for (Index lag = 1; lag <= t; ++lag) {
        prediction += model.coefficients(t, lag - 1) * x[t - lag];
      }
      x[t] = (x[t] - prediction) / model.innovation_std[t];
    }
    x.tail(steady) = rest / model.innovation_std[head];
  }
}

}  // namespace circlepoint
