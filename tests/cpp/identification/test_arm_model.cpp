#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "arm_model.hpp"

namespace circlepoint {
namespace {

// An arm with every kind of parameter away from zero.
struct ArmCase {
  ArmState state;
  ArmLayout layout;
  JointInstant instant;
};

ArmCase random_case(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const auto vector3 = [&](double size) { return Eigen::Vector3d(size * normal(generator), size * normal(generator), size * normal(generator)); };
  const auto vector = [&](Index count, double size) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(count, [&] { return size * normal(generator); }));
  };
  constexpr Index joints = 4;
  ArmCase arm;
  for (Index j = 0; j < joints; ++j) {
    Line line{vector3(1.0).normalized(), vector3(0.4)};
    line.point -= line.direction * line.direction.dot(line.point);
    arm.state.axes.push_back({j == 1 ? JointType::prismatic : JointType::revolute, line});
  }
  arm.state.reference = vector(joints, 0.5);
  arm.state.up_gravity = 9.8 * vector3(1.0).normalized();
  arm.state.sensor.bias = vector3(0.05);
  arm.state.sensor.scale = vector3(0.01);
  arm.state.sensor.misalignment = vector3(0.01);
  arm.state.sensor.percussion_distance = vector3(0.02);
  arm.state.sensor.second_order = vector3(1e-3);
  arm.state.clock_offset = 2e-3;
  arm.state.clock_rate = 1.0001;
  arm.state.encoder_gain = vector(joints, 1e-2);
  arm.state.eccentricity = vector(2 * joints, 1e-2).reshaped(2, joints);
  arm.state.gyroscope_bias = vector3(0.01);
  arm.state.gyroscope_matrix += 0.02 * Eigen::Matrix3d::Random();
  arm.state.gyroscope_delay = seed % 2 == 0 ? 0.0 : 3e-3;
  arm.layout.claim_lines(arm.state.axes, std::vector<bool>(joints, true));
  arm.layout.up_gravity = arm.layout.claim(3);
  arm.layout.bias = arm.layout.claim(3);
  arm.layout.scale = arm.layout.claim(3);
  arm.layout.misalignment = arm.layout.claim(3);
  arm.layout.percussion_distance = arm.layout.claim(3);
  arm.layout.second_order = arm.layout.claim(3);
  arm.layout.clock_offset = arm.layout.claim(1);
  arm.layout.clock_rate = arm.layout.claim(1);
  for (std::size_t j = 0; j < joints; ++j) {
    arm.layout.encoder_gain[j] = arm.layout.claim(1);
    arm.layout.eccentricity[j] = arm.layout.claim(2);
  }
  arm.layout.gyroscope_bias = arm.layout.claim(3);
  arm.layout.gyroscope_matrix = arm.layout.claim(9);
  arm.layout.gyroscope_delay = arm.layout.claim(1);
  arm.instant = {3.0, vector(joints, 1.0), vector(joints, 1.0), vector(joints, 3.0), vector(joints, 10.0), vector(joints, 30.0)};
  return arm;
}

// Central differences of both readings along each of the layout's columns.
Eigen::MatrixXd differences(const ArmCase& arm) {
  constexpr double step = 1e-5;
  Eigen::MatrixXd jacobian(6, arm.layout.columns);
  const auto readings = [&](const Eigen::VectorXd& by) {
    ArmPredictor predictor(moved(arm.state, arm.layout, by), arm.layout);
    Eigen::Matrix<double, 6, 1> both;
    both.head<3>() = predictor.reading(arm.instant);
    both.tail<3>() = predictor.angular_rate(arm.instant);
    return both;
  };
  for (Index k = 0; k < arm.layout.columns; ++k) {
    const Eigen::VectorXd by = step * Eigen::VectorXd::Unit(arm.layout.columns, k);
    jacobian.col(k) = (readings(by) - readings(-by)) / (2.0 * step);
  }
  return jacobian;
}

// Joints that swing to and fro at half a hertz.
JointInstant swinging(double time, Index joints) {
  constexpr double w = 3.14;  // rad/s
  const Eigen::ArrayXd phase = w * time + Eigen::ArrayXd::LinSpaced(joints, 0.0, 2.0);
  const Eigen::ArrayXd c = 1.3 * phase.cos();
  const Eigen::ArrayXd s = 1.3 * phase.sin();
  return {0.0, c, -w * s, -w * w * c, w * w * w * s, w * w * w * w * c};
}

TEST(ArmModel, a_delay_of_milliseconds_is_the_motion_before) {
  ArmCase arm = random_case(1);
  arm.state.clock_rate = 1.0;
  for (const double delay : {1e-3, 4e-3, -4e-3}) {
    arm.state.clock_offset = delay;
    const Eigen::Vector3d delayed = ArmPredictor(arm.state, arm.layout).reading(swinging(0.7, 4));
    arm.state.clock_offset = 0.0;
    const Eigen::Vector3d before = ArmPredictor(arm.state, arm.layout).reading(swinging(0.7 - delay, 4));
    EXPECT_LT((delayed - before).norm(), 2e-5) << delay;
  }
}

TEST(ArmModel, derivatives_in_closed_form_are_those_of_finite_differences) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ArmCase arm = random_case(seed);
    const Eigen::MatrixXd expected = differences(arm);
    ArmPredictor predictor(arm.state, arm.layout);
    Eigen::Matrix3Xd jacobian(3, arm.layout.columns);
    predictor.reading(arm.instant, jacobian);
    Eigen::Matrix3Xd rate(3, arm.layout.columns);
    predictor.angular_rate(arm.instant, rate);
    const std::vector<std::string> names = parameter_names(arm.state, arm.layout);
    for (Index k = 0; k < arm.layout.columns; ++k) {
      const double size = 1.0 + expected.col(k).norm();
      EXPECT_LT((jacobian.col(k) - expected.col(k).head<3>()).norm(), 1e-7 * size) << names[static_cast<std::size_t>(k)];
      EXPECT_LT((rate.col(k) - expected.col(k).tail<3>()).norm(), 1e-7 * size) << "rate by " << names[static_cast<std::size_t>(k)];
    }
  }
}

TEST(ArmModel, derivatives_by_the_joints_motion_are_those_of_finite_differences) {
  constexpr double step = 1e-5;
  for (unsigned seed = 0; seed < 20; ++seed) {
    ArmCase arm = random_case(seed);
    arm.state.encoder_gain.setZero();
    arm.state.eccentricity.setZero();
    arm.state.clock_offset = 0.0;
    arm.state.clock_rate = 1.0;
    ArmPredictor predictor(arm.state, arm.layout);
    Eigen::Matrix3Xd jacobian(3, arm.layout.columns);
    predictor.reading(arm.instant, jacobian);
    const ByJoint by = predictor.by_joint();
    const auto along = [&](Eigen::VectorXd JointInstant::*motion, Index joint) -> Eigen::Vector3d {
      JointInstant above = arm.instant;
      JointInstant below = arm.instant;
      (above.*motion)[joint] += step;
      (below.*motion)[joint] -= step;
      return (predictor.reading(above) - predictor.reading(below)) / (2.0 * step);
    };
    for (Index joint = 0; joint < arm.state.reference.size(); ++joint) {
      EXPECT_LT((by.position.col(joint) - along(&JointInstant::position, joint)).norm(), 1e-6);
      EXPECT_LT((by.velocity.col(joint) - along(&JointInstant::velocity, joint)).norm(), 1e-6);
      EXPECT_LT((by.acceleration.col(joint) - along(&JointInstant::acceleration, joint)).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace circlepoint
