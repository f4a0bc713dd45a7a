#include "circlepoint/identification/center_of_rotation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/conditioning/sosfilt.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/identification/circle_fit.hpp"
#include "circlepoint/identification/joint_frame.hpp"

namespace circlepoint {
namespace {

using Samples2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

// The dynamic test in O_w: everything the two methods share.
struct PlaneTest {
  Eigen::Matrix3d R_sensor_joint;
  Eigen::VectorXd angle;
  Eigen::VectorXd rate;         // rad/s, from the filtered encoder
  Samples3 dynamic;             // gravity-free reading in the sensor frame, not yet corrected for percussion
  SecondOrderSections low_pass;
  double dt = 0.0;
};

PlaneTest prepare(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& f, double sample_rate,
                  const Eigen::Vector3d& axis_direction, const GravityModel& gravity, const CenterOptions& options) {
  require(angle.size() == f.rows(), "angle has " + std::to_string(angle.size()) + " samples and specific_force " +
                                        std::to_string(f.rows()) + "; give one of each per sample");
  require(sample_rate > 0.0, "sample_rate is " + std::to_string(sample_rate) + " Hz; give a positive rate");
  PlaneTest test;
  test.R_sensor_joint = joint_frame(axis_direction);
  test.angle = angle;
  test.dt = 1.0 / sample_rate;
  test.low_pass = butter(options.filter_order, options.cutoff, sample_rate);
  test.dynamic = f - gravity.evaluate(angle);
  // Smoothed well above the band that is kept: differentiating counts would bury the rate.
  const double smooth = std::min(3.0 * options.cutoff, 0.4 * sample_rate);
  test.rate = savgol_filter(sosfiltfilt(butter(options.filter_order, smooth, sample_rate), angle), 7, 6, 1, test.dt).col(0);
  if (!(test.rate.cwiseAbs().maxCoeff() * static_cast<double>(angle.size()) * test.dt > 0.05)) {
    throw NotIdentifiable("the joint turns by " + std::to_string(angle.maxCoeff() - angle.minCoeff()) +
                          " rad only; a centre of rotation needs a faster or wider motion");
  }
  return test;
}

// Corrects each channel for its centre of percussion at the given rate, then rotates to O_w, projects and low-passes.
Samples2 plane_acceleration(const PlaneTest& test, const Eigen::VectorXd& rate, double percussion_distance) {
  const Eigen::Vector3d z = test.R_sensor_joint.col(2);
  const Eigen::RowVector3d lever = percussion_distance * (1.0 - z.array().square()).matrix().transpose();
  const Samples3 corrected = test.dynamic + rate.array().square().matrix() * lever;
  const Samples3 joint_axes = corrected * test.R_sensor_joint;
  Samples2 fixed(joint_axes.rows(), 2);
  for (Index i = 0; i < joint_axes.rows(); ++i) {
    const double c = std::cos(test.angle[i]);
    const double s = std::sin(test.angle[i]);
    fixed(i, 0) = c * joint_axes(i, 0) - s * joint_axes(i, 1);
    fixed(i, 1) = s * joint_axes(i, 0) + c * joint_axes(i, 1);
  }
  return sosfiltfilt(test.low_pass, fixed);
}

// The sensor's offset from the axis when the joint is at angle zero, in O_w, as a vector in the sensor frame.
void set_lever(CenterOfRotation& result, const PlaneTest& test, const Eigen::Vector2d& lever_joint) {
  result.center_joint = -lever_joint;
  result.radius = lever_joint.norm();
  result.lever_sensor = test.R_sensor_joint.leftCols<2>() * lever_joint;
}

NotIdentifiable growing_correction(double percussion_distance, double radius) {
  return NotIdentifiable("the position method's correction for the centre of percussion (" +
                         std::to_string(percussion_distance) + " m) grows from step to step at a radius of " +
                         std::to_string(radius) +
                         " m: the sensor is too near the axis for it, or too noisy; use the velocity, joint or "
                         "whole-arm method");
}

// A path that was a circle and is none once it is corrected has been corrected too far.
CircleFit circle_of(const Eigen::Ref<const Samples2>& path, bool corrected, double percussion_distance, double radius) {
  try {
    return fit_circle(path);
  } catch (const NotIdentifiable&) {
    if (corrected) {
      throw growing_correction(percussion_distance, radius);
    }
    throw;
  }
}

Samples3 with_zero_column(const Samples2& plane) {
  Samples3 path = Samples3::Zero(plane.rows(), 3);
  path.leftCols<2>() = plane;
  return path;
}

Eigen::Vector2d rotate(double angle, const Eigen::Vector2d& v) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

}  // namespace

CenterOfRotation center_by_position(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force,
                                    double sample_rate, const Eigen::Vector3d& axis_direction, const GravityModel& gravity,
                                    const CenterOptions& options) {
  const PlaneTest test = prepare(angle, specific_force, sample_rate, axis_direction, gravity, options);
  Index used = angle.size();
  if (options.position_window > 0.0) {
    used = std::min<Index>(used, static_cast<Index>(std::lround(options.position_window * sample_rate)) + 1);
  }
  CenterOfRotation result;
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(angle.size());
  Eigen::Vector2d previous = Eigen::Vector2d::Zero();
  double first_radius = 0.0;
  double first_step = 0.0;
  double step = 0.0;
  for (result.iterations = 1; result.iterations <= options.max_iterations; ++result.iterations) {
    const Samples2 acceleration = plane_acceleration(test, rate, options.percussion_distance);
    const Samples2 velocity = cumulative_trapezoid(acceleration, test.dt, 0.0);
    const Samples2 path = cumulative_trapezoid(velocity, test.dt, 0.0);
    const CircleFit circle = circle_of(path.topRows(used), result.iterations > 1, options.percussion_distance, first_radius);
    // The path starts at the sensor: the sensor's offset from the axis there is minus the centre.
    set_lever(result, test, rotate(-angle[0], -circle.center));
    result.residual_rms = circle.rms;
    result.point_std = circle.rms;
    result.path = with_zero_column(path.topRows(used));
    step = (circle.center - previous).norm();
    result.converged = result.iterations > 1 && step < options.tolerance;
    if (result.converged) {
      break;
    }
    if (result.iterations == 1) {
      first_radius = circle.radius;
    } else if (result.iterations == 2) {
      first_step = step;
    }
    previous = circle.center;
    rate = velocity.rowwise().norm() / std::max(circle.radius, 1e-6);
  }
  result.iterations = std::min(result.iterations, options.max_iterations);
  if (!result.converged && !(step < first_step) && result.iterations > 2) {
    throw growing_correction(options.percussion_distance, first_radius);
  }
  return result;
}

CenterOfRotation center_by_velocity(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force,
                                    double sample_rate, const Eigen::Vector3d& axis_direction, const GravityModel& gravity,
                                    const CenterOptions& options) {
  const PlaneTest test = prepare(angle, specific_force, sample_rate, axis_direction, gravity, options);
  const Samples2 acceleration = plane_acceleration(test, test.rate, options.percussion_distance);
  const Samples2 velocity = cumulative_trapezoid(acceleration, test.dt, 0.0);
  // v = w J R(angle) b with b the lever at angle zero: columns w (-sin, cos) and w (-cos, -sin), filtered like the readings.
  SamplesX columns(angle.size(), 4);
  for (Index i = 0; i < angle.size(); ++i) {
    const double s = test.rate[i] * std::sin(angle[i]);
    const double c = test.rate[i] * std::cos(angle[i]);
    columns.row(i) << -s, -c, c, -s;
  }
  columns = sosfiltfilt(test.low_pass, columns);
  const double threshold = options.significant_rate * test.rate.cwiseAbs().maxCoeff();

  CenterOfRotation result;
  result.iterations = 1;  // the encoder gives the rate, so one correction is the converged one
  result.converged = true;
  result.path = with_zero_column(velocity);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double radius_sum = 0.0;
  Eigen::Vector2d direction_sum = Eigen::Vector2d::Zero();
  Index significant = 0;
  for (Index i = 0; i < angle.size(); ++i) {
    if (std::abs(test.rate[i]) < threshold) {
      continue;
    }
    ++significant;
    Eigen::Matrix2d row;
    row << columns(i, 0), columns(i, 1), columns(i, 2), columns(i, 3);
    const Eigen::Vector2d v = velocity.row(i);
    normal += row.transpose() * row;
    right += row.transpose() * v;
    // v is a quarter turn ahead of R(angle) b times the sign of w (Figure 2 of the paper).
    const double speed = v.norm();
    radius_sum += speed / row.col(0).norm();
    if (speed > 0.0) {
      const Eigen::Vector2d quarter_back = Eigen::Vector2d(v.y(), -v.x()) / (test.rate[i] > 0.0 ? speed : -speed);
      direction_sum += rotate(-angle[i], quarter_back);
    }
  }
  const Eigen::Vector2d by_least_squares = normal.inverse() * right;
  const Eigen::Vector2d by_means = radius_sum / static_cast<double>(significant) * direction_sum.normalized();
  const Eigen::Vector2d lever = options.least_squares ? by_least_squares : by_means;
  set_lever(result, test, lever);
  double squares = 0.0;
  for (Index i = 0; i < angle.size(); ++i) {
    if (std::abs(test.rate[i]) >= threshold) {
      Eigen::Matrix2d row;
      row << columns(i, 0), columns(i, 1), columns(i, 2), columns(i, 3);
      squares += (velocity.row(i).transpose() - row * lever).squaredNorm();
    }
  }
  result.residual_rms = std::sqrt(squares / static_cast<double>(significant));
  result.point_std = result.residual_rms / std::sqrt(0.5 * normal.trace() / static_cast<double>(significant));
  return result;
}

}  // namespace circlepoint
