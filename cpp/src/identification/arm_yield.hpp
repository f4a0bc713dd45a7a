#pragma once
// What resting joints do while one joint moves, better than a coarse encoder shows it.
//
// While joint i moves alone, the others yield to its gravity and reaction torques. A loop that holds them stiffly makes their
// deflection a linear function of the moving joint's motion theta: of
//   cos theta, sin theta;  alpha, alpha cos theta, alpha sin theta;  omega^2, omega^2 cos theta, omega^2 sin theta
// (torque over stiffness) and of omega, omega cos theta, omega sin theta (the loop's damping). Relative to the home position the
// tests share,
//   q_j(t) = h_j + sum_k c_ijk (phi_k(t) - phi_k(home)).
// Per resting joint, h and c of all tests are fitted at once to what its encoder tells: where it changes from one count to the
// next (the position there is known to a small part of a count), and that it stays within its counts otherwise. The rows then
// rest on the fitted motion instead of on the staircase; its covariance is the prior of shared offset parameters with the same
// shapes, which the accelerometer may determine further.
//
// Where the arm's lines are known, the coefficients of all pairs are tied to one rigid arm on stiff joints (arm_tie), which follow
// their torques a time constant late: a tenth of the unknowns.
//
// Left as it was: a joint whose counts contradict the model (it sticks, or is moved), by the misfit at its count changes; and
// stretches in which several joints move.

#include <Eigen/Core>
#include <vector>

#include "arm_rows.hpp"
#include "arm_smooth.hpp"

namespace circlepoint {

// Replaces the resting joints' positions in single-joint stretches and in the tests' dwells; marks them as followed. Dwells and
// spans in the order of the segmentation and of the recording's spans.
void follow_yields(ArmRows& rows, const Recording& recording, const Segmentation& segmentation,
                   const std::vector<SmoothSpan>& spans, const Eigen::VectorXd& resolution, const KnownArm* arm);

// Ties the resting joints' motion again, where the readings have meanwhile told more of the loads: `offsets` (K) are the shared
// offsets found with the rows as they are, and become those of the new ones.
void retie(ArmRows& rows, Eigen::VectorXd& offsets);

}  // namespace circlepoint
