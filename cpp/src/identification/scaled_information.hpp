#pragma once
// An information matrix scaled to a diagonal of one, so that parameters of any units are of one size, and factored.

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace circlepoint {

class ScaledInformation {
 public:
  // `added` to the scaled diagonal keeps the inverse of a singular matrix finite.
  explicit ScaledInformation(const Eigen::MatrixXd& information, double added = 0.0)
      : root_(information.diagonal().cwiseMax(1e-300).cwiseSqrt()) {
    Eigen::MatrixXd scaled = root_.cwiseInverse().asDiagonal() * information * root_.cwiseInverse().asDiagonal();
    scaled.diagonal().array() += added;
    factor_.compute(scaled);
  }

  [[nodiscard]] double log_determinant() const {
    return factor_.vectorD().array().max(1e-300).log().sum() + 2.0 * root_.array().log().sum();
  }
  [[nodiscard]] Eigen::MatrixXd inverse() const {
    const Eigen::MatrixXd inverted = factor_.solve(Eigen::MatrixXd::Identity(root_.size(), root_.size()));
    return root_.cwiseInverse().asDiagonal() * inverted * root_.cwiseInverse().asDiagonal();
  }

 private:
  Eigen::VectorXd root_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace circlepoint
