#pragma once
// Random vectors, poses, lines and arms, from a seed that the test states.

#include <Eigen/Core>
#include <numbers>
#include <random>

#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint::support {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double normal() { return normal_(engine_); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Index integer(Index low, Index high) { return std::uniform_int_distribution<Index>(low, high)(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  Eigen::Vector3d vector() { return {normal(), normal(), normal()}; }
  Eigen::Vector3d unit() { return vector().normalized(); }
  Eigen::VectorXd vector(Index n, double scale) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(-scale, scale); });
  }
  RigidTransform pose() {
    RigidTransform transform = RigidTransform::Identity();
    transform.linear() = rotation_exp(uniform(0.0, std::numbers::pi) * unit());
    transform.translation() = vector();
    return transform;
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

struct ArmKind {
  double prismatic = 0.3;  ///< probability of each joint
  double special = 0.5;    ///< probability of a special position of neighbours
};

/// A line beside `line`: in a special position (parallel, anti-parallel, intersecting, intersecting at right angles,
/// coincident, coincident and opposite) or any.
inline Line random_neighbor(Random& random, const Line& line, double special) {
  const Eigen::Vector3d on_line = line.point + random.normal() * line.direction;
  if (!random.chance(special)) {
    return make_line(random.unit(), random.vector());
  }
  switch (random.integer(0, 5)) {
    case 0: return make_line(line.direction, random.vector());
    case 1: return make_line(-line.direction, random.vector());
    case 2: return make_line(random.unit(), on_line);
    case 3: return make_line(line.direction.cross(random.unit()), on_line);
    case 4: return make_line(line.direction, on_line);
    default: return make_line(-line.direction, on_line);
  }
}

/// An arm of n joints (0: two to ten).
inline ScrewChain random_arm(Random& random, Index n = 0, const ArmKind& kind = {}) {
  ScrewChain chain;
  const Index size = n > 0 ? n : random.integer(2, 10);
  Line line = make_line(random.unit(), random.vector());
  for (Index i = 0; i < size; ++i) {
    chain.axes.push_back({random.chance(kind.prismatic) ? JointType::prismatic : JointType::revolute, line});
    line = random_neighbor(random, line, kind.special);
  }
  chain.reference_configuration = random.vector(size, 2.0);
  chain.home = random.pose();
  return chain;
}

/// Random rows; with probability `special` each of a, alpha, d, theta is zero (alpha also a right or straight angle).
template <class DhChain>
DhChain random_dh_arm(Random& random, Index n, const ArmKind& kind = {}) {
  DhChain chain;
  const auto or_zero = [&](double value) { return random.chance(kind.special) ? 0.0 : value; };
  for (Index i = 0; i < n; ++i) {
    const double quarter = 0.5 * std::numbers::pi * static_cast<double>(random.integer(-1, 2));
    const double alpha = random.chance(kind.special) ? quarter : random.uniform(-3.0, 3.0);
    chain.rows.push_back({or_zero(random.uniform(-1.0, 1.0)), alpha, or_zero(random.uniform(-1.0, 1.0)),
                          or_zero(random.uniform(-3.0, 3.0))});
    chain.types.push_back(random.chance(kind.prismatic) ? JointType::prismatic : JointType::revolute);
  }
  chain.base = random.pose();
  chain.tool = random.pose();
  return chain;
}

}  // namespace circlepoint::support
