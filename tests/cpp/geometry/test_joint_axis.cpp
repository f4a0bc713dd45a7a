#include "circlepoint/geometry/joint_axis.hpp"

#include <gtest/gtest.h>

#include <random>

namespace circlepoint {
namespace {

TEST(JointAxis, LocalCoordinatesInvertRetract) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto vector3 = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (int trial = 0; trial < 1000; ++trial) {
    const Line line = make_line(vector3(), vector3());
    const Line other = make_line(line.direction + 0.2 * vector3(), line.point + 0.2 * vector3());
    const Line back = retract(line, local_coordinates(line, other));
    EXPECT_LT((back.direction - other.direction).norm(), 1e-12);
    EXPECT_LT((back.point - other.point).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace circlepoint
