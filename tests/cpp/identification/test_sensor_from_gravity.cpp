#include "circlepoint/identification/sensor_from_gravity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "circlepoint/core/error.hpp"
#include "support/joint_motion.hpp"
#include "support/matchers.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::Random;
using Vector12 = Eigen::Matrix<double, 12, 1>;

const AccelerometerSpecification poor{.bias_std = 0.03, .scale_std = 1e-3, .misalignment_std = 1e-3, .second_order_std = 1e-5, .noise_std = 0.02};

Samples3 dwells(const AccelerometerModel& sensor, Index count, double noise, Random& random) {
  Samples3 readings(count, 3);
  for (Index i = 0; i < count; ++i) {
    readings.row(i) = sensor.measure(standard_gravity * random.unit(), Eigen::Vector3d::Zero());
  }
  support::add_noise(readings, noise, random);
  return readings;
}

Vector12 errors_of(const AccelerometerModel& sensor) {
  Vector12 errors;
  errors << sensor.bias, sensor.scale, sensor.misalignment, sensor.second_order;
  return errors;
}

TEST(SensorFromGravity, ManyAttitudesShowTheStaticErrors) {
  Random random(1);
  constexpr int trials = 20;
  double nees = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    AccelerometerModel sensor;
    sensor.bias = 0.03 * random.vector();
    sensor.scale = 1e-3 * random.vector();
    sensor.misalignment = 1e-3 * random.vector();
    sensor.second_order = 1e-5 * random.vector();
    const SensorFromGravity found = fit_sensor_from_gravity(dwells(sensor, 200, 2e-3, random), poor, standard_gravity, false, 0.0);
    const Vector12 error = errors_of(found.sensor) - errors_of(sensor);
    EXPECT_LT(error.head<3>().cwiseAbs().maxCoeff(), 2e-3);
    EXPECT_LT(error.segment<6>(3).cwiseAbs().maxCoeff(), 3e-4);
    EXPECT_NEAR(found.noise_std, 2e-3, 6e-4);
    nees += error.dot(found.covariance.ldlt().solve(error)) / (12.0 * trials);
  }
  // 240 squares of unit normals: mean 1 +- 0.09.
  EXPECT_NEAR(nees, 1.0, 0.4);
}

TEST(SensorFromGravity, WithoutDwellsThePriorIsTheAnswer) {
  const SensorFromGravity found = fit_sensor_from_gravity(Samples3(0, 3), poor, standard_gravity, true, 0.0);
  Vector12 variance;
  variance << Eigen::Vector3d::Constant(9e-4), Eigen::Matrix<double, 6, 1>::Constant(1e-6), Eigen::Vector3d::Constant(1e-10);
  EXPECT_THAT(found.covariance, EntriesNear(SensorErrorMatrix(variance.asDiagonal()), 1e-18));
  EXPECT_EQ(errors_of(found.sensor), Vector12::Zero());
}

TEST(SensorFromGravity, WhatTheAttitudesDoNotReachStaysAsWideAsThePrior) {
  Random random(2);
  Samples3 upright(40, 3);
  upright.rowwise() = Eigen::RowVector3d(0.0, 0.0, standard_gravity + 0.02);
  support::add_noise(upright, 1e-4, random);
  const SensorFromGravity found = fit_sensor_from_gravity(upright, poor, standard_gravity, false, 0.0);
  EXPECT_NEAR(std::sqrt(found.covariance(0, 0)), poor.bias_std, 1e-4);
  EXPECT_NEAR(std::sqrt(found.covariance(6, 6)), poor.misalignment_std, 1e-6);
  EXPECT_LT(std::sqrt(found.covariance(2, 2)), 0.5 * poor.bias_std);
  EXPECT_NEAR(found.sensor.bias.z() + found.sensor.scale.z() * standard_gravity, 0.02, 1e-3);
}

TEST(SensorFromGravity, TheDwellsOfAGoodSensorNarrowAWidePrior) {
  Random random(3);
  const AccelerometerSpecification unspecified{.bias_std = 0.05, .scale_std = 5e-3, .misalignment_std = 3e-3, .noise_std = 0.02};
  AccelerometerModel good;
  good.bias = Eigen::Vector3d(3e-4, -2e-4, 1e-4);
  const Samples3 readings = dwells(good, 12, 3e-4, random);
  const SensorFromGravity fixed = fit_sensor_from_gravity(readings, unspecified, standard_gravity, false, 3e-4);
  const SensorFromGravity adapted = fit_sensor_from_gravity(readings, unspecified, standard_gravity, true, 3e-4);
  EXPECT_EQ(fixed.prior_factor, 1.0);
  EXPECT_LT(adapted.prior_factor, 0.1);
  EXPECT_LT(adapted.covariance.trace(), 0.3 * fixed.covariance.trace());
  EXPECT_LT((adapted.sensor.bias - good.bias).norm(), 2e-3);

  AccelerometerModel bad;
  bad.bias = Eigen::Vector3d(0.06, -0.04, 0.05);
  bad.scale = Eigen::Vector3d(4e-3, -6e-3, 5e-3);
  const SensorFromGravity kept =
      fit_sensor_from_gravity(dwells(bad, 40, 3e-4, random), unspecified, standard_gravity, true, 0.0);
  EXPECT_GT(kept.prior_factor, 0.4);
}

TEST(SensorFromGravity, FewDwellsDoNotTalkTheNoiseDown) {
  Random random(4);
  for (const Index count : {3, 6, 9, 12}) {
    double nees = 0.0;
    constexpr int trials = 20;
    for (int trial = 0; trial < trials; ++trial) {
      AccelerometerModel sensor;
      sensor.bias = 0.03 * random.vector();
      const Samples3 readings = dwells(sensor, count, 1e-3, random);
      const SensorFromGravity found = fit_sensor_from_gravity(readings, poor, standard_gravity, false, 1e-3);
      EXPECT_GE(found.noise_std, 1e-3);
      const Eigen::Vector3d error = found.sensor.bias - sensor.bias;
      nees += error.dot(Eigen::Matrix3d(found.covariance.topLeftCorner<3, 3>()).ldlt().solve(error)) / (3.0 * trials);
    }
    EXPECT_LT(nees, 1.8) << count << " dwells";
  }
}

TEST(SensorFromGravity, DwellsWithoutAReadingAndGravityWithoutMagnitudeAreRefused) {
  Samples3 readings = Samples3::Constant(3, 3, 5.0);
  EXPECT_THROW(fit_sensor_from_gravity(readings, poor, 0.0, false, 0.0), InvalidInput);
  readings.row(1).setZero();
  EXPECT_THROW(fit_sensor_from_gravity(readings, poor, standard_gravity, false, 0.0), InvalidInput);
  readings(1, 0) = std::nan("");
  EXPECT_THROW(fit_sensor_from_gravity(readings, poor, standard_gravity, false, 0.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
