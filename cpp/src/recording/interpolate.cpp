#include "circlepoint/recording/interpolate.hpp"

#include <algorithm>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

// Second derivatives at the knots: tridiagonal, the not-a-knot conditions folded into the first and last rows.
SamplesX second_derivatives(const Eigen::VectorXd& h, const Eigen::Ref<const SamplesX>& y) {
  const Index n = y.rows();
  SamplesX m = SamplesX::Zero(n, y.cols());
  if (n == 3) {
    m.row(0) = 2.0 * ((y.row(2) - y.row(1)) / h(1) - (y.row(1) - y.row(0)) / h(0)) / (h(0) + h(1));
    m.row(1) = m.row(0);
    m.row(2) = m.row(0);
    return m;
  }
  const Index inner = n - 2;
  Eigen::VectorXd lower(inner), diagonal(inner), upper(inner);
  for (Index i = 0; i < inner; ++i) {
    lower(i) = h(i);
    diagonal(i) = 2.0 * (h(i) + h(i + 1));
    upper(i) = h(i + 1);
    m.row(i + 1) = 6.0 * ((y.row(i + 2) - y.row(i + 1)) / h(i + 1) - (y.row(i + 1) - y.row(i)) / h(i));
  }
  const double first = h(0) / h(1);
  const double last = h(n - 2) / h(n - 3);
  diagonal(0) += h(0) * (1.0 + first);
  upper(0) -= h(0) * first;
  diagonal(inner - 1) += h(n - 2) * (1.0 + last);
  lower(inner - 1) -= h(n - 2) * last;
  for (Index i = 1; i < inner; ++i) {
    const double factor = lower(i) / diagonal(i - 1);
    diagonal(i) -= factor * upper(i - 1);
    m.row(i + 1) -= factor * m.row(i);
  }
  m.row(inner) /= diagonal(inner - 1);
  for (Index i = inner - 2; i >= 0; --i) {
    m.row(i + 1) = (m.row(i + 1) - upper(i) * m.row(i + 2)) / diagonal(i);
  }
  m.row(0) = (1.0 + first) * m.row(1) - first * m.row(2);
  m.row(n - 1) = (1.0 + last) * m.row(n - 2) - last * m.row(n - 3);
  return m;
}

}  // namespace

SamplesX interpolate_cubic(const Eigen::Ref<const Eigen::VectorXd>& knots, const Eigen::Ref<const SamplesX>& values,
                           const Eigen::Ref<const Eigen::VectorXd>& at) {
  const Index n = knots.size();
  require(n >= 1 && values.rows() == n, "interpolation needs a value for each knot: " + std::to_string(n) + " knots, " +
                                            std::to_string(values.rows()) + " values");
  const Eigen::VectorXd h = knots.tail(n - 1) - knots.head(n - 1);
  for (Index i = 0; i < n - 1; ++i) {
    require(h(i) > 0.0, "interpolation knots must increase: knot " + std::to_string(i + 2) + " is " +
                            std::to_string(knots(i + 1)) + " after " + std::to_string(knots(i)));
  }
  SamplesX result(at.size(), values.cols());
  if (n == 1) {
    result.rowwise() = values.row(0);
    return result;
  }
  const SamplesX m = n > 2 ? second_derivatives(h, values) : SamplesX::Zero(n, values.cols());
  for (Index i = 0; i < at.size(); ++i) {
    const Index above = std::upper_bound(knots.data(), knots.data() + n, at(i)) - knots.data();
    const Index k = std::clamp<Index>(above - 1, 0, n - 2);
    const double a = (knots(k + 1) - at(i)) / h(k);
    const double b = 1.0 - a;
    const double square = h(k) * h(k) / 6.0;
    result.row(i) = a * values.row(k) + b * values.row(k + 1) + (a * a * a - a) * square * m.row(k) +
                    (b * b * b - b) * square * m.row(k + 1);
  }
  return result;
}

}  // namespace circlepoint
