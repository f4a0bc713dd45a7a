#include "delay_profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace circlepoint::detail {
namespace {

constexpr double rank_threshold = 1e-7;  // of the scaled regressors

Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factorise(const Eigen::MatrixXd& x) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(rank_threshold);
  qr.compute(x);
  return qr;
}

// Variance of sum(residual * sensitivity) for stationary residuals: sum over lags of gamma(k) c(k), lags weighted down
// linearly (Bartlett) up to a quarter of the stretch.
double score_variance(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& sensitivity) {
  const Index m = residual.rows();
  const Index lags = std::max<Index>(1, m / 4);
  double variance = 0.0;
  for (Index channel = 0; channel < residual.cols(); ++channel) {
    const auto r = residual.col(channel);
    const auto z = sensitivity.col(channel);
    for (Index k = 0; k < lags; ++k) {
      const double gamma = r.head(m - k).dot(r.tail(m - k)) / static_cast<double>(m);
      const double c = z.head(m - k).dot(z.tail(m - k));
      variance += (k == 0 ? 1.0 : 2.0 * (1.0 - static_cast<double>(k) / static_cast<double>(lags))) * gamma * c;
    }
  }
  return variance;
}

}  // namespace

std::optional<DelayProfile> DelayProfile::make(const MotionModel& model, const UniformStream& joints,
                                               const UniformStream& sensor, const SamplesX& smooth_sensor,
                                               const RelativeClock& clock, double range, double margin,
                                               Index most_regressors) {
  DelayProfile profile;
  profile.row_period_ = joints.period;
  profile.row_start_ = joints.time(model.rows.begin);
  profile.range_ = range;
  const double begin = profile.row_start_ + range + 2.0 * joints.period;
  const double end = joints.time(model.rows.end - 1) - range - 3.0 * joints.period;
  std::vector<double> instants;
  std::vector<Index> samples;
  const auto stride = std::max<Index>(1, static_cast<Index>(0.02 / sensor.period));
  for (const IndexRange& span : sensor.spans) {
    for (Index i = span.begin; i < span.end; i += stride) {
      const double u = clock.joint(sensor.time(i));
      const bool settled = sensor.time(i) > sensor.time(span.begin) + margin
          && sensor.time(i) < sensor.time(span.end - 1) - margin;
      if (u > begin && u < end && settled) {
        instants.push_back(u);
        samples.push_back(i);
      }
    }
  }
  const auto m = static_cast<Index>(instants.size());
  if (m < 8 + model.regressors.cols()) {
    return std::nullopt;
  }
  profile.period_ = static_cast<double>(stride) * sensor.period;
  profile.instants_ = Eigen::Map<const Eigen::VectorXd>(instants.data(), m);
  profile.readings_.resize(m, 3);
  for (Index i = 0; i < m; ++i) {
    profile.readings_.row(i) = smooth_sensor.row(samples[static_cast<std::size_t>(i)]);
  }
  profile.regressors_ = model.regressors.leftCols(std::min(most_regressors, model.regressors.cols()));
  for (Index k = 1; k < profile.regressors_.cols(); ++k) {
    auto column = profile.regressors_.col(k);
    column.array() -= column.mean();
    const double size = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
    column /= size > 0.0 ? size : 1.0;
  }
  return profile;
}

Eigen::MatrixXd DelayProfile::regressors_at(double delay) const {
  Eigen::MatrixXd x(instants_.size(), regressors_.cols());
  const Index rows = regressors_.rows();
  for (Index i = 0; i < instants_.size(); ++i) {
    const double position = std::clamp((instants_(i) - delay - row_start_) / row_period_, 1.0,
        static_cast<double>(rows) - 2.001);
    const auto k = static_cast<Index>(position);
    const double t = position - static_cast<double>(k);
    const double t2 = t * t, t3 = t2 * t;
    x.row(i) = 0.5 * ((-t3 + 2.0 * t2 - t) * regressors_.row(k - 1) + (3.0 * t3 - 5.0 * t2 + 2.0) * regressors_.row(k) +
                      (-3.0 * t3 + 4.0 * t2 + t) * regressors_.row(k + 1) + (t3 - t2) * regressors_.row(k + 2));
  }
  return x;
}

double DelayProfile::cost(double delay) const {
  const Eigen::MatrixXd x = regressors_at(delay);
  const auto qr = factorise(x);
  return (readings_ - x * qr.solve(readings_)).squaredNorm();
}

double DelayProfile::effective_samples(double cutoff) const {
  return 3.0 * std::min(2.0 * cutoff * period_, 1.0) * static_cast<double>(instants_.size());
}

DelayProfile::Estimate DelayProfile::minimise(Index steps, double unseen) const {
  const double step = range_ / static_cast<double>(std::max<Index>(steps, 10));
  Estimate estimate;
  double lowest = steps > 0 ? cost(0.0) : 0.0;
  for (Index k = -steps; k <= steps && steps > 0; ++k) {
    const double value = cost(static_cast<double>(k) * step);
    if (value < lowest) {
      lowest = value;
      estimate.delay = static_cast<double>(k) * step;
    }
  }
  const double nudge = 1e-3;
  const Index m = readings_.rows();
  for (int iteration = 0; iteration < 6; ++iteration) {
    const Eigen::MatrixXd x = regressors_at(estimate.delay);
    const auto qr = factorise(x);
    const Eigen::MatrixXd coefficients = qr.solve(readings_);
    const Eigen::MatrixXd residual = readings_ - x * coefficients;
    Eigen::MatrixXd sensitivity =
        (regressors_at(estimate.delay + nudge) - regressors_at(estimate.delay - nudge)) * coefficients / (2.0 * nudge);
    sensitivity -= x * qr.solve(sensitivity);
    const double curvature = sensitivity.squaredNorm();
    if (!(curvature > 0.0)) {
      return {};
    }
    const double change = residual.cwiseProduct(sensitivity).sum() / curvature;
    const double freedom = std::max(0.1, 1.0 - static_cast<double>(qr.rank() + 1) * 3.0 / effective_samples(5.0));
    estimate.model_residual = std::sqrt(residual.squaredNorm() / static_cast<double>(m));
    const double white = residual.squaredNorm() / static_cast<double>(3 * m) / curvature;
    const double coloured = score_variance(residual, sensitivity) / (curvature * curvature);
    const double coherent = static_cast<double>(m) * unseen * unseen / curvature;
    estimate.std = std::sqrt(std::max(white, coloured) / freedom + coherent);
    estimate.centre = sensitivity.rowwise().squaredNorm().dot(instants_) / curvature;
    estimate.delay += std::clamp(change, -step, step);
    if (std::abs(change) < 1e-9) {
      break;
    }
  }
  estimate.interior = std::abs(estimate.delay) < range_ - step;
  return estimate;
}

}  // namespace circlepoint::detail
