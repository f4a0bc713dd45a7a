#pragma once
// Axis direction from a static test (paper, section 2.1).
//
// While one joint turns and the rest stand still, the component of the static specific force along the joint axis is
// constant: z . f_i = c (eq. 3). For isotropic noise the least-squares z over the unit sphere is the smallest eigenvector of
// the scatter of f_i: closed form, no chart, no sign trap. With the joint angles known the rotation's sense fixes the sign
// of z.
//
// The paper's own parameters are a chart of half the sphere: z = (l, m, sqrt(1 - l^2 - m^2)), printed with a sign error
// (docs/method), started here at its centre l = m = 0. Its derivative is unbounded where n = 0: an axis that lies nearly in
// the sensor's x-y plane is reached slowly or not at all (`converged` false), which the sphere does not notice.
//
// Fails (NotIdentifiable) when the samples do not spread in a plane: the axis is parallel to gravity, or the joint hardly
// turned. All samples then coincide up to noise and any z fits.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct AxisDirectionFit {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit, in the sensor frame
  double offset = 0.0;                                   ///< c, m/s^2
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< rad^2, in tangent_basis(direction)
  double residual_std = 0.0;                             ///< m/s^2
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();      ///< m/s^2, rms of the samples along the scatter's axes, ascending
  Eigen::VectorXd weights;                               ///< (N) final weights, 1 for inliers
  int iterations = 0;
  bool converged = true;
};

/// Which parameters the iteration moves z in.
enum class AxisChart {
  sphere,      ///< the tangent plane: the same everywhere
  hemisphere,  ///< the paper's l, m with n = sqrt(1 - l^2 - m^2) > 0
};

struct RobustOptions {
  double loss_scale = 3.0;  ///< residuals beyond this many robust standard deviations are down-weighted (Cauchy loss);
                            ///< infinity: plain least squares, the paper's objective
  int max_iterations = 50;
  AxisChart chart = AxisChart::sphere;
};

/// Closed form. specific_force: (N, 3) m/s^2, one row a pose. Raises InvalidInput for fewer than 3 poses and NotIdentifiable
/// when the poses do not spread over a plane.
AxisDirectionFit fit_axis_direction(const Eigen::Ref<const Samples3>& specific_force);

/// By iteration: Cauchy loss scaled by the median absolute residual; covariance from the weighted information. Same
/// arguments and errors, and InvalidInput for a loss scale that is not positive.
AxisDirectionFit fit_axis_direction_robust(const Eigen::Ref<const Samples3>& specific_force, const RobustOptions& options = {});

/// The direction or its opposite, whichever turns the samples the way the joint turned.
/// angle: (N) rad; specific_force: (N, 3) m/s^2. Raises as fit_gravity_model, whose coefficients tell.
Eigen::Vector3d orient_axis(const Eigen::Vector3d& direction, const Eigen::Ref<const Eigen::VectorXd>& angle,
                            const Eigen::Ref<const Samples3>& specific_force);

}  // namespace circlepoint
