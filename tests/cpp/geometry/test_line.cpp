#include "circlepoint/geometry/line.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using support::EntriesNear;
using support::LineNear;

TEST(Line, PointIsNearestTheOriginWhateverPointItIsMadeFrom) {
  support::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d direction = random.vector();
    const Eigen::Vector3d point = random.vector();
    const Line line = make_line(direction, point);
    EXPECT_NEAR(line.direction.norm(), 1.0, 1e-15);
    EXPECT_NEAR(line.point.dot(line.direction), 0.0, 1e-14);
    EXPECT_THAT(make_line(2.0 * direction, point - 3.0 * direction), LineNear(line, 1e-13));
  }
}

TEST(Line, PlueckerCoordinatesGoThereAndBack) {
  support::Random random(2);
  const Line line = make_line(random.vector(), random.vector());
  EXPECT_THAT(line_from_pluecker(line.direction, line.moment()), LineNear(line, 1e-14));
  EXPECT_THAT(line_from_pluecker(3.0 * line.direction, 3.0 * line.moment() + 0.7 * line.direction), LineNear(line, 1e-14));
}

TEST(Line, TransformCarriesItsPoints) {
  support::Random random(3);
  const RigidTransform T_a_b = random.pose();
  const Eigen::Vector3d direction = random.unit();
  const Eigen::Vector3d point = random.vector();
  EXPECT_THAT(transform(T_a_b, make_line(direction, point)),
              LineNear(make_line(T_a_b.linear() * direction, T_a_b * point), 1e-14));
}

TEST(Line, WithoutADirectionIsRefused) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d not_finite = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(make_line(zero, zero), InvalidInput);
  EXPECT_THROW(make_line(not_finite, zero), InvalidInput);
  EXPECT_THROW(make_line(Eigen::Vector3d::UnitX(), not_finite), InvalidInput);
  EXPECT_THROW(line_from_pluecker(zero, zero), InvalidInput);
}

TEST(CommonNormal, IsOrthogonalToBothLinesAndEndsOnThem) {
  support::Random random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const Line first = make_line(random.unit(), random.vector());
    const Line second = support::random_neighbor(random, first, 0.7);
    const CommonNormal normal = common_normal(first, second, random.vector());
    const double size = 1.0 + normal.foot_first.norm() + normal.foot_second.norm();
    EXPECT_NEAR(normal.direction.norm(), 1.0, 1e-14);
    EXPECT_NEAR(normal.direction.dot(first.direction), 0.0, 1e-11);
    EXPECT_NEAR(normal.direction.dot(second.direction), 0.0, 1e-11);
    EXPECT_THAT(normal.foot_first + normal.distance * normal.direction, EntriesNear(normal.foot_second, 1e-11 * size));
    EXPECT_THAT(make_line(first.direction, normal.foot_first), LineNear(first, 1e-11 * size));
    EXPECT_THAT(make_line(second.direction, normal.foot_second), LineNear(second, 1e-11 * size));
    EXPECT_GE(normal.distance, -1e-12);
    EXPECT_THAT(rotation_exp(normal.angle * normal.direction) * first.direction, EntriesNear(second.direction, 1e-11));
  }
}

TEST(CommonNormal, OfParallelsHasItsFeetBesideTheHint) {
  const Line first = make_line(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  const Line second = make_line(-Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.0, 0.5, 0.0));
  const CommonNormal normal = common_normal(first, second, Eigen::Vector3d(7.0, 7.0, 2.0));
  EXPECT_TRUE(normal.parallel);
  EXPECT_THAT(normal.foot_first, EntriesNear(Eigen::Vector3d(0.0, 0.0, 2.0), 1e-15));
  EXPECT_THAT(normal.foot_second, EntriesNear(Eigen::Vector3d(0.0, 0.5, 2.0), 1e-15));
  EXPECT_EQ(normal.angle, std::numbers::pi);
  EXPECT_EQ(normal.distance, 0.5);
}

TEST(CommonNormal, OfIntersectingLinesTakesItsSignFromTheDirections) {
  support::Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d meeting = random.vector();
    const Line first = make_line(random.unit(), meeting);
    const Line second = make_line(first.direction.cross(random.unit()) + 0.3 * first.direction, meeting);
    const CommonNormal normal = common_normal(first, second, Eigen::Vector3d::Zero());
    EXPECT_GT(normal.direction.dot(first.direction.cross(second.direction)), 0.0);
    EXPECT_NEAR(normal.distance, 0.0, 1e-12);
    EXPECT_GT(normal.angle, 0.0);
  }
}

}  // namespace
}  // namespace circlepoint
