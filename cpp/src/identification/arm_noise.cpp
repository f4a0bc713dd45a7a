#include "arm_noise.hpp"

#include "arm_encoder_noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace circlepoint {

namespace {

constexpr Index highest_order = 8;
constexpr Index rows_per_coefficient = 25;
constexpr double knock = 6.0;          // standard deviations
constexpr double model_failure = 0.2;  // share of rows beyond which knocks are none

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

// The common low-pass leaves white noise neither white nor, once thinned out, well said by few coefficients: at low frequency,
// where the arm shows itself, there is a tenth more than on average. What the filter does is known, and costs no coefficient.
AutoregressiveModel filtered_white(const ArmRows& rows) {
  constexpr Index order = 6;
  const auto step = static_cast<Index>(std::lround(rows.sample_rate / rows.rate));
  const Eigen::VectorXd covariance = smoothed_autocovariance(rows.cutoff, rows.sample_rate, step, order + 1);
  return autoregressive_of(covariance / covariance[0]);
}

// With `before`, of the orders it has.
MotionNoise fit_kind(const StretchResiduals& moving, const std::vector<std::size_t>& members, Index channels,
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
    noise.rotation.emplace_back(solver.eigenvectors().transpose());
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

// The sensor's own noise where coarse encoders add theirs, of known covariance: one step of expectation and maximisation for the
// spectrum's shape, one of scoring for each channel's size, which expectation alone is slow to find.
MotionNoise fit_kind_beside_encoders(const StretchResiduals& moving, const std::vector<std::size_t>& members,
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

// The quietest channel's noise in all: where encoders add theirs, what a search for the sensor's own begins with.
MotionNoise quietest(const MotionNoise& noise) {
  MotionNoise start;
  start.rotation.emplace_back(Eigen::Matrix3d::Identity());
  start.channels.assign(3, noise.channels.front());
  return start;
}

// With coarse encoders, what the counts and the modelled yields leave repeats in part with every cycle of the motion, and averaging
// over cycles does not lessen that part. The factor to the variance by the most cycles of any stretch, 1 where nothing is so
// modelled. The share is a figure of experience: with a half, intervals of simulated recordings are honest.
double repetition_factor(const ArmRows& rows, const std::vector<std::size_t>& members) {
  constexpr double repeating_share = 0.5;
  double most = 1.0;
  for (const std::size_t member : members) {
    const MovingStretch& stretch = rows.stretches[member];
    if (!rows.yields || stretch.joint < 0 ||
        std::none_of(stretch.follows.begin(), stretch.follows.end(), [](bool follows) { return follows; })) {
      continue;
    }
    const Eigen::VectorXd position = stretch.position.col(stretch.joint);
    const double path = (position.tail(position.size() - 1) - position.head(position.size() - 1)).cwiseAbs().sum();
    most = std::max(most, path / std::max(1e-12, 2.0 * (position.maxCoeff() - position.minCoeff())));
  }
  return 1.0 + repeating_share * (most - 1.0);
}

void scale(MotionNoise& noise, double factor) {
  noise.factor *= factor;
  for (AutoregressiveModel& channel : noise.channels) {
    channel.innovation_std *= std::sqrt(factor);
  }
}

}  // namespace

ArmNoise white_noise(const ArmRows& rows, double moving_std, double dwell_std, double rate_std) {
  ArmNoise noise;
  noise.dwell_excess = Eigen::VectorXd::Constant(rows.channels, dwell_std);
  MotionNoise kind;
  for (Index triad = 0; triad < rows.channels / 3; ++triad) {
    kind.rotation.emplace_back(Eigen::Matrix3d::Identity());
    for (int channel = 0; channel < 3; ++channel) {
      kind.channels.push_back({Eigen::MatrixXd::Zero(1, 0), Eigen::VectorXd::Constant(1, triad == 0 ? moving_std : rate_std)});
    }
  }
  if (rows.channels == 6) {
    noise.dwell_excess.tail<3>().setConstant(rate_std);
  }
  Index kinds = 0;
  for (const MovingStretch& stretch : rows.stretches) {
    kinds = std::max(kinds, stretch.noise + 1);
  }
  noise.kinds.assign(static_cast<std::size_t>(kinds), kind);
  return noise;
}

ArmNoise estimate_noise(const ArmRows& rows, const StretchResiduals& moving, const Eigen::MatrixXd& dwells,
                        const Eigen::MatrixXd& dwell_variance, double parameters, double inflation,
                        const std::vector<Eigen::MatrixXd>& encoders, const ArmNoise* before, bool settled) {
  ArmNoise noise;
  noise.inflation = inflation;
  Index kinds = 0;
  double total = static_cast<double>(dwells.size());
  for (const MovingStretch& stretch : rows.stretches) {
    kinds = std::max(kinds, stretch.noise + 1);
    total += static_cast<double>(stretch.rows() * rows.channels);
  }
  const AutoregressiveModel filter = filtered_white(rows);
  for (Index kind = 0; kind < kinds; ++kind) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
      if (rows.stretches[i].noise == kind) {
        members.push_back(i);
      }
    }
    if (members.empty()) {  // all its rows were knocks
      noise.kinds.push_back(before != nullptr ? before->kinds[static_cast<std::size_t>(kind)] : MotionNoise{});
      continue;
    }
    const bool coarse = std::any_of(members.begin(), members.end(), [&](std::size_t i) { return encoders[i].size() > 0; });
    if (coarse) {
      MotionNoise start = before != nullptr ? before->kinds[static_cast<std::size_t>(kind)]
                                            : quietest(fit_kind(moving, members, rows.channels, filter, nullptr));
      scale(start, 1.0 / start.factor);
      noise.kinds.push_back(settled ? start : fit_kind_beside_encoders(moving, members, encoders, start, filter));
    } else {
      const bool hold = settled && before != nullptr;
      noise.kinds.push_back(fit_kind(moving, members, rows.channels, filter, hold ? &before->kinds[static_cast<std::size_t>(kind)] : nullptr));
    }
    scale(noise.kinds.back(), total / std::max(total - parameters, 1.0) * repetition_factor(rows, members) * inflation);
  }
  include_encoders(noise, rows, encoders);
  // The excess that makes the dwells' normalised squares average one, by bisection.
  noise.dwell_excess = Eigen::VectorXd::Zero(rows.channels);
  const double dof = static_cast<double>(dwells.rows()) * std::max(0.2, 1.0 - parameters / std::max(1.0, total));
  for (Index triad = 0; triad < rows.channels / 3 && dwells.rows() > 0; ++triad) {
    const auto excess_squares = [&](double variance) {
      return (dwells.middleCols<3>(3 * triad).array().square() / (dwell_variance.middleCols<3>(3 * triad).array() + variance)).sum() -
             3.0 * dof;
    };
    double low = 0.0;
    double high = dwells.middleCols<3>(3 * triad).array().square().maxCoeff() + 1e-12;
    if (excess_squares(0.0) > 0.0) {
      for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (excess_squares(middle) > 0.0 ? low : high) = middle;
      }
      noise.dwell_excess.segment<3>(3 * triad).setConstant(std::sqrt(high));
    }
  }
  return noise;
}

double InflationSearch::next(double inflation, double ratio) {
  constexpr double far_enough = 0.05;  // of two logarithms, to tell a slope
  const Tried now{std::log(inflation), std::log(std::max(ratio, 1e-6))};
  double slope = -1.0;
  if (before_ && std::abs(now.inflation - before_->inflation) > far_enough) {
    slope = std::clamp((now.ratio - before_->ratio) / (now.inflation - before_->inflation), -4.0, -1.0);
  }
  before_ = now;
  return std::max(1.0, std::exp(now.inflation - now.ratio / slope));
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

void include_encoders(ArmNoise& noise, const ArmRows& rows, const std::vector<Eigen::MatrixXd>& encoders) {
  noise.encoder.assign(encoders.size(), {});
  for (std::size_t i = 0; i < encoders.size(); ++i) {
    if (encoders[i].size() == 0) {
      continue;
    }
    const MovingStretch& stretch = rows.stretches[i];
    const MotionNoise& kind = noise.kinds[static_cast<std::size_t>(stretch.noise)];
    Eigen::MatrixXd covariance = kind.factor * encoders[i];
    whiten_stretch(kind, stretch.rows(), covariance);
    covariance.transposeInPlace();
    whiten_stretch(kind, stretch.rows(), covariance);
    covariance.diagonal().array() += 1.0;
    noise.encoder[i] = covariance.llt().matrixL();
  }
}

void whiten_stretch(const ArmNoise& noise, const ArmRows& rows, std::size_t index, Eigen::Ref<Eigen::MatrixXd> columns) {
  const MovingStretch& stretch = rows.stretches[index];
  whiten_stretch(noise.kinds[static_cast<std::size_t>(stretch.noise)], stretch.rows(), columns);
  if (index < noise.encoder.size() && noise.encoder[index].size() > 0) {
    noise.encoder[index].triangularView<Eigen::Lower>().solveInPlace(columns);
  }
}

void name_kinds(ArmRows& rows, Index joints) {
  constexpr Index shortest = 100;
  std::vector<Index> count(static_cast<std::size_t>(joints) + 1, 0);
  const auto slot = [joints](const MovingStretch& stretch) {
    return static_cast<std::size_t>(stretch.joint >= 0 ? stretch.joint : joints);
  };
  for (const MovingStretch& stretch : rows.stretches) {
    count[slot(stretch)] += stretch.rows();
  }
  std::vector<Index> kind(count.size(), -1);
  Index kinds = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] >= shortest) {
      kind[i] = kinds++;
    }
  }
  Index shared = -1;
  for (MovingStretch& stretch : rows.stretches) {
    Index& mine = kind[slot(stretch)];
    if (mine < 0) {
      shared = shared < 0 ? kinds++ : shared;
      mine = shared;
    }
    stretch.noise = mine;
  }
}

Index cut_knocks(ArmRows& rows, const StretchResiduals& whitened_residuals, const Eigen::MatrixXd& dwells_normalized) {
  constexpr Index margin = 4;
  constexpr Index shortest = 5;
  std::vector<MovingStretch> kept;
  Index removed = 0;
  Index total = 0;
  for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
    const MovingStretch& stretch = rows.stretches[i];
    const Eigen::MatrixXd& whitened = whitened_residuals[i];
    std::vector<bool> bad(static_cast<std::size_t>(stretch.rows()), false);
    for (Index row = 0; row < stretch.rows(); ++row) {
      if (whitened.row(row).cwiseAbs().maxCoeff() > knock) {
        for (Index k = std::max<Index>(0, row - margin); k < std::min(stretch.rows(), row + margin + 1); ++k) {
          bad[static_cast<std::size_t>(k)] = true;
        }
      }
    }
    total += stretch.rows();
    Index begin = 0;
    for (Index row = 0; row <= stretch.rows(); ++row) {
      const bool ends = row == stretch.rows() || bad[static_cast<std::size_t>(row)];
      if (!ends) {
        continue;
      }
      if (row - begin >= shortest) {
        std::vector<Index> good(static_cast<std::size_t>(row - begin));
        std::iota(good.begin(), good.end(), begin);
        kept.push_back(picked(stretch, good));
      } else {
        removed += row - begin;
      }
      removed += row < stretch.rows() ? 1 : 0;
      begin = row + 1;
    }
  }
  if (static_cast<double>(removed) > model_failure * static_cast<double>(total)) {
    return 0;
  }
  rows.stretches = std::move(kept);
  std::vector<DwellRow> dwells;
  for (std::size_t i = 0; i < rows.dwells.size(); ++i) {
    if (dwells_normalized.row(static_cast<Index>(i)).cwiseAbs().maxCoeff() <= knock) {
      dwells.push_back(rows.dwells[i]);
    }
  }
  const auto dropped = static_cast<Index>(rows.dwells.size() - dwells.size());
  if (static_cast<double>(dropped) <= model_failure * static_cast<double>(rows.dwells.size())) {
    rows.dwells = std::move(dwells);
    removed += dropped;
  }
  return removed;
}

}  // namespace circlepoint
