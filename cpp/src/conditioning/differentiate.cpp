#include "circlepoint/conditioning/differentiate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"
#include "signal_kernels.hpp"

namespace circlepoint {
namespace {

// (positions, window) weights: row p . samples of a window = derivative of its least-squares polynomial at sample
// positions[p]. The polynomial is in t = (sample - half) / max(half, 1), which keeps the fit well conditioned.
SamplesX window_weights(const Eigen::Ref<const Eigen::VectorXd>& positions, Index window, int polyorder, int deriv,
                        double delta) {
  const double half = 0.5 * static_cast<double>(window - 1);
  const double scale = std::max(half, 1.0);
  const auto powers = [&](const Eigen::VectorXd& t, int derivative) {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(t.size(), polyorder + 1);
    for (int k = derivative; k <= polyorder; ++k) {
      double factor = 1.0;
      for (int j = 0; j < derivative; ++j) {
        factor *= k - j;
      }
      columns.col(k) = factor * t.array().pow(k - derivative);
    }
    return columns;
  };
  const Eigen::VectorXd samples = Eigen::VectorXd::LinSpaced(window, -half, half) / scale;
  const Eigen::MatrixXd at_positions = powers((positions.array() - half) / scale, deriv);
  const Eigen::HouseholderQR<Eigen::MatrixXd> fit(powers(samples, 0));
  // weights = at_positions R^-1 Q^T
  const Index terms = polyorder + 1;
  const Eigen::MatrixXd solved = fit.matrixQR()
                                     .topLeftCorner(terms, terms)
                                     .triangularView<Eigen::Upper>()
                                     .transpose()
                                     .solve(at_positions.transpose());
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(window, positions.size());
  padded.topRows(terms) = solved;
  return (fit.householderQ() * padded).transpose() / std::pow(scale * delta, deriv);
}

}  // namespace

SamplesX gradient(const Eigen::Ref<const SamplesX>& y, double dx, int edge_order) {
  require(edge_order == 1 || edge_order == 2, "edge_order is " + std::to_string(edge_order) + "; give 1 or 2");
  require(std::isfinite(dx) && dx != 0.0, "dx is " + std::to_string(dx) + "; give the spacing of the samples");
  const Index n = y.rows();
  require(n > edge_order, "a gradient of edge order " + std::to_string(edge_order) + " needs " +
                              std::to_string(edge_order + 1) + " samples or more, there are " + std::to_string(n));
  SamplesX slope = detail::unwritten_samples(n, y.cols());
  slope.middleRows(1, n - 2) = (y.bottomRows(n - 2) - y.topRows(n - 2)) / (2.0 * dx);
  if (edge_order == 1) {
    slope.row(0) = (y.row(1) - y.row(0)) / dx;
    slope.row(n - 1) = (y.row(n - 1) - y.row(n - 2)) / dx;
  } else {
    slope.row(0) = (-1.5 / dx) * y.row(0) + (2.0 / dx) * y.row(1) + (-0.5 / dx) * y.row(2);
    slope.row(n - 1) = (0.5 / dx) * y.row(n - 3) + (-2.0 / dx) * y.row(n - 2) + (1.5 / dx) * y.row(n - 1);
  }
  return slope;
}

SamplesX savgol_filter(const Eigen::Ref<const SamplesX>& x, Index window_length, int polyorder, int deriv,
                       double delta) {
  const Index n = x.rows();
  const std::string window_text = "window_length is " + std::to_string(window_length);
  require(window_length > 0 && window_length % 2 == 1, window_text + "; give an odd number of samples");
  require(window_length <= n, window_text + ", the signal has " + std::to_string(n) +
                                  " samples; give a shorter window or a longer signal");
  require(polyorder >= 0 && polyorder < window_length,
          "polyorder is " + std::to_string(polyorder) + "; give one from 0 to window_length - 1 = " +
              std::to_string(window_length - 1));
  require(deriv >= 0, "deriv is " + std::to_string(deriv) + "; give 0 (smooth), 1, 2, ...");
  require(std::isfinite(delta) && delta != 0.0,
          "delta is " + std::to_string(delta) + "; give the spacing of the samples");
  const Index half = window_length / 2;
  const Index channels = x.cols();
  if (deriv > polyorder) {
    return SamplesX::Zero(n, channels);
  }
  SamplesX y = detail::unwritten_samples(n, channels);
  const detail::ClearedAhead ahead(y);
  const Eigen::VectorXd positions = Eigen::VectorXd::LinSpaced(window_length, 0.0, static_cast<double>(2 * half));
  const SamplesX weights = window_weights(positions, window_length, polyorder, deriv, delta);
  y.topRows(half) = weights.topRows(half) * x.topRows(window_length);
  y.bottomRows(half) = weights.bottomRows(half) * x.bottomRows(window_length);

  // Weights of an even derivative are symmetric about the centre, of an odd one antisymmetric.
  const double sign = deriv % 2 == 0 ? 1.0 : -1.0;
  const Eigen::RowVectorXd centre = weights.row(half);
  const Eigen::VectorXd one_sided =
      0.5 * (centre.tail(half + 1) + sign * centre.head(half + 1).reverse()).transpose();
  const SamplesX copy = x.outerStride() == channels ? SamplesX() : SamplesX(x);
  const double* inner_x = (x.outerStride() == channels ? x.data() : copy.data()) + half * channels;
  double* inner_y = y.data() + half * channels;
  const Index inner_values = (n - 2 * half) * channels;
  detail::signal_kernels().correlate(inner_x, inner_y, inner_values, one_sided.data(), half, channels, deriv % 2 == 0);
  return y;
}

}  // namespace circlepoint
