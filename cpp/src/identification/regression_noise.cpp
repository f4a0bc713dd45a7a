#include "regression_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace circlepoint {

double residual_rms(const Eigen::Ref<const Samples3>& residual, double parameters) {
  const double dof = std::max(1.0, static_cast<double>(residual.size()) - parameters);
  return std::sqrt(residual.squaredNorm() / dof);
}

Eigen::MatrixXd score_covariance(const Eigen::Ref<const SamplesX>& x, const Eigen::Ref<const Samples3>& residual, double sample_rate) {
  const Index block = std::max<Index>(1, static_cast<Index>(std::lround(0.25 * sample_rate)));
  const Index coefficients = x.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * coefficients, 3 * coefficients);
  Eigen::MatrixXd score(coefficients, 3);
  Index blocks = 0;
  for (Index begin = 0; begin < x.rows(); begin += block) {
    const Index count = std::min(block, x.rows() - begin);
    score.noalias() = x.middleRows(begin, count).transpose() * residual.middleRows(begin, count);
    const Eigen::Map<const Eigen::VectorXd> stacked(score.data(), score.size());
    sum += stacked * stacked.transpose();
    ++blocks;
  }
  // As many coefficients a channel were fitted to the same residuals.
  const double inflation =
      blocks > coefficients ? static_cast<double>(blocks) / static_cast<double>(blocks - coefficients) : 2.0;
  return inflation * sum;
}

double correlation_factor(const Eigen::MatrixXd& score_covariance, const Eigen::MatrixXd& information, double variance) {
  const Index coefficients = information.rows();
  const Eigen::MatrixXd ridge = 1e-12 * information.diagonal().asDiagonal().toDenseMatrix();
  const Eigen::LDLT<Eigen::MatrixXd> factor(information + ridge);
  double sum = 0.0;
  for (Index channel = 0; channel < 3; ++channel) {
    const Index at = channel * coefficients;
    sum += factor.solve(score_covariance.block(at, at, coefficients, coefficients)).trace();
  }
  return std::clamp(sum / (static_cast<double>(3 * coefficients) * std::max(variance, 1e-300)), 1.0, 1e6);
}

Eigen::VectorXd without_knocks(const Eigen::Ref<const Samples3>& residual, Index margin) {
  const Index count = residual.rows();
  Eigen::VectorXd kept = Eigen::VectorXd::Ones(count);
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd magnitude = residual.col(channel).cwiseAbs();
    Eigen::VectorXd sorted = magnitude;
    std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.end());
    const double limit = 6.0 * 1.4826 * sorted[count / 2];
    for (Index i = 0; i < count; ++i) {
      if (magnitude[i] > limit) {
        const Index begin = std::max<Index>(0, i - margin);
        kept.segment(begin, std::min(count, i + margin + 1) - begin).setZero();
      }
    }
  }
  return kept.mean() > 0.8 ? kept : Eigen::VectorXd(Eigen::VectorXd::Ones(count));
}

Eigen::MatrixXd score_by_sensor(const Eigen::MatrixXd& information, const Eigen::MatrixXd& score, const Eigen::MatrixXd& square_score) {
  const Index coefficients = information.rows();
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(3 * coefficients, sensor_errors);
  for (Index channel = 0; channel < 3; ++channel) {
    const Index at = channel * coefficients;
    derivative.block(at, channel, coefficients, 1) = -information.col(0);
    derivative.block(at, 3 + channel, coefficients, 1) = -score.col(channel);
    derivative.block(at, 9 + channel, coefficients, 1) = -square_score.col(channel);
  }
  derivative.block(coefficients, 6, coefficients, 1) = -score.col(0);
  derivative.block(2 * coefficients, 7, coefficients, 1) = -score.col(0);
  derivative.block(2 * coefficients, 8, coefficients, 1) = -score.col(1);
  return derivative;
}

}  // namespace circlepoint
