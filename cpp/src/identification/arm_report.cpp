#include "arm_report.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>

#include "arm_marginal.hpp"

namespace circlepoint {
namespace {

constexpr double invisible = 1e-10;  // of the scaled information's largest eigenvalue: below it nothing is seen

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

std::string joint_of(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot == std::string::npos ? std::string() : name.substr(0, dot);
}

// What to record, by which parameters are tangled.
std::string remedy(const std::vector<std::string>& names) {
  bool line = false;
  bool sensor = false;
  bool clock = false;
  std::vector<std::string> joints;
  for (const std::string& name : names) {
    const std::string joint = joint_of(name);
    line = line || !joint.empty();
    sensor = sensor || joint.empty();
    clock = clock || name.starts_with("clock") || name == "gyroscope_delay";
    if (!joint.empty() && std::find(joints.begin(), joints.end(), joint) == joints.end()) {
      joints.push_back(joint);
    }
  }
  std::string who;
  for (const std::string& joint : joints) {
    who += (who.empty() ? "" : ", ") + joint;
  }
  if (line && sensor) {
    return "turn the joints beyond " + who + " to other angles and repeat " + (joints.size() == 1 ? "its" : "their") +
           " motion there, so that gravity meets the sensor from other sides";
  }
  if (line) {
    return "move " + who + (joints.size() == 1 ? " alone, farther and faster" : " one at a time, each farther and faster");
  }
  if (clock) {
    return "move the joints to and fro, faster";
  }
  return "hold still at more orientations of the sensor, six or more well apart";
}

// Shortens "joint2.d1, joint2.d2, joint2.p1" for reading.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " with ") + name;
  }
  return text;
}

StretchResidual describe(const std::string& name) {
  StretchResidual entry;
  entry.name = name;
  entry.begin = std::numeric_limits<double>::infinity();
  entry.end = -std::numeric_limits<double>::infinity();
  return entry;
}

ArmProblem without_rows(const ArmProblem& problem) {
  ArmProblem empty;
  empty.rows.channels = problem.rows.channels;
  empty.rows.middle = problem.rows.middle;
  empty.layout = problem.layout;
  empty.noise.kinds = problem.noise.kinds;
  empty.noise.dwell_excess = problem.noise.dwell_excess;
  empty.offsets = problem.offsets;
  return empty;
}

// The state the estimate would have been without one part, to first order; none where the rest does not determine it.
std::optional<ArmState> without(const ArmProblem& problem, const ArmState& state, const PartEquations& part, const Eigen::MatrixXd& information) {
  const NormalEquations mine = marginal_part(problem, part);
  const Eigen::MatrixXd rest = information - mine.information;
  const Eigen::LDLT<Eigen::MatrixXd> factor(rest);
  const Eigen::VectorXd step = factor.solve(mine.gradient);
  // Data that nothing else replaces cannot be predicted: the step would leave the linearisation.
  const double reach = step.dot(information * step);
  return step.allFinite() && reach < 25.0 * static_cast<double>(step.size()) ? std::optional(moved(state, problem.layout, step))
                                                                          : std::nullopt;
}

}  // namespace

Identifiability identifiability(const NormalEquations& data, const Eigen::MatrixXd& covariance, const ArmState& state,
                                const ArmLayout& layout) {
  const Index columns = layout.columns;
  const Eigen::VectorXd root = data.information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled = root.cwiseInverse().asDiagonal() * data.information * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
  const double largest = eigenvalues[columns - 1];
  Identifiability result;
  result.rank = static_cast<int>((eigenvalues.array() > invisible * largest).count());
  result.condition_number = largest / std::max(eigenvalues[0], 1e-300);
  result.data_std = Eigen::VectorXd::Zero(columns);
  for (Index k = 0; k < columns; ++k) {
    const Eigen::VectorXd vector = solver.eigenvectors().col(k).cwiseQuotient(root);
    if (eigenvalues[k] > invisible * largest) {
      result.data_std += vector.cwiseAbs2() / eigenvalues[k];
    } else {
      for (Index c = 0; c < columns; ++c) {
        if (std::abs(solver.eigenvectors()(c, k)) > 1e-3) {
          result.data_std[c] = std::numeric_limits<double>::infinity();
        }
      }
    }
  }
  result.data_std = result.data_std.cwiseSqrt();

  // Along a weak direction: which parameters take part (by their own standard deviations without priors) and how far it reaches.
  const std::vector<std::string> names = parameter_names(state, layout);
  for (Index k = 0; k < columns && result.weak.size() < 6; ++k) {
    if (eigenvalues[k] > 1e-5 * largest) {
      break;
    }
    const Eigen::VectorXd vector = solver.eigenvectors().col(k);
    std::vector<Index> order(static_cast<std::size_t>(columns));
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return std::abs(vector[a]) > std::abs(vector[b]); });
    std::vector<std::string> parts;
    double share = 0.0;
    for (const Index c : order) {
      if (share > 0.9 || parts.size() >= 4) {
        break;
      }
      share += vector[c] * vector[c];
      parts.push_back(names[static_cast<std::size_t>(c)]);
    }
    const Index main = order[0];
    WeakCombination weak;
    weak.information_ratio = std::max(0.0, eigenvalues[k] / largest);
    const double alone = 1.0 / (root[main] * std::sqrt(std::max(eigenvalues[k], 1e-300))) * std::abs(vector[main]);
    weak.description = listed(parts) + (eigenvalues[k] > invisible * largest
                                            ? ": the data alone leave " + names[static_cast<std::size_t>(main)] + " at +- " +
                                                  short_number(alone)
                                            : ": the data do not show it at all") +
                       ", with what is known beforehand +- " + short_number(std::sqrt(covariance(main, main))) + "; " + remedy(parts);
    result.weak.push_back(std::move(weak));
  }
  return result;
}

std::vector<StretchResidual> hold_out(const ArmProblem& problem, const ArmState& state, const std::vector<PartEquations>& parts,
                                      const Eigen::MatrixXd& information, const ArmResiduals& residuals_in) {
  const auto joints = static_cast<Index>(state.axes.size());
  std::vector<StretchResidual> entries;
  std::vector<Index> entry_of(static_cast<std::size_t>(joints) + 1, -1);
  const std::size_t stretches = problem.rows.stretches.size();
  for (std::size_t i = 0; i < stretches; ++i) {
    const MovingStretch& stretch = problem.rows.stretches[i];
    const auto slot = static_cast<std::size_t>(stretch.joint >= 0 ? stretch.joint : joints);
    if (entry_of[slot] < 0) {
      entry_of[slot] = static_cast<Index>(entries.size());
      entries.push_back(describe(stretch.joint >= 0 ? "joint " + std::to_string(stretch.joint + 1) : "several joints"));
    }
    StretchResidual& entry = entries[static_cast<std::size_t>(entry_of[slot])];
    ArmProblem alone = without_rows(problem);
    alone.rows.stretches = {stretch};
    if (i < problem.noise.encoder.size()) {
      alone.noise.encoder = {problem.noise.encoder[i]};
    }
    const std::optional<ArmState> rest = without(problem, state, parts[i], information);
    entry.begin = std::min(entry.begin, stretch.time[0]);
    entry.end = std::max(entry.end, stretch.time[stretch.rows() - 1]);
    entry.samples += stretch.rows();
    entry.residual_rms += residuals_in.moving[i].leftCols<3>().squaredNorm();
    entry.normalized_rms += problem.noise.inflation * residuals_in.whitened[i].leftCols<3>().squaredNorm();
    if (!rest) {
      ++entry.indispensable;
      continue;
    }
    const ArmResiduals held = residuals(alone, *rest);
    entry.held_out_samples += stretch.rows();
    entry.held_out_rms += held.moving[0].leftCols<3>().squaredNorm();
    entry.held_out_normalized_rms += problem.noise.inflation * held.whitened[0].leftCols<3>().squaredNorm();
  }
  if (!problem.rows.dwells.empty()) {
    StretchResidual entry = describe("dwells");
    for (std::size_t i = 0; i < problem.rows.dwells.size(); ++i) {
      ArmProblem alone = without_rows(problem);
      alone.rows.dwells = {problem.rows.dwells[i]};
      const std::optional<ArmState> rest = without(problem, state, parts[stretches + i], information);
      const auto row = static_cast<Index>(i);
      entry.begin = std::min(entry.begin, problem.rows.dwells[i].time);
      entry.end = std::max(entry.end, problem.rows.dwells[i].time);
      ++entry.samples;
      entry.residual_rms += residuals_in.dwells.row(row).head<3>().squaredNorm();
      entry.normalized_rms += residuals_in.dwells_normalized.row(row).head<3>().squaredNorm();
      if (!rest) {
        ++entry.indispensable;
        continue;
      }
      const ArmResiduals held = residuals(alone, *rest);
      ++entry.held_out_samples;
      entry.held_out_rms += held.dwells.leftCols<3>().squaredNorm();
      entry.held_out_normalized_rms += held.dwells_normalized.leftCols<3>().squaredNorm();
    }
    entries.push_back(entry);
  }
  for (StretchResidual& entry : entries) {
    const double count = 3.0 * static_cast<double>(entry.samples);
    entry.residual_rms = std::sqrt(entry.residual_rms / count);
    entry.normalized_rms = std::sqrt(entry.normalized_rms / count);
    const double held_out = 3.0 * static_cast<double>(entry.held_out_samples);
    entry.held_out_rms = std::sqrt(entry.held_out_rms / held_out);
    entry.held_out_normalized_rms = std::sqrt(entry.held_out_normalized_rms / held_out);
  }
  return entries;
}

}  // namespace circlepoint
