#pragma once
// Ties what the resting joints' counts tell, pair by pair, to one rigid arm on stiff joints.
//
// Joint j deflects by kappa_j tau_j, a time constant T_j late, with tau_j linear in the inertial parameters of the outer joint's load
// (arm_load). The pairs' coefficients c then are B(theta) + e, theta the loads, the joints' compliances and time constants and their
// homes, and e the model's own error, of one standard deviation for all. That is found by the evidence of the counts: where
// the arm is not rigid beyond its joints, or they stick, it becomes large and the coefficients stay what they are without.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "arm_counts.hpp"
#include "arm_load.hpp"

namespace circlepoint {

// What the counts of one resting joint tell.
struct RestingFit {
  Index joint = 0;
  JointFit fit;
  std::vector<Index> moving;             // (tests) the joint that moves
  std::vector<Eigen::MatrixXd> resolve;  // (tests): (r, functions) from the functions' coefficients to c
};

// Where the model is linearised, and its error.
struct LoadPoint {
  Eigen::VectorXd theta;
  double model_std = 0.0;  // counts rms, of e
};

struct TiedFits {
  Eigen::VectorXd estimate;    // of all fits' coefficients, in order
  Eigen::MatrixXd covariance;
};

// The model of some joints' fits, which it keeps a reference to.
class LoadModel {
 public:
  LoadModel(const std::vector<RestingFit>& fits, const ArmAtHome& arm);

  // What the counts alone tell.
  [[nodiscard]] LoadPoint fit() const;
  // Time constants, s, beyond those the functions follow with already.
  [[nodiscard]] Eigen::VectorXd lag(const LoadPoint& point) const;
  // The counts' and the model's knowledge of the coefficients together, linearised.
  [[nodiscard]] TiedFits tied(const LoadPoint& point) const;
  // The point of the model nearest to the coefficients.
  [[nodiscard]] LoadPoint nearest(const LoadPoint& point, const Eigen::VectorXd& coefficients) const;

 private:
  struct Equations {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient;
    double cost = 0.0;
  };
  using Factors = std::vector<Eigen::LLT<Eigen::MatrixXd>>;  // of the variances, by fit

  [[nodiscard]] Index parameters() const { return load_parameters * joints_ + 3 * joints_; }
  [[nodiscard]] Index compliance_at(Index joint) const { return load_parameters * joints_ + joint; }
  [[nodiscard]] Index home_at(Index joint) const { return compliance_at(joints_) + joint; }
  [[nodiscard]] Index lag_at(Index joint) const { return home_at(joints_) + joint; }
  [[nodiscard]] Eigen::VectorXd start() const;
  [[nodiscard]] Eigen::VectorXd prior() const;
  [[nodiscard]] Eigen::VectorXd model_variance(std::size_t fit, double model_std) const;
  [[nodiscard]] Factors factors(double model_std) const;
  Eigen::VectorXd evaluate(std::size_t fit, const Eigen::VectorXd& theta, Eigen::MatrixXd& jacobian) const;
  [[nodiscard]] Equations linearised(const Factors& factors, const Eigen::VectorXd& aim, const Eigen::VectorXd& prior,
                                     const Eigen::VectorXd& centre, const Eigen::VectorXd& theta) const;
  Equations minimise(const Factors& factors, const Eigen::VectorXd& aim, const Eigen::VectorXd& prior,
                     const Eigen::VectorXd& centre, Eigen::VectorXd& theta) const;

  const std::vector<RestingFit>& fits_;
  Index joints_;
  Index scale_ = 0;                                  // the joint whose compliance is one
  std::vector<std::vector<Eigen::MatrixXd>> loads_;  // of each fit's tests; empty: not described
  std::vector<Index> first_;                         // coefficient of each fit
  Eigen::VectorXd counted_;                          // all fits' estimates
};

}  // namespace circlepoint
