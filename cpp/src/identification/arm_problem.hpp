#pragma once
// The whole-arm least-squares problem: rows, noise and priors, linearised about a state.

#include <Eigen/Core>
#include <vector>

#include "arm_model.hpp"
#include "arm_noise.hpp"
#include "arm_rows.hpp"

namespace circlepoint {

// Gaussian knowledge of some neighbouring columns' values: root (value - mean) is standard normal.
struct PriorTerm {
  Index column = 0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;
};

struct ArmPrior {
  std::vector<PriorTerm> terms;
  double gravity = standard_gravity;  // m/s^2
  double gravity_std = 1e-6;          // m/s^2; infinite: the magnitude is free
  bool gravity_known = true;          // the magnitude is a datum, not a belief
};

// Independent columns of one standard deviation; infinite: nothing is known.
void add_prior(ArmPrior& prior, Index column, const Eigen::VectorXd& mean, double std);

// Sums over rows: information J^T W J, gradient J^T W r with r = model - reading, cost r^T W r.
struct NormalEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  double cost = 0.0;

  static NormalEquations zero(Index columns);
  NormalEquations& operator+=(const NormalEquations& other);
};

// One stretch or dwell: the layout's columns, then one for each shared offset it knows.
struct PartEquations {
  NormalEquations equations;
  std::vector<Index> offsets;  // their parameters
};

struct ArmProblem {
  ArmRows rows;
  ArmLayout layout;
  ArmPrior prior;
  ArmNoise noise;
  Eigen::VectorXd offsets;  // (K) where the shared offsets are linearised
  unsigned threads = 1;
};

// The joints at a stretch's row, offsets included.
void set_instant(const MovingStretch& stretch, Index row, const ArmProblem& problem, JointInstant& instant);

struct ArmResiduals {
  StretchResiduals moving;        // (M, channels) each, model - reading
  StretchResiduals whitened;      // the same whitened
  Eigen::MatrixXd dwells;         // (D, channels)
  std::vector<Eigen::MatrixXd> dwell_covariance;  // (D) (channels, channels) by their samples' scatter and the encoders
  Eigen::MatrixXd dwells_normalized;  // (D, channels)
};

// What the model gave last, before it is weighed: most of an evaluation's work, and the same while only the noise changes.
// Whoever changes rows or columns says forget().
struct KeptSystems {
  Eigen::VectorXd state;                   // they hold for, flattened
  Eigen::VectorXd offsets;
  Eigen::VectorXd linearised_at;           // the offsets their derivatives hold for
  std::vector<Eigen::MatrixXd> stretches;  // their systems in order; without elements: too large to keep

  void forget() { state.resize(0); }
};

// Data part: stretches first, in order, then each dwell. `parts` are overwritten: theirs is the memory.
std::vector<PartEquations> linearise_data(const ArmProblem& problem, const ArmState& state, KeptSystems* kept = nullptr,
                                          std::vector<PartEquations> parts = {});
NormalEquations linearise_prior(const ArmProblem& problem, const ArmState& state);
// What a magnitude of gravity known to a standard deviation makes, m/s^2: a part of it, which counts as data where that is known.
NormalEquations linearise_gravity(const ArmLayout& layout, const ArmState& state, double magnitude, double std);

ArmResiduals residuals(const ArmProblem& problem, const ArmState& state, KeptSystems* kept = nullptr);

}  // namespace circlepoint
