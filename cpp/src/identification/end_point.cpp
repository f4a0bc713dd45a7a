#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "arm_state.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "circlepoint/identification/whole_arm.hpp"

namespace circlepoint {
namespace {

// How the end-point moves with what a chain is made of, by central differences.
class EndPointJacobian {
 public:
  explicit EndPointJacobian(const ScrewChain& chain) : chain_(chain), nudged_(static_cast<std::size_t>(4 * chain.size()), {chain, chain}) {
    for (std::size_t k = 0; k < nudged_.size(); ++k) {
      for (std::size_t side = 0; side < 2; ++side) {
        Line& line = nudged_[k][side].axes[k / 4].line;
        line = retract(line, (side == 0 ? step : -step) * Eigen::Vector4d::Unit(static_cast<Index>(k % 4)));
      }
    }
  }

  // (3, 4n): by the lines' local coordinates.
  [[nodiscard]] Eigen::Matrix3Xd by_lines(const Eigen::VectorXd& q) const {
    Eigen::Matrix3Xd jacobian(3, 4 * chain_.size());
    for (Index k = 0; k < jacobian.cols(); ++k) {
      const auto& pair = nudged_[static_cast<std::size_t>(k)];
      jacobian.col(k) = difference(forward_kinematics(pair[0], q), forward_kinematics(pair[1], q));
    }
    return jacobian;
  }

  // By the position of a joint.
  [[nodiscard]] Eigen::Vector3d by_position(const Eigen::VectorXd& q, Index joint) const {
    const Eigen::VectorXd nudge = step * Eigen::VectorXd::Unit(q.size(), joint);
    return difference(forward_kinematics(chain_, q + nudge), forward_kinematics(chain_, q - nudge));
  }

 private:
  static constexpr double step = 1e-6;

  static Eigen::Vector3d difference(const Eigen::Isometry3d& up, const Eigen::Isometry3d& down) {
    return (up.translation() - down.translation()) / (2.0 * step);
  }

  ScrewChain chain_;
  std::vector<std::array<ScrewChain, 2>> nudged_;  // either way along each local coordinate
};

double spread(const Eigen::Matrix3Xd& jacobian, const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  return std::sqrt(std::max(0.0, (jacobian * covariance * jacobian.transpose()).trace()));
}

Index column_of(const WholeArmCalibration& calibration, Index joint, const char* coordinate) {
  const std::string name = "joint" + std::to_string(joint + 1) + "." + coordinate;
  const auto& parameters = calibration.parameters;
  const auto found = std::ranges::find(parameters, name, &NamedParameter::name);
  return found == parameters.end() ? -1 : found - parameters.begin();
}

// What of the estimate moves the end-point: a column, of a line's local coordinate or of an encoder's error.
struct Movers {
  struct Encoder {
    Index column;
    Index joint;
    double (*shift)(double q);
  };
  std::vector<std::array<Index, 2>> lines;  // column, local coordinate of all lines
  std::vector<Encoder> encoders;
};

Movers movers(const WholeArmCalibration& calibration) {
  Movers found;
  for (Index joint = 0; joint < static_cast<Index>(calibration.joints.joints.size()); ++joint) {
    for (std::size_t k = 0; k < line_coordinates.size(); ++k) {
      if (const Index column = column_of(calibration, joint, line_coordinates[k]); column >= 0) {
        found.lines.push_back({column, 4 * joint + static_cast<Index>(k)});
      }
    }
    const auto encoder = [&](const char* error, double (*shift)(double)) {
      if (const Index column = column_of(calibration, joint, error); column >= 0) {
        found.encoders.push_back({column, joint, shift});
      }
    };
    encoder("gain", [](double q) { return q; });
    encoder("eccentricity_cos", [](double q) { return std::cos(q); });
    encoder("eccentricity_sin", [](double q) { return std::sin(q); });
  }
  return found;
}

}  // namespace

Eigen::VectorXd end_point_std(const ScrewChain& chain, const Eigen::Ref<const Eigen::MatrixXd>& line_covariance,
                              const Eigen::Ref<const SamplesX>& configurations) {
  const Index parameters = 4 * chain.size();
  require(line_covariance.rows() == parameters && line_covariance.cols() == parameters,
          "line_covariance is " + std::to_string(line_covariance.rows()) + "x" + std::to_string(line_covariance.cols()) + " for " +
              std::to_string(chain.size()) + " joints; give " + std::to_string(parameters) + "x" + std::to_string(parameters));
  const EndPointJacobian jacobian(chain);
  Eigen::VectorXd std(configurations.rows());
  for (Index i = 0; i < configurations.rows(); ++i) {
    std[i] = spread(jacobian.by_lines(configurations.row(i)), line_covariance);
  }
  return std;
}

Eigen::VectorXd end_point_std(const WholeArmCalibration& calibration, const Eigen::Ref<const SamplesX>& configurations) {
  const ScrewChain chain = calibration.joints.chain();
  if (calibration.parameters.empty()) {
    return end_point_std(chain, calibration.joints.covariance, configurations);
  }
  const Movers moving = movers(calibration);
  const EndPointJacobian of_chain(chain);
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, calibration.covariance.rows());
  Eigen::VectorXd std(configurations.rows());
  for (Index i = 0; i < configurations.rows(); ++i) {
    const Eigen::VectorXd q = configurations.row(i);
    const Eigen::Matrix3Xd by_lines = of_chain.by_lines(q);
    for (const auto& [column, coordinate] : moving.lines) {
      jacobian.col(column) = by_lines.col(coordinate);
    }
    for (const auto& [column, joint, shift] : moving.encoders) {
      jacobian.col(column) = of_chain.by_position(q, joint) * (shift(q[joint]) - shift(chain.reference_configuration[joint]));
    }
    std[i] = spread(jacobian, calibration.covariance);
  }
  return std;
}

}  // namespace circlepoint
