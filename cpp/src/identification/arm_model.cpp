#include "arm_model.hpp"

#include <cmath>

#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"

namespace circlepoint {
namespace {

Eigen::Vector3d read(const AccelerometerModel& sensor, const Eigen::Vector3d& force, const Eigen::Vector3d& rate) {
  return sensor.measure(force, rate);
}

// Columns of a line's local coordinates as twists (angular, linear) at the base frame's origin.
Eigen::Matrix<double, 6, 4> line_twists(const ScrewAxis& axis) {
  const Eigen::Vector3d& z = axis.line.direction;
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(z);
  Eigen::Matrix<double, 6, 4> twists = Eigen::Matrix<double, 6, 4>::Zero();
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d rotation = z.cross(basis.col(k));
    twists.block<3, 1>(0, k) = rotation;
    twists.block<3, 1>(3, k) = axis.line.point.cross(rotation);
    twists.block<3, 1>(3, 2 + k) = basis.col(k);
  }
  return twists;
}

}  // namespace

ArmPredictor::ArmPredictor(const ArmState& state, const ArmLayout& layout)
    : state_(state), layout_(layout), joints_(state.reference.size()) {
  const auto links = static_cast<std::size_t>(joints_) + 1;
  turn_.resize(links, Eigen::Matrix3d::Identity());
  rate_.resize(links, Eigen::Vector3d::Zero());
  angular_acceleration_.resize(links, Eigen::Vector3d::Zero());
  force_.resize(links, Eigen::Vector3d::Zero());
  to_sensor_.resize(links, Eigen::Matrix3d::Identity());
  by_twist_.resize(links, Eigen::Matrix<double, 3, 6>::Zero());
  rate_by_rotation_.resize(links, Eigen::Matrix3d::Zero());
  place_.resize(links, Eigen::Vector3d::Zero());
  place_rate_.resize(links, Eigen::Vector3d::Zero());
  force_read_.resize(links, Eigen::Matrix3d::Zero());
  rate_read_.resize(links, Eigen::Matrix3d::Zero());
  rate_by_joint_.position = rate_by_joint_.velocity = rate_by_joint_.acceleration = Eigen::Matrix3Xd::Zero(3, joints_);
  by_joint_ = rate_by_joint_;
  for (const ScrewAxis& axis : state_.axes) {
    twists_.emplace_back(axis.twist());
    line_twists_.push_back(line_twists(axis));
  }
}

void ArmPredictor::delay(const JointInstant& instant, double further) {
  stamped_ = instant;
  const double delay = state_.clock_offset + (state_.clock_rate - 1.0) * instant.time_from_middle + further;
  if (delay != 0.0) {
    // To the fourth order: an acceleration without the snap would be too large by (delay x frequency)^2 / 2.
    const double d = -delay;
    stamped_.position += d * (instant.velocity + d / 2.0 * (instant.acceleration + d / 3.0 * (instant.jerk + d / 4.0 * instant.snap)));
    stamped_.velocity += d * (instant.acceleration + d / 2.0 * (instant.jerk + d / 3.0 * instant.snap));
    stamped_.acceleration += d * (instant.jerk + d / 2.0 * instant.snap);
    stamped_.jerk += d * instant.snap;
  }
}

void ArmPredictor::correct_encoders() {
  now_ = stamped_;
  for (Index j = 0; j < joints_; ++j) {
    const double gain = state_.encoder_gain[j];
    const double cosine = state_.eccentricity(0, j);
    const double sine = state_.eccentricity(1, j);
    if (gain == 0.0 && cosine == 0.0 && sine == 0.0) {
      continue;
    }
    const double q = stamped_.position[j];
    const double q_dot = stamped_.velocity[j];
    const double slope = 1.0 + gain - cosine * std::sin(q) + sine * std::cos(q);
    const double curvature = -cosine * std::cos(q) - sine * std::sin(q);
    now_.position[j] += gain * (q - state_.reference[j]) + cosine * (std::cos(q) - std::cos(state_.reference[j])) +
                        sine * (std::sin(q) - std::sin(state_.reference[j]));
    now_.velocity[j] = slope * q_dot;
    now_.acceleration[j] = slope * stamped_.acceleration[j] + curvature * q_dot * q_dot;
  }
}

void ArmPredictor::forward(const JointInstant& instant, double further_delay) {
  delay(instant, further_delay);
  correct_encoders();
  force_[0] = state_.up_gravity;
  for (Index j = 0; j < joints_; ++j) {
    const auto before = static_cast<std::size_t>(j);
    const auto after = before + 1;
    const ScrewAxis& axis = state_.axes[before];
    const Eigen::Vector3d& z = axis.line.direction;
    const double q = now_.position[j] - state_.reference[j];
    const Eigen::Vector3d& w = rate_[before];
    const Eigen::Vector3d& alpha = angular_acceleration_[before];
    if (axis.type == JointType::prismatic) {
      const Eigen::Vector3d shift = q * z;
      rate_[after] = w;
      angular_acceleration_[after] = alpha;
      force_[after] = force_[before] + alpha.cross(shift) + w.cross(w.cross(shift)) + 2.0 * now_.velocity[j] * w.cross(z) +
                      now_.acceleration[j] * z;
      continue;
    }
    const Eigen::Vector3d& c = axis.line.point;
    turn_[before] = Eigen::AngleAxisd(q, z).toRotationMatrix();
    const Eigen::Vector3d turned = turn_[before].transpose() * w;
    rate_[after] = turned + now_.velocity[j] * z;
    angular_acceleration_[after] =
        turn_[before].transpose() * alpha + now_.acceleration[j] * z + now_.velocity[j] * turned.cross(z);
    const Eigen::Vector3d at_axis = force_[before] + alpha.cross(c) + w.cross(w.cross(c));
    force_[after] = turn_[before].transpose() * at_axis - angular_acceleration_[after].cross(c) -
                    rate_[after].cross(rate_[after].cross(c));
  }
}

void ArmPredictor::turn_back() {
  const auto tip = static_cast<std::size_t>(joints_);
  to_sensor_[tip].setIdentity();
  for (std::size_t k = tip; k-- > 0;) {
    to_sensor_[k] = turn_[k] * to_sensor_[k + 1];  // a joint that slides turns nothing
  }
}

void ArmPredictor::backward() {
  turn_back();
  const auto tip = static_cast<std::size_t>(joints_);
  place_[tip].setZero();
  place_rate_[tip].setZero();
  for (std::size_t k = tip + 1; k-- > 0;) {
    if (k < tip) {
      const auto j = static_cast<Index>(k);
      const ScrewAxis& axis = state_.axes[k];
      const Eigen::Vector3d& z = axis.line.direction;
      if (axis.type == JointType::prismatic) {
        place_[k] = place_[k + 1] + (now_.position[j] - state_.reference[j]) * z;
        place_rate_[k] = place_rate_[k + 1] + now_.velocity[j] * z;
      } else {
        const Eigen::Vector3d arm = turn_[k] * (place_[k + 1] - axis.line.point);
        place_[k] = axis.line.point + arm;
        place_rate_[k] = now_.velocity[j] * z.cross(arm) + turn_[k] * place_rate_[k + 1];
      }
    }
    // A_k of the header, as the sensor reads it; products of skew-symmetric matrices written out as outer products.
    const Eigen::Vector3d& w = rate_[k];
    const Eigen::Vector3d& alpha = angular_acceleration_[k];
    const Eigen::Vector3d& p = place_[k];
    const Eigen::Vector3d& p_dot = place_rate_[k];
    const Eigen::Matrix3d w_skew = skew(w);
    force_read_[k] = by_force_ * to_sensor_[k].transpose();
    rate_read_[k] = by_rate_ * to_sensor_[k].transpose();
    Eigen::Matrix3d by_rotation = skew(force_[k]) + w.dot(p) * w_skew - alpha * p.transpose() -
                                  w * (w.cross(p) + 2.0 * p_dot).transpose();
    by_rotation.diagonal().array() += p.dot(alpha) + 2.0 * p_dot.dot(w);
    Eigen::Matrix3d by_shift = skew(alpha) + w * w.transpose();
    by_shift.diagonal().array() -= w.squaredNorm();
    by_twist_[k].leftCols<3>() = force_read_[k] * by_rotation + rate_read_[k] * w_skew;
    by_twist_[k].rightCols<3>() = force_read_[k] * by_shift;
  }
}

Eigen::Vector3d ArmPredictor::sense() const { return read(state_.sensor, force_.back(), rate_.back()); }

Eigen::Vector3d ArmPredictor::reading(const JointInstant& instant) {
  forward(instant);
  return sense();
}

Eigen::Vector3d ArmPredictor::reading(const JointInstant& instant, Eigen::Ref<Eigen::Matrix3Xd> jacobian) {
  jacobian.setZero();
  forward(instant);
  const AccelerometerModel& sensor = state_.sensor;
  const Eigen::Vector3d& w = rate_.back();
  const Eigen::Vector3d centripetal = w.squaredNorm() - w.array().square();
  const Eigen::Vector3d at_channels = force_.back() - sensor.percussion_distance.cwiseProduct(centripetal);
  const Eigen::Matrix3d misalignment = sensor.misalignment_matrix();
  const Eigen::Vector3d u = misalignment * at_channels;
  const Eigen::Vector3d slope = 1.0 + sensor.scale.array() + 2.0 * sensor.second_order.array() * u.array();
  by_force_ = slope.asDiagonal() * misalignment;
  // The centripetal terms' derivative by the sensor's angular velocity.
  by_rate_ = -2.0 * by_force_ * sensor.percussion_distance.asDiagonal() *
             (Eigen::Vector3d::Ones() * w.transpose() - Eigen::Matrix3d(w.asDiagonal()));
  backward();
  find_by_joint();
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const Index column = layout_.lines[i];
    if (column < 0) {
      continue;
    }
    const Eigen::Matrix<double, 3, 4> by_line = (by_twist_[i] - by_twist_[i + 1]) * line_twists_[i];
    const Index count = layout_.line_columns(state_.axes[i]);
    jacobian.middleCols(column, count) = by_line.leftCols(count);
  }
  if (layout_.up_gravity >= 0) {
    jacobian.middleCols<3>(layout_.up_gravity) = by_force_ * to_sensor_[0].transpose();
  }
  if (layout_.bias >= 0) {
    jacobian.middleCols<3>(layout_.bias).setIdentity();
  }
  if (layout_.scale >= 0) {
    jacobian.middleCols<3>(layout_.scale) = u.asDiagonal();
  }
  if (layout_.misalignment >= 0) {
    jacobian(1, layout_.misalignment) = slope.y() * at_channels.x();
    jacobian(2, layout_.misalignment + 1) = slope.z() * at_channels.x();
    jacobian(2, layout_.misalignment + 2) = slope.z() * at_channels.y();
  }
  if (layout_.percussion_distance >= 0) {
    jacobian.middleCols<3>(layout_.percussion_distance) = -by_force_ * centripetal.asDiagonal();
  }
  if (layout_.second_order >= 0) {
    jacobian.middleCols<3>(layout_.second_order) = u.cwiseAbs2().asDiagonal();
  }
  by_clocks_and_encoders(jacobian);
  return sense();
}

// All of them act through the joints' own motion.
void ArmPredictor::by_clocks_and_encoders(Eigen::Ref<Eigen::Matrix3Xd> jacobian) const {
  for (Index j = 0; j < joints_; ++j) {
    const Index gain = layout_.encoder_gain[static_cast<std::size_t>(j)];
    const Index eccentricity = layout_.eccentricity[static_cast<std::size_t>(j)];
    if (layout_.clock_offset < 0 && gain < 0 && eccentricity < 0) {
      continue;
    }
    const double q = stamped_.position[j];
    const double q_dot = stamped_.velocity[j];
    const double q_ddot = stamped_.acceleration[j];
    const auto column = [&](double position, double velocity, double acceleration) -> Eigen::Vector3d {
      return by_joint_.position.col(j) * position + by_joint_.velocity.col(j) * velocity + by_joint_.acceleration.col(j) * acceleration;
    };
    const double by_cosine = state_.eccentricity(0, j);
    const double by_sine = state_.eccentricity(1, j);
    const bool eccentric = eccentricity >= 0 || by_cosine != 0.0 || by_sine != 0.0;
    const double sine = eccentric ? std::sin(q) : 0.0;
    const double cosine = eccentric ? std::cos(q) : 0.0;
    if (layout_.clock_offset >= 0) {
      const double slope = 1.0 + state_.encoder_gain[j] - by_cosine * sine + by_sine * cosine;
      const double curvature = -by_cosine * cosine - by_sine * sine;
      const double third = 1.0 + state_.encoder_gain[j] - slope;
      const double jerk = stamped_.jerk[j];
      jacobian.col(layout_.clock_offset) -= column(slope * q_dot, slope * q_ddot + curvature * q_dot * q_dot,
                                                   slope * jerk + 3.0 * curvature * q_dot * q_ddot + third * q_dot * q_dot * q_dot);
    }
    if (gain >= 0) {
      jacobian.col(gain) = column(q - state_.reference[j], q_dot, q_ddot);
    }
    if (eccentricity >= 0) {
      jacobian.col(eccentricity) =
          column(cosine - std::cos(state_.reference[j]), -sine * q_dot, -sine * q_ddot - cosine * q_dot * q_dot);
      jacobian.col(eccentricity + 1) =
          column(sine - std::sin(state_.reference[j]), cosine * q_dot, cosine * q_ddot - sine * q_dot * q_dot);
    }
  }
  if (layout_.clock_rate >= 0) {
    jacobian.col(layout_.clock_rate) = now_.time_from_middle * jacobian.col(layout_.clock_offset);
  }
}

Eigen::Vector3d ArmPredictor::angular_rate(const JointInstant& instant) {
  if (state_.gyroscope_delay != 0.0) {
    forward(instant, state_.gyroscope_delay);
  }
  return state_.gyroscope_matrix * rate_.back() + state_.gyroscope_bias;
}

Eigen::Vector3d ArmPredictor::angular_rate(const JointInstant& instant, Eigen::Ref<Eigen::Matrix3Xd> jacobian) {
  jacobian.setZero();
  const Eigen::Vector3d reading = angular_rate(instant);
  if (state_.gyroscope_delay != 0.0) {
    turn_back();
  }
  for (std::size_t k = 0; k < rate_.size(); ++k) {
    rate_by_rotation_[k] = to_sensor_[k].transpose() * skew(rate_[k]);
  }
  const Eigen::Vector3d& w = rate_.back();
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    if (layout_.lines[i] >= 0) {
      jacobian.middleCols<2>(layout_.lines[i]) = state_.gyroscope_matrix *
                                                 (rate_by_rotation_[i] - rate_by_rotation_[i + 1]) *
                                                 line_twists_[i].topLeftCorner<3, 2>();
    }
  }
  // The sensor's angular acceleration, seen from the sensor itself.
  const Eigen::Vector3d by_delay = -state_.gyroscope_matrix * angular_acceleration_.back();
  if (layout_.clock_offset >= 0) {
    jacobian.col(layout_.clock_offset) = by_delay;
  }
  if (layout_.clock_rate >= 0) {
    jacobian.col(layout_.clock_rate) = now_.time_from_middle * by_delay;
  }
  if (layout_.gyroscope_delay >= 0) {
    jacobian.col(layout_.gyroscope_delay) = by_delay;
  }
  for (Index j = 0; j < joints_; ++j) {
    const auto k = static_cast<std::size_t>(j) + 1;
    const Index gain = layout_.encoder_gain[k - 1];
    const Index eccentricity = layout_.eccentricity[k - 1];
    const Eigen::Vector3d turn = twists_[k - 1].head<3>();
    const Eigen::Vector3d by_position = state_.gyroscope_matrix * rate_by_rotation_[k] * turn;
    const Eigen::Vector3d by_velocity = state_.gyroscope_matrix * to_sensor_[k].transpose() * turn;
    rate_by_joint_.position.col(j) = by_position;
    rate_by_joint_.velocity.col(j) = by_velocity;
    const double q = stamped_.position[j];
    const double q_dot = stamped_.velocity[j];
    if (gain >= 0) {
      jacobian.col(gain) = by_position * (q - state_.reference[j]) + by_velocity * q_dot;
    }
    if (eccentricity >= 0) {
      jacobian.col(eccentricity) =
          by_position * (std::cos(q) - std::cos(state_.reference[j])) - by_velocity * std::sin(q) * q_dot;
      jacobian.col(eccentricity + 1) =
          by_position * (std::sin(q) - std::sin(state_.reference[j])) + by_velocity * std::cos(q) * q_dot;
    }
  }
  if (layout_.gyroscope_bias >= 0) {
    jacobian.middleCols<3>(layout_.gyroscope_bias).setIdentity();
  }
  if (layout_.gyroscope_matrix >= 0) {
    for (int k = 0; k < 9; ++k) {
      jacobian(k / 3, layout_.gyroscope_matrix + k) = w[k % 3];
    }
  }
  return reading;
}

// Everything beyond the joint is displaced by eta = twist q: the point p of the sensor by u = v + z x p, whose own motion in the
// displaced link adds u'' + 2 w x u' with u' = v' + z' x p + z x p'.
void ArmPredictor::find_by_joint() {
  for (Index j = 0; j < joints_; ++j) {
    const auto k = static_cast<std::size_t>(j) + 1;
    const Eigen::Matrix<double, 6, 1>& twist = twists_[k - 1];
    const Eigen::Vector3d turn = twist.head<3>();
    const Eigen::Vector3d shift = twist.tail<3>() + turn.cross(place_[k]);
    by_joint_.position.col(j) = by_twist_[k] * twist;
    by_joint_.velocity.col(j) =
        force_read_[k] * (2.0 * (rate_[k].cross(shift) + turn.cross(place_rate_[k]))) + rate_read_[k] * turn;
    by_joint_.acceleration.col(j) = force_read_[k] * shift;
  }
}

}  // namespace circlepoint
