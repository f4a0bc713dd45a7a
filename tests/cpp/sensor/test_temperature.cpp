#include <gtest/gtest.h>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"
#include "circlepoint/sensor/calibrated_accelerometer.hpp"
#include "circlepoint/sensor/temperature_model.hpp"

namespace circlepoint {
namespace {

AccelerometerSpecification poor() {
  AccelerometerSpecification kind{.bias_std = 0.005, .scale_std = 2e-4, .misalignment_std = 1e-3,
                                  .percussion_distance = 0.018, .second_order_std = 5e-6};
  kind.uncorrected = {.bias_std = 0.03, .scale_std = 0.03, .bias_temperature_std = {2e-4, 1e-6, 1e-8},
                      .scale_temperature_std = {7e-5, 1e-7, 1e-9}, .reference_temperature = 20.0};
  return kind;
}

Samples3 random_samples(RandomSource& random, Index rows, double std) {
  Samples3 values(rows, 3);
  for (double& value : values.reshaped()) {
    value = std * random.normal();
  }
  return values;
}

TEST(TemperatureModel, IsTheCubicOfTheHeader) {
  TemperatureModel model{.reference = 20.0};
  model.bias.row(1) << 1.0, 0.1, 0.01;
  EXPECT_EQ(model.bias_change(20.0).norm(), 0.0);
  EXPECT_NEAR(model.bias_change(22.0)[1], 2.0 + 0.4 + 0.08, 1e-14);
  EXPECT_NEAR(model.bias_change(18.0)[1], -2.0 + 0.4 - 0.08, 1e-14);
  EXPECT_EQ(model.scale_change(30.0).norm(), 0.0);
}

TEST(TemperatureModel, CorrectInvertsMeasureAtEveryTemperature) {
  RandomSource random(2);
  const AccelerometerModel model = draw_calibrated_accelerometer(poor(), 4).actual;
  const Samples3 force = random_samples(random, 200, 20.0);
  const Samples3 rate = random_samples(random, 200, 3.0);
  const Eigen::VectorXd temperature = Eigen::VectorXd::LinSpaced(200, -40.0, 90.0);
  const Samples3 reading = measure(model, force, rate, temperature);
  EXPECT_GT((reading - measure(model, force, rate)).cwiseAbs().maxCoeff(), 1e-2);
  EXPECT_LT((correct(model, reading, rate, temperature) - force).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(TemperatureModel, TemperaturesOfAnotherNumberOrNotFiniteAreRefused) {
  const Samples3 zero = Samples3::Zero(4, 3);
  EXPECT_THROW(measure({}, zero, zero, Eigen::VectorXd::Zero(3)), InvalidInput);
  EXPECT_THROW(correct({}, zero, zero, Eigen::Vector4d(0.0, 0.0, std::nan(""), 0.0)), InvalidInput);
}

TEST(CalibratedAccelerometer, WhatTheSheetLeavesIsTheResidualSensor) {
  RandomSource random(3);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CalibratedAccelerometer sensor = draw_calibrated_accelerometer(poor(), seed);
    const Samples3 force = random_samples(random, 100, 15.0);
    const Samples3 rate = random_samples(random, 100, 3.0);
    const Samples3 still = Samples3::Zero(100, 3);
    const Samples3 residual = measure(sensor.residual, force, rate);
    const Eigen::VectorXd reference = Eigen::VectorXd::Constant(100, 20.0);
    const Samples3 corrected = correct(sensor.sheet, measure(sensor.actual, force, rate, reference), still, reference);
    EXPECT_LT((corrected - residual).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::VectorXd warm = Eigen::VectorXd::Constant(100, 60.0);
    const Samples3 raw = measure(sensor.actual, force, rate, warm);
    EXPECT_LT((correct(sensor.sheet, raw, still, warm) - residual).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_GT((raw - residual).cwiseAbs().maxCoeff(), 1e-2);
  }
}

TEST(CalibratedAccelerometer, TheResidualIsWhatDrawAccelerometerDraws) {
  const CalibratedAccelerometer sensor = draw_calibrated_accelerometer(poor(), 9);
  const AccelerometerModel drawn = draw_accelerometer(poor(), 9);
  EXPECT_EQ(sensor.residual.bias, drawn.bias);
  EXPECT_EQ(sensor.residual.second_order, drawn.second_order);
}

TEST(Accelerometer, CurrentIsProportionalToTheReading) {
  const Samples3 reading = Samples3::Constant(2, 3, 9.80665);
  EXPECT_NEAR(output_current(reading, 1.3e-4)(0, 0), 1.2748645e-3, 1e-12);
  EXPECT_LT((reading_from_current(output_current(reading, 1.3e-4), 1.3e-4) - reading).norm(), 1e-14);
  EXPECT_THROW(output_current(reading, 0.0), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
