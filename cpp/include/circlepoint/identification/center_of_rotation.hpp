#pragma once
// Centre of rotation from a dynamic test: the paper's two methods (section 2.2).
//
// One joint turns by `angle` while the rest stand still. The gravity model is subtracted (eq. 5), the readings are rotated
// into the fixed frame O_w (eq. 6: w_a = R_m^T R_a^T m_a, docs/method), projected on x_w y_w and low-passed without phase shift.
//
//   position: integrate twice (eq. 8) and fit a circle to the path. Assumes the test starts at rest; a constant bias left
//             after subtraction grows with t^2, so only the first `position_window` seconds are used.
//   velocity: integrate once (eq. 7). With the joint rate w from the encoder, r = mean |v| / |w| and the direction from the
//             angle of v against the joint angle (means), or the least-squares form v = w J R(angle) b, both sides filtered.
//
// Centre of percussion (eq. 9-10 with its sign): channel k measures at distance d along its own axis and so loses
// d (|w|^2 - w_k^2). Correct, re-estimate, iterate to convergence; the rate is |v|/r in the position method, the encoder's
// in the velocity method.
//
// Fails (NotIdentifiable) when the joint does not move enough for a circle or a velocity, and when the position method's
// correction grows from step to step: the speed |v|/r of an axis that passes near the sensor is mostly the error being
// corrected.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"
#include "circlepoint/identification/gravity_model.hpp"

namespace circlepoint {

struct CenterOptions {
  double cutoff = 10.0;               ///< Hz, zero-phase Butterworth low-pass
  int filter_order = 4;
  double percussion_distance = 0.0;   ///< m, d
  bool least_squares = true;          ///< velocity method: least squares instead of the paper's means
  double position_window = 2.0;       ///< s, position method: length of record used; 0 for all of it
  double significant_rate = 0.2;      ///< samples with |w| below this fraction of the peak rate are left out
  int max_iterations = 20;
  double tolerance = 1e-9;            ///< m, change of the centre that counts as converged
};

struct CenterOfRotation {
  Eigen::Vector3d lever_sensor = Eigen::Vector3d::Zero();  ///< b, m: from the axis to the sensor, sensor frame, orthogonal to z
  Eigen::Vector2d center_joint = Eigen::Vector2d::Zero();  ///< m, the centre in O_w, seen from the sensor at angle zero
  double radius = 0.0;                                     ///< m
  double point_std = 0.0;      ///< m: the fit's residual taken as fully correlated, a cautious figure
  double residual_rms = 0.0;   ///< m (position) or m/s (velocity)
  int iterations = 0;          ///< of the centre-of-percussion correction
  bool converged = false;
  Samples3 path;               ///< (M, 3): position (m) or velocity (m/s) in O_w as integrated, z column zero
};

/// angle: (N) rad, uniformly sampled; specific_force: (N, 3) m/s^2 in the (moving) sensor frame; axis_direction: unit z in the
/// sensor frame; gravity: the same joint's static model, its angle measured from the same zero.
CenterOfRotation center_by_position(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force,
                                    double sample_rate, const Eigen::Vector3d& axis_direction, const GravityModel& gravity,
                                    const CenterOptions& options = {});

/// Same arguments.
CenterOfRotation center_by_velocity(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force,
                                    double sample_rate, const Eigen::Vector3d& axis_direction, const GravityModel& gravity,
                                    const CenterOptions& options = {});

}  // namespace circlepoint
