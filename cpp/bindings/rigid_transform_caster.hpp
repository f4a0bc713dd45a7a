#pragma once
// Rigid transforms are (4, 4) float64 arrays in Python. Every file that binds a RigidTransform includes this.

#include "bindings.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"

namespace pybind11::detail {

template <>
struct type_caster<circlepoint::RigidTransform> {
  PYBIND11_TYPE_CASTER(circlepoint::RigidTransform, make_caster<Eigen::Matrix4d>::name);

  /// Raises InvalidInput when the matrix is 4x4 but not rigid.
  bool load(handle source, bool convert) {
    make_caster<Eigen::Matrix4d> matrix;
    if (!matrix.load(source, convert)) {
      return false;
    }
    value = circlepoint::make_rigid_transform(cast_op<Eigen::Matrix4d&>(matrix));
    return true;
  }

  static handle cast(const circlepoint::RigidTransform& transform, return_value_policy /*policy*/, handle parent) {
    return make_caster<Eigen::Matrix4d>::cast(Eigen::Matrix4d(transform.matrix()), return_value_policy::move, parent);
  }
};

}  // namespace pybind11::detail
