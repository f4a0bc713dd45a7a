#include "arm_noise.hpp"

#include <Eigen/Eigenvalues>
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
  return {model.coefficients.topLeftCorner(best + 1, best), model.innovation_std.head(best + 1)};
}

MotionNoise fit_kind(const StretchResiduals& moving, const std::vector<std::size_t>& members, Index channels) {
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
      noise.channels.push_back(with_fewest_coefficients(fit_autoregressive(segments, order), count));
      // The innovations' size by the residuals themselves: the pooled autocovariance errs on the wide side.
      double squares = 0.0;
      for (Eigen::VectorXd& segment : segments) {
        whiten(noise.channels.back(), segment);
        squares += segment.squaredNorm();
      }
      // The model's own coefficients were fitted to the same residuals.
      const auto freedom = static_cast<double>(std::max<Index>(1, count - noise.channels.back().order()));
      noise.channels.back().innovation_std *= std::sqrt(squares / freedom);
    }
  }
  return noise;
}

// With coarse encoders, what the counts and the modelled yields leave repeats in part with every cycle of the motion, and averaging
// over cycles does not lessen that part. The factor to the variance by the most cycles of any stretch, 1 where nothing is so
// modelled. The share is a figure of experience: with a half, intervals of simulated recordings are honest.
double repetition_factor(const ArmRows& rows, const std::vector<std::size_t>& members) {
  constexpr double repeating_share = 0.5;
  double most = 1.0;
  for (const std::size_t member : members) {
    const MovingStretch& stretch = rows.stretches[member];
    if (stretch.joint < 0 || std::none_of(stretch.follows.begin(), stretch.follows.end(), [](bool follows) { return follows; })) {
      continue;
    }
    const Eigen::VectorXd position = stretch.position.col(stretch.joint);
    const double path = (position.tail(position.size() - 1) - position.head(position.size() - 1)).cwiseAbs().sum();
    most = std::max(most, path / std::max(1e-12, 2.0 * (position.maxCoeff() - position.minCoeff())));
  }
  return 1.0 + repeating_share * (most - 1.0);
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
                        const Eigen::MatrixXd& dwell_variance, double parameters, double inflation) {
  ArmNoise noise;
  noise.inflation = inflation;
  Index kinds = 0;
  double total = static_cast<double>(dwells.size());
  for (const MovingStretch& stretch : rows.stretches) {
    kinds = std::max(kinds, stretch.noise + 1);
    total += static_cast<double>(stretch.rows() * rows.channels);
  }
  for (Index kind = 0; kind < kinds; ++kind) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
      if (rows.stretches[i].noise == kind) {
        members.push_back(i);
      }
    }
    noise.kinds.push_back(fit_kind(moving, members, rows.channels));
    const double repeats = repetition_factor(rows, members);
    for (AutoregressiveModel& channel : noise.kinds.back().channels) {
      channel.innovation_std *= std::sqrt(total / std::max(total - parameters, 1.0) * repeats * inflation);
    }
  }
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
