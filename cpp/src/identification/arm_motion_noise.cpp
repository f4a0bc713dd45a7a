#include "arm_motion_noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "arm_encoder_noise.hpp"

namespace circlepoint {

namespace {

constexpr Index highest_order = 8;
constexpr Index rows_per_coefficient = 25;

AutoregressiveModel of_order(const AutoregressiveModel& model, Index order) {
  return {model.coefficients.topLeftCorner(order + 1, order), model.innovation_std.head(order + 1)};
}

// The order whose coefficients the samples pay for (Schwarz' criterion): each one fitted in vain costs precision.
AutoregressiveModel with_fewest_coefficients(const AutoregressiveModel& model, Index samples) {
  const auto count = static_cast<double>(samples);
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index order = 0; order <= model.order(); ++order) {
    const double criterion = 2.0 * count * std::log(model.innovation_std[order]) + std::log(count) * static_cast<double>(order);
    if (criterion < least) {
      least = criterion;
      best = order;
    }
  }
  return of_order(model, best);
}

}  // namespace

AutoregressiveModel filtered_white(const ArmRows& rows) {
  constexpr Index order = 6;
  const auto step = static_cast<Index>(std::lround(rows.sample_rate / rows.rate));
  const Eigen::VectorXd covariance = smoothed_autocovariance(rows.cutoff, rows.sample_rate, step, order + 1);
  return autoregressive_of(covariance / covariance[0]);
}

MotionNoise fit_motion_noise(const StretchResiduals& moving, const std::vector<std::size_t>& members, Index channels,
                             const AutoregressiveModel& filter, const MotionNoise* before) {
  MotionNoise noise;
  Index count = 0;
  for (const std::size_t member : members) {
    count += moving[member].rows();
  }
  const Index order = std::clamp<Index>(count / rows_per_coefficient, 0, highest_order);
  for (Index triad = 0; triad < channels / 3; ++triad) {
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const std::size_t member : members) {
      const auto residual = moving[member].middleCols<3>(3 * triad);
      scatter += residual.transpose() * residual;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    noise.rotation.push_back(before != nullptr ? before->rotation[noise.rotation.size()]
                                               : Eigen::Matrix3d(solver.eigenvectors().transpose()));
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<Eigen::VectorXd> segments;
      for (const std::size_t member : members) {
        segments.emplace_back(moving[member].middleCols<3>(3 * triad) * noise.rotation.back().row(channel).transpose());
      }
      // Readings that fit exactly (a simulation without noise) still need a scale.
      segments.front()[0] += 1e-9;
      for (Eigen::VectorXd& segment : segments) {
        whiten(filter, segment);
      }
      const AutoregressiveModel full = fit_autoregressive(segments, order);
      const auto held = [&] { return before->channels[noise.channels.size()].order() - filter.order(); };
      const AutoregressiveModel beyond =
          before != nullptr ? of_order(full, std::clamp<Index>(held(), 0, full.order())) : with_fewest_coefficients(full, count);
      noise.channels.push_back(in_series(filter, beyond));
      // The innovations' size by the residuals themselves: the pooled autocovariance errs on the wide side.
      double squares = 0.0;
      for (Eigen::VectorXd& segment : segments) {
        whiten(beyond, segment);
        squares += segment.squaredNorm();
      }
      // The model's own coefficients were fitted to the same residuals.
      const auto freedom = static_cast<double>(std::max<Index>(1, count - beyond.order()));
      noise.channels.back().innovation_std *= std::sqrt(squares / freedom);
    }
  }
  return noise;
}

MotionNoise fit_beside_encoders(const StretchResiduals& moving, const std::vector<std::size_t>& members,
                                const std::vector<Eigen::MatrixXd>& encoders, const MotionNoise& before,
                                const AutoregressiveModel& filter) {
  struct Expected {
    Eigen::MatrixXd residual;    // (M, 3) of the sensor
    Eigen::MatrixXd covariance;  // (3 M, 3 M) it is known to
  };
  std::vector<Expected> expected;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d score = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  Index count = 0;
  for (const std::size_t member : members) {
    const Index rows = moving[member].rows();
    count += rows;
    Eigen::MatrixXd whitening = Eigen::MatrixXd::Identity(3 * rows, 3 * rows);
    whiten_stretch(before, rows, whitening);
    const Eigen::VectorXd whitened = whitening * moving[member].reshaped(3 * rows, 1);
    Expected mine;
    Eigen::VectorXd sensor = whitened;
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(3 * rows, 3 * rows);
    if (encoders[member].size() > 0) {
      const Eigen::MatrixXd all = inverse + whitening * encoders[member] * whitening.transpose();
      inverse = all.llt().solve(inverse);
      sensor = inverse * whitened;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> back(whitening);
    mine.residual = back.solve(sensor).reshaped(rows, 3);
    const Eigen::MatrixXd half = back.solve(Eigen::MatrixXd::Identity(3 * rows, 3 * rows) - inverse);
    mine.covariance = back.solve(half.transpose());
    for (int c = 0; c < 3; ++c) {
      const double squares = sensor.segment(c * rows, rows).squaredNorm();
      const double trace = inverse.diagonal().segment(c * rows, rows).sum();
      score[c] += 0.5 * (squares - trace);
      size[c] += squares + static_cast<double>(rows) - trace;
      for (int d = 0; d < 3; ++d) {
        information(c, d) += 0.5 * inverse.block(c * rows, d * rows, rows, rows).squaredNorm();
        scatter(c, d) += mine.covariance.block(c * rows, d * rows, rows, rows).trace();
      }
    }
    scatter += mine.residual.transpose() * mine.residual;
    expected.push_back(std::move(mine));
  }
  // Variances' factors by scoring, over those by expectation, which the fit below finds anyway.
  const Eigen::Vector3d found = (Eigen::Vector3d::Ones() + information.ldlt().solve(score)).cwiseMax(0.2).cwiseMin(5.0);
  const Eigen::Vector3d ahead = found.cwiseQuotient(size / static_cast<double>(count));
  MotionNoise noise;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  noise.rotation.emplace_back(solver.eigenvectors().transpose());
  const Eigen::Matrix3d across = noise.rotation[0] * before.rotation[0].transpose();
  const Index order = std::clamp<Index>(count / rows_per_coefficient, 0, highest_order);
  Eigen::Vector3d determined;
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::Vector3d direction = noise.rotation[0].row(channel);
    std::vector<Eigen::VectorXd> segments;
    Eigen::VectorXd more = Eigen::VectorXd::Zero(order + 1);
    for (const Expected& mine : expected) {
      const Index rows = mine.residual.rows();
      segments.emplace_back(mine.residual * direction);
      Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(rows, rows);
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 3; ++d) {
          covariance += direction[c] * direction[d] * mine.covariance.block(c * rows, d * rows, rows, rows);
        }
      }
      whiten(filter, covariance);
      covariance.transposeInPlace();
      whiten(filter, covariance);
      for (Index lag = 0; lag <= std::min(order, rows - 1); ++lag) {
        more[lag] += covariance.diagonal(lag).sum();
      }
    }
    segments.front()[0] += 1e-9;
    for (Eigen::VectorXd& segment : segments) {
      whiten(filter, segment);
    }
    noise.channels.push_back(in_series(filter, with_fewest_coefficients(fit_autoregressive(segments, order, more), count)));
    noise.channels.back().innovation_std *= std::sqrt(across.row(channel).cwiseAbs2().dot(ahead));
    determined[channel] = across.row(channel).cwiseAbs2().dot(information.diagonal());
  }
  // A channel that the encoders drown is not quieter than those they leave alone.
  const auto innovation = [&](int channel) { return noise.channels[static_cast<std::size_t>(channel)].innovation_std.tail<1>()[0]; };
  int quietest = -1;
  for (int channel = 0; channel < 3; ++channel) {
    if (determined[channel] >= 0.5 * determined.maxCoeff() && (quietest < 0 || innovation(channel) < innovation(quietest))) {
      quietest = channel;
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    if (determined[channel] < 0.5 * determined.maxCoeff() && innovation(channel) < innovation(quietest)) {
      noise.channels[static_cast<std::size_t>(channel)] = noise.channels[static_cast<std::size_t>(quietest)];
    }
  }
  return noise;
}

MotionNoise quietest(const MotionNoise& noise) {
  MotionNoise start;
  start.rotation.emplace_back(Eigen::Matrix3d::Identity());
  start.channels.assign(3, noise.channels.front());
  return start;
}

void whiten_stretch(const MotionNoise& noise, Index rows, Eigen::Ref<Eigen::MatrixXd> columns) {
  for (std::size_t triad = 0; triad < noise.rotation.size(); ++triad) {
    const Eigen::Matrix3d& rotation = noise.rotation[triad];
    const Index at = 3 * static_cast<Index>(triad) * rows;
    for (Index column = 0; column < columns.cols(); ++column) {
      Eigen::Map<Eigen::MatrixXd> samples(&columns(at, column), rows, 3);
      samples = (samples * rotation.transpose()).eval();
    }
    for (int channel = 0; channel < 3; ++channel) {
      whiten(noise.channels[3 * triad + static_cast<std::size_t>(channel)], columns.middleRows(at + channel * rows, rows));
    }
  }
}

}  // namespace circlepoint
