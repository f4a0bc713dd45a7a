#pragma once
// One joint's tests as a linear regression, and the joint's model from its sufficient statistics (docs/method, section 3).
//
// While only one joint turns by `angle`, at rate w and acceleration alpha, the reading is
//   y = A + B cos(angle) + C sin(angle) + E alpha + F w^2,
// five constant 3-vectors in the sensor frame. With z the axis, b the lever from the axis to the sensor (orthogonal to z),
// G the part of up-gravity orthogonal to z at angle zero and d_k the percussion distance of channel k:
//   A = up-gravity along z + bias,  B = G,  C = -z x G,  E = z x b,  F_k = -b_k - d_k (1 - z_k^2).
// For white noise the 5x5 normal matrix and the 5x3 right-hand side are all a test has to say. They are collected in one pass,
// add up over pieces and files, and the model fit sees fifteen numbers.
//
// Filter both sides: a zero-phase filter is linear, so readings and regressors go through the same one and the model stays
// exact; filtering the readings only would bias the result by the attenuation of their harmonics.
//
// A single test cannot tell a bias from a tilt when the axis is parallel to gravity: the prior on A (bias orthogonal to z,
// |up-gravity| = g) is then what is known of the direction, and the covariance says so.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/line.hpp"

namespace circlepoint {

using Regressors = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Matrix53 = Eigen::Matrix<double, 5, 3>;

/// Columns 1, cos(angle), sin(angle), alpha, w^2; inputs (N) rad, rad/s, rad/s^2.
Regressors joint_regressors(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Eigen::VectorXd>& rate,
                            const Eigen::Ref<const Eigen::VectorXd>& acceleration);

/// Sums over samples; statistics of pieces add up.
struct RegressionStatistics {
  Matrix5 information = Matrix5::Zero();              ///< sum x x^T
  Matrix53 score = Matrix53::Zero();                  ///< sum x y^T
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  ///< sum y_k^2
  double count = 0.0;                                 ///< samples, or their total weight

  /// Adds samples with one common weight. regressors (N, 5), readings (N, 3).
  void add(const Eigen::Ref<const Regressors>& regressors, const Eigen::Ref<const Samples3>& readings, double weight = 1.0);
  RegressionStatistics& operator+=(const RegressionStatistics& other);
  [[nodiscard]] RegressionStatistics scaled(double weight) const;
};

/// Statistics of samples of one motion, the sum of joint_regressors' rows by the readings turned by `rotation` (sensor frame
/// to the frame of the result), in one pass over the data and without the regressors in memory. angle, rate, acceleration: (N)
/// rad, rad/s, rad/s^2; readings: (N, 3) m/s^2. Raises InvalidInput on unequal lengths.
RegressionStatistics joint_statistics(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Eigen::VectorXd>& rate,
                                      const Eigen::Ref<const Eigen::VectorXd>& acceleration, const Eigen::Ref<const Samples3>& readings,
                                      const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

struct JointModel {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();      ///< z, unit
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();      ///< b, m
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();    ///< G, m/s^2
  Eigen::Vector3d constant = Eigen::Vector3d::Zero();   ///< A, m/s^2
  Eigen::Vector3d percussion_distance = Eigen::Vector3d::Zero();  ///< d, m, of each channel

  /// Rows A, B, C, E, F.
  [[nodiscard]] Matrix53 coefficients() const;
  /// The axis as a line in the sensor frame.
  [[nodiscard]] Line line() const;
};

/// m; how far the channels of one sensor may measure from their common distance: they share a housing (assumed).
inline constexpr double channel_spread_std = 1e-3;

/// What is known beforehand, as means and standard deviations.
struct JointModelPrior {
  double bias_std = 0.05;                ///< m/s^2, of the bias left in A
  double gravity = standard_gravity;     ///< m/s^2
  double gravity_std = 0.05;             ///< m/s^2, of the magnitude read (scale-factor error included)
  double percussion_distance = 0.0;      ///< m, the channels' mean
  double percussion_distance_std = 0.0;  ///< m, of that mean, and of each channel about it where that is less than
                                         ///< channel_spread_std; 0 fixes all
};

/// Number of parameters of the model's chart: direction 2, gravity 2, lever 2, constant 3, percussion distances 3.
inline constexpr int joint_model_parameters = 12;
using JointModelMatrix = Eigen::Matrix<double, joint_model_parameters, joint_model_parameters>;
/// d vec(coefficients) / d parameters; vec stacks the columns (channels).
using JointModelJacobian = Eigen::Matrix<double, 15, joint_model_parameters>;

struct JointModelFit {
  JointModel model;
  JointModelMatrix information = JointModelMatrix::Zero();        ///< data and prior
  JointModelMatrix data_information = JointModelMatrix::Zero();   ///< data alone
  JointModelJacobian jacobian = JointModelJacobian::Zero();
  double cost = 0.0;
  int iterations = 0;
  bool converged = false;

  /// The first-order map from chart parameters to the line's local coordinates (d1, d2, p1, p2) of geometry/joint_axis.
  [[nodiscard]] static Eigen::Matrix<double, 4, joint_model_parameters> line_selector();
};

/// Maximum-likelihood model for statistics already divided by the noise variance (weights 1/sigma^2). Start values come from
/// the data. Raises NotIdentifiable when there is no dynamic information at all (the joint never accelerated).
JointModelFit fit_joint_model(const RegressionStatistics& weighted, const JointModelPrior& prior);

}  // namespace circlepoint
