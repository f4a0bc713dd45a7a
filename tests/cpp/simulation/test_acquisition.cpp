#include "circlepoint/simulation/acquisition.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"
#include "circlepoint/simulation/simulate.hpp"

namespace circlepoint {
namespace {

const Eigen::Vector3d up(1.0, -2.0, 9.5);

ScrewChain one_joint() {
  ScrewChain chain;
  chain.axes = {{JointType::revolute, make_line({0.0, 1.0, 0.3}, {0.5, 0.2, -0.1})}};
  chain.reference_configuration = Eigen::VectorXd::Zero(1);
  return chain;
}

JointTrajectory swing(double rate) {
  return joint_trajectory(Eigen::VectorXd::Zero(1), {Dwell{0.5}, RaisedCosine{0, 1.0, 0.5, 2.0}}, rate);
}

TEST(Acquisition, WithNothingSwitchedOnEverySecondInstantIsRecordedAsItIs) {
  const Recording all = simulate(one_joint(), up, {}, swing(1000.0));
  const Recording half = simulate(one_joint(), up, {}, swing(1000.0),
                                  {.acquisition = AcquisitionOptions{.oversampling = 2}});
  ASSERT_EQ(half.samples(), (all.samples() - 1) / 2 + 1);
  EXPECT_EQ(half.sample_rate, 500.0);
  EXPECT_EQ(half.specific_force, Samples3(all.specific_force(Eigen::seqN(0, half.samples(), 2), Eigen::all)));
  EXPECT_EQ(half.time[10], all.time[20]);
}

TEST(Acquisition, ReadingsAreMultiplesOfTheConvertersStepWithinItsRange) {
  AcquisitionOptions options{.converter_bits = 10, .converter_range = 40.0, .converter_gain = 5.0};
  const Recording recording = simulate(one_joint(), up, {}, swing(500.0), {.acquisition = options});
  const double step = 16.0 / 1024.0;
  const Samples3 counts = recording.specific_force / step;
  EXPECT_LT((counts.array() - counts.array().round()).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(recording.specific_force.maxCoeff(), 8.0 - step);  // +9.5 is out of range
}

TEST(Acquisition, ChannelsAreReadOneAfterTheOther) {
  AcquisitionOptions options{.oversampling = 4, .channel_skew = 1e-4};
  const Recording skewed = simulate(one_joint(), up, {}, swing(2000.0), {.acquisition = options});
  const Recording fine = simulate(one_joint(), up, {}, swing(10000.0));
  for (Index i = 300; i < 700; ++i) {
    for (Index k = 0; k < 3; ++k) {
      EXPECT_NEAR(skewed.specific_force(i, k), fine.specific_force(20 * i + k, k), 1e-7) << i << " " << k;
    }
  }
}

TEST(Acquisition, EncodersAreHeldSinceTheirLastReading) {
  AcquisitionOptions options{.oversampling = 4, .encoder_rate = 50.0};
  const JointTrajectory motion = swing(2000.0);
  const Recording recording = simulate(one_joint(), up, {}, motion, {.seed = 3, .acquisition = options});
  Index changes = 0;
  double latest = 0.0;
  for (Index i = 300; i < 1200; ++i) {
    changes += recording.joint_positions(i, 0) != recording.joint_positions(i - 1, 0) ? 1 : 0;
    // The reading is a true position of the last 20 ms.
    double closest = 1.0;
    for (Index back = 0; back <= 41; ++back) {
      closest = std::min(closest, std::abs(recording.joint_positions(i, 0) - motion.position(4 * i - back, 0)));
    }
    latest = std::max(latest, closest);
  }
  EXPECT_NEAR(static_cast<double>(changes), 900 / 500.0 * 50.0, 2.0);
  EXPECT_LT(latest, 1e-3);
}

TEST(Acquisition, TheSheetUndoesBiasScaleAndTheWarmingUp) {
  AccelerometerModel sheet{.bias = {0.08, -0.05, 0.02}, .scale = {0.02, -0.01, 0.0}};
  sheet.temperature.bias.col(0).setConstant(1e-3);
  sheet.temperature.scale.col(0).setConstant(1e-4);
  SimulationOptions options{.temperature = TemperatureProfile{.start = 20.0, .rise = 10.0, .time_constant = 1.0},
                            .acquisition = AcquisitionOptions{.oversampling = 2, .sheet = sheet}};
  const Recording ideal = simulate(one_joint(), up, {}, swing(500.0));
  const Recording corrected = simulate(one_joint(), up, sheet, swing(1000.0), options);
  EXPECT_LT((corrected.specific_force - ideal.specific_force).cwiseAbs().maxCoeff(), 1e-12);
  ASSERT_TRUE(corrected.temperature.has_value());
  EXPECT_NEAR((*corrected.temperature)[500], 20.0 + 10.0 * (1.0 - std::exp(-1.0)), 1e-9);
  options.acquisition->sheet.reset();
  const Recording raw = simulate(one_joint(), up, sheet, swing(1000.0), options);
  EXPECT_GT((raw.specific_force - ideal.specific_force).cwiseAbs().maxCoeff(), 0.05);
}

TEST(Acquisition, TheGyroscopeReadsTheRateInTheSensorFrame) {
  const JointTrajectory motion = swing(500.0);
  const Recording recording = simulate(one_joint(), up, {}, motion, {.angular_velocity_noise_std = 0.0});
  ASSERT_TRUE(recording.angular_velocity.has_value());
  const Eigen::RowVector3d axis = one_joint().axes[0].line.direction;
  EXPECT_LT((*recording.angular_velocity - motion.velocity * axis).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_FALSE(simulate(one_joint(), up, {}, motion).angular_velocity.has_value());
}

TEST(Acquisition, SwitchingOneNoiseOnDoesNotChangeAnother) {
  AcquisitionOptions options{.cable_noise_std = 0.01};
  const auto recorded = [&options] {
    return simulate(one_joint(), up, {}, swing(500.0), {.seed = 5, .acquisition = options}).specific_force;
  };
  const Samples3 quiet = recorded();
  options.pickup_amplitude = 0.1;
  const Samples3 hum = recorded();
  options.cable_noise_std = 0.0;
  const Samples3 hum_alone = recorded();
  options.pickup_amplitude = 0.0;
  const Samples3 silent = recorded();
  EXPECT_LT(((hum - hum_alone) - (quiet - silent)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_NEAR((hum_alone - silent).cwiseAbs().maxCoeff(), 0.1, 1e-3);
}

TEST(Acquisition, WhatCannotBeSampledIsRefused) {
  const auto with = [](const AcquisitionOptions& options) {
    return simulate(one_joint(), up, {}, swing(500.0), {.acquisition = options});
  };
  EXPECT_THROW(with({.oversampling = 0}), InvalidInput);
  EXPECT_THROW(with({.signal_cutoff = 250.0}), InvalidInput);
  EXPECT_THROW(with({.channel_skew = 1e-3}), InvalidInput);
  EXPECT_THROW(with({.converter_bits = 99}), InvalidInput);
  EXPECT_THROW(with({.cable_noise_std = -1.0}), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
