#include "arm_state.hpp"

#include <array>
#include <string>

#include "circlepoint/geometry/joint_axis.hpp"

namespace circlepoint {

Index ArmLayout::claim(Index count) {
  const Index column = columns;
  columns += count;
  return column;
}

void ArmLayout::claim_lines(const std::vector<ScrewAxis>& axes, const std::vector<bool>& moves) {
  lines.assign(axes.size(), -1);
  encoder_gain = lines;
  eccentricity = lines;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (moves[i]) {
      lines[i] = claim(line_columns(axes[i]));
    }
  }
}

ArmState moved(const ArmState& state, const ArmLayout& layout, const Eigen::Ref<const Eigen::VectorXd>& step) {
  ArmState next = state;
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    if (layout.lines[i] >= 0) {
      Eigen::Vector4d local = Eigen::Vector4d::Zero();
      local.head(layout.line_columns(state.axes[i])) = step.segment(layout.lines[i], layout.line_columns(state.axes[i]));
      next.axes[i].line = retract(state.axes[i].line, local);
    }
  }
  for_each_group(next, layout, [&](Index column, auto group) {
    if (column >= 0) {
      group += step.segment(column, group.size());
    }
  });
  return next;
}

Eigen::VectorXd flattened(const ArmState& state, const ArmLayout& layout) {
  Index size = 6 * static_cast<Index>(state.axes.size());
  for_each_group(state, layout, [&](Index, const auto& group) { size += group.size(); });
  Eigen::VectorXd flat(size);
  Index at = 0;
  for (const ScrewAxis& axis : state.axes) {
    flat.segment<3>(at) = axis.line.direction;
    flat.segment<3>(at + 3) = axis.line.point;
    at += 6;
  }
  for_each_group(state, layout, [&](Index, const auto& group) {
    flat.segment(at, group.size()) = group;
    at += group.size();
  });
  return flat;
}

Eigen::VectorXd values(const ArmState& state, const ArmLayout& layout) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(layout.columns);
  for_each_group(state, layout, [&](Index column, const auto& group) {
    if (column >= 0) {
      value.segment(column, group.size()) = group;
    }
  });
  return value;
}

std::vector<std::string> parameter_names(const ArmState& state, const ArmLayout& layout) {
  std::vector<std::string> names(static_cast<std::size_t>(layout.columns));
  const auto put = [&](Index column, const std::string& name) { names[static_cast<std::size_t>(column)] = name; };
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    const auto count = static_cast<int>(layout.line_columns(state.axes[i]));
    for (int k = 0; layout.lines[i] >= 0 && k < count; ++k) {
      put(layout.lines[i] + k, "joint" + std::to_string(i + 1) + "." + line_coordinates[static_cast<std::size_t>(k)]);
    }
  }
  const auto triple = [&](Index column, const std::string& name, const std::array<const char*, 3>& suffix) {
    for (int k = 0; column >= 0 && k < 3; ++k) {
      put(column + k, name + "_" + suffix[static_cast<std::size_t>(k)]);
    }
  };
  const std::array<const char*, 3> xyz{"x", "y", "z"};
  triple(layout.up_gravity, "gravity", xyz);
  triple(layout.bias, "bias", xyz);
  triple(layout.scale, "scale", xyz);
  triple(layout.misalignment, "misalignment", {"yx", "zx", "zy"});
  triple(layout.percussion_distance, "percussion_distance", xyz);
  triple(layout.second_order, "second_order", xyz);
  triple(layout.gyroscope_bias, "gyroscope_bias", xyz);
  if (layout.clock_offset >= 0) {
    put(layout.clock_offset, "clock_offset");
  }
  if (layout.clock_rate >= 0) {
    put(layout.clock_rate, "clock_rate");
  }
  for (std::size_t j = 0; j < state.axes.size(); ++j) {
    const std::string joint = "joint" + std::to_string(j + 1);
    if (layout.encoder_gain[j] >= 0) {
      put(layout.encoder_gain[j], joint + ".gain");
    }
    if (layout.eccentricity[j] >= 0) {
      put(layout.eccentricity[j], joint + ".eccentricity_cos");
      put(layout.eccentricity[j] + 1, joint + ".eccentricity_sin");
    }
  }
  for (int k = 0; layout.gyroscope_matrix >= 0 && k < 9; ++k) {
    put(layout.gyroscope_matrix + k,
        std::string("gyroscope_") + xyz[static_cast<std::size_t>(k / 3)] + xyz[static_cast<std::size_t>(k % 3)]);
  }
  if (layout.gyroscope_delay >= 0) {
    put(layout.gyroscope_delay, "gyroscope_delay");
  }
  return names;
}

}  // namespace circlepoint
