#include "circlepoint/chain/screws_to_dh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "circlepoint/core/error.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "common_normal_frames.hpp"

namespace circlepoint {
namespace {

/// Angle of the undirected axes of a pair, 0 to pi/2.
double enclosed_angle(const ScrewChain& chain, Index first) {
  const Eigen::Vector3d& u = chain.axes[static_cast<std::size_t>(first)].line.direction;
  const Eigen::Vector3d& v = chain.axes[static_cast<std::size_t>(first) + 1].line.direction;
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}

template <class DhChain>
void require_convertible(const ScrewChain& chain, const DhOptions<DhChain>& options) {
  require(chain.size() > 0, "screw chain has no joints; give at least one axis");
  require(chain.reference_configuration.size() == chain.size(),
          "reference_configuration has " + std::to_string(chain.reference_configuration.size()) +
              " entries for a chain of " + std::to_string(chain.size()) + " joints; give one per joint, base to tip");
  require(options.parallel_tolerance > 0.0 && options.parallel_tolerance < 0.1,
          "parallel_tolerance is " + std::to_string(options.parallel_tolerance) + " rad; give a small positive angle");
  if (!options.nominal) {
    return;
  }
  require(options.nominal->size() == chain.size() && options.nominal->types.size() == options.nominal->rows.size(),
          "nominal DH chain has " + std::to_string(options.nominal->rows.size()) + " rows and " +
              std::to_string(options.nominal->types.size()) + " joint types for a chain of " +
              std::to_string(chain.size()) + " joints; give one of each per joint");
  for (std::size_t i = 0; i < chain.axes.size(); ++i) {
    require(options.nominal->types[i] == chain.axes[i].type,
            "joint " + std::to_string(i) + " (from 0) is of another type in the nominal DH chain; the types must agree");
  }
}

template <class DhChain>
std::vector<NearParallel> find_near_parallel(const ScrewChain& chain, const DhOptions<DhChain>& options) {
  std::vector<NearParallel> found;
  for (Index i = 0; i + 1 < chain.size(); ++i) {
    const double angle = enclosed_angle(chain, i);
    const bool parallel = std::sin(angle) < options.parallel_tolerance;
    if (parallel || angle < options.near_parallel_threshold) {
      found.push_back({i, angle, parallel});
    }
  }
  return found;
}

/// The same arm seen from the sensor: joints in opposite order moving the opposite way.
ScrewChain reversed(const ScrewChain& chain) {
  ScrewChain result;
  result.home = chain.home.inverse();
  for (auto axis = chain.axes.rbegin(); axis != chain.axes.rend(); ++axis) {
    result.axes.push_back(transform(result.home, *axis));
  }
  result.reference_configuration = -chain.reference_configuration.reverse();
  return result;
}

/// A modified row undone is a standard row of the opposite signs, so this turns either convention into the other.
template <class To, class From>
To reversed_as(const From& chain) {
  To result;
  for (auto row = chain.rows.rbegin(); row != chain.rows.rend(); ++row) {
    result.rows.push_back({-row->a, -row->alpha, -row->d, -row->theta});
  }
  result.types.assign(chain.types.rbegin(), chain.types.rend());
  result.base = chain.tool.inverse();
  result.tool = chain.base.inverse();
  return result;
}

/// Reversal leaves the odd length between parallels in the later row; both conventions have it in the earlier one.
void move_offset_to_earlier_row(ModifiedDhConversion& result, std::size_t later, double nominal_d) {
  const auto row = static_cast<Index>(later);
  std::vector<DhRow>& rows = result.chain.rows;
  if (later < 2 || result.free(row, 2) || !result.free(row - 1, 2)) {
    return;
  }
  const double excess = rows[later].d - nominal_d;
  rows[later - 1].d += std::cos(rows[later].alpha) > 0.0 ? excess : -excess;
  rows[later].d = nominal_d;
  result.free(row, 2) = true;
  result.free(row - 1, 2) = false;
}

/// z axis of each joint's frame as a screw in the base frame of the DH chain.
template <class DhChain, class JointFrames>
ScrewChain screws_of(const DhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration,
                     BaseFrame base_frame, JointFrames joint_frames) {
  ScrewChain screws;
  screws.home = forward_kinematics(chain, reference_configuration);
  screws.reference_configuration = reference_configuration;
  RigidTransform frame = chain.base;
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    const auto [T_joint, T_next] = joint_frames(chain.rows[i], chain.types[i], reference_configuration[static_cast<Index>(i)]);
    const RigidTransform joint = frame * T_joint;
    screws.axes.push_back({chain.types[i], make_line(joint.linear().col(2), joint.translation())});
    frame = frame * T_next;
  }
  return base_frame == BaseFrame::chain_base ? screws : rebase(screws, reference_configuration);
}

StandardDhConversion convert(const ScrewChain& chain, const StandardDhOptions& options) {
  return to_standard_dh(chain, options);
}

ModifiedDhConversion convert(const ScrewChain& chain, const ModifiedDhOptions& options) {
  return to_modified_dh(chain, options);
}

/// The row that holds a and alpha of the pair (first, first + 1).
Index normal_row(const StandardDhConversion& /*convention*/, Index first) { return first; }
Index normal_row(const ModifiedDhConversion& /*convention*/, Index first) { return first + 1; }

template <class DhChain>
Eigen::VectorXd parameters(const DhChain& chain) {
  Eigen::VectorXd values(4 * chain.size());
  for (Index i = 0; i < chain.size(); ++i) {
    const DhRow& row = chain.rows[static_cast<std::size_t>(i)];
    values.segment<4>(4 * i) << row.a, row.alpha, row.d, row.theta;
  }
  return values;
}

template <class DhChain>
Eigen::MatrixXd jacobian(const ScrewChain& chain, const DhConversion<DhChain>& at, double step) {
  require(step > 0.0 && step < 0.01, "step is " + std::to_string(step) + "; give a small positive number (rad, m)");
  require(at.free.rows() == chain.size(), "conversion has " + std::to_string(at.free.rows()) + " rows for a chain of " +
                                              std::to_string(chain.size()) + " joints; give the conversion of this chain");
  DhOptions<DhChain> options;
  options.nominal = at.chain;
  // Parallels stay parallel under the disturbance, all others stay what they are.
  std::vector<bool> parallel(static_cast<std::size_t>(chain.size()), false);
  double tolerance = 0.0;
  for (const NearParallel& pair : at.near_parallel) {
    parallel[static_cast<std::size_t>(pair.first)] = pair.parallel;
    tolerance = pair.parallel ? std::max(tolerance, pair.angle) : tolerance;
  }
  for (Index i = 0; i + 1 < chain.size(); ++i) {
    step = parallel[static_cast<std::size_t>(i)] ? step : std::min(step, 1e-3 * enclosed_angle(chain, i));
  }
  const bool any_parallel = std::find(parallel.begin(), parallel.end(), true) != parallel.end();
  options.parallel_tolerance = any_parallel ? tolerance + 4.0 * step : std::numeric_limits<double>::min();

  const Index n = chain.size();
  Eigen::MatrixXd result(4 * n, 4 * n);
  for (Index k = 0; k < 4 * n; ++k) {
    const auto displaced = [&](double by) {
      ScrewChain moved = chain;
      Line& line = moved.axes[static_cast<std::size_t>(k / 4)].line;
      line = retract(line, by * Eigen::Vector4d::Unit(k % 4));
      return parameters(convert(moved, options).chain);
    };
    result.col(k) = (displaced(step) - displaced(-step)) / (2.0 * step);
  }
  for (Index i = 0; i + 1 < n; ++i) {
    if (parallel[static_cast<std::size_t>(i)]) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      result.middleRows<2>(4 * normal_row(at, i)).setConstant(none);
      result.middleRows<2>(4 * i + 2).setConstant(none);
      result.middleRows<2>(4 * i + 6).setConstant(none);
    }
  }
  for (Index k = 0; k < 4 * n; ++k) {
    if (at.free(k / 4, k % 4)) {
      result.row(k).setZero();
    }
  }
  return result;
}

}  // namespace

StandardDhConversion to_standard_dh(const ScrewChain& chain, const StandardDhOptions& options) {
  require_convertible(chain, options);
  StandardDhConversion result = lay_standard_frames(
      chain, {options.nominal ? &*options.nominal : nullptr, options.parallel_tolerance, 1.0});
  result.near_parallel = find_near_parallel(chain, options);
  return result;
}

ModifiedDhConversion to_modified_dh(const ScrewChain& chain, const ModifiedDhOptions& options) {
  require_convertible(chain, options);
  StandardDhChain nominal;
  if (options.nominal) {
    nominal = reversed_as<StandardDhChain>(*options.nominal);
  }
  const StandardDhConversion mirrored =
      lay_standard_frames(reversed(chain), {options.nominal ? &nominal : nullptr, options.parallel_tolerance, -1.0});
  ModifiedDhConversion result;
  result.chain = reversed_as<ModifiedDhChain>(mirrored.chain);
  result.free = mirrored.free.colwise().reverse();
  result.near_parallel = find_near_parallel(chain, options);
  for (std::size_t i = 0; i < result.chain.rows.size(); ++i) {
    const DhRow expected = options.nominal ? options.nominal->rows[i] : DhRow{};
    DhRow& row = result.chain.rows[i];
    // Zeros lose the sign the reversal gave them, angles their half-turns.
    row = {row.a + 0.0, nearest_turn(row.alpha, expected.alpha), row.d + 0.0, nearest_turn(row.theta, expected.theta)};
  }
  for (auto pair = result.near_parallel.rbegin(); pair != result.near_parallel.rend(); ++pair) {
    if (pair->parallel) {
      const auto later = static_cast<std::size_t>(pair->first) + 1;
      move_offset_to_earlier_row(result, later, options.nominal ? options.nominal->rows[later].d : 0.0);
    }
  }
  return result;
}

ScrewChain to_screws(const StandardDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration,
                     BaseFrame base_frame) {
  return screws_of(chain, reference_configuration, base_frame, [](const DhRow& row, JointType type, double q) {
    return std::pair{RigidTransform(RigidTransform::Identity()), standard_dh_transform(row, type, q)};
  });
}

ScrewChain to_screws(const ModifiedDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration,
                     BaseFrame base_frame) {
  return screws_of(chain, reference_configuration, base_frame, [](const DhRow& row, JointType type, double q) {
    const RigidTransform frame = modified_dh_transform(row, type, q);
    return std::pair{frame, frame};
  });
}

Eigen::MatrixXd dh_parameter_jacobian(const ScrewChain& chain, const StandardDhConversion& at, double step) {
  return jacobian(chain, at, step);
}

Eigen::MatrixXd dh_parameter_jacobian(const ScrewChain& chain, const ModifiedDhConversion& at, double step) {
  return jacobian(chain, at, step);
}

}  // namespace circlepoint
