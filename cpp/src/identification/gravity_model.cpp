#include "circlepoint/identification/gravity_model.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

Eigen::Matrix<double, Eigen::Dynamic, 3> regressors_of(const Eigen::Ref<const Eigen::VectorXd>& angle) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> regressors(angle.size(), 3);
  regressors << Eigen::VectorXd::Ones(angle.size()), angle.array().cos().matrix(), angle.array().sin().matrix();
  return regressors;
}

}  // namespace

Samples3 GravityModel::evaluate(const Eigen::Ref<const Eigen::VectorXd>& angle) const {
  Eigen::Matrix3d coefficients;
  coefficients << constant.transpose(), cosine.transpose(), sine.transpose();
  return regressors_of(angle) * coefficients;
}

GravityModel fit_gravity_model(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Samples3>& specific_force) {
  require(angle.size() == specific_force.rows(), "angle has " + std::to_string(angle.size()) + " entries for " +
                                                     std::to_string(specific_force.rows()) + " poses; give one per pose");
  const Eigen::Matrix<double, Eigen::Dynamic, 3> regressors = regressors_of(angle);
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(regressors);
  qr.setThreshold(1e-4);
  if (angle.size() < 3 || qr.rank() < 3) {
    throw NotIdentifiable("the gravity model needs static poses at three distinct angles of the joint, got " +
                          std::to_string(angle.size()) + " poses over " +
                          std::to_string(angle.size() > 0 ? angle.maxCoeff() - angle.minCoeff() : 0.0) +
                          " rad; hold the joint still at more angles, further apart");
  }
  const Eigen::Matrix3d coefficients = qr.solve(Eigen::MatrixXd(specific_force));
  const Eigen::MatrixXd residual = specific_force - regressors * coefficients;
  GravityModel model;
  model.constant = coefficients.row(0);
  model.cosine = coefficients.row(1);
  model.sine = coefficients.row(2);
  const double dof = std::max(1.0, static_cast<double>(3 * (angle.size() - 3)));
  model.residual_std = std::sqrt(residual.squaredNorm() / dof);
  model.covariance = model.residual_std * model.residual_std * (regressors.transpose() * regressors).inverse();
  return model;
}

}  // namespace circlepoint
