#include "arm_encoder_noise.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "arm_problem.hpp"

namespace circlepoint {

namespace {

constexpr int derivatives = 5;  // of the autocovariance, the zeroth included

// C_cd += diag(g_a,c) T_ab diag(g_b,d), T_ab(i, k) = cov(e^(a)(t_i), e^(b)(t_k)) = (-1)^b r^(a + b)(t_i - t_k).
void add_error(const std::array<Eigen::MatrixXd, 3>& by_motion, const Eigen::MatrixXd& autocovariance, const Eigen::ArrayXi& lag,
               double variance, Eigen::MatrixXd& covariance) {
  const Index rows = lag.size();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const double sign = b == 1 ? -1.0 : 1.0;
      const bool odd = (a + b) % 2 != 0;
      Eigen::MatrixXd toeplitz(rows, rows);
      for (Index k = 0; k < rows; ++k) {
        for (Index i = 0; i < rows; ++i) {
          const double value = variance * sign * autocovariance(std::abs(lag[i] - lag[k]), a + b);
          toeplitz(i, k) = odd && i < k ? -value : value;
        }
      }
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 3; ++d) {
          covariance.block(c * rows, d * rows, rows, rows) +=
              by_motion[static_cast<std::size_t>(a)].col(c).asDiagonal() * toeplitz *
              by_motion[static_cast<std::size_t>(b)].col(d).asDiagonal();
        }
      }
    }
  }
}

}  // namespace

Eigen::MatrixXd smoothed_autocovariance(double cutoff, double rate, Index step, Index lags) {
  constexpr double widest = 4.0;  // cut-offs: the response is 4^-16 of itself there
  constexpr Index points_per_cycle = 12;
  const double last = std::min(0.5 * rate, widest * cutoff);
  const double longest = static_cast<double>(lags * step) / rate;
  const auto points = std::max<Index>(400, static_cast<Index>(std::ceil(static_cast<double>(points_per_cycle) * last * longest)));
  const double width = last / static_cast<double>(points);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(lags, derivatives);
  const double corner = std::tan(std::numbers::pi * cutoff / rate);
  for (Index p = 0; p < points; ++p) {
    const double frequency = (static_cast<double>(p) + 0.5) * width;
    const double response = 1.0 / (1.0 + std::pow(std::tan(std::numbers::pi * frequency / rate) / corner, 8));
    const double omega = 2.0 * std::numbers::pi * frequency;
    const double power = 2.0 * width / rate * response * response;
    const double turn = omega * static_cast<double>(step) / rate;
    for (Index lag = 0; lag < lags; ++lag) {
      const double cosine = power * std::cos(turn * static_cast<double>(lag));
      const double sine = power * std::sin(turn * static_cast<double>(lag));
      result(lag, 0) += cosine;
      result(lag, 1) -= omega * sine;
      result(lag, 2) -= omega * omega * cosine;
      result(lag, 3) += omega * omega * omega * sine;
      result(lag, 4) += omega * omega * omega * omega * cosine;
    }
  }
  return result;
}

std::vector<Eigen::MatrixXd> encoder_covariances(const ArmProblem& problem, const ArmState& state) {
  const std::vector<MovingStretch>& stretches = problem.rows.stretches;
  std::vector<Eigen::MatrixXd> covariances(stretches.size());
  std::map<std::pair<double, Index>, Eigen::MatrixXd> tables;
  ArmPredictor predictor(state, problem.layout);
  Eigen::Matrix3Xd jacobian(3, problem.layout.columns);
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    const MovingStretch& stretch = stretches[s];
    const Index rows = stretch.rows();
    if (stretch.errors.empty() || rows < 2) {
      continue;
    }
    const Index step = stretch.sample[1] - stretch.sample[0];
    const Eigen::ArrayXi lag = (stretch.sample - stretch.sample[0]) / static_cast<int>(step);
    std::vector<std::array<Eigen::MatrixXd, 3>> by_motion(stretch.errors.size());
    for (auto& of_joint : by_motion) {
      of_joint.fill(Eigen::MatrixXd(rows, 3));
    }
    JointInstant instant;
    for (Index i = 0; i < rows; ++i) {
      set_instant(stretch, i, problem, instant);
      predictor.reading(instant, jacobian);
      for (std::size_t k = 0; k < stretch.errors.size(); ++k) {
        const Index joint = stretch.errors[k].joint;
        by_motion[k][0].row(i) = predictor.by_joint().position.col(joint);
        by_motion[k][1].row(i) = predictor.by_joint().velocity.col(joint);
        by_motion[k][2].row(i) = predictor.by_joint().acceleration.col(joint);
      }
    }
    covariances[s] = Eigen::MatrixXd::Zero(3 * rows, 3 * rows);
    for (std::size_t k = 0; k < stretch.errors.size(); ++k) {
      const PositionError& error = stretch.errors[k];
      Eigen::MatrixXd& table = tables[{error.cutoff, step}];
      if (table.rows() <= lag[rows - 1]) {
        table = smoothed_autocovariance(error.cutoff, problem.rows.sample_rate, step, lag[rows - 1] + 1);
      }
      add_error(by_motion[k], table, lag, error.variance, covariances[s]);
    }
  }
  return covariances;
}

}  // namespace circlepoint
