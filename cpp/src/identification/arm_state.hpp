#pragma once
// Everything the whole-arm estimate may not know, and which of it is estimated in which columns.

#include <Eigen/Core>
#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/screw_axis.hpp"
#include "circlepoint/sensor/accelerometer.hpp"

namespace circlepoint {

struct ArmState {
  std::vector<ScrewAxis> axes;  // base to tip, sensor frame at the reference configuration
  Eigen::VectorXd reference;    // (n)
  Eigen::Vector3d up_gravity = Eigen::Vector3d::Zero();
  AccelerometerModel sensor;
  double clock_offset = 0.0;    // s: the sample stamped t shows the joints at t - clock_offset - (clock_rate - 1) (t - middle)
  double clock_rate = 1.0;
  Eigen::VectorXd encoder_gain;  // (n) relative error of the joints' encoders
  Eigen::Matrix2Xd eccentricity;  // (2, n) rad: of cos(q) and sin(q)
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();  // rad/s
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> gyroscope_matrix = Eigen::Matrix3d::Identity();  // reading = matrix w + bias
  double gyroscope_delay = 0.0;  // s: it shows what the accelerometer showed so much earlier
};

// Columns of the parameter vector: each group begins at its column, or at -1 when it is fixed.
struct ArmLayout {
  std::vector<Index> lines;  // (n) first column of each joint's line; -1: the joint never moves
  bool points = true;        // lines have points; false: nothing but rests was recorded, which show directions only
  Index up_gravity = -1;
  Index bias = -1;
  Index scale = -1;
  Index misalignment = -1;
  Index percussion_distance = -1;
  Index second_order = -1;
  Index clock_offset = -1;
  Index clock_rate = -1;
  std::vector<Index> encoder_gain;  // (n) one column each
  std::vector<Index> eccentricity;  // (n) two columns each
  Index gyroscope_bias = -1;
  Index gyroscope_matrix = -1;
  Index gyroscope_delay = -1;
  Index columns = 0;

  // The next free column; `count` of them are taken.
  Index claim(Index count);
  // A line's columns for every joint that moves, and none yet for any encoder.
  void claim_lines(const std::vector<ScrewAxis>& axes, const std::vector<bool>& moves);
  // How many parameters a line has: a prismatic joint's has a direction only.
  [[nodiscard]] Index line_columns(const ScrewAxis& axis) const { return points && axis.type == JointType::revolute ? 4 : 2; }
};

// Calls visit(column, values) for every group but the lines, estimated or not: `values` maps the state's own memory, in the
// order of the group's columns.
template <class State, class Visit>
void for_each_group(State& state, const ArmLayout& layout, const Visit& visit) {
  using Values = std::conditional_t<std::is_const_v<State>, const Eigen::VectorXd, Eigen::VectorXd>;
  const auto array = [&](Index column, auto& group) { visit(column, Eigen::Map<Values>(group.data(), group.size())); };
  const auto number = [&](Index column, auto& value) { visit(column, Eigen::Map<Values>(&value, 1)); };
  array(layout.up_gravity, state.up_gravity);
  array(layout.bias, state.sensor.bias);
  array(layout.scale, state.sensor.scale);
  array(layout.misalignment, state.sensor.misalignment);
  array(layout.percussion_distance, state.sensor.percussion_distance);
  array(layout.second_order, state.sensor.second_order);
  number(layout.clock_offset, state.clock_offset);
  number(layout.clock_rate, state.clock_rate);
  for (std::size_t j = 0; j < layout.lines.size(); ++j) {
    const auto joint = static_cast<Index>(j);
    number(layout.encoder_gain[j], state.encoder_gain[joint]);
    visit(layout.eccentricity[j], Eigen::Map<Values>(state.eccentricity.col(joint).data(), 2));
  }
  array(layout.gyroscope_bias, state.gyroscope_bias);
  array(layout.gyroscope_matrix, state.gyroscope_matrix);
  number(layout.gyroscope_delay, state.gyroscope_delay);
}

// The state moved by a step in the layout's coordinates (lines: their local coordinates).
ArmState moved(const ArmState& state, const ArmLayout& layout, const Eigen::Ref<const Eigen::VectorXd>& step);

// All that a state says, estimated or not: of each line direction and point (6), then all groups.
Eigen::VectorXd flattened(const ArmState& state, const ArmLayout& layout);

// Current values of the layout's columns; a line's are zero.
Eigen::VectorXd values(const ArmState& state, const ArmLayout& layout);

// Of a line, after its joint's name; of a sliding joint the first two.
inline constexpr std::array<const char*, 4> line_coordinates{"d1", "d2", "p1", "p2"};

// One name a column: joint1.d1 ..., gravity_x, bias_x ...
std::vector<std::string> parameter_names(const ArmState& state, const ArmLayout& layout);

}  // namespace circlepoint
