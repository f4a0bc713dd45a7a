#include "arm_encoder_errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

#include "arm_marginal.hpp"
#include "scaled_information.hpp"

namespace circlepoint {
namespace {

constexpr double evident = 36.0;  // what an error must lower the sum of squares by: six standard deviations

struct EncoderError {
  std::size_t joint = 0;
  bool once_a_turn = false;  // else the gain
};

using EncoderErrors = std::vector<EncoderError>;

const ParameterTreatment& treatment(const EncoderError& error, const WholeArmOptions& options) {
  return error.once_a_turn ? options.eccentricity : options.encoder_gain;
}

// The first of its columns, or -1.
const Index& column_of(const EncoderError& error, const ArmLayout& layout) {
  return (error.once_a_turn ? layout.eccentricity : layout.encoder_gain)[error.joint];
}
Index& column_of(const EncoderError& error, ArmLayout& layout) {
  return (error.once_a_turn ? layout.eccentricity : layout.encoder_gain)[error.joint];
}

Index size_of(const EncoderError& error) { return error.once_a_turn ? 2 : 1; }

std::vector<Index> columns_of(const EncoderError& error, const ArmLayout& layout) {
  std::vector<Index> columns(static_cast<std::size_t>(size_of(error)));
  std::iota(columns.begin(), columns.end(), column_of(error, layout));
  return columns;
}

// Those without columns that are treated so.
EncoderErrors candidates(const ArmLayout& layout, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options,
                         bool where_evident) {
  EncoderErrors errors;
  for (std::size_t joint = 0; joint < moves.size(); ++joint) {
    for (const bool once_a_turn : {false, true}) {
      const EncoderError error{joint, once_a_turn};
      const ParameterTreatment& treated = treatment(error, options);
      const bool turns = state.axes[joint].type == JointType::revolute;
      if (moves[joint] && (turns || !once_a_turn) && column_of(error, layout) < 0 && treated.estimated && treated.std > 0.0 &&
          treated.where_evident == where_evident) {
        errors.push_back(error);
      }
    }
  }
  return errors;
}

void claim(ArmProblem& problem, const EncoderErrors& errors, const WholeArmOptions& options) {
  for (const EncoderError& error : errors) {
    const Index column = problem.layout.claim(size_of(error));
    column_of(error, problem.layout) = column;
    add_prior(problem.prior, column, Eigen::VectorXd::Zero(size_of(error)), treatment(error, options).std);
  }
}

// How much the sum of squares falls if these columns are estimated beside the others, whose covariance is given.
double fall_of(const std::vector<Index>& columns, const std::vector<Index>& others, const Eigen::MatrixXd& covariance,
               const NormalEquations& all) {
  const Eigen::MatrixXd coupling = all.information(columns, others);
  const Eigen::VectorXd gradient = all.gradient(columns) - coupling * (covariance * all.gradient(others));
  const Eigen::MatrixXd information = all.information(columns, columns) - coupling * covariance * coupling.transpose();
  return gradient.dot(information.ldlt().solve(gradient));
}

// The evident ones of `left`; `all` has the columns of `layout`, of which the first `estimated` are estimated anyhow.
EncoderErrors select(EncoderErrors left, const NormalEquations& all, const ArmLayout& layout, Index estimated) {
  std::vector<Index> taken(static_cast<std::size_t>(estimated));
  std::iota(taken.begin(), taken.end(), Index{0});
  EncoderErrors found;
  while (!left.empty()) {
    const Eigen::MatrixXd covariance = ScaledInformation(all.information(taken, taken), 1e-15).inverse();
    std::vector<double> falls;
    for (const EncoderError& error : left) {
      falls.push_back(fall_of(columns_of(error, layout), taken, covariance, all));
    }
    const auto best = std::max_element(falls.begin(), falls.end()) - falls.begin();
    if (falls[static_cast<std::size_t>(best)] < evident) {
      break;
    }
    found.push_back(left[static_cast<std::size_t>(best)]);
    left.erase(left.begin() + best);
    const std::vector<Index> columns = columns_of(found.back(), layout);
    taken.insert(taken.end(), columns.begin(), columns.end());
  }
  return found;
}

}  // namespace

void claim_encoder_errors(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options) {
  claim(problem, candidates(problem.layout, state, moves, options, false), options);
}

bool claim_evident_encoder_errors(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves,
                                  const WholeArmOptions& options) {
  const EncoderErrors errors = candidates(problem.layout, state, moves, options, true);
  if (errors.empty()) {
    return false;
  }
  const ArmLayout narrow = problem.layout;
  const ArmPrior prior = problem.prior;
  claim(problem, errors, options);
  const ArmLayout wide = problem.layout;
  NormalEquations all = marginal(problem, linearise_data(problem, state)).equations;
  all += linearise_prior(problem, state);
  problem.layout = narrow;
  problem.prior = prior;
  const EncoderErrors found = select(errors, all, wide, narrow.columns);
  claim(problem, found, options);
  return !found.empty();
}

}  // namespace circlepoint
