#pragma once
// Serial chains whose rows are Denavit-Hartenberg or Hayati rows, as their neighbours demand.
//
//   T_i-1_i = Rot_z(theta_i) Trans_z(d_i) Trans_x(a_i) Rot_x(alpha_i) Rot_y(beta_i);  joint i moves about z of frame i-1
//   dh row:      beta = 0, the standard convention
//   hayati row:  d = 0; the next frame lies in the x-y plane of this one and two small angles tilt its axis
//   T_base_sensor(q) = base  T_0_1(q_1) ... T_n-1_n(q_n)  tool
//
// Between nearly parallel axes the common normal is far away and d of the order of gap / angle; a Hayati row has no such
// length, its four numbers are as well conditioned there as a DH row's are between axes at right angles (Hayati and
// Mirmirani, J. Robotic Systems 2, 1985). It degrades where the axes come to be at right angles. A revolute joint adds q
// to theta, a prismatic one to d, in both forms.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

enum class RowForm { dh, hayati };

struct HayatiRow {
  double a = 0.0;      ///< m
  double alpha = 0.0;  ///< rad
  double d = 0.0;      ///< m, at q = 0; zero in a Hayati row
  double theta = 0.0;  ///< rad, at q = 0
  double beta = 0.0;   ///< rad; zero in a DH row
  RowForm form = RowForm::dh;

  [[nodiscard]] bool operator==(const HayatiRow&) const = default;
};

struct HayatiChain {
  std::vector<HayatiRow> rows;   ///< base to tip
  std::vector<JointType> types;  ///< one a row
  RigidTransform base = RigidTransform::Identity();  ///< T_base_0
  RigidTransform tool = RigidTransform::Identity();  ///< T_n_sensor

  [[nodiscard]] Index size() const { return static_cast<Index>(rows.size()); }
};

/// T_i-1_i of one row at joint value q.
RigidTransform hayati_transform(const HayatiRow& row, JointType type, double q);

/// Pose of the sensor frame. Raises InvalidInput when q or types do not have one entry per row.
RigidTransform forward_kinematics(const HayatiChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q);

/// Poses of many configurations, (N, n) -> (N, 16): one row-major 4x4 matrix a row.
SamplesX forward_kinematics_rows(const HayatiChain& chain, const Eigen::Ref<const SamplesX>& q);

}  // namespace circlepoint
