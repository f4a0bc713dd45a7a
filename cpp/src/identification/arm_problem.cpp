#include "arm_problem.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace circlepoint {

void set_instant(const MovingStretch& stretch, Index row, const ArmProblem& problem, JointInstant& instant) {
  instant.time_from_middle = stretch.time[row] - problem.rows.middle;
  instant.position = stretch.position.row(row);
  instant.velocity = stretch.velocity.row(row);
  instant.acceleration = stretch.acceleration.row(row);
  instant.jerk = stretch.jerk.row(row);
  instant.snap = stretch.snap.row(row);
  for (std::size_t k = 0; k < stretch.offsets.size(); ++k) {
    const OffsetTerm& term = stretch.offsets[k];
    const auto column = static_cast<Index>(k);
    const double offset = problem.offsets[term.parameter];
    instant.position[term.joint] += offset * stretch.shapes.position(row, column);
    instant.velocity[term.joint] += offset * stretch.shapes.velocity(row, column);
    instant.acceleration[term.joint] += offset * stretch.shapes.acceleration(row, column);
  }
}

namespace {

void set_instant(const DwellRow& dwell, double middle, const ArmProblem& problem, JointInstant& instant) {
  instant.time_from_middle = dwell.time - middle;
  instant.position = dwell.position;
  for (std::size_t k = 0; k < dwell.offsets.size(); ++k) {
    instant.position[dwell.offsets[k].joint] += problem.offsets[dwell.offsets[k].parameter] * dwell.shape[static_cast<Index>(k)];
  }
  instant.velocity = Eigen::VectorXd::Zero(dwell.position.size());
  instant.acceleration = instant.velocity;
  instant.jerk = instant.snap = instant.velocity;
}

// d reading / d parameter of every offset term at a stretch's row, of either sensor.
void fill_by_offset(const ByJoint& by_joint, const MovingStretch& stretch, Index row, Eigen::Ref<Eigen::MatrixXd> derivative) {
  for (std::size_t k = 0; k < stretch.offsets.size(); ++k) {
    const Index joint = stretch.offsets[k].joint;
    const auto column = static_cast<Index>(k);
    derivative.col(column) = by_joint.position.col(joint) * stretch.shapes.position(row, column) +
                             by_joint.velocity.col(joint) * stretch.shapes.velocity(row, column) +
                             by_joint.acceleration.col(joint) * stretch.shapes.acceleration(row, column);
  }
}

// Columns of a stretch's system: the layout's, its offsets and, last, the residual.
Index system_columns(const ArmProblem& problem, const MovingStretch& stretch) {
  return problem.layout.columns + static_cast<Index>(stretch.offsets.size()) + 1;
}

// Rows (channel-major) of Jacobian, last column residual.
void fill_system(const ArmProblem& problem, ArmPredictor& predictor, const MovingStretch& stretch, Eigen::MatrixXd& system) {
  const Index rows = stretch.rows();
  const Index columns = problem.layout.columns;
  const auto terms = static_cast<Index>(stretch.offsets.size());
  const Index last = columns + terms;
  system.setZero(rows * problem.rows.channels, last + 1);
  Eigen::Matrix3Xd jacobian(3, columns);
  JointInstant instant;
  Eigen::MatrixXd by_offset(3, terms);
  for (Index i = 0; i < rows; ++i) {
    set_instant(stretch, i, problem, instant);
    const Eigen::Vector3d reading = predictor.reading(instant, jacobian);
    if (terms > 0) {
      fill_by_offset(predictor.by_joint(), stretch, i, by_offset);
    }
    for (int channel = 0; channel < 3; ++channel) {
      system.row(channel * rows + i).head(columns) = jacobian.row(channel);
      system.row(channel * rows + i).segment(columns, terms) = by_offset.row(channel);
      system(channel * rows + i, last) = reading[channel] - stretch.reading(i, channel);
    }
    if (problem.rows.channels == 6) {
      const Eigen::Vector3d rate = predictor.angular_rate(instant, jacobian);
      if (terms > 0) {
        fill_by_offset(predictor.rate_by_joint(), stretch, i, by_offset);
      }
      for (int channel = 0; channel < 3; ++channel) {
        system.row((3 + channel) * rows + i).head(columns) = jacobian.row(channel);
        system.row((3 + channel) * rows + i).segment(columns, terms) = by_offset.row(channel);
        system((3 + channel) * rows + i, last) = rate[channel] - stretch.reading(i, 3 + channel);
      }
    }
  }
}

// Model - reading of a stretch, (rows, channels).
Eigen::MatrixXd differences(const ArmProblem& problem, ArmPredictor& predictor, const MovingStretch& stretch) {
  Eigen::MatrixXd result(stretch.rows(), problem.rows.channels);
  JointInstant instant;
  for (Index row = 0; row < stretch.rows(); ++row) {
    set_instant(stretch, row, problem, instant);
    result.row(row).head<3>() = predictor.reading(instant) - stretch.reading.row(row).head<3>().transpose();
    if (problem.rows.channels == 6) {
      result.row(row).tail<3>() = predictor.angular_rate(instant) - stretch.reading.row(row).tail<3>().transpose();
    }
  }
  return result;
}

struct DwellSystem {
  Eigen::MatrixXd rows;      // (channels, columns + 1), not weighted
  Eigen::MatrixXd variance;  // (channels, channels) by scatter and encoders
};

DwellSystem dwell_system(const ArmProblem& problem, ArmPredictor& predictor, const DwellRow& dwell) {
  const Index columns = problem.layout.columns;
  const Index channels = problem.rows.channels;
  const auto terms = static_cast<Index>(dwell.offsets.size());
  const Index last = columns + terms;
  DwellSystem system{Eigen::MatrixXd::Zero(channels, last + 1), Eigen::MatrixXd(dwell.variance.asDiagonal())};
  JointInstant instant;
  set_instant(dwell, problem.rows.middle, problem, instant);
  Eigen::Matrix3Xd jacobian(3, columns);
  const Eigen::Vector3d reading = predictor.reading(instant, jacobian);
  system.rows.topLeftCorner(3, columns) = jacobian;
  system.rows.col(last).head<3>() = reading - dwell.reading.head<3>();
  const Eigen::Matrix3Xd& by_position = predictor.by_joint().position;
  for (Index k = 0; k < terms; ++k) {
    system.rows.col(columns + k).head<3>() = by_position.col(dwell.offsets[static_cast<std::size_t>(k)].joint) * dwell.shape[k];
  }
  system.variance.topLeftCorner<3, 3>() += by_position * dwell.position_variance.asDiagonal() * by_position.transpose();
  if (channels == 6) {
    const Eigen::Vector3d rate = predictor.angular_rate(instant, jacobian);
    system.rows.bottomLeftCorner(3, columns) = jacobian;
    system.rows.col(last).tail<3>() = rate - dwell.reading.tail<3>();
  }
  return system;
}

// Of a system whose last column is the residual.
void set_normal_equations(NormalEquations& equations, const Eigen::MatrixXd& system) {
  const Index columns = system.cols() - 1;
  const auto jacobian = system.leftCols(columns);
  const auto residual = system.col(columns);
  equations.information.setZero(columns, columns);
  equations.information.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
  equations.information.triangularView<Eigen::StrictlyUpper>() = equations.information.transpose();
  equations.gradient.noalias() = jacobian.transpose() * residual;
  equations.cost = residual.squaredNorm();
}

// What a thread works with.
struct Workspace {
  ArmPredictor predictor;
  Eigen::MatrixXd system;
};

// Calls work(workspace, i) for i in [0, count) on the problem's threads.
template <class Work>
void for_each(const ArmProblem& problem, const ArmState& state, std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    Workspace workspace{ArmPredictor(state, problem.layout), {}};
    for (std::size_t i = next++; i < count; i = next++) {
      work(workspace, i);
    }
  };
  const auto threads = std::min<std::size_t>(problem.threads, count);
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) {
    others.emplace_back(run);
  }
  run();
  for (std::thread& thread : others) {
    thread.join();
  }
}

// Brings the systems kept to the problem's offsets; whether they are then what the model gives at the state. Small steps of the offsets
// alone they follow by their own columns: the second order, 1e-10 of what gravity does, is nothing.
bool brought_up_to(KeptSystems& kept, const ArmProblem& problem, const Eigen::VectorXd& state) {
  constexpr double small = 1e-5;  // rad or m, from where they were linearised
  const std::vector<MovingStretch>& stretches = problem.rows.stretches;
  if (kept.state.size() != state.size() || kept.state != state || kept.offsets.size() != problem.offsets.size() ||
      kept.stretches.size() != stretches.size()) {
    return false;
  }
  if (kept.offsets == problem.offsets) {
    return true;
  }
  if (!((problem.offsets - kept.linearised_at).cwiseAbs().maxCoeff() <= small)) {
    return false;
  }
  const Eigen::VectorXd step = problem.offsets - kept.offsets;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const std::vector<OffsetTerm>& terms = stretches[i].offsets;
    Eigen::MatrixXd& system = kept.stretches[i];
    for (std::size_t k = 0; system.size() > 0 && k < terms.size(); ++k) {
      system.rightCols<1>() += step[terms[k].parameter] * system.col(problem.layout.columns + static_cast<Index>(k));
    }
  }
  kept.offsets = problem.offsets;
  return true;
}

// Makes room for the systems of as many stretches as may be kept.
void make_room(KeptSystems& kept, const ArmProblem& problem) {
  constexpr Index most_kept = (Index{128} << 20) / static_cast<Index>(sizeof(double));
  kept.stretches.resize(problem.rows.stretches.size());
  Index left = most_kept;
  for (std::size_t i = 0; i < kept.stretches.size(); ++i) {
    const MovingStretch& stretch = problem.rows.stretches[i];
    const Index rows = stretch.rows() * problem.rows.channels;
    const Index columns = system_columns(problem, stretch);
    const bool keep = rows * columns <= left;
    kept.stretches[i].resize(keep ? rows : 0, keep ? columns : 0);
    left -= kept.stretches[i].size();
  }
}

}  // namespace

void add_prior(ArmPrior& prior, Index column, const Eigen::VectorXd& mean, double std) {
  if (std::isfinite(std)) {
    prior.terms.push_back({column, mean, Eigen::MatrixXd(Eigen::MatrixXd::Identity(mean.size(), mean.size()) / std)});
  }
}

NormalEquations NormalEquations::zero(Index columns) {
  return {Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(columns), 0.0};
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  information += other.information;
  gradient += other.gradient;
  cost += other.cost;
  return *this;
}

std::vector<PartEquations> linearise_data(const ArmProblem& problem, const ArmState& state, KeptSystems* kept,
                                          std::vector<PartEquations> parts) {
  const std::size_t stretches = problem.rows.stretches.size();
  parts.resize(stretches + problem.rows.dwells.size());
  const auto finish = [&parts](std::size_t i, const Eigen::MatrixXd& system, const std::vector<OffsetTerm>& offsets) {
    set_normal_equations(parts[i].equations, system);
    parts[i].offsets.clear();
    for (const OffsetTerm& term : offsets) {
      parts[i].offsets.push_back(term.parameter);
    }
  };
  const Eigen::VectorXd flat = flattened(state, problem.layout);
  const bool known = kept != nullptr && brought_up_to(*kept, problem, flat);
  if (kept != nullptr && !known) {
    make_room(*kept, problem);
    kept->state = flat;
    kept->offsets = kept->linearised_at = problem.offsets;
  }
  for_each(problem, state, parts.size(), [&](Workspace& workspace, std::size_t i) {
    if (i < stretches) {
      const MovingStretch& stretch = problem.rows.stretches[i];
      const bool keep = kept != nullptr && kept->stretches[i].size() > 0;
      if (!keep) {
        fill_system(problem, workspace.predictor, stretch, workspace.system);
      } else {
        if (!known) {
          fill_system(problem, workspace.predictor, stretch, kept->stretches[i]);
        }
        workspace.system = kept->stretches[i];
      }
      whiten_stretch(problem.noise, problem.rows, i, workspace.system);
      finish(i, workspace.system, stretch.offsets);
      return;
    }
    const DwellRow& dwell = problem.rows.dwells[i - stretches];
    DwellSystem system = dwell_system(problem, workspace.predictor, dwell);
    system.variance.diagonal() += problem.noise.dwell_excess.cwiseAbs2();
    const Eigen::LLT<Eigen::MatrixXd> factor(system.variance);
    factor.matrixL().solveInPlace(system.rows);
    finish(i, system.rows, dwell.offsets);
  });
  return parts;
}

NormalEquations linearise_gravity(const ArmLayout& layout, const ArmState& state, double magnitude, double std) {
  NormalEquations all = NormalEquations::zero(layout.columns);
  if (layout.up_gravity >= 0 && std::isfinite(std)) {
    const double residual = (state.up_gravity.norm() - magnitude) / std;
    const Eigen::Vector3d slope = state.up_gravity.normalized() / std;
    all.information.block<3, 3>(layout.up_gravity, layout.up_gravity) = slope * slope.transpose();
    all.gradient.segment<3>(layout.up_gravity) = slope * residual;
    all.cost = residual * residual;
  }
  return all;
}

NormalEquations linearise_prior(const ArmProblem& problem, const ArmState& state) {
  NormalEquations all = linearise_gravity(problem.layout, state, problem.prior.gravity, problem.prior.gravity_std);
  const Eigen::VectorXd value = values(state, problem.layout);
  for (const PriorTerm& term : problem.prior.terms) {
    const Index size = term.mean.size();
    const Eigen::VectorXd residual = term.root * (value.segment(term.column, size) - term.mean);
    all.information.block(term.column, term.column, size, size) += term.root.transpose() * term.root;
    all.gradient.segment(term.column, size) += term.root.transpose() * residual;
    all.cost += residual.squaredNorm();
  }
  return all;
}

ArmResiduals residuals(const ArmProblem& problem, const ArmState& state, KeptSystems* kept) {
  const std::size_t stretches = problem.rows.stretches.size();
  const Index channels = problem.rows.channels;
  const auto dwells = static_cast<Index>(problem.rows.dwells.size());
  ArmResiduals result;
  result.moving.resize(stretches);
  result.whitened.resize(stretches);
  result.dwells.resize(dwells, channels);
  result.dwells_normalized.resize(dwells, channels);
  const bool known = kept != nullptr && brought_up_to(*kept, problem, flattened(state, problem.layout));
  for_each(problem, state, stretches, [&](Workspace& workspace, std::size_t i) {
    const MovingStretch& stretch = problem.rows.stretches[i];
    if (known && kept->stretches[i].size() > 0) {
      result.moving[i] = kept->stretches[i].rightCols<1>().reshaped(stretch.rows(), channels);
    } else {
      result.moving[i] = differences(problem, workspace.predictor, stretch);
    }
    Eigen::MatrixXd column = result.moving[i].reshaped(result.moving[i].size(), 1);
    whiten_stretch(problem.noise, problem.rows, i, column);
    result.whitened[i] = column.reshaped(stretch.rows(), channels);
  });
  ArmPredictor predictor(state, problem.layout);
  for (Index i = 0; i < dwells; ++i) {
    DwellSystem system = dwell_system(problem, predictor, problem.rows.dwells[static_cast<std::size_t>(i)]);
    const Eigen::VectorXd residual = system.rows.col(system.rows.cols() - 1);
    result.dwells.row(i) = residual;
    result.dwell_covariance.push_back(system.variance);
    system.variance.diagonal() += problem.noise.dwell_excess.cwiseAbs2();
    const Eigen::LLT<Eigen::MatrixXd> factor(system.variance);
    result.dwells_normalized.row(i) = factor.matrixL().solve(residual);
  }
  return result;
}

}  // namespace circlepoint
