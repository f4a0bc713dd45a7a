#include "circlepoint/identification/joint_regression.hpp"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "regression_kernels.hpp"

namespace circlepoint {
namespace {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// The chart: everything is expressed in [u v z0] at the start and turned by Exp(u p0 + v p1 as a shift of z).
struct Chart {
  Eigen::Vector3d z0;
  Eigen::Matrix<double, 3, 2> basis;

  explicit Chart(const Eigen::Vector3d& axis) : z0(axis), basis(tangent_basis(axis)) {}

  template <typename T>
  struct Point {
    Vector3<T> z, gravity, lever, constant, percussion_distance;
  };

  template <typename T>
  Point<T> operator()(const T* p) const {
    // Rotation by the vector z0 x shift, written out so that its derivative at zero is exact.
    const Vector3<T> shift = basis.cast<T>() * Eigen::Map<const Eigen::Matrix<T, 2, 1>>(p);
    const Vector3<T> axis = z0.cast<T>().cross(shift);
    const T squared = axis.squaredNorm();
    T a = T(1.0) - squared / T(6.0);
    T b = T(0.5) - squared / T(24.0);
    if (squared > T(1e-8)) {
      using std::cos;
      using std::sin;
      using std::sqrt;
      const T angle = sqrt(squared);
      a = sin(angle) / angle;
      b = (T(1.0) - cos(angle)) / squared;
    }
    const auto rotate = [&](const Vector3<T>& v) -> Vector3<T> {
      const Vector3<T> once = axis.cross(v);
      return v + a * once + b * axis.cross(once);
    };
    Point<T> point;
    point.z = rotate(z0.cast<T>());
    point.gravity = rotate(basis.cast<T>() * Eigen::Map<const Eigen::Matrix<T, 2, 1>>(p + 2));
    point.lever = rotate(basis.cast<T>() * Eigen::Map<const Eigen::Matrix<T, 2, 1>>(p + 4));
    point.constant = Eigen::Map<const Vector3<T>>(p + 6);
    point.percussion_distance = Eigen::Map<const Vector3<T>>(p + 9);
    return point;
  }
};

template <typename T>
Eigen::Matrix<T, 5, 3> coefficients_of(const Chart::Point<T>& m) {
  Eigen::Matrix<T, 5, 3> rows;
  rows.row(0) = m.constant;
  rows.row(1) = m.gravity;
  rows.row(2) = -m.z.cross(m.gravity);
  rows.row(3) = m.z.cross(m.lever);
  rows.row(4) = (-m.lever.array() - m.percussion_distance.array() * (T(1.0) - m.z.array().square())).matrix();
  return rows;
}

// (W coefficients - target), W^T W the information: the whole test in 15 residuals.
struct WhitenedTest {
  Matrix5 whitener;
  Matrix53 target;
  Chart chart;

  template <typename T>
  bool operator()(const T* p, T* residuals) const {
    const Eigen::Matrix<T, 5, 3> difference = whitener.cast<T>() * coefficients_of(chart(p)) - target.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 5, 3>>(residuals, 5, 3) = difference;
    return true;
  }
};

struct PriorResidual {
  JointModelPrior prior;
  Chart chart;

  template <typename T>
  bool operator()(const T* p, T* residuals) const {
    using std::sqrt;
    const Chart::Point<T> m = chart(p);
    const T along = m.z.dot(m.constant);
    const Vector3<T> bias = m.constant - along * m.z;
    for (int k = 0; k < 3; ++k) {
      residuals[k] = bias[k] / prior.bias_std;
    }
    residuals[3] = (sqrt(m.gravity.squaredNorm() + along * along + T(1e-12)) - prior.gravity) / prior.gravity_std;
    const double distance_std = std::max(prior.percussion_distance_std, 1e-9);
    const T mean = m.percussion_distance.sum() / T(3.0);
    residuals[4] = (mean - prior.percussion_distance) / distance_std;
    for (int k = 0; k < 3; ++k) {
      residuals[5 + k] = (m.percussion_distance[k] - mean) / std::min(distance_std, channel_spread_std);
    }
    return true;
  }
};

struct Whitened {
  Matrix5 whitener;
  Matrix53 target;
  Matrix53 coefficients;  // minimum-norm least-squares solution
};

Whitened whiten(const RegressionStatistics& statistics) {
  // Regressors differ by orders of magnitude (alpha, w^2 against 1): balance before deciding what is rank.
  const Eigen::Matrix<double, 5, 1> root = statistics.information.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const Matrix5 balanced = root.cwiseInverse().asDiagonal() * statistics.information * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix5> solver(balanced);
  Whitened whitened;
  whitened.whitener.setZero();
  Matrix5 inverse = Matrix5::Zero();
  for (int k = 0; k < 5; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value < 1e-12) {
      continue;
    }
    const Eigen::Matrix<double, 5, 1> vector = solver.eigenvectors().col(k);
    whitened.whitener.row(k) = std::sqrt(value) * vector.transpose() * root.asDiagonal();
    inverse.row(k) = vector.transpose() * root.cwiseInverse().asDiagonal() / std::sqrt(value);
  }
  whitened.target = inverse * statistics.score;
  whitened.coefficients = inverse.transpose() * whitened.target;
  return whitened;
}

// Axis directions worth starting from: by the turning of gravity, by tangential against centripetal, along the constant part.
std::vector<Eigen::Vector3d> candidate_axes(const Matrix53& coefficients) {
  const Eigen::Vector3d constant = coefficients.row(0);
  const Eigen::Vector3d cosine = coefficients.row(1);
  const Eigen::Vector3d sine = coefficients.row(2);
  const Eigen::Vector3d tangential = coefficients.row(3);
  const Eigen::Vector3d centripetal = coefficients.row(4);
  std::vector<Eigen::Vector3d> axes;
  const auto add = [&](const Eigen::Vector3d& v) {
    if (v.norm() > 1e-9) {
      axes.emplace_back(v.normalized());
    }
  };
  add(sine.cross(cosine));
  add(tangential.cross(centripetal));
  add(constant);
  add(-constant);
  return axes;
}

// A place in the model's chart and how it was reached.
struct Descent {
  Chart chart;
  std::array<double, joint_model_parameters> p{};
  double cost = 0.0;
  int iterations = 0;
  bool converged = false;
};

Descent start_at(const Whitened& whitened, const JointModelPrior& prior, const Eigen::Vector3d& axis) {
  Descent start{Chart(axis)};
  const Eigen::Vector3d cosine = whitened.coefficients.row(1);
  const Eigen::Vector3d sine = whitened.coefficients.row(2);
  const Eigen::Vector3d tangential = whitened.coefficients.row(3);
  const Eigen::Matrix<double, 2, 3> in_plane = start.chart.basis.transpose();
  Eigen::Map<Eigen::Vector2d>(start.p.data() + 2) = in_plane * (0.5 * (cosine + axis.cross(sine)));
  Eigen::Map<Eigen::Vector2d>(start.p.data() + 4) = in_plane * tangential.cross(axis);
  Eigen::Map<Eigen::Vector3d>(start.p.data() + 6) = whitened.coefficients.row(0);
  Eigen::Map<Eigen::Vector3d>(start.p.data() + 9).setConstant(prior.percussion_distance);
  return start;
}

void descend(Descent& descent, const Whitened& whitened, const JointModelPrior& prior, int max_iterations) {
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<WhitenedTest, 15, joint_model_parameters>(
                               new WhitenedTest{whitened.whitener, whitened.target, descent.chart}),
                           nullptr, descent.p.data());
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PriorResidual, 8, joint_model_parameters>(new PriorResidual{prior, descent.chart}), nullptr,
      descent.p.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 1e-13;
  options.gradient_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  descent.cost = summary.final_cost;
  descent.iterations += static_cast<int>(summary.iterations.size());
  descent.converged = summary.termination_type == ceres::CONVERGENCE;
}

JointModelFit described(const Descent& descent) {
  const Chart::Point<double> found = descent.chart(descent.p.data());
  JointModelFit fit;
  fit.model = {found.z.normalized(), found.lever, found.gravity, found.constant, found.percussion_distance};
  fit.cost = descent.cost;
  fit.iterations = descent.iterations;
  fit.converged = descent.converged;
  return fit;
}

// Derivatives at the solution in a chart centred there, so that its first six parameters are tangent-plane coordinates.
void describe_at_solution(JointModelFit& fit, const Whitened& whitened, const JointModelPrior& prior) {
  using Jet = ceres::Jet<double, joint_model_parameters>;
  const Chart chart(fit.model.axis);
  std::array<Jet, joint_model_parameters> p;
  Eigen::Matrix<double, joint_model_parameters, 1> value;
  value << 0.0, 0.0, chart.basis.transpose() * fit.model.gravity, chart.basis.transpose() * fit.model.lever, fit.model.constant,
      fit.model.percussion_distance;
  for (int k = 0; k < joint_model_parameters; ++k) {
    p[static_cast<std::size_t>(k)] = Jet(value[k], k);
  }
  const Eigen::Matrix<Jet, 5, 3> coefficients = coefficients_of(chart(p.data()));
  for (int channel = 0; channel < 3; ++channel) {
    for (int row = 0; row < 5; ++row) {
      fit.jacobian.row(5 * channel + row) = coefficients(row, channel).v.transpose();
    }
  }
  fit.data_information.setZero();
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::Matrix<double, 5, joint_model_parameters> block = whitened.whitener * fit.jacobian.middleRows<5>(5 * channel);
    fit.data_information += block.transpose() * block;
  }
  std::array<Jet, 8> residuals;
  PriorResidual{prior, chart}(p.data(), residuals.data());
  fit.information = fit.data_information;
  for (const Jet& residual : residuals) {
    fit.information += residual.v * residual.v.transpose();
  }
}

void require_equal_lengths(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Eigen::VectorXd>& rate,
                           const Eigen::Ref<const Eigen::VectorXd>& acceleration) {
  require(rate.size() == angle.size() && acceleration.size() == angle.size(),
          "angle, rate and acceleration have " + std::to_string(angle.size()) + ", " + std::to_string(rate.size()) + " and " +
              std::to_string(acceleration.size()) + " samples; give one of each per sample");
}

// The sums as matrices, of readings turned by `rotation`.
RegressionStatistics statistics_of(const detail::RegressionSums& sums, Index samples, const Eigen::Matrix3d& rotation) {
  RegressionStatistics statistics;
  for (int k = 0, entry = 0; k < 5; ++k) {
    for (int l = k; l < 5; ++l, ++entry) {
      statistics.information(k, l) = statistics.information(l, k) = sums.information[entry];
    }
  }
  Eigen::Matrix3d squares;
  squares << sums.squares[0], sums.squares[1], sums.squares[2],  //
      sums.squares[1], sums.squares[3], sums.squares[4],         //
      sums.squares[2], sums.squares[4], sums.squares[5];
  statistics.score = Eigen::Map<const Eigen::Matrix<double, 5, 3, Eigen::RowMajor>>(sums.score);
  if (!rotation.isIdentity(0.0)) {
    statistics.score *= rotation.transpose();
    squares = rotation * squares * rotation.transpose();
  }
  statistics.squares = squares.diagonal();
  statistics.count = static_cast<double>(samples);
  return statistics;
}

}  // namespace

Regressors joint_regressors(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Eigen::VectorXd>& rate,
                            const Eigen::Ref<const Eigen::VectorXd>& acceleration) {
  require_equal_lengths(angle, rate, acceleration);
  Regressors regressors(angle.size(), 5);
  regressors.col(0).setOnes();
  regressors.col(1) = angle.array().cos();
  regressors.col(2) = angle.array().sin();
  regressors.col(3) = acceleration;
  regressors.col(4) = rate.array().square();
  return regressors;
}

void RegressionStatistics::add(const Eigen::Ref<const Regressors>& regressors, const Eigen::Ref<const Samples3>& readings,
                               double weight) {
  require(regressors.rows() == readings.rows(), "regressors have " + std::to_string(regressors.rows()) + " rows and readings " +
                                                    std::to_string(readings.rows()) + "; give one of each per sample");
  detail::RegressionSums sums{};
  detail::regression_kernels().add_rows(regressors.data(), regressors.outerStride(), readings.data(), readings.outerStride(),
                                        readings.rows(), &sums);
  *this += statistics_of(sums, readings.rows(), Eigen::Matrix3d::Identity()).scaled(weight);
}

RegressionStatistics joint_statistics(const Eigen::Ref<const Eigen::VectorXd>& angle, const Eigen::Ref<const Eigen::VectorXd>& rate,
                                      const Eigen::Ref<const Eigen::VectorXd>& acceleration, const Eigen::Ref<const Samples3>& readings,
                                      const Eigen::Matrix3d& rotation) {
  require_equal_lengths(angle, rate, acceleration);
  require(readings.rows() == angle.size(), "there are " + std::to_string(angle.size()) + " angles and " +
                                               std::to_string(readings.rows()) + " readings; give one of each per sample");
  const Samples3 copy = readings.outerStride() == 3 ? Samples3() : Samples3(readings);
  detail::RegressionSums sums{};
  detail::regression_kernels().add_motion(angle.data(), rate.data(), acceleration.data(),
                                          copy.size() > 0 ? copy.data() : readings.data(), angle.size(), &sums);
  return statistics_of(sums, angle.size(), rotation);
}

RegressionStatistics& RegressionStatistics::operator+=(const RegressionStatistics& other) {
  information += other.information;
  score += other.score;
  squares += other.squares;
  count += other.count;
  return *this;
}

RegressionStatistics RegressionStatistics::scaled(double weight) const {
  return {weight * information, weight * score, weight * squares, weight * count};
}

Matrix53 JointModel::coefficients() const {
  return coefficients_of(Chart::Point<double>{axis, gravity, lever, constant, percussion_distance});
}

Line JointModel::line() const { return make_line(axis, -lever); }

Eigen::Matrix<double, 4, joint_model_parameters> JointModelFit::line_selector() {
  // The line's point is minus the lever.
  Eigen::Matrix<double, 4, joint_model_parameters> selector = Eigen::Matrix<double, 4, joint_model_parameters>::Zero();
  selector.block<2, 2>(0, 0).setIdentity();
  selector.block<2, 2>(2, 4) = -Eigen::Matrix2d::Identity();
  return selector;
}

JointModelFit fit_joint_model(const RegressionStatistics& weighted, const JointModelPrior& prior) {
  require(prior.bias_std > 0.0 && prior.gravity_std > 0.0,
          "prior standard deviations must be positive: bias_std " + std::to_string(prior.bias_std) + ", gravity_std " +
              std::to_string(prior.gravity_std) + " m/s^2");
  if (!(weighted.information(3, 3) > 0.0)) {
    throw NotIdentifiable("the joint never accelerated, so the distance of its axis cannot be seen; record a motion of this "
                          "joint alone, such as eq. (11) with 0.5 Hz over 150 degrees");
  }
  const Whitened whitened = whiten(weighted);
  // A start far off may crawl for hundreds of iterations; the best after a few is the one worth finishing.
  constexpr int scouting_iterations = 12;
  constexpr int max_iterations = 200;
  std::optional<Descent> best;
  for (const Eigen::Vector3d& axis : candidate_axes(whitened.coefficients)) {
    Descent descent = start_at(whitened, prior, axis);
    descend(descent, whitened, prior, scouting_iterations);
    if (!best || descent.cost < best->cost) {
      best = descent;
    }
  }
  if (!best) {
    throw NotIdentifiable("the joint's readings do not change with its angle or acceleration: no axis can be seen; check that "
                          "the sensor moves with the joint");
  }
  if (!best->converged) {
    descend(*best, whitened, prior, max_iterations);
  }
  JointModelFit fit = described(*best);
  describe_at_solution(fit, whitened, prior);
  return fit;
}

}  // namespace circlepoint
