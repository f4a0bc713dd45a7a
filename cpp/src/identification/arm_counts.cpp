#include "arm_counts.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <utility>

namespace circlepoint {
namespace {

constexpr double supposed_change = 0.03;   // counts rms that changes scatter by, supposed with the weight of
constexpr double supposed_weight = 4.0;    // changes
constexpr double finest_change = 5e-3;     // counts: no boundary is known better
constexpr double worst_change = 0.35;      // counts rms: the model does not hold beyond

// Squared counts: the position midway between two samples of which one is on either side of a boundary is off by as much as the joint
// may have moved from it in that time; of several boundaries passed at once, by what its motion and their number leave open.
Eigen::ArrayXd between_samples(const CountRows& counts) {
  const Eigen::ArrayXd moved = counts.change_moved.array().abs();
  return (moved.min(1.0).square() + (counts.change_size.array() - moved.max(1.0)).square().min(1.0)) / 12.0;
}

JointFit fit_joint(const std::vector<CountRows>& counts, const std::vector<std::size_t>& tests) {
  JointFit fit;
  fit.tests = tests;
  Index columns = 1;
  for (const std::size_t t : tests) {
    fit.first.push_back(columns);
    columns += counts[t].within_functions.cols();
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(columns);
  information(0, 0) = 12.0;  // home shows one count: its middle, within a twelfth of a squared count
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const CountRows& mine = counts[tests[k]];
    const Index size = mine.within_functions.cols();
    // Within the counts: in all as much as says that the deflection is known to within_std. A joint that goes to and fro over one
    // boundary shows a square wave, whose error of a count's scatter lies in one direction: so much is left open in each then.
    const double directions = mine.change.size() > 0 || !mine.small ? 1.0 : static_cast<double>(size);
    const double weight = directions / (mine.within_std * mine.within_std * static_cast<double>(mine.within.size()));
    information.block(fit.first[k], fit.first[k], size, size) += weight * mine.within_functions.transpose() * mine.within_functions;
    gradient.segment(fit.first[k], size) += weight * mine.within_functions.transpose() * mine.within;
    if (mine.change.size() == 0) {
      continue;
    }
    const Eigen::ArrayXd variance = mine.repeats.array() * (mine.change_std * mine.change_std) + between_samples(mine);
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(mine.change.size(), columns);
    system.col(0).setOnes();
    system.middleCols(fit.first[k], size) = mine.change_functions;
    const Eigen::MatrixXd weighted = variance.inverse().matrix().asDiagonal() * system;
    information += weighted.transpose() * system;
    gradient += weighted.transpose() * mine.change;
  }
  fit.covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(columns, columns));
  fit.estimate = fit.covariance * gradient;
  return fit;
}

// What the changes of a test are off by.
struct Scatter {
  double freedom = 0.0;
  double squares = 0.0;  // counts^2
  double beyond = 0.0;   // the same, beyond what passes between samples

  [[nodiscard]] double rms() const { return freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0; }
};

Scatter scatter(const CountRows& counts, const Eigen::VectorXd& c, double home) {
  const auto size = static_cast<double>(counts.change.size());
  Scatter result;
  if (counts.change.size() > 0) {
    result.freedom = std::max(0.3 * size, size - static_cast<double>(c.size()));
    result.squares = ((counts.change_functions * c - counts.change).array() + home).square().sum();
    result.beyond = std::max(0.0, result.squares - between_samples(counts).sum() * result.freedom / size);
  }
  return result;
}

}  // namespace

void count_repeats(CountRows& counts) {
  std::map<std::pair<long, bool>, double> times;
  const auto kind = [&](Index i) { return std::pair{std::lround(2.0 * counts.change[i]), counts.upward[i] > 0.5}; };
  for (Index i = 0; i < counts.change.size(); ++i) {
    times[kind(i)] += 1.0;
  }
  counts.repeats = Eigen::VectorXd::NullaryExpr(counts.change.size(), [&](Index i) { return times[kind(i)]; });
}

void read_counts(CountRows& counts, const Eigen::MatrixXd& phi, const Eigen::Ref<const Eigen::VectorXd>& encoder, Index thinning) {
  std::vector<Index> changes;
  std::vector<Index> within;
  for (Index k = 0; k < encoder.size(); ++k) {
    if (k + 1 < encoder.size() && std::abs(encoder[k + 1] - encoder[k]) > 0.5) {
      changes.push_back(k);
    }
    if (k % thinning == 0) {
      within.push_back(k);
    }
  }
  const auto append = [](Eigen::MatrixXd& matrix, Eigen::VectorXd& values, const Eigen::MatrixXd& more, const Eigen::VectorXd& value) {
    const Index before = values.size();
    matrix.conservativeResize(before + value.size(), more.cols());
    values.conservativeResize(before + value.size());
    matrix.bottomRows(value.size()) = more;
    values.tail(value.size()) = value;
  };
  const auto count = static_cast<Index>(changes.size());
  Eigen::MatrixXd functions_there(count, phi.cols());
  Eigen::MatrixXd motion(count, phi.cols());
  Eigen::VectorXd value(count);
  Eigen::VectorXd size(count);
  Eigen::VectorXd upward(count);
  for (Index k = 0; k < count; ++k) {
    const Index at = changes[static_cast<std::size_t>(k)];
    functions_there.row(k) = 0.5 * (phi.row(at) + phi.row(at + 1));
    motion.row(k) = phi.row(at + 1) - phi.row(at);
    value[k] = 0.5 * (encoder[at] + encoder[at + 1]);
    size[k] = std::abs(encoder[at + 1] - encoder[at]);
    upward[k] = encoder[at + 1] > encoder[at] ? 1.0 : 0.0;
  }
  const Index before = counts.change.size();
  append(counts.change_functions, counts.change, functions_there, value);
  counts.change_motion.conservativeResize(before + count, phi.cols());
  counts.change_motion.bottomRows(count) = motion;
  counts.change_moved = Eigen::VectorXd::Zero(before + count);
  counts.change_size.conservativeResize(counts.change.size());
  counts.change_size.tail(count) = size;
  counts.upward.conservativeResize(counts.change.size());
  counts.upward.tail(count) = upward;
  append(counts.within_functions, counts.within, phi(within, Eigen::all), encoder(within));
}

JointFit fit_and_judge(std::vector<CountRows>& counts, std::vector<std::size_t> tests) {
  JointFit fit;
  for (int pass = 0; pass < 4; ++pass) {
    fit = fit_joint(counts, tests);
    std::vector<std::size_t> holding;
    std::vector<Scatter> off;
    Scatter all{supposed_weight, 0.0, supposed_weight * supposed_change * supposed_change};
    for (std::size_t k = 0; k < tests.size(); ++k) {
      CountRows& mine = counts[tests[k]];
      const Eigen::VectorXd c = fit.estimate.segment(fit.first[k], mine.within_functions.cols());
      mine.change_moved = mine.change_motion * c;
      const Scatter here = scatter(mine, c, fit.estimate[0]);
      if (pass > 0 && here.rms() > worst_change) {
        continue;
      }
      holding.push_back(tests[k]);
      off.push_back(here);
      if (here.rms() <= worst_change) {  // others tell nothing of those in which the model holds
        all.freedom += here.freedom;
        all.beyond += here.beyond;
      }
    }
    const double common = all.beyond / all.freedom;
    for (std::size_t k = 0; k < holding.size(); ++k) {
      const double variance = (off[k].beyond + supposed_weight * common) / (off[k].freedom + supposed_weight);
      counts[holding[k]].change_std = std::max(finest_change, std::sqrt(variance));
    }
    if (pass > 1 && holding.size() == tests.size()) {
      break;
    }
    tests = std::move(holding);
  }
  return fit;
}

}  // namespace circlepoint
