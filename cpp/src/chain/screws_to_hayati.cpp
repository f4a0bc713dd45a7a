#include "circlepoint/chain/screws_to_hayati.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "common_normal_frames.hpp"

namespace circlepoint {
namespace {

/// Distance, m, below which parallel lines count as coincident.
constexpr double coincident_distance = 1e-10;
/// Angle, rad, between axes and the place where a row's form breaks down.
constexpr double smallest_angle = 1e-8;

enum Column : Index { column_a = 0, column_alpha = 1, column_d = 2, column_theta = 3 };

double enclosed_angle(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}

void require_convertible(const ScrewChain& chain, const HayatiOptions& options) {
  const std::string joints = std::to_string(chain.size()) + " joints";
  require(chain.size() > 0, "screw chain has no joints; give at least one axis");
  require(chain.reference_configuration.size() == chain.size(),
          "reference_configuration has " + std::to_string(chain.reference_configuration.size()) +
              " entries for a chain of " + joints + "; give one per joint, base to tip");
  require(options.forms.empty() || options.forms.size() == chain.axes.size(),
          "forms has " + std::to_string(options.forms.size()) + " entries for a chain of " + joints + "; give one a row or none");
  require(options.near_parallel_threshold > smallest_angle && options.near_parallel_threshold < 0.8,
          "near_parallel_threshold is " + std::to_string(options.near_parallel_threshold) +
              " rad; give an angle from 1e-8 to pi/4, where a Hayati row is no worse than a DH row");
  for (std::size_t j = 0; j + 1 < options.forms.size(); ++j) {
    const double angle = enclosed_angle(chain.axes[j].line.direction, chain.axes[j + 1].line.direction);
    const bool hayati = options.forms[j] == RowForm::hayati;
    require(hayati ? angle < 0.5 * std::numbers::pi - smallest_angle : angle > smallest_angle,
            "row " + std::to_string(j) + " (from 0) cannot be a " + (hayati ? "Hayati" : "DH") + " row: its axis and the next enclose " +
                std::to_string(angle) + " rad; ask for the other form");
  }
  if (!options.nominal) {
    return;
  }
  require(options.nominal->size() == chain.size() && options.nominal->types.size() == options.nominal->rows.size(),
          "nominal DH chain has " + std::to_string(options.nominal->rows.size()) + " rows and " +
              std::to_string(options.nominal->types.size()) + " joint types for a chain of " + joints +
              "; give one of each per joint");
  for (std::size_t i = 0; i < chain.axes.size(); ++i) {
    require(options.nominal->types[i] == chain.axes[i].type,
            "joint " + std::to_string(i) + " (from 0) is of another type in the nominal DH chain; the types must agree");
  }
}

/// Lays the rows one after the other; `frame_` is the frame the next row starts from, at the reference configuration.
class RowLayer {
 public:
  RowLayer(const ScrewChain& chain, const HayatiOptions& options)
      : chain_(chain), options_(options), free_(HayatiFreeFlags::Zero(chain.size(), 5)) {
    const RigidTransform hint = options.nominal ? options.nominal->base : RigidTransform(RigidTransform::Identity());
    const ScrewAxis& first = chain.axes.front();
    const Eigen::Vector3d& z = first.line.direction;
    const Eigen::Vector3d across = hint.linear().col(0) - hint.linear().col(0).dot(z) * z;
    const Eigen::Vector3d x = across.norm() > 0.4 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d(tangent_basis(z).col(0));
    frame_.linear() << x, z.cross(x), z;
    const Eigen::Vector3d& point = first.line.point;
    frame_.translation() = first.type == JointType::prismatic
                               ? Eigen::Vector3d(hint.translation())
                               : Eigen::Vector3d(point + z.dot(hint.translation() - point) * z);
  }

  HayatiConversion convert() {
    const std::size_t last = chain_.axes.size() - 1;
    RigidTransform base = frame_;
    for (std::size_t j = 0; j < last; ++j) {
      HayatiRow row = form(j) == RowForm::hayati ? hayati_row(j) : dh_row(j);
      if (j == 0) {
        base = base * row_at_nominal_placement(row);
        frame_ = base;
      }
      frame_ = frame_ * hayati_transform(row, type(j), reference(j));
      rows_.push_back(row);
    }
    rows_.push_back(nominal(last));
    free_.row(static_cast<Index>(last)) << true, true, true, true, false;
    HayatiConversion result;
    result.free = free_;
    result.chain.rows = rows_;
    result.chain.base = base;
    for (const ScrewAxis& axis : chain_.axes) {
      result.chain.types.push_back(axis.type);
    }
    result.chain.tool = forward_kinematics(result.chain, chain_.reference_configuration).inverse() * chain_.home;
    return result;
  }

 private:
  [[nodiscard]] JointType type(std::size_t j) const { return chain_.axes[j].type; }
  [[nodiscard]] double reference(std::size_t j) const { return chain_.reference_configuration[static_cast<Index>(j)]; }
  [[nodiscard]] double reference_angle(std::size_t j) const { return type(j) == JointType::revolute ? reference(j) : 0.0; }
  [[nodiscard]] double reference_slide(std::size_t j) const { return type(j) == JointType::prismatic ? reference(j) : 0.0; }
  [[nodiscard]] bool prismatic(std::size_t j) const { return type(j) == JointType::prismatic; }
  void mark_free(std::size_t row, Column column) { free_(static_cast<Index>(row), column) = true; }

  [[nodiscard]] HayatiRow nominal(std::size_t j) const {
    if (!options_.nominal) {
      return {};
    }
    const DhRow& row = options_.nominal->rows[j];
    return {row.a, row.alpha, row.d, row.theta, 0.0, RowForm::dh};
  }

  [[nodiscard]] RowForm form(std::size_t j) const {
    if (!options_.forms.empty()) {
      return options_.forms[j];
    }
    const double angle = enclosed_angle(chain_.axes[j].line.direction, chain_.axes[j + 1].line.direction);
    return angle < options_.near_parallel_threshold ? RowForm::hayati : RowForm::dh;
  }

  /// Turns and slides the base so that the first row's theta and, in a dh row, d are nominal.
  RigidTransform row_at_nominal_placement(HayatiRow& row) {
    RigidTransform shift = RigidTransform::Identity();
    const HayatiRow expected = nominal(0);
    shift.linear() = rotation_exp((row.theta - expected.theta) * Eigen::Vector3d::UnitZ());
    row.theta = expected.theta;
    mark_free(0, column_theta);
    if (row.form == RowForm::dh) {
      shift.translation().z() = row.d - expected.d;
      row.d = expected.d;
      mark_free(0, column_d);
    }
    return shift;
  }

  [[nodiscard]] HayatiRow dh_row(std::size_t j) {
    const HayatiRow expected = nominal(j);
    const RigidTransform to_frame = frame_.inverse();
    const Line next = transform(to_frame, chain_.axes[j + 1].line);
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    HayatiRow row;
    row.d = expected.d;
    row.a = expected.a;
    Eigen::Vector3d x = z.cross(next.direction).normalized();
    double gap = 0.0;
    if (!prismatic(j + 1)) {
      const CommonNormal normal = common_normal({z, Eigen::Vector3d::Zero()}, next, Eigen::Vector3d::Zero(), 0.0);
      gap = (normal.foot_second - normal.foot_first).dot(x);
      row.d = normal.foot_first.z() - reference_slide(j);
    } else {
      mark_free(j, column_a);
      mark_free(j, column_d);
    }
    const double alpha = std::atan2(x.dot(z.cross(next.direction)), next.direction.z());
    const auto cost = [&](double sign) {
      return std::hypot(std::remainder(sign * alpha - expected.alpha, 2.0 * std::numbers::pi),
                        prismatic(j + 1) ? 0.0 : sign * gap - expected.a);
    };
    const double sign = options_.nominal && cost(-1.0) < cost(1.0) ? -1.0 : 1.0;
    x *= sign;
    row.alpha = nearest_turn(sign * alpha, expected.alpha);
    row.a = prismatic(j + 1) ? row.a : sign * gap;
    row.theta = nearest_turn(std::atan2(x.y(), x.x()) - reference_angle(j), expected.theta);
    return row;
  }

  [[nodiscard]] HayatiRow hayati_row(std::size_t j) {
    const HayatiRow expected = nominal(j);
    const Line next = transform(frame_.inverse(), chain_.axes[j + 1].line);
    HayatiRow row;
    row.form = RowForm::hayati;
    row.a = expected.a;
    row.theta = expected.theta;
    const Eigen::Vector3d pierced =
        next.point + (reference_slide(j) - next.point.z()) / next.direction.z() * next.direction;
    const double gap = pierced.head<2>().norm();
    if (prismatic(j + 1)) {
      mark_free(j, column_a);
      mark_free(j, column_theta);
    } else if (gap <= coincident_distance) {
      row.a = 0.0;
      mark_free(j, column_theta);
    } else {
      const double sign = expected.a < 0.0 ? -1.0 : 1.0;
      row.a = sign * gap;
      row.theta = nearest_turn(std::atan2(sign * pierced.y(), sign * pierced.x()) - reference_angle(j), expected.theta);
    }
    const Eigen::Vector3d tilted =
        rotation_exp(-(row.theta + reference_angle(j)) * Eigen::Vector3d::UnitZ()) * next.direction;
    row.beta = std::atan2(tilted.x(), tilted.tail<2>().norm());
    row.alpha = nearest_turn(std::atan2(-tilted.y(), tilted.z()), expected.alpha);
    return row;
  }

  const ScrewChain& chain_;
  const HayatiOptions& options_;
  HayatiFreeFlags free_;
  RigidTransform frame_ = RigidTransform::Identity();
  std::vector<HayatiRow> rows_;
};

Eigen::VectorXd parameters(const HayatiChain& chain) {
  Eigen::VectorXd values(5 * chain.size());
  for (Index i = 0; i < chain.size(); ++i) {
    const HayatiRow& row = chain.rows[static_cast<std::size_t>(i)];
    values.segment<5>(5 * i) << row.a, row.alpha, row.d, row.theta, row.beta;
  }
  return values;
}

}  // namespace

HayatiConversion to_hayati(const ScrewChain& chain, const HayatiOptions& options) {
  require_convertible(chain, options);
  return RowLayer(chain, options).convert();
}

Eigen::MatrixXd hayati_parameter_jacobian(const ScrewChain& chain, const HayatiConversion& at, double step) {
  require(step > 0.0 && step < 0.01, "step is " + std::to_string(step) + "; give a small positive number (rad, m)");
  require(at.free.rows() == chain.size(), "conversion has " + std::to_string(at.free.rows()) + " rows for a chain of " +
                                              std::to_string(chain.size()) + " joints; give the conversion of this chain");
  HayatiOptions options;
  options.nominal = StandardDhChain{{}, at.chain.types, at.chain.base, at.chain.tool};
  for (const HayatiRow& row : at.chain.rows) {
    options.nominal->rows.push_back({row.a, row.alpha, row.d, row.theta});
    options.forms.push_back(row.form);
  }
  const Index n = chain.size();
  Eigen::MatrixXd result(5 * n, 4 * n);
  for (Index k = 0; k < 4 * n; ++k) {
    const auto displaced = [&](double by) {
      ScrewChain moved = chain;
      Line& line = moved.axes[static_cast<std::size_t>(k / 4)].line;
      line = retract(line, by * Eigen::Vector4d::Unit(k % 4));
      return parameters(to_hayati(moved, options).chain);
    };
    result.col(k) = (displaced(step) - displaced(-step)) / (2.0 * step);
  }
  for (Index k = 0; k < 5 * n; ++k) {
    if (at.free(k / 5, k % 5)) {
      result.row(k).setZero();
    }
  }
  return result;
}

}  // namespace circlepoint
