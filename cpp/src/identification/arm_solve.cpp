#include "arm_solve.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "arm_marginal.hpp"

namespace circlepoint {
namespace {

// A state as a flat block for Ceres: lines as direction and point, then all groups.
class FlatState {
 public:
  FlatState(const ArmState& shape, const ArmLayout& layout) : shape_(shape), layout_(layout), size_(flattened(shape, layout).size()) {}

  [[nodiscard]] int size() const { return static_cast<int>(size_); }

  void write(const ArmState& state, double* block) const { Eigen::Map<Eigen::VectorXd>(block, size_) = flattened(state, layout_); }

  [[nodiscard]] ArmState read(const double* block) const {
    const Eigen::Map<const Eigen::VectorXd> flat(block, size_);
    ArmState state = shape_;
    Index at = 0;
    for (ScrewAxis& axis : state.axes) {
      axis.line.direction = flat.segment<3>(at);
      axis.line.point = flat.segment<3>(at + 3);
      at += 6;
    }
    for_each_group(state, layout_, [&](Index, auto group) {
      group = flat.segment(at, group.size());
      at += group.size();
    });
    return state;
  }

  [[nodiscard]] const ArmLayout& layout() const { return layout_; }

 private:
  const ArmState& shape_;
  const ArmLayout& layout_;
  Index size_;
};

// Steps are taken in the layout's coordinates. The cost function gives its derivative in them at once, in the first columns of its
// Jacobian, which is what PlusJacobian picks out.
class ArmManifold final : public ceres::Manifold {
 public:
  explicit ArmManifold(const FlatState& flat) : flat_(flat) {}
  int AmbientSize() const override { return flat_.size(); }
  int TangentSize() const override { return static_cast<int>(flat_.layout().columns); }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Map<const Eigen::VectorXd> step(delta, TangentSize());
    flat_.write(moved(flat_.read(x), flat_.layout(), step), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobian, AmbientSize(), TangentSize())
        .setIdentity();
    return true;
  }
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }

 private:
  const FlatState& flat_;
};

// The whole problem as columns + 1 residuals: the square root of its normal equations. Same cost and gradient at the state and
// the same Gauss-Newton matrix, at any number of samples.
class ArmCost final : public ceres::CostFunction {
 public:
  ArmCost(const ArmProblem& problem, const FlatState& flat, KeptSystems* kept) : problem_(problem), flat_(flat), kept_(kept) {
    set_num_residuals(static_cast<int>(problem.layout.columns) + 1);
    mutable_parameter_block_sizes()->push_back(flat.size());
  }
  bool Evaluate(const double* const* parameters, double* residual, double** jacobians) const override {
    const Index columns = problem_.layout.columns;
    const Eigen::Map<const Eigen::VectorXd> here(parameters[0], flat_.size());
    // Ceres asks for residuals first, and for the derivatives at the same place once it has accepted the step.
    if (evaluated_.size() == 0 || evaluated_ != here) {
      evaluated_ = here;
      evaluate(flat_.read(parameters[0]));
    }
    if (!usable_) {
      return false;
    }
    Eigen::Map<Eigen::VectorXd>(residual, columns + 1) = residual_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(jacobians[0], columns + 1,
                                                                                                 flat_.size());
      jacobian.setZero();
      jacobian.topLeftCorner(columns, columns) = root_;
    }
    return true;
  }
  // By how much the sum of squares would still fall where it was evaluated last, were it quadratic: the squared distance to the
  // minimum in standard deviations.
  [[nodiscard]] double expected_fall() const { return residual_.head(problem_.layout.columns).squaredNorm(); }
  // The data's equations at `block`, which is mostly where the solver looked last.
  std::vector<PartEquations> parts_at(const std::vector<double>& block) const {
    const Eigen::Map<const Eigen::VectorXd> here(block.data(), flat_.size());
    return evaluated_ == here ? std::move(parts_) : linearise_data(problem_, flat_.read(block.data()), kept_);
  }

 private:
  void evaluate(const ArmState& state) const {
    const Index columns = problem_.layout.columns;
    parts_ = linearise_data(problem_, state, kept_, std::move(parts_));
    NormalEquations all = marginal(problem_, parts_).equations;
    all += linearise_prior(problem_, state);
    // Directions nothing is known of would stop the factorisation; what is added is far below rounding of the others.
    all.information.diagonal() += 1e-14 * all.information.diagonal();
    all.information.diagonal().array() += 1e-12;
    const Eigen::LLT<Eigen::MatrixXd> factor(all.information);
    usable_ = factor.info() == Eigen::Success;
    if (!usable_) {
      return;
    }
    residual_.resize(columns + 1);
    residual_.head(columns) = factor.matrixL().solve(all.gradient);
    residual_[columns] = std::sqrt(std::max(0.0, all.cost - residual_.head(columns).squaredNorm()));
    root_ = factor.matrixU();
    usable_ = residual_.allFinite();
  }

  const ArmProblem& problem_;
  const FlatState& flat_;
  KeptSystems* kept_;
  mutable Eigen::VectorXd evaluated_;  // where the rest was evaluated
  mutable std::vector<PartEquations> parts_;
  mutable Eigen::VectorXd residual_;
  mutable Eigen::MatrixXd root_;
  mutable bool usable_ = false;
};

// Ends where a step would lower the sum of squares by next to nothing, and after one that has lowered it by little and left little:
// near the minimum what is left falls with the step's square, but not where the model bends and steps are cut short. Ceres' own
// tolerances know neither what is little nor keep that step.
class EndAtMinimum final : public ceres::IterationCallback {
 public:
  EndAtMinimum(const ArmCost& cost, double negligible_change) : cost_(cost), negligible_change_(negligible_change) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    const double next_to_nothing = 0.001 * negligible_change_;
    const double little = 0.02 * negligible_change_;
    if (iteration.iteration > 0 && !iteration.step_is_successful) {
      return ceres::SOLVER_CONTINUE;
    }
    const bool small = iteration.iteration > 0 && 2.0 * iteration.cost_change < negligible_change_;
    return cost_.expected_fall() < (small ? little : next_to_nothing) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const ArmCost& cost_;
  double negligible_change_;
};

}  // namespace

ArmSolution solve(const ArmProblem& problem, const ArmState& start, int max_iterations, double negligible_change, KeptSystems* kept) {
  const FlatState flat(start, problem.layout);
  std::vector<double> block(static_cast<std::size_t>(flat.size()));
  flat.write(start, block.data());
  ceres::Problem ceres_problem;
  ceres_problem.AddParameterBlock(block.data(), flat.size(), new ArmManifold(flat));
  auto* cost = new ArmCost(problem, flat, kept);
  ceres_problem.AddResidualBlock(cost, nullptr, block.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-14;
  EndAtMinimum end(*cost, negligible_change);
  options.callbacks.push_back(&end);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  ArmSolution solution;
  solution.state = flat.read(block.data());
  solution.parts = cost->parts_at(block);
  solution.cost = 2.0 * summary.final_cost;
  solution.iterations = static_cast<int>(summary.iterations.size());
  solution.converged = summary.termination_type == ceres::CONVERGENCE || summary.termination_type == ceres::USER_SUCCESS;
  return solution;
}

}  // namespace circlepoint
