#include "circlepoint/identification/circle_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/random_arms.hpp"

namespace circlepoint {
namespace {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

Points arc(const Eigen::Vector2d& center, double radius, double first, double span, Index count) {
  Points points(count, 2);
  for (Index i = 0; i < count; ++i) {
    const double angle = first + span * static_cast<double>(i) / static_cast<double>(count - 1);
    points.row(i) << center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle);
  }
  return points;
}

double algebraic_radius(const Points& points) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> system(points.rows(), 3);
  system << 2.0 * points, Eigen::VectorXd::Ones(points.rows());
  const Eigen::VectorXd squares = points.rowwise().squaredNorm();
  const Eigen::Vector3d solution = system.colPivHouseholderQr().solve(squares);
  return std::sqrt(solution[2] + solution.head<2>().squaredNorm());
}

TEST(CircleFit, ExactArcsOfAnySizeAndPlaceAreFound) {
  support::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d center(random.normal(), random.normal());
    const double radius = std::pow(10.0, random.uniform(-2.0, 1.0));
    const CircleFit fit = fit_circle(arc(center, radius, random.uniform(-3.0, 3.0), random.uniform(0.5, 6.0), 40));
    EXPECT_TRUE(fit.converged);
    EXPECT_THAT(fit.center, support::EntriesNear(center, 1e-9 * std::max(1.0, radius)));
    EXPECT_NEAR(fit.radius, radius, 1e-9 * std::max(1.0, radius));
    EXPECT_LT(fit.rms, 1e-9);
  }
}

TEST(CircleFit, ShortArcsAreNotShrunkAsByTheAlgebraicFit) {
  support::Random random(2);
  constexpr int trials = 500;
  double geometric = 0.0;
  double algebraic = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    Points points = arc({0.3, -0.2}, 1.0, 0.4, 0.8, 100);
    points += Points::NullaryExpr(points.rows(), 2, [&] { return 0.01 * random.normal(); });
    geometric += (fit_circle(points).radius - 1.0) / trials;
    algebraic += (algebraic_radius(points) - 1.0) / trials;
  }
  EXPECT_LT(algebraic, -0.02);
  EXPECT_LT(std::abs(geometric), 0.3 * std::abs(algebraic));
}

TEST(CircleFit, CovarianceIsTheSpreadOfRepeatedFits) {
  support::Random random(3);
  const Eigen::Vector2d center(0.3, -0.2);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d predicted = Eigen::Matrix2d::Zero();
  constexpr int trials = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    Points points = arc(center, 0.5, 0.4, 2.0, 100);
    points += Points::NullaryExpr(points.rows(), 2, [&] { return 1e-3 * random.normal(); });
    const CircleFit fit = fit_circle(points);
    spread += (fit.center - center) * (fit.center - center).transpose() / trials;
    predicted += fit.covariance / trials;
  }
  EXPECT_NEAR(predicted(0, 0) / spread(0, 0), 1.0, 0.15);
  EXPECT_NEAR(predicted(1, 1) / spread(1, 1), 1.0, 0.15);
}

TEST(CircleFit, PointsOnALineAreNotIdentifiable) {
  Points points(20, 2);
  points.col(0) = Eigen::VectorXd::LinSpaced(20, -0.3, 0.9);
  points.col(1) = 0.37 * points.col(0).array() + 0.11;
  EXPECT_THROW(fit_circle(points), NotIdentifiable);
  EXPECT_THROW(fit_circle(Points::Ones(10, 2)), NotIdentifiable);
}

TEST(CircleFit, TooFewOrBrokenPointsAreRefused) {
  Points points = arc({0.0, 0.0}, 1.0, 0.0, 2.0, 10);
  EXPECT_THROW(fit_circle(points.topRows(2)), InvalidInput);
  points(4, 0) = std::nan("");
  EXPECT_THROW(fit_circle(points), InvalidInput);
}

}  // namespace
}  // namespace circlepoint
