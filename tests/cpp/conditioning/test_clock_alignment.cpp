#include "circlepoint/conditioning/clock_alignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Joint j turns alone, to and fro, during [start, start + 6) s; a rigid body's specific force.
struct Swing {
  Index joint;
  double start;
};

struct Motion {
  double angle = 0.0, speed = 0.0, acceleration = 0.0;
};

Motion swing(double t) {
  constexpr double length = 6.0, amplitude = 0.4, fast = 2.0 * std::numbers::pi * 0.5;
  if (t <= 0.0 || t >= length) {
    return {};
  }
  // amplitude (1 - cos(fast t))^2: angle, speed and acceleration vanish at both ends.
  const double raised = 1.0 - std::cos(fast * t), sine = std::sin(fast * t), cosine = std::cos(fast * t);
  return {amplitude * raised * raised, 2.0 * amplitude * fast * raised * sine,
          2.0 * amplitude * fast * fast * (sine * sine + raised * cosine)};
}

struct Arm {
  std::vector<Swing> swings;

  SamplesX positions(const Eigen::VectorXd& time) const {
    SamplesX q = SamplesX::Zero(time.size(), 3);
    for (const Swing& s : swings) {
      for (Index i = 0; i < time.size(); ++i) {
        q(i, s.joint) += swing(time(i) - s.start).angle;
      }
    }
    return q;
  }

  Samples3 specific_force(const Eigen::VectorXd& time, double noise, unsigned seed) const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    Samples3 f(time.size(), 3);
    for (Index i = 0; i < time.size(); ++i) {
      Eigen::RowVector3d value(3.0, -2.0, 8.0);
      for (const Swing& s : swings) {
        const Motion m = swing(time(i) - s.start);
        const double turn = static_cast<double>(s.joint);
        value += (std::cos(m.angle) - 1.0) * Eigen::RowVector3d(1.0 + turn, -2.0, 3.0) +
                 std::sin(m.angle) * Eigen::RowVector3d(2.0, 3.0 - turn, 1.0) +
                 m.acceleration * Eigen::RowVector3d(0.1, 0.3, -0.2) +
                 m.speed * m.speed * Eigen::RowVector3d(-0.3, 0.1, 0.2);
      }
      f.row(i) = value + Eigen::RowVector3d(normal(random), normal(random), normal(random));
    }
    return f;
  }
};

struct TwoLogs {
  Eigen::VectorXd joint_time, sensor_time;
  SamplesX positions;
  Samples3 force;
};

TwoLogs record(const Arm& arm, double duration, const ClockModel& clock, double noise, unsigned seed) {
  TwoLogs logs;
  logs.joint_time = Eigen::VectorXd::LinSpaced(static_cast<Index>(duration * 125.0) + 1, 0.0, duration);
  const auto samples = static_cast<Index>((duration - 1.0) * 230.0);
  logs.sensor_time.resize(samples);
  for (Index i = 0; i < samples; ++i) {
    logs.sensor_time(i) = clock.offset + 0.4 + static_cast<double>(i) / 230.0;
  }
  logs.positions = arm.positions(logs.joint_time);
  logs.force = arm.specific_force((logs.sensor_time.array() - clock.offset) / clock.rate, noise, seed);
  return logs;
}

ClockAlignment align(const TwoLogs& logs) {
  return align_clocks(logs.joint_time, logs.positions, logs.sensor_time, logs.force);
}

const Arm four_swings{{{0, 3.0}, {2, 14.0}, {1, 25.0}, {0, 41.0}}};

TEST(ClockAlignment, RecoversOffsetAndRateWithinItsOwnStandardDeviations) {
  int outside = 0;
  constexpr int trials = 12;
  for (unsigned seed = 0; seed < trials; ++seed) {
    const ClockModel clock{0.05 * static_cast<double>(seed) - 0.2, 1.0 + 0.0015 * (static_cast<double>(seed) - 6.0)};
    const ClockAlignment found = align(record(four_swings, 50.0, clock, 0.05, seed));
    EXPECT_TRUE(found.single_joint);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.rate_determined);
    EXPECT_EQ(found.tests.size(), 4U);
    for (const DelayTest& test : found.tests) {
      EXPECT_LT(test.model_residual, 0.02);
      EXPECT_LT(test.std, 2e-3);
    }
    EXPECT_LT(found.offset_std, 1e-3);
    EXPECT_LT(found.rate_std, 5e-5);
    EXPECT_LT(std::abs(found.offset - clock.offset), 4.0 * found.offset_std);
    EXPECT_LT(std::abs(found.rate - clock.rate), 4.0 * found.rate_std);
    outside += std::abs(found.rate - clock.rate) > 2.0 * found.rate_std ? 1 : 0;
  }
  EXPECT_LE(outside, trials / 4);
}

TEST(ClockAlignment, EpochsDoNotMatter) {
  const ClockAlignment near = align(record(four_swings, 50.0, {0.3, 1.002}, 0.02, 1));
  TwoLogs logs = record(four_swings, 50.0, {0.3, 1.002}, 0.02, 1);
  logs.sensor_time.array() += 1.7e9;
  const ClockAlignment far = align(logs);
  EXPECT_NEAR(far.offset - 1.7e9, near.offset, 2e-5);
  EXPECT_NEAR(far.rate, near.rate, 1e-6);
}

TEST(ClockAlignment, ItsReferenceTimeIsWhereItIsBestKnown) {
  const ClockAlignment found = align(record(four_swings, 50.0, {0.3, 1.002}, 0.05, 2));
  const auto variance = [&](double t) {
    const Eigen::Vector2d gradient(1.0, t);
    return gradient.dot(found.covariance * gradient);
  };
  EXPECT_NEAR(std::sqrt(variance(found.reference_time)), found.reference_std, 1e-9);
  EXPECT_GT(variance(found.reference_time - 1.0), variance(found.reference_time));
  EXPECT_GT(variance(found.reference_time + 1.0), variance(found.reference_time));
}

TEST(ClockAlignment, OneShortMotionLeavesTheRateToTheRangeSearched) {
  const ClockAlignment found = align(record(Arm{{{1, 20.0}}}, 40.0, {0.3, 1.004}, 0.02, 3));
  EXPECT_FALSE(found.rate_determined);
  EXPECT_NEAR(found.rate_std, 0.01, 1e-3);
  EXPECT_LT(found.reference_std, 5e-3);
  EXPECT_NEAR(found.offset + found.rate * found.reference_time, 0.3 + 1.004 * found.reference_time, 3.0
      * found.reference_std);
  EXPECT_THAT(found.notes, testing::Contains(HasSubstr("at its end")));
}

TEST(ClockAlignment, WithoutMotionItSaysWhatToRecord) {
  const TwoLogs logs = record(Arm{{}}, 40.0, {0.3, 1.0}, 0.02, 4);
  EXPECT_THAT([&] { align(logs); }, ThrowsMessage<NotIdentifiable>(HasSubstr("one joint alone")));
}

TEST(ClockAlignment, ASensorThatSawSomethingElseIsNotAligned) {
  TwoLogs logs = record(four_swings, 50.0, {0.3, 1.0}, 0.02, 5);
  logs.force = record(Arm{{}}, 50.0, {0.3, 1.0}, 0.5, 6).force;
  EXPECT_THROW(align(logs), NotIdentifiable);
}

TEST(ClockAlignment, RefusesSizesThatDiffer) {
  const TwoLogs logs = record(four_swings, 50.0, {0.3, 1.0}, 0.02, 7);
  EXPECT_THROW(align_clocks(logs.joint_time.head(10), logs.positions, logs.sensor_time, logs.force), InvalidInput);
  EXPECT_THROW(align_clocks(logs.joint_time, logs.positions, logs.sensor_time.head(10), logs.force), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
