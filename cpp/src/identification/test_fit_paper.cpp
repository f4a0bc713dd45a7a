#include <Eigen/LU>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "circlepoint/identification/axis_direction.hpp"
#include "circlepoint/identification/center_of_rotation.hpp"
#include "test_fit.hpp"

namespace circlepoint {
namespace {

// Derivative of the plane fit's direction, in tangent_basis(z), by the sensor's bias, scale, misalignment and second-order
// errors: d = -(sum w p p^T)^-1 sum w p (z . df), p the poses in the tangent plane about their mean. A bias moves the plane
// without turning it.
Eigen::Matrix<double, 2, sensor_errors> direction_by_sensor(const Eigen::Ref<const Samples3>& poses, const Eigen::VectorXd& weights,
                                                 const Eigen::Vector3d& z) {
  Eigen::Matrix<double, Eigen::Dynamic, sensor_errors> along(poses.rows(), 12);
  along.leftCols<3>() = z.transpose().replicate(poses.rows(), 1);
  along.middleCols<3>(3) = poses * z.asDiagonal();
  along.col(6) = z.y() * poses.col(0);
  along.col(7) = z.z() * poses.col(0);
  along.col(8) = z.z() * poses.col(1);
  along.rightCols<3>() = poses.cwiseAbs2() * z.asDiagonal();
  const Eigen::RowVector3d mean = weights.transpose() * poses / weights.sum();
  const Eigen::Matrix<double, Eigen::Dynamic, 2> in_plane = (poses.rowwise() - mean) * tangent_basis(z);
  const Eigen::Matrix2d information = in_plane.transpose() * weights.asDiagonal() * in_plane;
  return -information.inverse() * (in_plane.transpose() * weights.asDiagonal() * along);
}

}  // namespace

FittedTest fit_by_paper(const TestSamples& samples, const TestRegression& regression, CalibrationMethod method,
                        double sample_rate, const JointCalibrationOptions& options) {
  if (samples.dwell_force.rows() < 3) {
    throw NotIdentifiable("the static test has " + std::to_string(samples.dwell_force.rows()) +
                          " poses and needs at least 3; hold the joint still at more angles, 1 s each");
  }
  const Eigen::VectorXd angle = samples.dwell_positions.col(samples.joint).array() - samples.configuration[samples.joint];
  const AxisDirectionFit axis = fit_axis_direction_robust(samples.dwell_force);
  const Eigen::Vector3d z = orient_axis(axis.direction, angle, samples.dwell_force);
  const GravityModel gravity = fit_gravity_model(angle, samples.dwell_force);

  const MotionSamples& motion = widest_motion(samples);
  CenterOptions center_options;
  center_options.cutoff = samples.cutoff;
  center_options.filter_order = options.filter_order;
  center_options.percussion_distance = options.sensor.percussion_distance;
  const Eigen::VectorXd moving = motion.position.col(samples.joint).array() - samples.configuration[samples.joint];
  const CenterOfRotation center =
      method == CalibrationMethod::position
          ? center_by_position(moving, motion.specific_force, sample_rate, z, gravity, center_options)
          : center_by_velocity(moving, motion.specific_force, sample_rate, z, gravity, center_options);

  JointModel model;
  model.axis = z;
  model.lever = center.lever_sensor - center.lever_sensor.dot(z) * z;
  model.gravity = gravity.cosine - gravity.cosine.dot(z) * z;
  model.constant = gravity.constant;
  model.percussion_distance.setConstant(options.sensor.percussion_distance);

  FittedTest fitted;
  record_fit(fitted.fit, samples, regression, model, model.coefficients());
  fitted.fit.iterations = center.iterations;
  fitted.fit.converged = center.converged && axis.converged;
  fitted.fit.gravity_share = model.gravity.norm() / options.gravity;
  // The plane fit's basis belongs to the direction's sign: u stays, v turns with it.
  Eigen::Matrix2d direction = axis.covariance;
  if (z.dot(axis.direction) < 0.0) {
    direction(0, 1) = -direction(0, 1);
    direction(1, 0) = -direction(1, 0);
  }
  fitted.fit.noise_covariance.topLeftCorner<2, 2>() = direction;
  fitted.sensor_jacobian.topRows<2>() = direction_by_sensor(samples.dwell_force, axis.weights, z);
  fitted.fit.noise_covariance.bottomRightCorner<2, 2>() =
      center.point_std * center.point_std * Eigen::Matrix2d::Identity();
  return fitted;
}

}  // namespace circlepoint
