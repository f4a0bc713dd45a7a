#include "arm_settle.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "arm_encoder_errors.hpp"
#include "arm_encoder_noise.hpp"
#include "arm_knocks.hpp"
#include "arm_marginal.hpp"
#include "arm_scores.hpp"
#include "arm_solve.hpp"
#include "arm_yield.hpp"
#include "scaled_information.hpp"

namespace circlepoint {
namespace {

constexpr double still = 0.05;          // standard deviations a pass may still move a parameter by
constexpr int most_ties = 6;            // passes in which what the readings tell of resting joints' loads is taken up; knocks show after
constexpr int passes_that_cut = 3;      // knocks
constexpr int passes_to_settle = 5;     // in which the sensor's noise is told from the encoders' and its order found
constexpr double disagreement = 2.0;    // of the stretches' scores, beyond which encoders are looked at before all is settled

double largest_step(const ArmState& before, const ArmState& after, const ArmLayout& layout, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd change = values(after, layout) - values(before, layout);
  for (std::size_t i = 0; i < before.axes.size(); ++i) {
    if (layout.lines[i] >= 0) {
      const Eigen::Vector4d local = local_coordinates(before.axes[i].line, after.axes[i].line);
      const Index count = layout.line_columns(before.axes[i]);
      change.segment(layout.lines[i], count) = local.head(count);
    }
  }
  const Eigen::VectorXd std = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
  return change.cwiseAbs().cwiseQuotient(std).maxCoeff();
}

}  // namespace

void settle(ArmFit& fit, const std::vector<bool>& moves, const WholeArmOptions& options) {
  ArmProblem& problem = fit.problem;
  const int first_cut = problem.rows.ties.empty() ? 1 : std::clamp(options.max_passes / 2, 1, most_ties);
  KeptSystems kept;
  InflationSearch search;
  int since = 0;  // the pass after the columns last changed
  int last = options.max_passes;
  for (int pass = 0; pass < last; ++pass) {
    ArmSolution solution = solve(problem, fit.state, most_iterations, last_change, &kept);
    fit.iterations += solution.iterations;
    const ArmState former = fit.state;
    fit.state = solution.state;
    fit.parts = std::move(solution.parts);
    const MarginalEquations data = marginal(problem, fit.parts);
    fit.data = data.equations;
    problem.offsets = data.offsets;
    const NormalEquations prior = linearise_prior(problem, fit.state);
    fit.information = fit.data.information + prior.information;
    fit.covariance = ScaledInformation(fit.information, 1e-15).inverse();
    fit.now = residuals(problem, fit.state, &kept);
    const Eigen::VectorXd gradient = fit.data.gradient + prior.gradient;
    const double left = std::sqrt(std::max(0.0, gradient.dot(fit.covariance * gradient)));  // to the minimum, in standard deviations
    const int cutting = since == 0 ? first_cut : since + 1;
    fit.unsettled = std::max(left, largest_step(former, fit.state, problem.layout, fit.covariance));
    fit.converged = pass > cutting + 1 && fit.unsettled < still;
    // The first pass's noise is a guess, or of other columns, and nothing follows from its scores; nor any more from the last's.
    const double ratio = pass > since && !fit.converged ? score_ratio(problem, fit.parts, fit.covariance) : 1.0;
    const bool wrong = pass == cutting + passes_that_cut && problem.noise.inflation * ratio > disagreement;
    if ((fit.converged || wrong || pass + 1 == last) && pass > since &&
        claim_evident_encoder_errors(problem, fit.state, moves, options)) {
      search = InflationSearch();
      kept.forget();
      fit.converged = false;
      since = pass + 1;
      last = since + options.max_passes;
      continue;
    }
    // What follows changes rows and weights, which only another pass takes in.
    if (fit.converged || pass + 1 == last) {
      break;
    }
    if (pass < first_cut && !problem.rows.ties.empty()) {
      retie(problem.rows, problem.offsets);
      kept.forget();
    }
    problem.noise.encoder.clear();  // of these rows at this state
    const double inflation = pass > since ? search.next(problem.noise.inflation, ratio) : 1.0;
    if (pass >= cutting && pass < cutting + passes_that_cut) {
      const Index cut = cut_knocks(problem.rows, fit.now.whitened, fit.now.dwells_normalized);
      fit.outliers += cut;
      if (cut > 0) {
        kept.forget();
        fit.now = residuals(problem, fit.state);
      }
    }
    const ArmNoise before = std::move(problem.noise);
    // A few rests have hardly more equations than there are columns, most of which what is known of the sensor settles.
    const double fitted =
        problem.layout.points ? static_cast<double>(problem.layout.columns) : (fit.covariance * fit.data.information).trace();
    problem.noise = estimate_noise(problem.rows, fit.now.moving, fit.now.dwells, fit.now.dwell_covariance, fitted, inflation,
                                   encoder_covariances(problem, fit.state), pass > since ? &before : nullptr,
                                   pass > std::max(since + passes_to_settle, cutting + passes_that_cut - 1));
  }
}

double normalised_squares(const ArmFit& fit) {
  double squares = fit.now.dwells_normalized.squaredNorm();
  for (const Eigen::MatrixXd& whitened : fit.now.whitened) {
    squares += fit.problem.noise.inflation * whitened.squaredNorm();
  }
  return squares;
}

double misfit(const ArmFit& fit) {
  const ArmProblem& problem = fit.problem;
  const double inflation = problem.noise.inflation;  // for what motions disagree by, not for how they scatter
  double logarithms = 0.0;
  for (Eigen::MatrixXd covariance : fit.now.dwell_covariance) {
    covariance.diagonal() += problem.noise.dwell_excess.cwiseAbs2();
    logarithms += covariance.llt().matrixLLT().diagonal().array().log().sum();
  }
  for (std::size_t i = 0; i < problem.rows.stretches.size(); ++i) {
    const auto count = static_cast<double>(fit.now.whitened[i].size());
    logarithms += log_root_determinant(problem.noise, problem.rows, i) - 0.5 * count * std::log(inflation);
  }
  const auto left = static_cast<double>(problem.rows.equations());
  const double all = left + static_cast<double>(fit.outliers * problem.rows.channels);
  const double prior = linearise_prior(problem, fit.state).cost + problem.offsets.dot(problem.rows.offset_information * problem.offsets);
  return (normalised_squares(fit) + 2.0 * logarithms) * all / left + prior;
}

}  // namespace circlepoint
