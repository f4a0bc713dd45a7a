#pragma once
// The whole-arm estimate in the form that the single-joint methods' results have.

#include "arm_problem.hpp"
#include "circlepoint/identification/joint_calibration.hpp"

namespace circlepoint {

// Lines with their covariance; those too vague to mean anything are given as reasons instead.
void write_lines(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance,
                 bool gravity_seen);

// Up-gravity and the sensor's own errors with their covariances.
void write_sensor(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance);

// What a joint's motions alone and its dwells looked like, for the page.
void record_signals(JointCalibration& joints, const Segmentation& segmentation, const ArmProblem& problem,
                    const ArmResiduals& residuals);

}  // namespace circlepoint
