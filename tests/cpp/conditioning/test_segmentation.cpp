#include "circlepoint/conditioning/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

using std::numbers::pi;

/// A joint's position against time.
using Law = std::function<double(double)>;

/// Smooth step from 0 to 1 (zero velocity at both ends).
double smooth_step(double t, double begin, double duration) {
  const double x = std::clamp((t - begin) / duration, 0.0, 1.0);
  return x - std::sin(2.0 * pi * x) / (2.0 * pi);
}

/// `periods` raised cosines of this amplitude (peak to peak) and period: the paper's eq. (11).
double raised_cosine(double t, double begin, double period, int periods, double amplitude) {
  const double x = (t - begin) / period;
  return x < 0.0 || x > periods ? 0.0 : 0.5 * amplitude * (1.0 - std::cos(2.0 * pi * x));
}

double standing(double /*t*/) { return 0.4; }

struct Setting {
  double rate = 250.0;
  double counts = 400000.0;  ///< a revolution; 0: exact encoders
  double noise = 5e-4;       ///< m/s^2
};

/// An arm of horizontal parallel axes, the sensor 0.5 m from each: gravity turns by the sum of the joints.
Recording record(const std::vector<Law>& laws, double duration, const Setting& setting) {
  const auto samples = static_cast<Index>(std::llround(duration * setting.rate));
  const auto joints = static_cast<Index>(laws.size());
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Recording recording;
  recording.sample_rate = setting.rate;
  recording.time = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / setting.rate);
  recording.joint_positions.resize(samples, joints);
  recording.specific_force.resize(samples, 3);
  recording.spans = {{0, samples}};
  const auto angle = [&](double t) {
    double sum = 0.0;
    for (const Law& law : laws) {
      sum += law(t);
    }
    return sum;
  };
  const double step = setting.counts > 0.0 ? 2.0 * pi / setting.counts : 0.0;
  constexpr double reach = 0.5;
  constexpr double h = 1e-3;
  for (Index k = 0; k < samples; ++k) {
    const double t = recording.time[k];
    for (Index joint = 0; joint < joints; ++joint) {
      const double position = laws[static_cast<std::size_t>(joint)](t);
      recording.joint_positions(k, joint) = step > 0.0 ? step * std::round(position / step) : position;
    }
    const double now = angle(t);
    const double velocity = (angle(t + h) - angle(t - h)) / (2.0 * h);
    const double acceleration = (angle(t + h) - 2.0 * now + angle(t - h)) / (h * h);
    recording.specific_force.row(k) =
        Eigen::RowVector3d(standard_gravity * std::sin(now) - reach * velocity * velocity,
                           standard_gravity * std::cos(now) + reach * acceleration, 0.0) +
        setting.noise * Eigen::RowVector3d(normal(random), normal(random), normal(random));
  }
  return recording;
}

/// 16 dwells of 0.75 s between moves of 0.75 s, back to the start, then three periods of eq. (11): 36 s in all.
double stepped_sweep(double t) {
  double position = -1.3;
  for (int k = 0; k < 15; ++k) {
    position += 0.17 * smooth_step(t, 0.75 + 1.5 * k, 0.75);
  }
  position -= 15 * 0.17 * smooth_step(t, 24.0, 1.5);
  return position + raised_cosine(t, 27.0, 2.0, 3, 2.6);
}

class StandardTest : public testing::TestWithParam<Setting> {};

TEST_P(StandardTest, IsFoundWhateverTheRateTheEncoderAndTheNoise) {
  const Recording recording = record({standing, stepped_sweep, standing}, 36.0, GetParam());
  const Segmentation found = segment(recording);
  EXPECT_EQ(found.dwells.size(), 18U);
  ASSERT_EQ(found.motions.size(), 17U);
  for (const SingleJointMotion& motion : found.motions) {
    EXPECT_EQ(motion.joint, 1);
    EXPECT_TRUE(motion.from_rest && motion.to_rest);
  }
  EXPECT_NEAR(found.motions.back().travel, 2.6, 0.03);
  EXPECT_NEAR(found.motions.back().peak_velocity, 1.3 * pi, 0.1);
  const double seconds = static_cast<double>(found.motions.back().samples.size()) / recording.sample_rate;
  EXPECT_NEAR(seconds, 6.2, 0.35);
  ASSERT_EQ(found.tests.size(), 1U);
  EXPECT_EQ(found.tests.front().joint, 1);
  EXPECT_EQ(found.tests.front().dwells.size(), 18U);
  EXPECT_EQ(found.tests.front().motions.size(), 17U);
  EXPECT_NEAR(found.tests.front().dwell_span, 15 * 0.17, 0.02);
  for (const StaticDwell& dwell : found.dwells) {
    const double sum = stepped_sweep(recording.time[dwell.samples.begin]) + 0.8;
    const Eigen::Vector3d still = standard_gravity * Eigen::Vector3d(std::sin(sum), std::cos(sum), 0.0);
    EXPECT_LT((dwell.specific_force - still).norm(), 2e-3 + GetParam().noise);
    EXPECT_LT(dwell.specific_force_std.maxCoeff(), 2e-3 + 1.5 * GetParam().noise);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Segmentation, StandardTest,
    testing::Values(Setting{50.0, 400000.0, 5e-4}, Setting{250.0, 0.0, 0.0}, Setting{250.0, 4096.0, 5e-4},
                    Setting{250.0, 1024.0, 5e-4}, Setting{250.0, 400000.0, 0.05}, Setting{1000.0, 1024.0, 0.05},
                    Setting{10000.0, 400000.0, 5e-4}),
    [](const auto& instance) {
      const Setting& setting = instance.param;
      return "Rate" + std::to_string(static_cast<int>(setting.rate)) + "Counts" +
             std::to_string(static_cast<int>(setting.counts)) + "Noise" +
             std::to_string(static_cast<int>(1e4 * setting.noise)) + "e4";
    });

TEST(Segmentation, AJointHoveringBetweenTwoCountsIsAtRest) {
  Recording recording = record({standing, standing}, 4.0, {});
  std::mt19937_64 random(3);
  for (Index k = 0; k < recording.samples(); ++k) {
    recording.joint_positions(k, 1) = 2.0 * pi / 1024.0 * static_cast<double>(random() % 2);
  }
  const Segmentation found = segment(recording);
  ASSERT_EQ(found.dwells.size(), 1U);
  EXPECT_GT(found.dwells.front().samples.size(), 900);
  EXPECT_TRUE(found.motions.empty());
}

TEST(Segmentation, SlowTurningPointsDoNotDivideAMotionNorMakeDwells) {
  for (const double amplitude : {0.1, 0.5, 2.0}) {
    const auto law = [amplitude](double t) { return raised_cosine(t, 1.0, 6.0, 3, amplitude); };
    const Segmentation found = segment(record({law, standing}, 20.0, {}));
    EXPECT_EQ(found.motions.size(), 1U) << amplitude;
    EXPECT_EQ(found.dwells.size(), 2U) << amplitude;
  }
}

TEST(Segmentation, JointsThatYieldInProportionDoNotMove) {
  const auto law = [](double t) { return raised_cosine(t, 1.0, 2.0, 3, 2.0); };
  const auto yielding = [&](double t) { return 0.4 + 0.015 * law(t); };
  const Segmentation found = segment(record({yielding, law, standing}, 9.0, {}));
  ASSERT_EQ(found.motions.size(), 1U);
  EXPECT_EQ(found.motions.front().joint, 1);
}

TEST(Segmentation, JointsMovingTogetherMakeNoTest) {
  const auto first = [](double t) { return std::sin(1.7 * t) + 0.4 * std::sin(3.1 * t + 1.0); };
  const auto second = [](double t) { return 0.8 * std::sin(1.3 * t + 2.0) + 0.5 * std::sin(2.9 * t); };
  const auto third = [](double t) { return 0.7 * std::sin(2.1 * t + 0.5) + 0.3 * std::sin(0.9 * t); };
  const Segmentation found = segment(record({first, second, third}, 60.0, {}));
  EXPECT_TRUE(found.dwells.empty());
  EXPECT_TRUE(found.motions.empty());
  EXPECT_TRUE(found.tests.empty());
}

TEST(Segmentation, TheAlonePartOfAMotionAnotherJointJoinsSaysItDoesNotEndAtRest) {
  const auto first = [](double t) { return 2.0 * smooth_step(t, 1.0, 4.0); };
  const auto second = [](double t) { return 1.0 * smooth_step(t, 3.0, 3.0); };
  const Recording recording = record({first, second}, 8.0, {});
  const Segmentation found = segment(recording);
  ASSERT_EQ(found.motions.size(), 2U);
  EXPECT_EQ(found.motions[0].joint, 0);
  EXPECT_TRUE(found.motions[0].from_rest);
  EXPECT_FALSE(found.motions[0].to_rest);
  EXPECT_NEAR(recording.time[found.motions[0].samples.end - 1], 3.1, 0.2);
  EXPECT_EQ(found.motions[1].joint, 1);
  EXPECT_FALSE(found.motions[1].from_rest);
  EXPECT_TRUE(found.motions[1].to_rest);
  SegmentationOptions strict;
  strict.min_partial = 3.0;
  EXPECT_TRUE(segment(recording, strict).motions.empty());
}

TEST(Segmentation, CreepingIsNotRest) {
  for (const double counts : {400000.0, 1024.0}) {
    const auto law = [](double t) { return 0.012 * std::clamp(t - 3.0, 0.0, 20.0); };
    const Recording recording = record({law, standing}, 26.0, {250.0, counts, 5e-4});
    const Segmentation found = segment(recording);
    ASSERT_EQ(found.dwells.size(), 2U) << counts;
    EXPECT_LT(recording.time[found.dwells[0].samples.end - 1], 4.1);
    EXPECT_GT(recording.time[found.dwells[1].samples.begin], 21.9);
    ASSERT_EQ(found.motions.size(), 1U) << counts;
    EXPECT_NEAR(found.motions[0].travel, 0.24, 0.02);
  }
}

TEST(Segmentation, NothingCrossesAGap) {
  Recording recording = record({stepped_sweep, standing}, 36.0, {});
  const Index cut = static_cast<Index>(28.5 * recording.sample_rate);  // within the first period of eq. (11)
  const Index pause = static_cast<Index>(0.4 * recording.sample_rate);  // within the first dwell
  recording.spans = {{0, pause}, {pause, cut}, {cut, recording.samples()}};
  const Segmentation found = segment(recording);
  for (const IndexRange& span : {IndexRange{0, pause}, IndexRange{pause, cut}, IndexRange{cut, recording.samples()}}) {
    const auto crosses = [&](const IndexRange& range) { return range.begin < span.end && range.end > span.end; };
    for (const StaticDwell& dwell : found.dwells) {
      EXPECT_FALSE(crosses(dwell.samples));
    }
    for (const SingleJointMotion& motion : found.motions) {
      EXPECT_FALSE(crosses(motion.samples));
    }
  }
  EXPECT_EQ(found.motions.size(), 18U);
  EXPECT_FALSE(found.motions[16].to_rest);
  EXPECT_FALSE(found.motions[17].from_rest);
}

TEST(Segmentation, ADwellBeginsWhenTheVibrationAfterAStopHasDied) {
  const auto law = [](double t) { return smooth_step(t, 1.0, 1.0); };
  Recording recording = record({law}, 6.0, {});
  for (Index k = 0; k < recording.samples(); ++k) {
    if (const double t = recording.time[k] - 2.0; t > 0.0) {
      recording.specific_force(k, 0) += 0.8 * std::exp(-t / 0.25) * std::sin(2.0 * pi * 9.0 * t);
    }
  }
  const Segmentation found = segment(recording);
  ASSERT_EQ(found.dwells.size(), 2U);
  const StaticDwell& dwell = found.dwells.back();
  EXPECT_GT(recording.time[dwell.samples.begin], 3.0);
  EXPECT_LT(recording.time[dwell.samples.begin], 4.2);
  EXPECT_NEAR(dwell.specific_force[0], standard_gravity * std::sin(1.0), 5e-4);
}

TEST(Segmentation, AShakenSensorIsNotStaticThoughTheJointsRest) {
  const auto law = [](double t) { return smooth_step(t, 3.0, 1.0) + smooth_step(t, 8.0, 1.0); };
  Recording recording = record({law, standing}, 12.0, {});
  EXPECT_EQ(static_intervals(recording).size(), 3U);
  for (Index k = 0; k < recording.samples(); ++k) {
    if (recording.time[k] > 3.0 && recording.time[k] < 9.0) {
      recording.specific_force(k, 2) += 0.3 * std::sin(2.0 * pi * 7.0 * recording.time[k]);
    }
  }
  const std::vector<IndexRange> intervals = static_intervals(recording);
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_LT(recording.time[intervals[0].end - 1], 3.1);
  EXPECT_GT(recording.time[intervals[1].begin], 8.9);
}

TEST(Segmentation, DwellsAloneMakeATestOfTheJointInWhichTheyDiffer) {
  const auto quick = [](double t) { return 0.5 * std::floor(t / 2.0); };
  const Segmentation found = segment(record({standing, quick, standing}, 12.0, {}));
  ASSERT_EQ(found.tests.size(), 1U);
  EXPECT_EQ(found.tests[0].joint, 1);
  EXPECT_EQ(found.tests[0].dwells.size(), 6U);
  EXPECT_NEAR(found.tests[0].dwell_span, 2.5, 1e-3);
}

TEST(Segmentation, DwellsInWhichOtherJointsStrayMakeNoTest) {
  const auto quick = [](double t) { return 0.15 * std::fmod(std::floor(t / 2.0), 2.0); };
  const auto stray = [](double t) { return 0.08 * std::fmod(std::floor(t / 2.0), 3.0) / 2.0; };
  const Segmentation found = segment(record({quick, stray, standing}, 12.0, {}));
  EXPECT_EQ(found.dwells.size(), 6U);
  EXPECT_TRUE(found.tests.empty());
}

TEST(Segmentation, TheHomeDwellBelongsToEveryTest) {
  const auto first = [](double t) { return raised_cosine(t, 1.0, 2.0, 2, 1.0); };
  const auto second = [](double t) { return raised_cosine(t, 7.0, 2.0, 2, 1.0); };
  const Segmentation found = segment(record({first, second}, 13.0, {}));
  ASSERT_EQ(found.tests.size(), 2U);
  EXPECT_EQ(found.tests[0].joint, 0);
  EXPECT_EQ(found.tests[1].joint, 1);
  EXPECT_EQ(found.tests[0].dwells, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(found.tests[1].dwells, (std::vector<Index>{0, 1, 2}));
}

TEST(Segmentation, RefusesWhatItCannotJudge) {
  Recording recording = record({standing}, 2.0, {});
  SegmentationOptions options;
  options.min_velocity = 0.0;
  EXPECT_THROW(segment(recording, options), InvalidInput);
  recording.specific_force(7, 1) = std::nan("");
  EXPECT_THROW(segment(recording), InvalidInput);
  recording.specific_force.conservativeResize(10, 3);
  EXPECT_THROW(segment(recording), InvalidInput);
  Recording nothing;
  nothing.sample_rate = 100.0;
  EXPECT_TRUE(segment(nothing).dwells.empty());
}

}  // namespace
}  // namespace circlepoint
