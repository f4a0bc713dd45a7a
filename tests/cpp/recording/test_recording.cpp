#include "circlepoint/recording/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Log {
  Eigen::VectorXd time;
  SamplesX positions;
  SensorSamples sensor;
};

// Smooth signals that are functions of time alone, so that a sample shows when it was taken.
SamplesX positions_at(const Eigen::VectorXd& time) {
  SamplesX q(time.size(), 2);
  q.col(0) = (1.3 * time.array()).sin();
  q.col(1) = 0.5 * (0.7 * time.array()).cos();
  return q;
}

Samples3 force_at(const Eigen::VectorXd& time) {
  Samples3 f(time.size(), 3);
  f.col(0) = (0.9 * time.array()).sin();
  f.col(1) = (2.1 * time.array()).cos();
  f.col(2).setConstant(9.8);
  return f;
}

Log make_log(Index samples, double rate, double start = 0.0) {
  Log log;
  log.time = start + Eigen::ArrayXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / rate);
  log.positions = positions_at(log.time);
  log.sensor.specific_force = force_at(log.time);
  return log;
}

TEST(Recording, ARegularLogIsKeptAsItIs) {
  const Log log = make_log(1000, 250.0);
  const Recording recording = make_recording(log.time, log.positions, log.sensor);
  EXPECT_DOUBLE_EQ(recording.sample_rate, 250.0);
  EXPECT_EQ(recording.joint_positions, log.positions);
  EXPECT_EQ(recording.specific_force, log.sensor.specific_force);
  EXPECT_FALSE(recording.angular_velocity.has_value());
}

TEST(Recording, ANonFiniteValueIsAnErrorThatNamesRowAndColumn) {
  Log log = make_log(100, 100.0);
  log.positions(41, 1) = std::nan("");
  EXPECT_THAT([&] { make_recording(log.time, log.positions, log.sensor); },
              ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("q2"), HasSubstr("row 42"), HasSubstr("nan"))));
  log = make_log(100, 100.0);
  log.sensor.specific_force(7, 2) = INFINITY;
  EXPECT_THAT([&] { make_recording(log.time, log.positions, log.sensor); },
              ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("az"), HasSubstr("row 8"), HasSubstr("inf"))));
}

TEST(Recording, ColumnsOfDifferentLengthAreRefused) {
  Log log = make_log(100, 100.0);
  log.sensor.temperature = Eigen::VectorXd::Zero(99);
  EXPECT_THAT([&] { make_recording(log.time, log.positions, log.sensor); },
              ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("temperature"), HasSubstr("99"), HasSubstr("100"))));
}

TEST(Recording, ALowRateIsAllowedWithANote) {
  const Log log = make_log(100, 20.0);
  const Recording recording = make_recording(log.time, log.positions, log.sensor);
  ASSERT_EQ(recording.timeline.notes.size(), 1U);
  EXPECT_THAT(recording.timeline.notes[0], HasSubstr("20 Hz"));
}

TEST(Recording, TwoClocksMeetOnTheSensorsSamplesInJointTime) {
  const ClockModel clock{1234.5, 1.0021};
  const Log joints = make_log(2000, 125.0);
  Log sensor = make_log(5000, 266.27, 1230.0);
  sensor.sensor.specific_force = force_at((sensor.time.array() - clock.offset) / clock.rate);
  const Recording recording = make_recording(joints.time, joints.positions, sensor.time, sensor.sensor, clock);
  EXPECT_NEAR(recording.sample_rate, 266.27 * clock.rate, 1e-6);
  EXPECT_GE(recording.time(0), joints.time(0));
  EXPECT_LE(recording.time(recording.samples() - 1), joints.time(1999));
  EXPECT_LT((recording.joint_positions - positions_at(recording.time)).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((recording.specific_force - force_at(recording.time)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_TRUE(recording.joint_timeline.has_value());
}

TEST(Recording, TwoLogsThatDoNotOverlapAreRefused) {
  const Log log = make_log(1000, 100.0);
  EXPECT_THAT([&] { make_recording(log.time, log.positions, log.time, log.sensor, ClockModel{500.0, 1.0}); },
              ThrowsMessage<InvalidInput>(HasSubstr("do not overlap")));
}

TEST(StaticRecording, EveryPoseIsASpanOfItsOwn) {
  const Log log = make_log(8, 250.0);
  const Recording poses = make_static_recording(log.positions, log.sensor);
  EXPECT_TRUE(poses.is_static());
  EXPECT_FALSE(make_recording(log.time, log.positions, log.sensor).is_static());
  EXPECT_EQ(poses.spans, (std::vector<IndexRange>{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 8}}));
  EXPECT_EQ(poses.joint_positions, log.positions);
  EXPECT_EQ(poses.specific_force, log.sensor.specific_force);
  EXPECT_DOUBLE_EQ(poses.time(7), 7.0);
}

TEST(StaticRecording, FewPosesAndValuesThatAreNotFiniteAreRefused) {
  Log log = make_log(3, 250.0);
  EXPECT_THAT([&] { make_static_recording(log.positions.topRows(2), log.sensor); }, ThrowsMessage<InvalidInput>(HasSubstr("2 still poses")));
  log.positions(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { make_static_recording(log.positions, log.sensor); }, ThrowsMessage<InvalidInput>(HasSubstr("row 2")));
}

TEST(Concatenate, TablesOfStillPosesAreOneAndNeverBesideALog) {
  const Log log = make_log(10, 250.0);
  const Recording poses = make_static_recording(log.positions, log.sensor);
  const Recording both = concatenate({poses, poses});
  EXPECT_TRUE(both.is_static());
  EXPECT_EQ(both.samples(), 20);
  EXPECT_THAT([&] { concatenate({make_recording(log.time, log.positions, log.sensor), poses}); },
              ThrowsMessage<InvalidInput>(HasSubstr("still poses")));
}

TEST(Concatenate, EachFileStartsASpanAndRestartedClocksMoveOn) {
  const Log log = make_log(1000, 250.0);
  const Recording one = make_recording(log.time, log.positions, log.sensor);
  const Recording joined = concatenate({one, one});
  EXPECT_EQ(joined.spans, (std::vector<IndexRange>{{0, 1000}, {1000, 2000}}));
  EXPECT_NEAR(joined.time(1000), one.time(999) + 1.0, 1e-12);
  EXPECT_EQ(joined.joint_positions.bottomRows(1000), one.joint_positions);
  EXPECT_THAT(joined.timeline.notes, testing::ElementsAre(HasSubstr("moved by")));
  EXPECT_EQ(joined.timeline.samples, 2000);
}

TEST(Concatenate, RatesWithinOnePercentAreBroughtTogether) {
  const Log first = make_log(1000, 250.0);
  const Log second = make_log(1000, 251.0, 10.0);
  const Recording joined = concatenate({make_recording(first.time, first.positions, first.sensor),
                                        make_recording(second.time, second.positions, second.sensor)});
  EXPECT_DOUBLE_EQ(joined.sample_rate, 250.0);
  const IndexRange span = joined.spans[1];
  const Eigen::VectorXd time = joined.time.segment(span.begin, span.size());
  EXPECT_NEAR(time(1) - time(0), 1.0 / 250.0, 1e-12);
  EXPECT_LT((joined.specific_force.middleRows(span.begin, span.size()) - force_at(time)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Concatenate, OtherRatesAndJointsAreRefused) {
  const Log first = make_log(1000, 250.0);
  const Log faster = make_log(1000, 300.0);
  const Recording one = make_recording(first.time, first.positions, first.sensor);
  EXPECT_THAT([&] { concatenate({one, make_recording(faster.time, faster.positions, faster.sensor)}); },
              ThrowsMessage<InvalidInput>(testing::AllOf(HasSubstr("300"), HasSubstr("1 %"))));
  EXPECT_THAT([&] { concatenate({one, make_recording(first.time, first.positions.leftCols(1), first.sensor)}); },
              ThrowsMessage<InvalidInput>(HasSubstr("1 joints")));
  EXPECT_THROW(concatenate({}), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
