#include <array>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/identification/joint_calibration.hpp"

namespace circlepoint {

Eigen::VectorXd end_point_std(const ScrewChain& chain, const Eigen::Ref<const Eigen::MatrixXd>& line_covariance,
                              const Eigen::Ref<const SamplesX>& configurations) {
  const Index parameters = 4 * chain.size();
  require(line_covariance.rows() == parameters && line_covariance.cols() == parameters,
          "line_covariance is " + std::to_string(line_covariance.rows()) + "x" + std::to_string(line_covariance.cols()) + " for " +
              std::to_string(chain.size()) + " joints; give " + std::to_string(parameters) + "x" + std::to_string(parameters));
  constexpr double step = 1e-6;
  std::vector<std::array<ScrewChain, 2>> nudged(static_cast<std::size_t>(parameters), {chain, chain});
  for (Index k = 0; k < parameters; ++k) {
    for (std::size_t side = 0; side < 2; ++side) {
      Line& line = nudged[static_cast<std::size_t>(k)][side].axes[static_cast<std::size_t>(k / 4)].line;
      line = retract(line, (side == 0 ? step : -step) * Eigen::Vector4d::Unit(k % 4));
    }
  }
  Eigen::VectorXd std(configurations.rows());
  Eigen::MatrixXd jacobian(3, parameters);
  for (Index i = 0; i < configurations.rows(); ++i) {
    const Eigen::VectorXd q = configurations.row(i);
    for (Index k = 0; k < parameters; ++k) {
      const auto& pair = nudged[static_cast<std::size_t>(k)];
      jacobian.col(k) = (forward_kinematics(pair[0], q).translation() - forward_kinematics(pair[1], q).translation()) / (2.0 * step);
    }
    std[i] = std::sqrt(std::max(0.0, (jacobian * line_covariance * jacobian.transpose()).trace()));
  }
  return std;
}

}  // namespace circlepoint
