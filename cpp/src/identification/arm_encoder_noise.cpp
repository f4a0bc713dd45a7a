#include "arm_encoder_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "arm_problem.hpp"
#include "arm_smooth.hpp"

namespace circlepoint {
namespace {

// What one sample does to the smoothed position around it and to its derivatives: columns 0 to 2, from `reach` before to `reach` after.
Eigen::MatrixXd impulse_responses(double cutoff, double rate, Index reach) {
  const Index margin = 3 * reach;
  SamplesX impulse = SamplesX::Zero(2 * margin + 1, 1);
  impulse(margin, 0) = 1.0;
  const SamplesX position = low_passed(impulse, cutoff, rate);
  Eigen::MatrixXd responses(2 * reach + 1, 3);
  responses.col(0) = position.col(0).segment(margin - reach, 2 * reach + 1);
  for (int order = 1; order < 3; ++order) {
    responses.col(order) = differentiated(position, order, rate).col(0).segment(margin - reach, 2 * reach + 1);
  }
  return responses;
}

// C_cd += diag(g_a,c) E_ab diag(g_b,d) for all pairs of position, velocity and acceleration.
void add_error(const std::array<Eigen::MatrixXd, 3>& by_motion, const Eigen::MatrixXf& error, Eigen::MatrixXd& covariance) {
  const Index rows = by_motion[0].rows();
  const Eigen::MatrixXd exact = error.cast<double>();
  for (Index c = 0; c < 3; ++c) {
    Eigen::MatrixXd half = Eigen::MatrixXd::Zero(rows, 3 * rows);
    for (Index a = 0; a < 3; ++a) {
      half += by_motion[static_cast<std::size_t>(a)].col(c).asDiagonal() * exact.middleRows(a * rows, rows);
    }
    for (Index d = 0; d < 3; ++d) {
      for (Index b = 0; b < 3; ++b) {
        covariance.block(c * rows, d * rows, rows, rows) +=
            half.middleCols(b * rows, rows) * by_motion[static_cast<std::size_t>(b)].col(d).asDiagonal();
      }
    }
  }
}

}  // namespace

Eigen::MatrixXf count_error_covariance(const Eigen::Ref<const Eigen::VectorXd>& position, const Eigen::ArrayXi& rows, double cutoff,
                                       double rate) {
  const auto reach = static_cast<Index>(std::lround(2.0 * rate / cutoff));
  // What a row takes from the samples around it: the responses to them, backwards.
  const Eigen::MatrixXf weights = impulse_responses(cutoff, rate, reach).colwise().reverse().cast<float>();
  const Index count = rows.size();
  const Index first = rows[0] - reach;
  const Index size = rows[count - 1] + reach + 1 - first;
  // Beyond its ends a span is continued as its mirror image.
  const Index last = position.size() - 1;
  Eigen::ArrayXf around(size);
  for (Index i = 0; i < size; ++i) {
    const Index at = std::abs(first + i);
    const double counts = position[std::clamp<Index>(at > last ? 2 * last - at : at, 0, last)];
    around[i] = static_cast<float>(counts - std::floor(counts));
  }
  // E = A R A^T, a column of A R at a time.
  Eigen::MatrixXf carried = Eigen::MatrixXf::Zero(3 * count, size);
  Eigen::VectorXf column(size);
  for (Index k = 0; k < size; ++k) {
    const Eigen::ArrayXf apart = (around - around[k]).abs();
    column = 1.0F / 12.0F - 0.5F * apart * (1.0F - apart);
    for (Index i = 0; i < count; ++i) {
      const auto near = column.segment(rows[i] - reach - first, 2 * reach + 1);
      carried(i, k) = weights.col(0).dot(near);
      carried(count + i, k) = weights.col(1).dot(near);
      carried(2 * count + i, k) = weights.col(2).dot(near);
    }
  }
  Eigen::MatrixXf covariance(3 * count, 3 * count);
  for (Index i = 0; i < count; ++i) {
    const Eigen::MatrixXf here = carried.middleCols(rows[i] - reach - first, 2 * reach + 1) * weights;
    for (Index a = 0; a < 3; ++a) {
      covariance.col(a * count + i) = here.col(a);
    }
  }
  return 0.5F * (covariance + covariance.transpose());
}

Eigen::VectorXd smoothed_autocovariance(double cutoff, double rate, Index step, Index lags) {
  constexpr double widest = 4.0;  // cut-offs: the response is 4^-16 of itself there
  constexpr Index points_per_cycle = 12;
  const double last = std::min(0.5 * rate, widest * cutoff);
  const double longest = static_cast<double>(lags * step) / rate;
  const auto points = std::max<Index>(400, static_cast<Index>(std::ceil(static_cast<double>(points_per_cycle) * last * longest)));
  const double width = last / static_cast<double>(points);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(lags);
  const double corner = std::tan(std::numbers::pi * cutoff / rate);
  for (Index p = 0; p < points; ++p) {
    const double frequency = (static_cast<double>(p) + 0.5) * width;
    const double response = 1.0 / (1.0 + std::pow(std::tan(std::numbers::pi * frequency / rate) / corner, 8));
    const double turn = 2.0 * std::numbers::pi * frequency * static_cast<double>(step) / rate;
    for (Index lag = 0; lag < lags; ++lag) {
      result[lag] += 2.0 * width / rate * response * response * std::cos(turn * static_cast<double>(lag));
    }
  }
  return result;
}

std::vector<Eigen::MatrixXd> encoder_covariances(const ArmProblem& problem, const ArmState& state) {
  const std::vector<MovingStretch>& stretches = problem.rows.stretches;
  std::vector<Eigen::MatrixXd> covariances(stretches.size());
  ArmPredictor predictor(state, problem.layout);
  Eigen::Matrix3Xd jacobian(3, problem.layout.columns);
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    const MovingStretch& stretch = stretches[s];
    const Index rows = stretch.rows();
    if (stretch.errors.empty() || rows < 2) {
      continue;
    }
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
      add_error(by_motion[k], stretch.errors[k].covariance, covariances[s]);
    }
  }
  return covariances;
}

}  // namespace circlepoint
