#include "circlepoint/simulation/held_joints.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

// One joint's error e and its rate, advanced exactly over a step in which the acceleration a is linear.
class Oscillator {
 public:
  Oscillator(double omega, double decay, double step) : omega_square_(omega * omega), decay_(decay), step_(step) {
    const double ringing = std::sqrt(omega * omega - decay * decay);
    const double fade = std::exp(-decay * step);
    const double c = fade * std::cos(ringing * step);
    const double s = fade * std::sin(ringing * step) / ringing;
    transition_ << c + decay * s, s, -omega_square_ * s, c - decay * s;
  }

  // e = particular solution (linear in time) + homogeneous part.
  void advance(double from, double to) {
    const double slope = (to - from) / step_;
    const double linear = -slope / omega_square_;
    const double constant = -(from + 2.0 * decay_ * linear) / omega_square_;
    state_ = transition_ * (state_ - Eigen::Vector2d(constant, linear)) +
             Eigen::Vector2d(constant + linear * step_, linear);
  }

  [[nodiscard]] double error() const { return state_[0]; }
  [[nodiscard]] double rate() const { return state_[1]; }
  // With the commanded acceleration it gives the actual one.
  [[nodiscard]] double pull() const { return -2.0 * decay_ * state_[1] - omega_square_ * state_[0]; }

 private:
  double omega_square_, decay_, step_;
  Eigen::Matrix2d transition_;
  Eigen::Vector2d state_ = Eigen::Vector2d::Zero();
};

}  // namespace

JointTrajectory follow(const JointTrajectory& commanded, const HeldJoints& joints) {
  const Eigen::VectorXd& frequency = joints.natural_frequency;
  require(frequency.size() == 0 || frequency.size() == commanded.joints(),
          "natural_frequency has " + std::to_string(frequency.size()) + " entries for " +
              std::to_string(commanded.joints()) + " joints; give one a joint, or none");
  require(std::isfinite(joints.settling_time) && joints.settling_time > 0.0,
          "settling_time is " + std::to_string(joints.settling_time) + " s; give a positive time");
  const double decay = 4.0 / joints.settling_time;
  JointTrajectory actual = commanded;
  for (Index j = 0; j < frequency.size(); ++j) {
    const double omega = 2.0 * std::numbers::pi * frequency[j];
    require(frequency[j] == 0.0 || (std::isfinite(omega) && omega > decay),
            "natural_frequency of joint " + std::to_string(j) + " is " + std::to_string(frequency[j]) +
                " Hz; give 0, or enough to ring: above " + std::to_string(decay / (2.0 * std::numbers::pi)) + " Hz");
    if (frequency[j] == 0.0) {
      continue;
    }
    Oscillator oscillator(omega, decay, 1.0 / commanded.sample_rate);
    for (Index i = 0; i < commanded.samples(); ++i) {
      if (i > 0) {
        oscillator.advance(commanded.acceleration(i - 1, j), commanded.acceleration(i, j));
      }
      actual.position(i, j) += oscillator.error();
      actual.velocity(i, j) += oscillator.rate();
      // q'' + e'' = -2 c e' - w0^2 e: the actual acceleration has no steps, whatever the command's does.
      actual.acceleration(i, j) = oscillator.pull();
    }
  }
  return actual;
}

Eigen::VectorXd joint_compliance(const Eigen::Ref<const Eigen::VectorXd>& stiffness, double mass) {
  require((stiffness.array() > 0.0).all() && stiffness.allFinite(),
          "stiffness holds a value that is not positive; give N m/rad a joint");
  require(std::isfinite(mass) && mass >= 0.0, "mass is " + std::to_string(mass) + " kg; give zero or a positive one");
  return mass * stiffness.cwiseInverse();
}

}  // namespace circlepoint
