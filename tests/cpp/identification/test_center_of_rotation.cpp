#include "circlepoint/identification/center_of_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "circlepoint/core/error.hpp"
#include "support/joint_motion.hpp"
#include "support/matchers.hpp"

namespace circlepoint {
namespace {

using support::OneJoint;
using support::OneJointMotion;
using support::Random;

constexpr double rate = 250.0;

struct Method {
  std::string name;
  std::function<CenterOfRotation(const Eigen::VectorXd&, const Samples3&, const Eigen::Vector3d&, const GravityModel&,
                                 CenterOptions)>
      run;
};

class CenterMethods : public testing::TestWithParam<Method> {};

const Method position{"Position", [](const auto& angle, const auto& f, const auto& z, const auto& gravity, CenterOptions options) {
                        return center_by_position(angle, f, rate, z, gravity, options);
                      }};
const Method velocity{"Velocity", [](const auto& angle, const auto& f, const auto& z, const auto& gravity, CenterOptions options) {
                        return center_by_velocity(angle, f, rate, z, gravity, options);
                      }};
const Method velocity_means{"VelocityByMeans",
                            [](const auto& angle, const auto& f, const auto& z, const auto& gravity, CenterOptions options) {
                              options.least_squares = false;
                              return center_by_velocity(angle, f, rate, z, gravity, options);
                            }};

struct JointRun {
  OneJoint joint;
  OneJointMotion motion;
  Samples3 readings;
  GravityModel gravity;
};

JointRun random_test(Random& random) {
  JointRun test;
  test.joint = support::random_joint(random);
  test.joint.bias = 0.01 * random.vector();
  const double first = random.uniform(-2.0, 2.0);
  const double span = random.chance(0.5) ? 2.6 : -2.6;
  const OneJointMotion sweep = support::still_poses(16, first, span);
  test.gravity = fit_gravity_model(sweep.angle, support::readings(test.joint, sweep));
  test.motion = support::raised_cosine(first, span, 0.5, 3, rate);
  test.readings = support::readings(test.joint, test.motion);
  return test;
}

TEST_P(CenterMethods, ExactReadingsGiveTheLever) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const JointRun test = random_test(random);
    const CenterOfRotation found = GetParam().run(test.motion.angle, test.readings, test.joint.axis, test.gravity, {});
    EXPECT_TRUE(found.converged);
    EXPECT_THAT(found.lever_sensor, support::EntriesNear(test.joint.lever, 2e-4));
    EXPECT_NEAR(found.radius, test.joint.lever.norm(), 2e-4);
    EXPECT_NEAR(found.lever_sensor.dot(test.joint.axis), 0.0, 1e-12);
    EXPECT_NEAR(found.center_joint.norm(), found.radius, 1e-12);
  }
}

TEST_P(CenterMethods, PercussionIsCorrectedWithItsSign) {
  Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    JointRun test = random_test(random);
    test.joint.percussion_distance = 0.0182;
    // An axis along the sensor's z: the correction lies wholly in the plane of the circle.
    const double radius = random.uniform(0.6, 0.9);
    const double azimuth = random.uniform(-3.0, 3.0);
    test.joint.lever = radius * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0);
    test.joint.axis = Eigen::Vector3d::UnitZ();
    test.joint.up_gravity = standard_gravity * Eigen::Vector3d(0.6, 0.64, 0.48);
    const OneJointMotion sweep = support::still_poses(16, -1.0, 3.0);
    test.gravity = fit_gravity_model(sweep.angle, support::readings(test.joint, sweep));
    test.readings = support::readings(test.joint, test.motion);
    const auto error = [&](double distance) {
      const CenterOptions options{.percussion_distance = distance};
      const CenterOfRotation found = GetParam().run(test.motion.angle, test.readings, test.joint.axis, test.gravity, options);
      return (found.lever_sensor - test.joint.lever).norm();
    };
    EXPECT_LT(error(0.0182), 2e-4);
    EXPECT_GT(error(0.0), 10e-3);
    EXPECT_GT(error(-0.0182), 1.5 * error(0.0));
  }
}

TEST_P(CenterMethods, AJointThatHardlyTurnsIsNotIdentifiable) {
  Random random(3);
  const JointRun test = random_test(random);
  const OneJointMotion still = support::still_poses(1000, 0.3, 0.0);
  EXPECT_THROW(GetParam().run(still.angle, support::readings(test.joint, still), test.joint.axis, test.gravity, {}),
               NotIdentifiable);
}

TEST_P(CenterMethods, UnequalLengthsAreRefused) {
  Random random(4);
  const JointRun test = random_test(random);
  EXPECT_THROW(GetParam().run(test.motion.angle.head(100), test.readings, test.joint.axis, test.gravity, {}), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Identification, CenterMethods, testing::Values(position, velocity, velocity_means),
                         [](const auto& instance) { return instance.param.name; });

// The circle's radius is first seen as the error that percussion makes; |v|/r is then far from the joint's rate.
TEST(CenterOfRotation, APercussionCorrectionThatGrowsIsToldInsteadOfItsLever) {
  Random random(6);
  JointRun test = random_test(random);
  test.joint.percussion_distance = 0.0182;
  test.joint.lever = test.joint.lever.normalized() * 0.015;
  const OneJointMotion sweep = support::still_poses(16, -1.0, 3.0);
  test.gravity = fit_gravity_model(sweep.angle, support::readings(test.joint, sweep));
  test.readings = support::readings(test.joint, test.motion);
  const CenterOptions options{.percussion_distance = 0.0182};
  try {
    const auto found = center_by_position(test.motion.angle, test.readings, rate, test.joint.axis, test.gravity, options);
    FAIL() << "lever of " << found.lever_sensor.norm() << " m after " << found.iterations << " iterations";
  } catch (const NotIdentifiable& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("grows from step to step"));
  }
  const auto by_velocity = center_by_velocity(test.motion.angle, test.readings, rate, test.joint.axis, test.gravity, options);
  EXPECT_THAT(by_velocity.lever_sensor, support::EntriesNear(test.joint.lever, 2e-4));
}

TEST(CenterOfRotation, SingleIntegrationToleratesALeftOverBiasBetterThanDouble) {
  Random random(5);
  const JointRun test = random_test(random);
  Samples3 drifted = test.readings;
  drifted.rowwise() += Eigen::RowVector3d(0.005, -0.005, 0.005);
  const CenterOptions whole{.position_window = 0.0};
  const auto by_position = center_by_position(test.motion.angle, drifted, rate, test.joint.axis, test.gravity, whole);
  const auto by_velocity = center_by_velocity(test.motion.angle, drifted, rate, test.joint.axis, test.gravity, whole);
  const double position_error = (by_position.lever_sensor - test.joint.lever).norm();
  const double velocity_error = (by_velocity.lever_sensor - test.joint.lever).norm();
  EXPECT_LT(velocity_error, 0.2 * position_error);
}

}  // namespace
}  // namespace circlepoint
