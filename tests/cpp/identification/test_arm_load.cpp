#include "arm_load.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <numbers>

#include "circlepoint/chain/kdl.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr Index joints = 4;

Eigen::Vector3d random_vector(RandomSource& random, double size) {
  return size * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
}

// An arm of links with random inertias, for KDL's recursive Newton-Euler solver.
struct HeavyArm {
  KnownArm known;
  KDL::Chain chain;
  KDL::Vector gravity;

  explicit HeavyArm(std::uint64_t seed) {
    RandomSource random(seed);
    for (Index j = 0; j < joints; ++j) {
      known.chain.axes.push_back({JointType::revolute, make_line(random_vector(random, 1.0), random_vector(random, 0.4))});
      known.known.push_back(true);
    }
    known.chain.reference_configuration = Eigen::VectorXd::NullaryExpr(joints, [&] { return random.normal(); });
    known.up_gravity = standard_gravity * random_vector(random, 1.0).normalized();
    gravity = KDL::Vector(-known.up_gravity[0], -known.up_gravity[1], -known.up_gravity[2]);
    const KDL::Chain light = to_kdl(known.chain);
    for (unsigned i = 0; i < light.getNrOfSegments(); ++i) {
      const KDL::Segment& segment = light.getSegment(i);
      const KDL::Vector centre(0.2 * random.normal(), 0.2 * random.normal(), 0.2 * random.normal());
      const KDL::RotationalInertia inertia(0.03, 0.05, 0.04, 0.01 * random.normal(), 0.01 * random.normal(), 0.01 * random.normal());
      chain.addSegment(KDL::Segment(segment.getName(), segment.getJoint(), segment.getFrameToTip(),
                                    KDL::RigidBodyInertia(random.uniform(1.0, 3.0), centre, inertia)));
    }
  }

  [[nodiscard]] Eigen::VectorXd torques(const Eigen::VectorXd& position, Index moving, double velocity, double acceleration) const {
    KDL::ChainIdSolver_RNE solver(chain, gravity);
    KDL::JntArray q(joints);
    KDL::JntArray rate(joints);
    KDL::JntArray change(joints);
    KDL::JntArray torque(joints);
    q.data = position;
    rate(static_cast<unsigned>(moving)) = velocity;
    change(static_cast<unsigned>(moving)) = acceleration;
    solver.CartToJnt(q, rate, change, KDL::Wrenches(chain.getNrOfSegments(), KDL::Wrench::Zero()), torque);
    return torque.data;
  }

  // All beyond a joint in the sensor frame at a configuration.
  [[nodiscard]] Eigen::VectorXd load_beyond(Index joint, const Eigen::VectorXd& configuration) const {
    KDL::RigidBodyInertia sum = KDL::RigidBodyInertia::Zero();
    KDL::Frame frame = KDL::Frame::Identity();
    unsigned at = 0;
    for (unsigned i = 0; i < chain.getNrOfSegments(); ++i) {
      const KDL::Segment& segment = chain.getSegment(i);
      const bool moves = segment.getJoint().getType() != KDL::Joint::None;
      frame = frame * segment.pose(moves ? configuration[at] : 0.0);
      at += moves ? 1U : 0U;
      if (static_cast<Index>(at) > joint) {
        sum = sum + frame * segment.getInertia();
      }
    }
    sum = to_kdl(forward_kinematics(known.chain, configuration)).Inverse() * sum;
    Eigen::VectorXd load(load_parameters);
    const KDL::Vector moment = sum.getCOG() * sum.getMass();
    const KDL::RotationalInertia inertia = sum.getRotationalInertia();
    load << sum.getMass(), moment.x(), moment.y(), moment.z(), inertia.data[0], inertia.data[4], inertia.data[8], inertia.data[1],
        inertia.data[2], inertia.data[5];
    return load;
  }
};

Eigen::VectorXd functions(double position, double velocity, double acceleration) {
  Eigen::VectorXd values(load_functions);
  const double c = std::cos(position);
  const double s = std::sin(position);
  const double square = velocity * velocity;
  values << c, s, acceleration, acceleration * c, acceleration * s, square, square * c, square * s;
  return values;
}

TEST(ArmLoad, TorquesOnRestingJointsAreThoseOfARecursiveNewtonEulerSolver) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const HeavyArm arm(seed);
    RandomSource random(100 + seed);
    const Eigen::VectorXd home = Eigen::VectorXd::NullaryExpr(joints, [&] { return random.normal(); });
    const ArmAtHome at = at_home(arm.known, home);
    for (Index moving = 0; moving < joints; ++moving) {
      Eigen::VectorXd position = home;
      position[moving] += random.uniform(-2.0, 2.0);
      const double velocity = random.normal();
      const double acceleration = 5.0 * random.normal();
      const Eigen::VectorXd change = arm.torques(position, moving, velocity, acceleration) - arm.torques(home, moving, 0.0, 0.0);
      const Eigen::VectorXd phi = functions(position[moving], velocity, acceleration) - functions(home[moving], 0.0, 0.0);
      for (Index resting = 0; resting < joints; ++resting) {
        if (resting != moving) {
          const Eigen::VectorXd load = arm.load_beyond(std::max(moving, resting), home);
          EXPECT_NEAR(phi.dot(load_coefficients(at, moving, resting) * load), change[resting], 1e-9) << moving << " " << resting;
        }
      }
    }
  }
}

}  // namespace
}  // namespace circlepoint
