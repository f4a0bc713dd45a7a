#include "joint_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"

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

// The direction a prismatic joint's fit gives up for one radian or metre by which another joint yields in step with it: gravity
// tilts, and the sensor accelerates, in proportion to the joint's own acceleration and travel.
Eigen::Matrix<double, 2, 2> direction_by_yield(const Placed& placed, const ScrewAxis& axis, const ScrewAxis& other, const TestFit& fit) {
  const double acceleration = std::max(fit.acceleration_rms, 1e-9);
  const double travel = std::max(std::sqrt((fit.position.array() - fit.position.mean()).square().mean()), 1e-9);
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(axis.line.direction);
  const bool turns = other.type == JointType::revolute;
  const Eigen::Vector3d& z = other.line.direction;
  const Eigen::Vector3d tilt = turns ? Eigen::Vector3d(z.cross(placed.chain.up_gravity) / acceleration) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d shift = (turns ? Eigen::Vector3d(-z.cross(other.line.point)) : z) / travel;
  Eigen::Matrix2d effects;
  effects << basis.transpose() * tilt, basis.transpose() * shift;
  return effects;
}

// What the encoders do not resolve: the joints beyond stand within half a count of where they say (carrying), and any other
// joint may yield by as much in step with the test (tilt, and acceleration): three independent errors of resolution/sqrt(12).
// Unknown joints that stand off the reference by little add that offset as it is.
// Where yielding is not corrected, it adds as much as the encoders saw.
Eigen::Matrix4d pose_uncertainty(const Placed& placed, std::size_t i, const TestFit& fit, const Eigen::VectorXd& resolution,
                                 const Eigen::VectorXd& uncorrected_yield) {
  const ScrewAxis& axis = *placed.chain.axes[i];
  const bool slides = axis.type == JointType::prismatic;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (std::size_t j = 0; j < placed.axes.size(); ++j) {
    const auto joint = static_cast<Index>(j);
    if (j == i) {
      continue;
    }
    const double step = resolution[joint] * resolution[joint] / 12.0;
    const double yield = uncorrected_yield[joint] * uncorrected_yield[joint];
    if (placed.chain.axes[j]) {
      const ScrewAxis& other = *placed.chain.axes[j];
      const Eigen::Vector4d turn = turn_about(axis, other);
      sum += (slides ? step : 3.0 * step + yield) * turn * turn.transpose();
      if (slides) {
        const Eigen::Matrix2d effects = direction_by_yield(placed, axis, other, fit);
        sum.topLeftCorner<2, 2>() += (step + yield) * effects * effects.transpose();
      }
    } else if (j > i) {
      const double offset = placed.configurations[i][joint] - placed.chain.reference_configuration[joint];
      const double reach = axis.line.point.norm() + 0.5;
      const Eigen::Vector4d turned(offset, offset, offset * reach, offset * reach);
      const Eigen::Vector4d shifted(0.0, 0.0, offset, offset);
      sum.diagonal() += (placed.types[j] == JointType::prismatic ? shifted : turned).cwiseAbs2();
    }
  }
  if (slides) {
    sum.bottomRows<2>().setZero();
    sum.rightCols<2>().setZero();
  }
  return sum;
}

}  // namespace

PartialChain carry_all(const std::vector<std::optional<ScrewAxis>>& axes, const std::vector<Eigen::VectorXd>& configurations,
                       const Eigen::VectorXd& reference) {
  PartialChain chain;
  chain.reference_configuration = reference;
  chain.axes.resize(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    if (axes[i]) {
      const RigidTransform carry = carry_to_reference(chain, static_cast<Index>(i), configurations[i]);
      chain.axes[i] = transform(carry, *axes[i]);
      if (axes[i]->type == JointType::prismatic) {
        chain.axes[i]->line.point.setZero();
      }
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
    if (placed.axes[i]) {
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
    if (!placed.axes[moved]) {
      continue;
    }
    std::array<PartialChain, 2> chains;
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<std::optional<ScrewAxis>> axes = placed.axes;
      axes[moved]->line = retract(axes[moved]->line, (side == 0 ? step : -step) * Eigen::Vector4d::Unit(column % 4));
      chains[side] = carry_all(axes, placed.configurations, placed.chain.reference_configuration);
    }
    for (std::size_t i = 0; i <= moved; ++i) {
      if (placed.axes[i]) {
        const Line& here = placed.chain.axes[i]->line;
        carrying.block<4, 1>(4 * static_cast<Index>(i), column) =
            (local_coordinates(here, chains[0].axes[i]->line) - local_coordinates(here, chains[1].axes[i]->line)) / (2.0 * step);
      }
    }
  }
  Eigen::MatrixXd covariance = carrying * at_tests * carrying.transpose();
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (placed.axes[i]) {
      const Eigen::VectorXd left =
          yielding_corrected ? Eigen::VectorXd::Zero(joints) : yield_rms(*work[i].samples);
      covariance.block<4, 4>(4 * static_cast<Index>(i), 4 * static_cast<Index>(i)) += pose_uncertainty(placed, i, work[i].fitted->fit, resolution, left);
    }
  }
  return covariance;
}

}  // namespace circlepoint
