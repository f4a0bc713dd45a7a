#include "circlepoint/campaign/comparison.hpp"

#include <array>
#include <cmath>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

constexpr double chart_ends = 0.1;  // cosine of the angle between two directions

void require_joints(Index estimated, Index true_joints) {
  require(estimated == true_joints, "the estimate has " + std::to_string(estimated) + " joints, the truth " +
                                        std::to_string(true_joints) + "; compare an arm with itself");
}

// Local coordinates of the truth at the estimate, also where the chart does not reach.
Eigen::Vector4d difference(const Line& estimate, const Line& truth) {
  if (estimate.direction.dot(truth.direction) > chart_ends) {
    return local_coordinates(estimate, truth);
  }
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(estimate.direction);
  const double angle =
      std::atan2(estimate.direction.cross(truth.direction).norm(), estimate.direction.dot(truth.direction));
  const Eigen::Vector2d across = basis.transpose() * truth.direction;
  Eigen::Vector4d local;
  local.head<2>() = across.norm() > 0.0 ? Eigen::Vector2d(angle * across.normalized()) : Eigen::Vector2d(angle, 0.0);
  local.tail<2>() = basis.transpose() * (truth.point - estimate.point);
  return local;
}

double normalised_square(const Eigen::Vector4d& error, const Eigen::Matrix4d& covariance, JointType type) {
  const Index freedoms = type == JointType::revolute ? 4 : 2;
  // d in rad and p in m differ in size: scaled, the matrix is as well conditioned as its correlations.
  const Eigen::VectorXd std = covariance.diagonal().head(freedoms).cwiseMax(0.0).cwiseSqrt();
  if (!(std.minCoeff() > 0.0)) {
    return not_compared;
  }
  const Eigen::MatrixXd correlation =
      std.cwiseInverse().asDiagonal() * covariance.topLeftCorner(freedoms, freedoms) * std.cwiseInverse().asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation);
  if (factor.info() != Eigen::Success) {
    return not_compared;
  }
  const Eigen::VectorXd scaled = error.head(freedoms).cwiseQuotient(std);
  return factor.matrixL().solve(scaled).squaredNorm() / static_cast<double>(freedoms);
}

LineComparison compare(const JointAxis& estimate, const ScrewAxis& truth) {
  const Line& line = estimate.screw.line;
  Eigen::Vector4d error = -difference(line, truth.line);
  if (truth.type == JointType::prismatic) {
    error.tail<2>().setZero();
  }
  const double nees = normalised_square(error, estimate.covariance, truth.type);
  // From the estimate's tangent basis to the truth's: the two planes are parallel to first order.
  Eigen::Matrix2d rotation = tangent_basis(truth.line.direction).transpose() * tangent_basis(line.direction);
  rotation.col(0).normalize();
  rotation.col(1) = Eigen::Vector2d(-rotation(1, 0), rotation(0, 0));
  LineComparison comparison;
  comparison.nees = nees;
  for (const Index at : {Index{0}, Index{2}}) {
    comparison.error.segment<2>(at) = rotation * error.segment<2>(at);
    const Eigen::Matrix2d turned = rotation * estimate.covariance.block<2, 2>(at, at) * rotation.transpose();
    comparison.std.segment<2>(at) = turned.diagonal().cwiseMax(0.0).cwiseSqrt();
  }
  return comparison;
}

}  // namespace

const std::vector<std::string>& sensor_figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto* group : {"bias", "scale", "misalignment", "percussion_distance", "second_order"}) {
      const bool skew = std::string(group) == "misalignment";
      for (const auto* suffix : skew ? std::array{"yx", "zx", "zy"} : std::array{"x", "y", "z"}) {
        all.push_back(std::string(group) + "_" + suffix);
      }
    }
    return all;
  }();
  return names;
}

std::vector<LineComparison> compare_lines(const JointCalibration& calibration, const ScrewChain& truth) {
  require_joints(static_cast<Index>(calibration.joints.size()), truth.size());
  const ScrewChain carried = rebase(truth, calibration.reference_configuration);
  std::vector<LineComparison> comparisons;
  comparisons.reserve(calibration.joints.size());
  for (std::size_t joint = 0; joint < calibration.joints.size(); ++joint) {
    const std::optional<JointAxis>& axis = calibration.joints[joint].axis;
    comparisons.push_back(axis ? compare(*axis, carried.axes[joint]) : LineComparison{});
  }
  return comparisons;
}

SensorComparison compare_sensor(const JointCalibration& calibration, const AccelerometerModel& truth) {
  const AccelerometerModel& estimate = calibration.sensor.sensor;
  SensorComparison comparison;
  comparison.error << estimate.bias - truth.bias, estimate.scale - truth.scale,
      estimate.misalignment - truth.misalignment, calibration.percussion_distance - truth.percussion_distance,
      estimate.second_order - truth.second_order;
  const Eigen::Matrix<double, sensor_errors, 1> std =
      calibration.sensor.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  comparison.std << std.head<9>(), calibration.percussion_distance_std, std.tail<3>();
  return comparison;
}

double end_point_error(const ScrewChain& estimate, const ScrewChain& truth,
                       const Eigen::Ref<const SamplesX>& configurations) {
  require_joints(estimate.size(), truth.size());
  require(configurations.rows() > 0, "there are no configurations to compare at; give one at least");
  const ScrewChain carried = rebase(truth, estimate.reference_configuration);
  double sum = 0.0;
  for (Index i = 0; i < configurations.rows(); ++i) {
    const Eigen::VectorXd q = configurations.row(i);
    sum += (forward_kinematics(estimate, q).translation() - forward_kinematics(carried, q).translation()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(configurations.rows()));
}

}  // namespace circlepoint
