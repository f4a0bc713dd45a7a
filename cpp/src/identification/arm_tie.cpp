#include "arm_tie.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scaled_information.hpp"

namespace circlepoint {
namespace {

constexpr double free_load = 1e3;         // prior of the loads: anything
constexpr double free_compliance = 2.0;   // its logarithm, relative to the joint that shows its own best
constexpr double largest_logarithm = 20.0;
constexpr double free_home = 1e2;         // counts
constexpr double free_lag = 0.1;          // s
constexpr double unmodelled = 1e4;        // counts, of a pair the model does not describe
constexpr double near = 0.01;             // counts rms that coefficients are taken to err by in the search for the nearest point
constexpr double largest_error = 3.0;      // counts, of the model
constexpr double smallest_error = 4e-3;    // no arm is a rigid one on springs to less
constexpr int most_steps = 30;
constexpr Index cosine = 0;               // arm_yield's functions
constexpr Index sine = 1;
constexpr Index velocity_cosine = 9;
constexpr Index velocity_sine = 10;

}  // namespace

LoadModel::LoadModel(const std::vector<RestingFit>& fits, const ArmAtHome& arm)
    : fits_(fits), joints_(static_cast<Index>(arm.axes.size())) {
  Index coefficients = 0;
  double most = -1.0;
  for (const RestingFit& fit : fits) {
    const Eigen::VectorXd squares = fit.fit.estimate.cwiseAbs2().cwiseQuotient(fit.fit.covariance.diagonal());
    const double shown = squares.tail(squares.size() - 1).sum();
    if (shown > most) {
      most = shown;
      scale_ = fit.joint;
    }
    std::vector<Eigen::MatrixXd> loads;
    for (const Index moving : fit.moving) {
      const bool known = arm.known[static_cast<std::size_t>(moving)] && arm.known[static_cast<std::size_t>(fit.joint)];
      loads.push_back(known ? load_coefficients(arm, moving, fit.joint) : Eigen::MatrixXd());
    }
    loads_.push_back(std::move(loads));
    first_.push_back(coefficients);
    coefficients += fit.fit.estimate.size();
  }
  counted_.resize(coefficients);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    counted_.segment(first_[i], fits[i].fit.estimate.size()) = fits[i].fit.estimate;
  }
}

// theta: loads of every outer joint, logarithms of compliances (none is negative, and where the counts show next to nothing of a joint
// its compliance stays as large as they allow, not zero), homes, time constants.
Eigen::VectorXd LoadModel::start() const { return Eigen::VectorXd::Zero(parameters()); }

// Inverse variances about the start.
Eigen::VectorXd LoadModel::prior() const {
  Eigen::VectorXd information(parameters());
  information.head(load_parameters * joints_).setConstant(1.0 / (free_load * free_load));
  information.segment(compliance_at(0), joints_).setConstant(1.0 / (free_compliance * free_compliance));
  information[compliance_at(scale_)] = 1e8;  // loads and compliances have one scale
  information.segment(home_at(0), joints_).setConstant(1.0 / (free_home * free_home));
  information.segment(lag_at(0), joints_).setConstant(1.0 / (free_lag * free_lag));
  return information;
}

// B(theta) of one fit, and its derivative (coefficients of the fit, parameters).
Eigen::VectorXd LoadModel::evaluate(std::size_t fit, const Eigen::VectorXd& theta, Eigen::MatrixXd& jacobian) const {
  const RestingFit& mine = fits_[fit];
  Eigen::VectorXd value = Eigen::VectorXd::Zero(mine.fit.estimate.size());
  jacobian = Eigen::MatrixXd::Zero(value.size(), parameters());
  value[0] = theta[home_at(mine.joint)];
  jacobian(0, home_at(mine.joint)) = 1.0;
  const double compliance = std::exp(std::clamp(theta[compliance_at(mine.joint)], -largest_logarithm, largest_logarithm));
  const double late = theta[lag_at(mine.joint)];
  for (std::size_t k = 0; k < mine.moving.size(); ++k) {
    if (loads_[fit][k].size() == 0) {
      continue;
    }
    const Eigen::MatrixXd& resolve = mine.resolve[k];
    const Index load = load_parameters * std::max(mine.moving[k], mine.joint);
    Eigen::MatrixXd by_load = Eigen::MatrixXd::Zero(resolve.cols(), load_parameters);
    by_load.topRows(load_functions) = loads_[fit][k];
    // tau(t - T) is tau - T d tau / dt.
    by_load.row(velocity_cosine) = -late * by_load.row(sine);
    by_load.row(velocity_sine) = late * by_load.row(cosine);
    const Eigen::VectorXd torque = by_load * theta.segment(load, load_parameters);
    Eigen::VectorXd by_lag = Eigen::VectorXd::Zero(resolve.cols());
    by_lag[velocity_cosine] = -torque[sine];
    by_lag[velocity_sine] = torque[cosine];
    const Index first = mine.fit.first[k];
    value.segment(first, resolve.rows()) = compliance * (resolve * torque);
    jacobian.block(first, load, resolve.rows(), load_parameters) = compliance * (resolve * by_load);
    jacobian.block(first, compliance_at(mine.joint), resolve.rows(), 1) = compliance * (resolve * torque);
    jacobian.block(first, lag_at(mine.joint), resolve.rows(), 1) = compliance * (resolve * by_lag);
  }
  return value;
}

// Variance of e.
Eigen::VectorXd LoadModel::model_variance(std::size_t fit, double model_std) const {
  const RestingFit& mine = fits_[fit];
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(mine.fit.estimate.size());
  for (std::size_t k = 0; k < mine.moving.size(); ++k) {
    const double std = loads_[fit][k].size() > 0 ? model_std : unmodelled;
    variance.segment(mine.fit.first[k], mine.resolve[k].rows()).setConstant(std * std);
  }
  return variance;
}

LoadModel::Factors LoadModel::factors(double model_std) const {
  Factors result;
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    Eigen::MatrixXd variance = fits_[i].fit.covariance;
    variance.diagonal() += model_variance(i, model_std);
    result.emplace_back(variance);
  }
  return result;
}

LoadModel::Equations LoadModel::linearised(const Factors& factors, const Eigen::VectorXd& aim, const Eigen::VectorXd& prior,
                                           const Eigen::VectorXd& centre, const Eigen::VectorXd& theta) const {
  Equations equations;
  const Eigen::VectorXd off = theta - centre;
  equations.information = prior.asDiagonal();
  equations.gradient = prior.cwiseProduct(off);
  equations.cost = prior.dot(off.cwiseAbs2());
  Eigen::MatrixXd jacobian;
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    Eigen::VectorXd residual = evaluate(i, theta, jacobian);
    residual -= aim.segment(first_[i], residual.size());
    factors[i].matrixL().solveInPlace(residual);
    factors[i].matrixL().solveInPlace(jacobian);
    equations.cost += residual.squaredNorm();
    equations.information.noalias() += jacobian.transpose() * jacobian;
    equations.gradient.noalias() += jacobian.transpose() * residual;
  }
  return equations;
}

// Levenberg's and Marquardt's search; `theta` is where it begins and ends.
LoadModel::Equations LoadModel::minimise(const Factors& factors, const Eigen::VectorXd& aim, const Eigen::VectorXd& prior,
                                         const Eigen::VectorXd& centre, Eigen::VectorXd& theta) const {
  Equations here = linearised(factors, aim, prior, centre, theta);
  double damping = 1e-6;
  for (int step = 0; step < most_steps && damping < 1e6; ++step) {
    Eigen::MatrixXd damped = here.information;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd next = theta - damped.ldlt().solve(here.gradient);
    Equations there = linearised(factors, aim, prior, centre, next);
    if (!(there.cost < here.cost)) {
      damping = std::max(1e-4, 10.0 * damping);
      continue;
    }
    const bool settled = here.cost - there.cost < 1e-3;
    theta = next;
    here = std::move(there);
    damping *= 0.1;
    if (settled) {
      break;
    }
  }
  return here;
}

LoadPoint LoadModel::fit() const {
  LoadPoint best;
  double most = -std::numeric_limits<double>::infinity();
  Eigen::VectorXd theta = start();
  for (double model_std = largest_error; model_std > smallest_error; model_std /= 1.6) {
    const Factors factors = this->factors(model_std);
    const Equations equations = minimise(factors, counted_, prior(), start(), theta);
    double log_determinant = ScaledInformation(equations.information).log_determinant();
    for (const auto& factor : factors) {
      log_determinant += 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    }
    const double log_evidence = -0.5 * (equations.cost + log_determinant);
    if (log_evidence > most) {
      most = log_evidence;
      best = {theta, model_std};
    }
  }
  return best;
}

Eigen::VectorXd LoadModel::lag(const LoadPoint& point) const { return point.theta.segment(lag_at(0), joints_); }

TiedFits LoadModel::tied(const LoadPoint& point) const {
  const Equations equations = linearised(factors(point.model_std), counted_, prior(), start(), point.theta);
  const Eigen::MatrixXd covariance = ScaledInformation(equations.information).inverse();
  const Eigen::VectorXd step = -covariance * equations.gradient;
  // c given theta is between the counts and B(theta), by their variances; theta's own uncertainty is common to all.
  TiedFits result;
  result.estimate.resize(counted_.size());
  result.covariance = Eigen::MatrixXd::Zero(counted_.size(), counted_.size());
  Eigen::MatrixXd by_theta(counted_.size(), parameters());
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    const JointFit& fit = fits_[i].fit;
    Eigen::MatrixXd jacobian;
    const Eigen::VectorXd value = evaluate(i, point.theta, jacobian);
    Eigen::MatrixXd both = fit.covariance;
    both.diagonal() += model_variance(i, point.model_std);
    const Eigen::MatrixXd to_model = both.ldlt().solve(fit.covariance).transpose();
    const Index size = fit.estimate.size();
    result.estimate.segment(first_[i], size) = fit.estimate + to_model * (value + jacobian * step - fit.estimate);
    by_theta.middleRows(first_[i], size) = to_model * jacobian;
    const Eigen::MatrixXd remaining = fit.covariance - to_model * fit.covariance;
    result.covariance.block(first_[i], first_[i], size, size) = 0.5 * (remaining + remaining.transpose());
  }
  result.covariance += by_theta * covariance * by_theta.transpose();
  return result;
}

LoadPoint LoadModel::nearest(const LoadPoint& point, const Eigen::VectorXd& coefficients) const {
  Factors all_alike;
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    Eigen::VectorXd variance = model_variance(i, 0.0);
    variance.array() += near * near;
    all_alike.emplace_back(Eigen::MatrixXd(variance.asDiagonal()));
  }
  LoadPoint result = point;
  minimise(all_alike, coefficients, prior(), start(), result.theta);
  return result;
}

}  // namespace circlepoint
