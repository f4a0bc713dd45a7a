#include "arm_scores.hpp"

#include <algorithm>
#include <cmath>

#include "arm_marginal.hpp"

namespace circlepoint {
namespace {

// Which motion each stretch is, numbered by first appearance: stretches whose joints go the same way in the same time are of one.
std::vector<std::size_t> repeated_motions(const ArmRows& rows) {
  constexpr double near = 0.05;    // of a joint's travel in the whole recording
  constexpr double still = 1e-3;   // rad or m
  constexpr double as_long = 0.2;  // of the number of rows
  constexpr int places = 5;
  std::vector<Eigen::MatrixXd> paths;  // (places, n) of the first stretch of each motion
  std::vector<double> lengths;
  std::vector<std::size_t> motions;
  Eigen::ArrayXd lowest;
  Eigen::ArrayXd highest;
  for (const MovingStretch& stretch : rows.stretches) {
    const Eigen::ArrayXd low = stretch.position.colwise().minCoeff().transpose();
    const Eigen::ArrayXd high = stretch.position.colwise().maxCoeff().transpose();
    lowest = lowest.size() == 0 ? low : lowest.min(low).eval();
    highest = highest.size() == 0 ? high : highest.max(high).eval();
  }
  for (const MovingStretch& stretch : rows.stretches) {
    const Eigen::ArrayXi at = Eigen::ArrayXi::LinSpaced(places, 0, static_cast<int>(stretch.rows() - 1));
    const Eigen::MatrixXd path = stretch.position(at, Eigen::all);
    const auto length = static_cast<double>(stretch.rows());
    std::size_t motion = 0;
    while (motion < paths.size() && (std::abs(length - lengths[motion]) > as_long * lengths[motion] ||
                                     ((path - paths[motion]).cwiseAbs().colwise().maxCoeff().transpose().array() >
                                      (near * (highest - lowest)).max(still))
                                         .any())) {
      ++motion;
    }
    if (motion == paths.size()) {
      paths.push_back(path);
      lengths.push_back(length);
    }
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace

double score_ratio(const ArmProblem& problem, const std::vector<PartEquations>& parts, const Eigen::MatrixXd& covariance) {
  std::vector<int> uses(static_cast<std::size_t>(problem.offsets.size()), 0);
  const auto count = [&](const auto& parts_with_offsets) {
    for (const auto& part : parts_with_offsets) {
      for (const OffsetTerm& term : part.offsets) {
        ++uses[static_cast<std::size_t>(term.parameter)];
      }
    }
  };
  count(problem.rows.stretches);
  count(problem.rows.dwells);
  const auto shared = [&](const OffsetTerm& term) { return uses[static_cast<std::size_t>(term.parameter)] > 1; };
  const auto shares_counts = [&](const MovingStretch& stretch) {
    return !stretch.errors.empty() && std::any_of(stretch.offsets.begin(), stretch.offsets.end(), shared);
  };
  if (std::any_of(problem.rows.stretches.begin(), problem.rows.stretches.end(), shares_counts)) {
    return 1.0;
  }
  std::vector<NormalEquations> motions;
  const std::vector<std::size_t> motion = repeated_motions(problem.rows);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (motion[i] == motions.size()) {
      motions.push_back(NormalEquations::zero(problem.layout.columns));
    }
    motions[motion[i]] += marginal_part(problem, parts[i]);
  }
  double seen = 0.0;
  double expected = 0.0;
  for (const NormalEquations& all : motions) {
    const Eigen::MatrixXd leverage = covariance * all.information;
    seen += all.gradient.dot(covariance * all.gradient);
    expected += leverage.trace() - leverage.cwiseProduct(leverage.transpose()).sum();
  }
  return expected > 0.0 ? seen / expected : 1.0;
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

}  // namespace circlepoint
