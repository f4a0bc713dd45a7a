#pragma once
// One pose a configuration for any chain that has forward_kinematics: rows of 16 numbers, a row-major 4x4 matrix each.

#include <Eigen/Core>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

template <class Chain>
SamplesX pose_rows(const Chain& chain, const Eigen::Ref<const SamplesX>& q) {
  using RowMajor4d = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  SamplesX poses(q.rows(), 16);
  for (Index i = 0; i < q.rows(); ++i) {
    Eigen::Map<RowMajor4d>(poses.row(i).data()) = forward_kinematics(chain, q.row(i).transpose()).matrix();
  }
  return poses;
}

}  // namespace circlepoint
