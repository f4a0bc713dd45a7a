#pragma once
// What a sensor reads while one joint turns, by rigid-body kinematics in vectors: written without the library's own
// regression, so that the two can be held against each other.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "circlepoint/core/types.hpp"
#include "support/random_arms.hpp"

namespace circlepoint::support {

/// One joint and one sensor, in the sensor frame at angle zero.
struct OneJoint {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();              ///< unit
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();              ///< m, axis to sensor, orthogonal to the axis
  Eigen::Vector3d up_gravity = Eigen::Vector3d(0.0, 0.0, standard_gravity);  ///< m/s^2
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();               ///< m/s^2
  double percussion_distance = 0.0;                             ///< m
};

/// Lever and gravity in general position.
inline OneJoint random_joint(Random& random) {
  OneJoint joint;
  joint.axis = random.unit();
  joint.lever = random.unit().cross(joint.axis).normalized() * random.uniform(0.1, 0.8);
  // Well away from the axis.
  joint.up_gravity = (joint.lever.normalized() + 0.5 * joint.axis + 0.3 * random.unit()).normalized() * standard_gravity;
  return joint;
}

struct OneJointMotion {
  Eigen::VectorXd angle;         ///< (N) rad
  Eigen::VectorXd rate;          ///< (N) rad/s
  Eigen::VectorXd acceleration;  ///< (N) rad/s^2
};

/// Still poses over [first, first + span].
inline OneJointMotion still_poses(Index poses, double first, double span) {
  return {Eigen::VectorXd::LinSpaced(poses, first, first + span), Eigen::VectorXd::Zero(poses), Eigen::VectorXd::Zero(poses)};
}

/// Eq. (11) from `first` over `span`, after and before one second of rest. Where its acceleration steps, at both ends, the
/// sample is the mean of both sides, as of any band-limited signal.
inline OneJointMotion raised_cosine(double first, double span, double frequency, Index cycles, double sample_rate) {
  const double duration = static_cast<double>(cycles) / frequency;
  const auto samples = static_cast<Index>(std::lround((duration + 2.0) * sample_rate)) + 1;
  OneJointMotion motion = still_poses(samples, first, 0.0);
  const double w = 2.0 * std::numbers::pi * frequency;
  for (Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / sample_rate - 1.0;
    if (t > -1e-9 && t < duration + 1e-9) {
      motion.angle[i] = first + 0.5 * span * (1.0 - std::cos(w * t));
      motion.rate[i] = 0.5 * span * w * std::sin(w * t);
      const bool at_step = t < 1e-9 || t > duration - 1e-9;
      motion.acceleration[i] = (at_step ? 0.5 : 1.0) * 0.5 * span * w * w * std::cos(w * t);
    }
  }
  return motion;
}

/// Readings (N, 3) m/s^2, without noise: gravity turned back, tangential and centripetal acceleration of the lever, each
/// channel's own distance from the frame's origin, bias.
inline Samples3 readings(const OneJoint& joint, const OneJointMotion& motion) {
  Samples3 y(motion.angle.size(), 3);
  for (Index i = 0; i < y.rows(); ++i) {
    const Eigen::Vector3d w = motion.rate[i] * joint.axis;
    const Eigen::Vector3d alpha = motion.acceleration[i] * joint.axis;
    const Eigen::Vector3d gravity = Eigen::AngleAxisd(-motion.angle[i], joint.axis) * joint.up_gravity;
    Eigen::Vector3d f = gravity + joint.bias;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d from_axis = joint.lever + joint.percussion_distance * Eigen::Vector3d::Unit(k);
      f[k] += (alpha.cross(from_axis) + w.cross(w.cross(from_axis)))[k];
    }
    y.row(i) = f;
  }
  return y;
}

inline void add_noise(Samples3& samples, double std, Random& random) {
  samples += Samples3::NullaryExpr(samples.rows(), 3, [&] { return std * random.normal(); });
}

}  // namespace circlepoint::support
