#include "joint_work.hpp"

#include <algorithm>
#include <array>

#include "circlepoint/geometry/joint_axis.hpp"

namespace circlepoint {
namespace {

// Rotating line i about line j by one radian, in line i's local coordinates.
Eigen::Vector4d turn_about(const ScrewAxis& axis, const ScrewAxis& about) {
  constexpr double step = 1e-6;
  return local_coordinates(axis.line, transform(screw_exp(about, step), axis.line)) / step;
}

// Root mean square by which every joint stood off the test's configuration, for methods that do not correct for it.
Eigen::VectorXd yield_rms(const TestSamples& samples) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(samples.configuration.size());
  double count = 0.0;
  const auto add = [&](const SamplesX& position) {
    squares += (position.rowwise() - samples.configuration.transpose()).colwise().squaredNorm().transpose();
    count += static_cast<double>(position.rows());
  };
  add(samples.dwell_positions);
  for (const MotionSamples& motion : samples.motions) {
    add(motion.position);
  }
  return (squares / std::max(count, 1.0)).cwiseSqrt();
}

// What the encoders do not resolve: the joints beyond stand within half a count of where they say (carrying), and any other
// joint may yield by as much in step with the test (tilt, and acceleration): three independent errors of resolution/sqrt(12).
// Unknown joints that stand off the reference by little add that offset as it is.
// Where yielding is not corrected, it adds as much as the encoders saw.
Eigen::Matrix4d pose_uncertainty(const Placed& placed, std::size_t i, const Eigen::VectorXd& resolution,
                                 const Eigen::VectorXd& uncorrected_yield) {
  const ScrewAxis& axis = *placed.chain.axes[i];
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (std::size_t j = 0; j < placed.lines.size(); ++j) {
    const auto joint = static_cast<Index>(j);
    if (j == i) {
      continue;
    }
    if (placed.chain.axes[j]) {
      const Eigen::Vector4d turn = turn_about(axis, *placed.chain.axes[j]);
      const double variance = 3.0 * resolution[joint] * resolution[joint] / 12.0 + uncorrected_yield[joint] * uncorrected_yield[joint];
      sum += variance * turn * turn.transpose();
    } else if (j > i) {
      const double offset = placed.configurations[i][joint] - placed.chain.reference_configuration[joint];
      const double reach = axis.line.point.norm() + 0.5;
      const Eigen::Vector4d scale(offset, offset, offset * reach, offset * reach);
      sum.diagonal() += scale.cwiseAbs2();
    }
  }
  return sum;
}

}  // namespace

PartialChain carry_all(const std::vector<std::optional<Line>>& lines, const std::vector<Eigen::VectorXd>& configurations,
                       const Eigen::VectorXd& reference) {
  PartialChain chain;
  chain.reference_configuration = reference;
  chain.axes.resize(lines.size());
  for (std::size_t i = lines.size(); i-- > 0;) {
    if (lines[i]) {
      const RigidTransform carry = carry_to_reference(chain, static_cast<Index>(i), configurations[i]);
      chain.axes[i] = transform(carry, ScrewAxis{JointType::revolute, *lines[i]});
    }
  }
  return chain;
}

Eigen::MatrixXd covariance_at_reference(const std::vector<JointWork>& work, const Placed& placed, const SensorFromGravity& sensor,
                                        const Eigen::VectorXd& resolution, bool yielding_corrected) {
  const auto joints = static_cast<Index>(work.size());
  Eigen::MatrixXd at_tests = Eigen::MatrixXd::Zero(4 * joints, 4 * joints);
  Eigen::MatrixXd by_sensor = Eigen::MatrixXd::Zero(4 * joints, sensor_errors);
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (placed.lines[i]) {
      const auto at = 4 * static_cast<Index>(i);
      at_tests.block<4, 4>(at, at) = work[i].fitted->fit.noise_covariance;
      by_sensor.middleRows<4>(at) = work[i].fitted->sensor_jacobian;
    }
  }
  at_tests += by_sensor * sensor.covariance * by_sensor.transpose();
  // Central differences of the carrying by every line at its test.
  constexpr double step = 1e-6;
  Eigen::MatrixXd carrying = Eigen::MatrixXd::Zero(4 * joints, 4 * joints);
  for (Index column = 0; column < 4 * joints; ++column) {
    const auto moved = static_cast<std::size_t>(column / 4);
    if (!placed.lines[moved]) {
      continue;
    }
    std::array<PartialChain, 2> chains;
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<std::optional<Line>> lines = placed.lines;
      lines[moved] = retract(*lines[moved], (side == 0 ? step : -step) * Eigen::Vector4d::Unit(column % 4));
      chains[side] = carry_all(lines, placed.configurations, placed.chain.reference_configuration);
    }
    for (std::size_t i = 0; i <= moved; ++i) {
      if (placed.lines[i]) {
        const Line& here = placed.chain.axes[i]->line;
        carrying.block<4, 1>(4 * static_cast<Index>(i), column) =
            (local_coordinates(here, chains[0].axes[i]->line) - local_coordinates(here, chains[1].axes[i]->line)) / (2.0 * step);
      }
    }
  }
  Eigen::MatrixXd covariance = carrying * at_tests * carrying.transpose();
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (placed.lines[i]) {
      const Eigen::VectorXd left =
          yielding_corrected ? Eigen::VectorXd::Zero(joints) : yield_rms(*work[i].samples);
      covariance.block<4, 4>(4 * static_cast<Index>(i), 4 * static_cast<Index>(i)) += pose_uncertainty(placed, i, resolution, left);
    }
  }
  return covariance;
}

}  // namespace circlepoint
