#include "arm_noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace circlepoint {

namespace {

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

// m/s^2 or rad/s: the standard deviation in every direction that, beside what is known of each dwell, makes three channels' residuals
// likeliest; zero where the likelihood falls from there. Where an encoder's count tilts gravity, what is across that direction tells.
// `freedom`: the share that no parameter takes; what shared offsets take is left out.
double dwell_excess(const Eigen::MatrixXd& dwells, const std::vector<Eigen::MatrixXd>& covariance, Index channel, double freedom) {
  const Index count = dwells.rows();
  Eigen::ArrayXXd known(3, count);    // variance in each dwell's principal directions
  Eigen::ArrayXXd squares(3, count);  // there
  for (Index i = 0; i < count; ++i) {
    const Eigen::Matrix3d mine = covariance[static_cast<std::size_t>(i)].block<3, 3>(channel, channel);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(mine);
    known.col(i) = directions.eigenvalues().cwiseMax(0.0);
    squares.col(i) = (directions.eigenvectors().transpose() * dwells.row(i).segment<3>(channel).transpose()).array().square() / freedom;
  }
  // Minus twice the slope of the logarithm of the likelihood: below zero where more is likelier.
  const auto slope = [&](double variance) {
    const Eigen::ArrayXXd weight = (known + variance).inverse();
    return (weight - squares * weight.square()).sum();
  };
  double low = 0.0;
  double high = count > 0 ? squares.maxCoeff() : 0.0;
  if (!(high > 0.0) || slope(1e-3 * known.minCoeff()) >= 0.0) {
    return 0.0;
  }
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0.0 ? low : high) = middle;
  }
  return std::sqrt(high);
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
                        const std::vector<Eigen::MatrixXd>& dwell_covariance, double parameters, double inflation,
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
                                            : quietest(fit_motion_noise(moving, members, rows.channels, filter, nullptr));
      scale(start, 1.0 / start.factor);
      noise.kinds.push_back(settled ? start : fit_beside_encoders(moving, members, encoders, start, filter));
    } else {
      const bool hold = settled && before != nullptr;
      const MotionNoise* held = hold ? &before->kinds[static_cast<std::size_t>(kind)] : nullptr;
      noise.kinds.push_back(fit_motion_noise(moving, members, rows.channels, filter, held));
    }
    scale(noise.kinds.back(), total / std::max(total - parameters, 1.0) * repetition_factor(rows, members) * inflation);
  }
  include_encoders(noise, rows, encoders);
  // A dwell without any scatter still has a weight.
  constexpr double least = 1e-6;  // m/s^2 or rad/s
  const double freedom = std::max(0.2, 1.0 - parameters / std::max(1.0, total));
  noise.dwell_excess.resize(rows.channels);
  for (Index triad = 0; triad < rows.channels / 3; ++triad) {
    noise.dwell_excess.segment<3>(3 * triad).setConstant(std::max(least, dwell_excess(dwells, dwell_covariance, 3 * triad, freedom)));
  }
  return noise;
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

double log_root_determinant(const ArmNoise& noise, const ArmRows& rows, std::size_t index) {
  const MovingStretch& stretch = rows.stretches[index];
  double sum = 0.0;
  for (const AutoregressiveModel& channel : noise.kinds[static_cast<std::size_t>(stretch.noise)].channels) {
    for (Index row = 0; row < stretch.rows(); ++row) {
      sum += std::log(channel.innovation_std[std::min(row, channel.order())]);
    }
  }
  if (index < noise.encoder.size() && noise.encoder[index].size() > 0) {
    sum += noise.encoder[index].diagonal().array().log().sum();
  }
  return sum;
}

}  // namespace circlepoint
