#include "arm_layout.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "arm_encoder_errors.hpp"

namespace circlepoint {
namespace {

constexpr double known_gravity_std = 2e-5;  // m/s^2: a known magnitude, without making the equations stiff

ParameterTreatment settle(const ParameterTreatment& treatment, double specified) {
  ParameterTreatment settled = treatment;
  if (settled.std == 0.0) {
    settled.std = specified;
  }
  settled.estimated = settled.estimated && settled.std > 0.0;
  return settled;
}

}  // namespace

void lay_out(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options) {
  ArmLayout& layout = problem.layout;
  layout.claim_lines(state.axes, moves);
  layout.up_gravity = layout.claim(3);
  problem.prior.gravity = options.gravity_magnitude;
  const ParameterTreatment gravity = settle(options.gravity, 0.0);
  problem.prior.gravity_known = !gravity.estimated;
  problem.prior.gravity_std = gravity.estimated ? gravity.std : known_gravity_std;
  const auto group = [&](Index& column, const ParameterTreatment& treatment, double specified, const Eigen::VectorXd& mean) {
    const ParameterTreatment settled = settle(treatment, specified);
    if (settled.estimated) {
      column = layout.claim(mean.size());
      add_prior(problem.prior, column, mean, settled.std);
    }
  };
  const AccelerometerSpecification& sensor = options.sensor;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  group(layout.bias, options.bias, sensor.bias_std, zero);
  group(layout.scale, options.scale, sensor.scale_std, zero);
  group(layout.misalignment, options.misalignment, sensor.misalignment_std, zero);
  const ParameterTreatment percussion = settle(options.percussion_distance, sensor.percussion_distance_std);
  const bool motion = !problem.rows.stretches.empty();  // which alone shows what follows but the nonlinearity
  if (percussion.estimated && motion) {
    layout.percussion_distance = layout.claim(3);
    if (std::isfinite(percussion.std)) {
      const double spread = std::min(percussion.std, channel_spread_std);
      const Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(percussion.std * percussion.std) +
                                         spread * spread * Eigen::Matrix3d::Identity();
      const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
      problem.prior.terms.push_back({layout.percussion_distance, Eigen::Vector3d::Constant(sensor.percussion_distance),
                                     factor.matrixL().solve(Eigen::Matrix3d::Identity())});
    }
  }
  group(layout.second_order, options.second_order, sensor.second_order_std, zero);
  if (motion) {
    group(layout.clock_offset, options.clock_offset, 0.0, Eigen::VectorXd::Zero(1));
  }
  if (layout.clock_offset >= 0) {
    group(layout.clock_rate, options.clock_rate, 0.0, Eigen::VectorXd::Ones(1));
  }
  claim_encoder_errors(problem, state, moves, options);
  if (problem.rows.channels == 6) {
    group(layout.gyroscope_bias, options.gyroscope_bias, 0.0, zero);
    Eigen::VectorXd identity(9);
    identity << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    group(layout.gyroscope_matrix, options.gyroscope_matrix, 0.0, identity);
    group(layout.gyroscope_delay, options.gyroscope_delay, 0.0, Eigen::VectorXd::Zero(1));
  }
}

void hold_fixed(ArmState& state, const ArmLayout& layout, const AccelerometerSpecification& sensor) {
  const auto reset = [](Index column, Eigen::Vector3d& value, double nominal) {
    if (column < 0) {
      value.setConstant(nominal);
    }
  };
  reset(layout.bias, state.sensor.bias, 0.0);
  reset(layout.scale, state.sensor.scale, 0.0);
  reset(layout.misalignment, state.sensor.misalignment, 0.0);
  reset(layout.percussion_distance, state.sensor.percussion_distance, sensor.percussion_distance);
  reset(layout.second_order, state.sensor.second_order, 0.0);
}

}  // namespace circlepoint
