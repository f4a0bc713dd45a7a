#include "circlepoint/recording/timeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

// Ticks of a clock without those in [from, to), stamped in whole `resolution` (0: exactly).
Eigen::VectorXd stamps(Index ticks, double rate, double resolution, Index from = 0, Index to = 0) {
  std::vector<double> times;
  for (Index k = 0; k < ticks; ++k) {
    if (k < from || k >= to) {
      const double t = 0.3 + static_cast<double>(k) / rate;
      times.push_back(resolution > 0.0 ? std::round(t / resolution) * resolution : t);
    }
  }
  return as_vector(times);
}

TEST(Timeline, ExactStampsAreTheirOwnClock) {
  const Eigen::VectorXd time = stamps(5000, 250.0, 0.0);
  const Timeline timeline = make_timeline(time);
  EXPECT_DOUBLE_EQ(timeline.report.sample_rate, 250.0);
  EXPECT_EQ(timeline.report.rule, StampRule::regularised);
  EXPECT_EQ(timeline.spans, (std::vector<IndexRange>{{0, 5000}}));
  EXPECT_LT((timeline.time - time).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_TRUE(timeline.report.gaps.empty());
  EXPECT_TRUE(timeline.report.notes.empty());
}

TEST(Timeline, RoundedStampsAreReplacedByTheClockTheyFit) {
  constexpr double rate = 266.27;
  const Timeline timeline = make_timeline(stamps(20000, rate, 1e-3));
  EXPECT_EQ(timeline.report.rule, StampRule::regularised);
  EXPECT_DOUBLE_EQ(timeline.report.resolution, 1e-3);
  EXPECT_NEAR(timeline.report.sample_rate, rate, 1e-4);
  EXPECT_NEAR(timeline.report.jitter_std, 1e-3 / std::sqrt(12.0), 2e-5);
  EXPECT_EQ(timeline.report.late, 0);
  EXPECT_TRUE(timeline.report.gaps.empty());
  EXPECT_LT((timeline.time - stamps(20000, rate, 0.0)).cwiseAbs().maxCoeff(), 2e-5);
}

TEST(Timeline, EveryDroppedSampleOfARoundedStreamIsNoticed) {
  constexpr double rate = 266.27;
  for (Index missing = 1; missing <= 5; ++missing) {
    for (Index at = 200; at < 212; ++at) {
      const Eigen::VectorXd time = stamps(4000, rate, 1e-3, at, at + missing);
      const Timeline timeline = make_timeline(time);
      ASSERT_EQ(timeline.report.gaps.size(), 1U) << missing << " missing at " << at;
      EXPECT_EQ(timeline.report.gaps[0].missing, missing);
      EXPECT_EQ(timeline.report.gaps[0].index, at);
      EXPECT_EQ(timeline.report.gaps[0].filled, missing <= 3);
      EXPECT_EQ(timeline.spans.size(), missing <= 3 ? 1U : 2U);
      EXPECT_EQ(timeline.time.size(), missing <= 3 ? 4000 : 4000 - missing);
    }
  }
}

TEST(Timeline, ALateBunchIsNotAGap) {
  Eigen::VectorXd time = stamps(4000, 250.0, 1e-3);
  const Eigen::VectorXd clock = time;
  for (Index i = 1000; i < 1004; ++i) {
    time(i) = clock(1003) + 1e-3;  // four samples stamped together when the last one arrived
  }
  const Timeline timeline = make_timeline(time);
  EXPECT_TRUE(timeline.report.gaps.empty());
  EXPECT_EQ(timeline.report.repeated.size(), 3U);
  EXPECT_GE(timeline.report.late, 3);
  EXPECT_EQ(timeline.time.size(), 4000);
  EXPECT_LT((timeline.time - clock).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Timeline, JitteredStampsAreBelieved) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> jitter(0.0, 0.4e-3);
  Eigen::VectorXd time = stamps(4000, 200.0, 0.0);
  for (double& t : time) {
    t += jitter(random);
  }
  const Timeline timeline = make_timeline(time);
  EXPECT_EQ(timeline.report.rule, StampRule::believed);
  EXPECT_NEAR(timeline.report.sample_rate, 200.0, 1e-2);
  EXPECT_NEAR(timeline.report.jitter_std, 0.4e-3, 0.05e-3);
  EXPECT_EQ(timeline.spans.size(), 1U);
  const SamplesX signal = (2.0 * 3.14159 * 2.0 * time.array()).sin().matrix();
  const SamplesX expected = (2.0 * 3.14159 * 2.0 * timeline.time.array()).sin().matrix();
  EXPECT_LT((regularise(timeline, signal) - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Timeline, StampsTooJitteredToCountStillGiveAUniformClock) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> step(0.5e-3, 19.5e-3);
  std::vector<double> times{0.0};
  for (int i = 0; i < 1500; ++i) {
    times.push_back(times.back() + step(random) + (i == 700 ? 0.4 : 0.0));
  }
  const Timeline timeline = make_timeline(as_vector(times));
  EXPECT_EQ(timeline.report.rule, StampRule::believed);
  EXPECT_NEAR(timeline.report.sample_rate, 100.0, 5.0);
  EXPECT_EQ(timeline.spans.size(), 2U);
  ASSERT_EQ(timeline.report.gaps.size(), 1U);
  EXPECT_EQ(timeline.report.gaps[0].index, 701);
}

TEST(Timeline, FilledSamplesFollowTheSignalAndOthersAreKept) {
  const Eigen::VectorXd time = stamps(1000, 250.0, 0.0, 400, 403);
  const SamplesX signal = (6.0 * time.array()).sin().matrix();
  const Timeline timeline = make_timeline(time);
  const SamplesX regular = regularise(timeline, signal);
  ASSERT_EQ(regular.rows(), 1000);
  EXPECT_EQ(regular.topRows(400), signal.topRows(400));
  EXPECT_EQ(regular.bottomRows(597), signal.bottomRows(597));
  EXPECT_LT((regular - SamplesX((6.0 * timeline.time.array()).sin().matrix())).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(timeline.report.filled, 3);
}

TEST(Timeline, SamplesThatArriveInBunchesDoNotMakeTheSignalSwing) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::uniform_real_distribution<double> wait(0.0, 1.0);
  constexpr double period = 0.01;
  std::vector<double> times;
  for (Index k = 0; k < 3000; ++k) {  // every other one comes right behind the one before it
    times.push_back(k % 2 == 0 ? static_cast<double>(k) * period + 0.8 * period * wait(random) : times.back() + 5e-6);
  }
  const Timeline timeline = make_timeline(as_vector(times));
  SamplesX values(timeline.row_time.size(), 1);
  for (double& value : values.reshaped()) {
    value = 9.8 + noise(random);
  }
  const SamplesX regular = regularise(timeline, values);
  EXPECT_LT((regular.array() - 9.8).abs().maxCoeff(), 0.1);
}

TEST(Timeline, APauseStartsASpanOnItsOwnPhase) {
  Eigen::VectorXd time = stamps(2000, 250.0, 0.0);
  time.tail(1000).array() += 10.0013;
  const Timeline timeline = make_timeline(time);
  EXPECT_EQ(timeline.spans, (std::vector<IndexRange>{{0, 1000}, {1000, 2000}}));
  EXPECT_LT((timeline.time - time).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Timeline, TimeRunningBackwardsIsAnErrorThatNamesTheRow) {
  Eigen::VectorXd time = stamps(100, 100.0, 0.0);
  time(50) = time(48);
  EXPECT_THAT([&] { make_timeline(time); }, ThrowsMessage<InvalidInput>(HasSubstr("row 51")));
  const TimelineReport report = analyse_timeline(time);
  ASSERT_EQ(report.backwards.size(), 1U);
  EXPECT_EQ(report.backwards[0].index, 50);
  EXPECT_DOUBLE_EQ(report.backwards[0].value, time(48));
}

TEST(Timeline, ARowWrittenTwiceIsAnErrorThatNamesTheRow) {
  Eigen::VectorXd time = stamps(1000, 100.0, 0.0);
  const Eigen::VectorXd tail = time.segment(500, 499);
  time.tail(499) = tail;  // row 501 again, then everything one row later
  EXPECT_THAT([&] { make_timeline(time); }, ThrowsMessage<InvalidInput>(HasSubstr("row 502")));
}

TEST(Timeline, RefusesTooFewOrNonFiniteStamps) {
  EXPECT_THROW(make_timeline(stamps(7, 100.0, 0.0)), InvalidInput);
  Eigen::VectorXd time = stamps(100, 100.0, 0.0);
  time(9) = std::nan("");
  EXPECT_THAT([&] { make_timeline(time); }, ThrowsMessage<InvalidInput>(HasSubstr("row 10")));
}

TEST(Timeline, LargeEpochsLoseNothingButTheirOwnDigits) {
  Eigen::VectorXd time = stamps(5000, 125.0, 0.0);
  time.array() += 1.7e9;
  const Timeline timeline = make_timeline(time);
  EXPECT_NEAR(timeline.report.sample_rate, 125.0, 1e-5);
  EXPECT_LT((timeline.time - time).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace circlepoint
