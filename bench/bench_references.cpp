// What a C++ user would pick instead, on the same data: KDL for forward kinematics, Ceres for a joint's axis direction.
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>

#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <random>

#include "circlepoint/chain/kdl.hpp"
#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/core/types.hpp"
#include "circlepoint/identification/axis_direction.hpp"
#include "seven_joints.hpp"

namespace circlepoint {
namespace {

constexpr Index poses = 150;

void forward_kinematics_of_screws(benchmark::State& state) {
  const ScrewChain chain = seven_joints();
  const Eigen::VectorXd q = Eigen::VectorXd::Random(joints);
  for (auto _ : state) {
    benchmark::DoNotOptimize(forward_kinematics(chain, q));
  }
}

void forward_kinematics_by_kdl(benchmark::State& state) {
  const KDL::Chain chain = to_kdl(seven_joints());
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::JntArray q(joints);
  q.data = Eigen::VectorXd::Random(joints);
  KDL::Frame frame;
  for (auto _ : state) {
    solver.JntToCart(q, frame);
    benchmark::DoNotOptimize(frame);
  }
}

Samples3 rests() {
  Samples3 readings(poses, 3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (Index i = 0; i < poses; ++i) {
    const double angle = 2.0 * static_cast<double>(i) / static_cast<double>(poses);
    readings.row(i) << 9.0 * std::cos(angle) + noise(random), 3.0 + noise(random), 9.0 * std::sin(angle) + noise(random);
  }
  return readings;
}

void axis_direction_in_closed_form(benchmark::State& state) {
  const Samples3 readings = rests();
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_axis_direction(readings));
  }
}

// z . f_i = c for all rests at once: one block a test.
class Plane : public ceres::CostFunction {
 public:
  explicit Plane(const Samples3& readings) : readings_(readings) {
    set_num_residuals(static_cast<int>(readings.rows()));
    mutable_parameter_block_sizes()->assign({3, 1});
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> axis(parameters[0]);
    const Index n = readings_.rows();
    Eigen::Map<Eigen::VectorXd>(residuals, n) = (readings_ * axis).array() - parameters[1][0];
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Samples3>(jacobians[0], n, 3) = readings_;
    }
    if (jacobians != nullptr && jacobians[1] != nullptr) {
      Eigen::Map<Eigen::VectorXd>(jacobians[1], n).setConstant(-1.0);
    }
    return true;
  }

 private:
  const Samples3& readings_;
};

void axis_direction_by_ceres(benchmark::State& state) {
  const Samples3 readings = rests();
  for (auto _ : state) {
    Eigen::Vector3d axis(0.3, 0.9, 0.3);
    axis.normalize();
    double offset = 3.0;
    ceres::Problem problem;
    problem.AddResidualBlock(new Plane(readings), nullptr, axis.data(), &offset);
    problem.SetManifold(axis.data(), new ceres::SphereManifold<3>());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    benchmark::DoNotOptimize(axis);
  }
}

BENCHMARK(forward_kinematics_of_screws)->Unit(benchmark::kNanosecond);
BENCHMARK(forward_kinematics_by_kdl)->Unit(benchmark::kNanosecond);
BENCHMARK(axis_direction_in_closed_form)->Unit(benchmark::kMicrosecond);
BENCHMARK(axis_direction_by_ceres)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace circlepoint
