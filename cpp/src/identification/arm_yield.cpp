#include "arm_yield.hpp"

#include <Eigen/Eigenvalues>

#include "arm_home.hpp"
#include "arm_offsets.hpp"

namespace circlepoint {
namespace {

constexpr double negligible = 0.005;       // counts rms: not worth a parameter
constexpr double longest_lag = 0.15;       // s
constexpr int lag_rounds = 3;

// The directions of a joint's coefficients that make a difference, as parameters: the home's first.
struct Reduction {
  std::vector<Eigen::MatrixXd> directions;  // of each test's c
  std::vector<Index> first;                 // parameter of each test's
  Eigen::MatrixXd reduce;                   // (parameters, coefficients), rad a count included
};

Reduction reduction(const RestingFit& resting, double count) {
  const JointFit& fit = resting.fit;
  Reduction result;
  Index parameters = 1;
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    const Index size = resting.resolve[k].rows();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fit.covariance.block(fit.first[k], fit.first[k], size, size));
    const auto kept = (solver.eigenvalues().array() > negligible * negligible).count();
    result.directions.emplace_back(solver.eigenvectors().rightCols(kept));
    result.first.push_back(parameters);
    parameters += kept;
  }
  result.reduce = Eigen::MatrixXd::Zero(parameters, fit.estimate.size());
  result.reduce(0, 0) = count;
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    const Eigen::MatrixXd& directions = result.directions[k];
    result.reduce.block(result.first[k], fit.first[k], directions.cols(), directions.rows()) = count * directions.transpose();
  }
  return result;
}

// Puts one joint's fitted motion under the rows; its parameters begin at `offset`.
void apply(ArmRows& rows, const HomeGroup& group, const RestingFit& resting, const Eigen::VectorXd& estimate,
           const Reduction& reduced, Index offset, double count, double lag) {
  const JointFit& fit = resting.fit;
  const Index joint = resting.joint;
  const auto slot = static_cast<std::size_t>(joint);
  const double home = group.home[joint] + count * estimate[0];
  const auto take = [&](DwellRow& dwell, double position) {
    dwell.position[joint] = position;
    dwell.position_variance[joint] = 0.0;
    dwell.follows[slot] = true;
    add_term(dwell, {joint, offset}, 1.0);
  };
  for (const std::size_t i : group.dwells) {
    take(rows.dwells[i], home);
  }
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    const TestMotion& motion = group.tests[fit.tests[k]];
    const Eigen::MatrixXd& directions = reduced.directions[k];
    const Index first = offset + reduced.first[k];
    const Eigen::VectorXd c = estimate.segment(fit.first[k], motion.combination.cols());
    for (const std::size_t i : motion.dwells) {
      DwellRow& dwell = rows.dwells[i];
      const Eigen::MatrixXd phi = dwell_functions(motion, dwell);
      take(dwell, home + count * (phi * c)[0]);
      const Eigen::MatrixXd shape = phi * directions;
      for (Index d = 0; d < shape.cols(); ++d) {
        add_term(dwell, {joint, first + d}, shape(0, d));
      }
    }
    for (std::size_t s = 0; s < motion.stretches.size(); ++s) {
      MovingStretch& stretch = rows.stretches[motion.stretches[s]];
      const Eigen::ArrayXi index = stretch.sample - stretch.sample[0];
      const SamplesX phi = functions_of(motion, s, lag, rows.sample_rate);
      const Eigen::MatrixXd position = phi(index, Eigen::all);
      const Eigen::MatrixXd velocity = differentiated(phi, 1, rows.sample_rate)(index, Eigen::all);
      const Eigen::MatrixXd acceleration = differentiated(phi, 2, rows.sample_rate)(index, Eigen::all);
      stretch.position.col(joint) = (home + count * (position * c).array()).matrix();
      stretch.velocity.col(joint) = count * velocity * c;
      stretch.acceleration.col(joint) = count * acceleration * c;
      stretch.jerk.col(joint).setZero();
      stretch.snap.col(joint).setZero();
      std::erase_if(stretch.errors, [&](const PositionError& error) { return error.joint == joint; });
      stretch.follows[slot] = true;
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(stretch.rows());
      add_term(stretch, {joint, offset}, Eigen::VectorXd::Ones(stretch.rows()), zero, zero);
      for (Index d = 0; d < directions.cols(); ++d) {
        add_term(stretch, {joint, first + d}, position * directions.col(d), velocity * directions.col(d),
                 acceleration * directions.col(d));
      }
    }
  }
}

// The coefficients that the reduced parameters stand for: directions are at right angles.
Eigen::VectorXd expanded(const Eigen::MatrixXd& reduce, const Eigen::VectorXd& parameters) {
  return reduce.transpose() * parameters.cwiseQuotient(reduce.rowwise().squaredNorm());
}

// The reduced parameters' prior, of all fits, from the coefficients' covariance.
Eigen::MatrixXd reduced_covariance(const Eigen::MatrixXd& reduce, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd prior = reduce * covariance * reduce.transpose();
  return 0.5 * (prior + prior.transpose());
}

// Time constants, s, with which the joints follow their loads: where the functions so delayed need no further one, by secants.
template <class ReadAll>
Eigen::VectorXd find_lags(const ReadAll& read_all, const ArmAtHome& home) {
  Eigen::VectorXd lag = Eigen::VectorXd::Zero(home.position.size());
  const auto missing_at = [&](const Eigen::VectorXd& here) {
    const std::vector<RestingFit> fits = read_all(here);
    const LoadModel model(fits, home);
    return model.lag(model.fit());
  };
  Eigen::VectorXd missing = missing_at(lag);
  Eigen::VectorXd step = missing;
  for (int round = 0; round < lag_rounds; ++round) {
    const Eigen::VectorXd before = lag;
    lag = (lag + step).cwiseMax(0.0).cwiseMin(longest_lag);
    if (round + 1 == lag_rounds) {
      break;
    }
    const Eigen::VectorXd now = missing_at(lag);
    for (Index joint = 0; joint < lag.size(); ++joint) {
      const double moved = lag[joint] - before[joint];
      const double slope = moved != 0.0 ? (now[joint] - missing[joint]) / moved : 0.0;
      step[joint] = slope < -0.5 ? -now[joint] / slope : now[joint];
    }
    missing = now;
  }
  return lag;
}

// Puts what a group's counts tell under the rows: pair by pair, or as loads on a known arm.
void follow_group(ArmRows& rows, const HomeGroup& group, const GroupReader& reader, const Eigen::VectorXd& resolution,
                  const KnownArm* arm) {
  const auto read_all = [&](const Eigen::VectorXd& lag) {
    std::vector<RestingFit> fits;
    for (Index joint = 0; joint < resolution.size(); ++joint) {
      if (resolution[joint] > 0.0) {
        RestingFit fit = reader.read(joint, resolution[joint], lag[joint], arm != nullptr);
        if (!fit.fit.tests.empty()) {
          fits.push_back(std::move(fit));
        }
      }
    }
    return fits;
  };
  Eigen::VectorXd lag = Eigen::VectorXd::Zero(resolution.size());
  ArmAtHome home;
  if (arm != nullptr) {
    home = at_home(*arm, group.home);
    lag = find_lags(read_all, home);
  }
  YieldTie tie{read_all(lag), home, {}, {}, {}, 0};
  if (tie.fits.empty()) {
    return;
  }
  Index coefficients = 0;
  Index parameters = 0;
  std::vector<Reduction> reduced;
  for (const RestingFit& resting : tie.fits) {
    reduced.push_back(reduction(resting, resolution[resting.joint]));
    coefficients += resting.fit.estimate.size();
    parameters += reduced.back().reduce.rows();
  }
  tie.reduce = Eigen::MatrixXd::Zero(parameters, coefficients);
  TiedFits known{Eigen::VectorXd(coefficients), Eigen::MatrixXd::Zero(coefficients, coefficients)};
  Index row = 0;
  Index column = 0;
  for (std::size_t i = 0; i < tie.fits.size(); ++i) {
    const JointFit& fit = tie.fits[i].fit;
    const Eigen::MatrixXd& reduce = reduced[i].reduce;
    tie.reduce.block(row, column, reduce.rows(), reduce.cols()) = reduce;
    known.estimate.segment(column, reduce.cols()) = fit.estimate;
    known.covariance.block(column, column, reduce.cols(), reduce.cols()) = fit.covariance;
    row += reduce.rows();
    column += reduce.cols();
  }
  if (arm != nullptr) {
    const LoadModel model(tie.fits, home);
    tie.point = model.fit();
    known = model.tied(tie.point);
  }
  tie.offset = add_parameters(rows, reduced_covariance(tie.reduce, known.covariance));
  tie.estimate = known.estimate;
  row = 0;
  column = 0;
  for (std::size_t i = 0; i < tie.fits.size(); ++i) {
    const RestingFit& resting = tie.fits[i];
    const Index size = resting.fit.estimate.size();
    apply(rows, group, resting, tie.estimate.segment(column, size), reduced[i], tie.offset + row, resolution[resting.joint],
          lag[resting.joint]);
    row += reduced[i].reduce.rows();
    column += size;
  }
  if (arm != nullptr) {
    rows.ties.push_back(std::move(tie));
  }
}

}  // namespace

void follow_yields(ArmRows& rows, const Recording& recording, const Segmentation& segmentation,
                   const std::vector<SmoothSpan>& spans, const Eigen::VectorXd& resolution, const KnownArm* arm) {
  const HomeTests tests = find_home_tests(rows, recording, segmentation, spans, resolution);
  rows.yields = tests.changed > 0;
  for (const HomeGroup& group : tests.groups) {
    follow_group(rows, group, GroupReader(group, rows, recording, segmentation), resolution, arm);
  }
}

void retie(ArmRows& rows, Eigen::VectorXd& offsets) {
  for (YieldTie& tie : rows.ties) {
    const LoadModel model(tie.fits, tie.arm);
    const Index size = tie.reduce.rows();
    const Eigen::VectorXd found = tie.estimate + expanded(tie.reduce, offsets.segment(tie.offset, size));
    tie.point = model.nearest(tie.point, found);
    const TiedFits known = model.tied(tie.point);
    const Eigen::VectorXd shift = tie.reduce * (known.estimate - tie.estimate);
    tie.estimate += expanded(tie.reduce, shift);
    shift_offsets(rows, tie.offset, shift);
    offsets.segment(tie.offset, size) -= shift;
    set_prior(rows, tie.offset, reduced_covariance(tie.reduce, known.covariance));
  }
}

}  // namespace circlepoint
