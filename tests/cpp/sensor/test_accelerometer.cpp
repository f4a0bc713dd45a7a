#include "circlepoint/sensor/accelerometer.hpp"

#include <gtest/gtest.h>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

Eigen::Vector3d normal3(RandomSource& random, double std) {
  return {std * random.normal(), std * random.normal(), std * random.normal()};
}

TEST(Accelerometer, CorrectInvertsMeasureForAnyModel) {
  RandomSource random(1);
  const AccelerometerSpecification poor{.bias_std = 0.5, .scale_std = 0.05, .misalignment_std = 0.05,
                                        .percussion_distance = 0.02, .percussion_distance_std = 0.01,
                                        .second_order_std = 1e-4};
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    const AccelerometerModel model = draw_accelerometer(poor, trial);
    const Eigen::Vector3d force = normal3(random, 30.0);
    const Eigen::Vector3d rate = normal3(random, 5.0);
    EXPECT_LT((model.correct(model.measure(force, rate), rate) - force).norm(), 1e-12 * (1.0 + force.norm()));
  }
}

TEST(Accelerometer, EveryTermActsAsTheFormulaSays) {
  const AccelerometerModel model{.bias = {0.1, 0.2, 0.3}, .scale = {0.01, 0.02, 0.03}, .misalignment = {0.1, 0.2, 0.4},
                                 .percussion_distance = {0.5, 0.0, 0.25}, .second_order = {0.001, 0.002, 0.003}};
  // |w|^2 - w_k^2 = (13, 10, 5): f - D (.) = (3.5, 2, 1.75); M gives (3.5, 2.35, 3.25).
  const Eigen::Vector3d reading = model.measure({10.0, 2.0, 3.0}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(reading[0], 1.01 * 3.5 + 0.001 * 3.5 * 3.5 + 0.1, 1e-14);
  EXPECT_NEAR(reading[1], 1.02 * 2.35 + 0.002 * 2.35 * 2.35 + 0.2, 1e-14);
  EXPECT_NEAR(reading[2], 1.03 * 3.25 + 0.003 * 3.25 * 3.25 + 0.3, 1e-14);
}

TEST(Accelerometer, AReadingTheModelCannotProduceIsNamedByItsRow) {
  const AccelerometerModel model{.second_order = {-0.01, 0.0, 0.0}};
  Samples3 reading = Samples3::Zero(3, 3);
  reading(2, 0) = 30.0;  // the parabola's vertex is at 25
  try {
    const Samples3 force = correct(model, reading, Samples3::Zero(3, 3));
    FAIL() << force;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("row 2"), std::string::npos) << error.what();
  }
}

TEST(RandomSource, TheEngineIsTheStandardsOwnAndStreamsDiffer) {
  // [rand.predef]: the 10000th value of a default-seeded std::mt19937_64.
  std::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042ULL);
  EXPECT_NE(derive_seed(1, 0), derive_seed(1, 1));
  EXPECT_NE(derive_seed(1, 0), derive_seed(2, 0));
}

}  // namespace
}  // namespace circlepoint
