#pragma once
// What a sensor on an arm reads, as a function of everything that is unknown, with its derivatives.
//
// The chain is a product of exponentials of lines given in the sensor frame at the reference configuration; the links' frames
// all coincide there, so home is the identity. A forward pass carries angular velocity, angular acceleration and specific force
// from the base (which "accelerates" by up-gravity) to the sensor; a backward pass carries the sensor's motion as seen from
// every link. Displacing everything beyond link k by a small twist eta changes the sensor's specific force by A_k eta, with
// A_k in closed form of the two; a line displaced by eta is eta before its joint and -eta after it, so its derivative is
// (A_before - A_after) eta: exact, and linear in the number of joints.

#include <Eigen/Core>
#include <vector>

#include "arm_state.hpp"

namespace circlepoint {

// Joints at one instant.
struct JointInstant {
  double time_from_middle = 0.0;  // s, for the clock's rate
  Eigen::VectorXd position;       // (n)
  Eigen::VectorXd velocity;       // (n)
  Eigen::VectorXd acceleration;   // (n)
  Eigen::VectorXd jerk;           // (n)
  Eigen::VectorXd snap;           // (n)
};

// d reading / d q, d q' and d q'' of the joints, encoders' errors undone: (3, n) each.
struct ByJoint {
  Eigen::Matrix3Xd position;
  Eigen::Matrix3Xd velocity;
  Eigen::Matrix3Xd acceleration;
};

// Evaluates one instant at a time; keeps its workspace.
class ArmPredictor {
 public:
  ArmPredictor(const ArmState& state, const ArmLayout& layout);

  // Accelerometer reading, m/s^2.
  Eigen::Vector3d reading(const JointInstant& instant);
  // The same with its derivatives: jacobian (3, columns).
  Eigen::Vector3d reading(const JointInstant& instant, Eigen::Ref<Eigen::Matrix3Xd> jacobian);
  // Gyroscope reading, rad/s, after a call of reading() for the same instant; what by_joint() gives stays as it was.
  Eigen::Vector3d angular_rate(const JointInstant& instant);
  // The same with its derivatives, after such a call with derivatives.
  Eigen::Vector3d angular_rate(const JointInstant& instant, Eigen::Ref<Eigen::Matrix3Xd> jacobian);
  // By the joints' own motion, at the instant evaluated last with derivatives.
  [[nodiscard]] const ByJoint& by_joint() const { return by_joint_; }
  // The angular rate's, after a call for it with derivatives.
  [[nodiscard]] const ByJoint& rate_by_joint() const { return rate_by_joint_; }

 private:
  void forward(const JointInstant& instant, double further_delay = 0.0);
  void turn_back();
  void backward();
  void delay(const JointInstant& instant, double further);
  void correct_encoders();
  [[nodiscard]] Eigen::Vector3d sense() const;
  void find_by_joint();
  void by_clocks_and_encoders(Eigen::Ref<Eigen::Matrix3Xd> jacobian) const;

  ArmState state_;
  const ArmLayout& layout_;
  Index joints_;
  std::vector<Eigen::Matrix3d> turn_;             // R of each joint
  std::vector<Eigen::Vector3d> rate_;             // w of each link, 0..n
  std::vector<Eigen::Vector3d> angular_acceleration_;
  std::vector<Eigen::Vector3d> force_;            // a of each link, 0..n
  std::vector<Eigen::Matrix3d> to_sensor_;        // R_k_sensor
  std::vector<Eigen::Matrix<double, 3, 6>> by_twist_;      // d reading / d eta
  std::vector<Eigen::Matrix3d> rate_by_rotation_;          // d w_sensor / d eta_w
  std::vector<Eigen::Vector3d> place_;            // p of the sensor in each link
  std::vector<Eigen::Vector3d> place_rate_;
  JointInstant stamped_;  // by the encoders, delayed to the sensor's clock
  JointInstant now_;      // and with the encoders' errors undone
  std::vector<Eigen::Matrix<double, 6, 1>> twists_;        // (n) of the joints
  std::vector<Eigen::Matrix<double, 6, 4>> line_twists_;   // (n) of the lines' local coordinates
  std::vector<Eigen::Matrix3d> force_read_;                // d reading / d specific force in link k
  std::vector<Eigen::Matrix3d> rate_read_;                 // d reading / d angular velocity in link k
  ByJoint by_joint_;
  ByJoint rate_by_joint_;
  Eigen::Matrix3d by_force_ = Eigen::Matrix3d::Identity();  // d reading / d specific force at the channels
  Eigen::Matrix3d by_rate_ = Eigen::Matrix3d::Zero();       // d reading / d angular velocity of the sensor
};

}  // namespace circlepoint
