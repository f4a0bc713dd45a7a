#include "arm_load.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace circlepoint {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using LoadRow = Eigen::Matrix<double, 1, load_parameters>;

// Momentum of a unit twist (angular, linear), for a unit of one inertial parameter.
Matrix6d unit_inertia(Index parameter) {
  Matrix6d inertia = Matrix6d::Zero();
  if (parameter == 0) {
    inertia.bottomRightCorner<3, 3>().setIdentity();
  } else if (parameter < 4) {
    const Eigen::Matrix3d moment = skew(Eigen::Vector3d::Unit(parameter - 1));
    inertia.topRightCorner<3, 3>() = moment;
    inertia.bottomLeftCorner<3, 3>() = -moment;
  } else {
    constexpr std::array<std::array<Index, 2>, 6> at = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    const auto [row, column] = at[static_cast<std::size_t>(parameter - 4)];
    inertia(row, column) = 1.0;
    inertia(column, row) = 1.0;
  }
  return inertia;
}

Matrix6d adjoint(const RigidTransform& transform) {
  Matrix6d matrix = Matrix6d::Zero();
  matrix.topLeftCorner<3, 3>() = transform.linear();
  matrix.bottomRightCorner<3, 3>() = transform.linear();
  matrix.bottomLeftCorner<3, 3>() = skew(transform.translation()) * transform.linear();
  return matrix;
}

// d/dt of what moves with the twist.
Matrix6d twist_bracket(const Vector6d& twist) {
  Matrix6d matrix = Matrix6d::Zero();
  matrix.topLeftCorner<3, 3>() = skew(twist.head<3>());
  matrix.bottomRightCorner<3, 3>() = matrix.topLeftCorner<3, 3>();
  matrix.bottomLeftCorner<3, 3>() = skew(twist.tail<3>());
  return matrix;
}

// Torques by gravity, by a unit of angular acceleration, and by a unit of squared angular velocity.
struct Torques {
  LoadRow gravity;
  LoadRow acceleration;
  LoadRow velocity;
};

Torques torques(const ArmAtHome& arm, Index moving, Index resting, double turn) {
  const ScrewAxis& axis = arm.axes[static_cast<std::size_t>(moving)];
  const Vector6d twist = axis.twist();
  const Matrix6d here = adjoint(screw_exp(axis, turn));
  const Matrix6d back = adjoint(screw_exp(axis, -turn));
  const Vector6d borne = arm.axes[static_cast<std::size_t>(resting)].twist();
  const Vector6d bearing = resting > moving ? Vector6d(here * borne) : borne;
  Vector6d lifted = Vector6d::Zero();
  lifted.tail<3>() = arm.up_gravity;
  const Matrix6d bracket = twist_bracket(twist);
  Torques result;
  for (Index k = 0; k < load_parameters; ++k) {
    const Matrix6d inertia = back.transpose() * unit_inertia(k) * back;
    const Vector6d momentum = inertia * twist;
    result.gravity[k] = bearing.dot(inertia * lifted);
    result.acceleration[k] = bearing.dot(momentum);
    result.velocity[k] = -bearing.dot(bracket.transpose() * momentum);
  }
  return result;
}

}  // namespace

ArmAtHome at_home(const KnownArm& arm, const Eigen::VectorXd& home) {
  ArmAtHome result;
  result.axes = rebase(arm.chain, home).axes;
  for (std::size_t i = 0; i < result.axes.size(); ++i) {
    result.known.push_back(arm.known[i] && result.axes[i].type == JointType::revolute);
  }
  result.position = home;
  result.up_gravity = forward_kinematics(arm.chain, home).linear().transpose() * arm.up_gravity;
  return result;
}

Eigen::MatrixXd load_coefficients(const ArmAtHome& arm, Index moving, Index resting) {
  // Each is a + b cos + c sin of the moving joint's position: three places tell them.
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(load_functions, load_parameters);
  for (int place = 0; place < 3; ++place) {
    const double position = 2.0 * std::numbers::pi / 3.0 * place;
    const Torques here = torques(arm, moving, resting, position - arm.position[moving]);
    const double cosine = 2.0 / 3.0 * std::cos(position);
    const double sine = 2.0 / 3.0 * std::sin(position);
    coefficients.row(0) += cosine * here.gravity;
    coefficients.row(1) += sine * here.gravity;
    coefficients.row(2) += here.acceleration / 3.0;
    coefficients.row(3) += cosine * here.acceleration;
    coefficients.row(4) += sine * here.acceleration;
    coefficients.row(5) += here.velocity / 3.0;
    coefficients.row(6) += cosine * here.velocity;
    coefficients.row(7) += sine * here.velocity;
  }
  return coefficients;
}

}  // namespace circlepoint
