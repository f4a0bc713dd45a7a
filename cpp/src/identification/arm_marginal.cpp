#include "arm_marginal.hpp"

#include <Eigen/Cholesky>

namespace circlepoint {

namespace {

// Layout columns first, then all offsets, their prior included. The lower triangle of the information.
NormalEquations assemble(const ArmProblem& problem, const std::vector<PartEquations>& parts) {
  const Index columns = problem.layout.columns;
  const Index offsets = problem.rows.offset_covariance.rows();
  NormalEquations all = NormalEquations::zero(columns + offsets);
  for (const PartEquations& part : parts) {
    const auto mine = static_cast<Index>(part.offsets.size());
    const NormalEquations& equations = part.equations;
    for (Index column = 0; column < columns; ++column) {
      all.information.col(column).segment(column, columns - column) +=
          equations.information.col(column).segment(column, columns - column);
    }
    all.gradient.head(columns) += equations.gradient.head(columns);
    all.cost += equations.cost;
    for (Index a = 0; a < mine; ++a) {
      const Index at = columns + part.offsets[static_cast<std::size_t>(a)];
      all.information.row(at).head(columns) += equations.information.col(columns + a).head(columns).transpose();
      all.gradient[at] += equations.gradient[columns + a];
      for (Index b = 0; b < mine; ++b) {
        all.information(at, columns + part.offsets[static_cast<std::size_t>(b)]) += equations.information(columns + a, columns + b);
      }
    }
  }
  if (offsets > 0) {
    const Eigen::VectorXd pull = problem.rows.offset_information * problem.offsets;
    all.information.bottomRightCorner(offsets, offsets) += problem.rows.offset_information;
    all.gradient.tail(offsets) += pull;
    all.cost += problem.offsets.dot(pull);
  }
  return all;
}

// Minimised over the last columns: what is left for the first `columns`, and where the last ones then are. Of `all`, the lower triangle.
MarginalEquations without_last(const NormalEquations& all, Index columns) {
  const Index last = all.gradient.size() - columns;
  MarginalEquations reduced{{all.information.topLeftCorner(columns, columns).selfadjointView<Eigen::Lower>(), all.gradient.head(columns),
                             all.cost},
                            Eigen::VectorXd::Zero(last)};
  if (last > 0) {
    const Eigen::LLT<Eigen::MatrixXd> factor(all.information.bottomRightCorner(last, last));
    const Eigen::MatrixXd coupling = factor.matrixL().solve(all.information.bottomLeftCorner(last, columns));
    const Eigen::VectorXd gradient = factor.matrixL().solve(all.gradient.tail(last));
    reduced.equations.information -= coupling.transpose() * coupling;
    reduced.equations.gradient -= coupling.transpose() * gradient;
    reduced.equations.cost -= gradient.squaredNorm();
    reduced.offsets -= factor.matrixU().solve(gradient);
  }
  return reduced;
}

}  // namespace

MarginalEquations marginal(const ArmProblem& problem, const std::vector<PartEquations>& parts) {
  MarginalEquations reduced = without_last(assemble(problem, parts), problem.layout.columns);
  reduced.offsets += problem.offsets;
  return reduced;
}

NormalEquations marginal_part(const ArmProblem& problem, const PartEquations& part) {
  const auto offsets = static_cast<Index>(part.offsets.size());
  if (offsets == 0) {
    return part.equations;
  }
  NormalEquations all = part.equations;
  const Eigen::MatrixXd prior = problem.rows.offset_covariance(part.offsets, part.offsets).inverse();
  const Eigen::VectorXd at = problem.offsets(part.offsets);
  const Eigen::VectorXd pull = prior * at;
  all.information.bottomRightCorner(offsets, offsets) += prior;
  all.gradient.tail(offsets) += pull;
  all.cost += at.dot(pull);
  return without_last(all, problem.layout.columns).equations;
}

}  // namespace circlepoint
