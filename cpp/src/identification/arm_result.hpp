#pragma once
// The whole-arm estimate in the form that the single-joint methods' results have.

#include "arm_problem.hpp"
#include "circlepoint/identification/joint_calibration.hpp"

namespace circlepoint {

// How far the covariance of the lines may be believed.
struct Seen {
  double gravity_std = 0.0;      // rad, of its direction, by the data alone where the sensor is not known
  bool sensor_is_known = true;
  Eigen::VectorXd data_std;      // of all columns, by the data alone
  Eigen::VectorXd rounding;      // (n) share of its counts' rounding in each joint's acceleration
  std::vector<bool> ambiguous;   // (n) the mirrored line explains the joint's motion about as well
  double rest_rms = 0.0;         // m/s^2, of the rests' residuals
};

// Lines with their covariance; those too vague to mean anything are given as reasons instead.
void write_lines(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance,
                 const Seen& seen);

// Up-gravity and the sensor's own errors with their covariances.
void write_sensor(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance);

// What a joint's motions alone and its dwells looked like, for the page.
void record_signals(JointCalibration& joints, const Segmentation& segmentation, const ArmProblem& problem,
                    const ArmResiduals& residuals);

}  // namespace circlepoint
