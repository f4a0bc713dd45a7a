#pragma once
// Serial chains in Denavit-Hartenberg form. A convention is a type: rows of one cannot be taken for rows of the other.
//
//   standard:        T_i-1_i = Rot_z(theta_i) Trans_z(d_i) Trans_x(a_i) Rot_x(alpha_i);  joint i moves about z of frame i-1
//   modified (Craig): T_i-1_i = Rot_x(alpha) Trans_x(a) Rot_z(theta_i) Trans_z(d_i), alpha and a those of i-1 in Craig's
//                     numbering;  joint i moves about z of frame i
//   T_base_sensor(q) = base  T_0_1(q_1) ... T_n-1_n(q_n)  tool
//
// Joint values are raw encoder values: a revolute joint adds q to theta, a prismatic one adds q to d.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/geometry/screw_axis.hpp"

namespace circlepoint {

struct DhRow {
  double a = 0.0;      ///< m
  double alpha = 0.0;  ///< rad
  double d = 0.0;      ///< m, at q = 0
  double theta = 0.0;  ///< rad, at q = 0

  [[nodiscard]] bool operator==(const DhRow&) const = default;
};

struct StandardDhChain {
  std::vector<DhRow> rows;       ///< base to tip
  std::vector<JointType> types;  ///< one a row
  RigidTransform base = RigidTransform::Identity();  ///< T_base_0
  RigidTransform tool = RigidTransform::Identity();  ///< T_n_sensor

  [[nodiscard]] Index size() const { return static_cast<Index>(rows.size()); }
};

/// Craig's convention; a row holds the a and alpha that come before its joint.
struct ModifiedDhChain {
  std::vector<DhRow> rows;       ///< base to tip
  std::vector<JointType> types;  ///< one a row
  RigidTransform base = RigidTransform::Identity();  ///< T_base_0
  RigidTransform tool = RigidTransform::Identity();  ///< T_n_sensor

  [[nodiscard]] Index size() const { return static_cast<Index>(rows.size()); }
};

/// T_i-1_i of one row at joint value q, in the standard convention.
RigidTransform standard_dh_transform(const DhRow& row, JointType type, double q);
/// T_i-1_i of one row at joint value q, in the modified (Craig) convention.
RigidTransform modified_dh_transform(const DhRow& row, JointType type, double q);

/// Pose of the sensor frame. Raises InvalidInput when q or types do not have one entry per row.
RigidTransform forward_kinematics(const StandardDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q);
RigidTransform forward_kinematics(const ModifiedDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& q);

/// Poses of many configurations, (N, n) -> (N, 16): one row-major 4x4 matrix a row.
SamplesX forward_kinematics_rows(const StandardDhChain& chain, const Eigen::Ref<const SamplesX>& q);
SamplesX forward_kinematics_rows(const ModifiedDhChain& chain, const Eigen::Ref<const SamplesX>& q);

}  // namespace circlepoint
