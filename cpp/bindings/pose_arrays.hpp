#pragma once
// Forward kinematics of any chain as NumPy has it: (n,) -> (4, 4) and (N, n) -> (N, 4, 4).

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "bindings.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/core/types.hpp"
#include "rigid_transform_caster.hpp"

namespace circlepoint::bindings {

inline constexpr const char* forward_kinematics_doc = R"(Pose of the sensor frame in the base frame.

Parameters
----------
chain : ScrewChain, StandardDhChain, ModifiedDhChain or HayatiChain
q : (n,) or (N, n) array
    Joint positions, rad or m; (N, n) must be C-contiguous float64.

Returns
-------
(4, 4) or (N, 4, 4) array
    T_base_sensor.

Raises
------
InvalidInput
    q does not have one entry per joint.)";

/// (n,) -> (4, 4) and (N, n) -> (N, 4, 4): two depths of one array type, which overloads on Eigen types cannot tell apart.
template <class Chain>
py::array_t<double> poses(const Chain& chain, const py::array_t<double, py::array::c_style>& q) {
  if (q.ndim() != 1 && q.ndim() != 2) {
    throw InvalidInput("q has " + std::to_string(q.ndim()) + " dimensions; give (n,) or (N, n)");
  }
  const bool single = q.ndim() == 1;
  const Eigen::Map<const SamplesX> rows(q.data(), single ? 1 : q.shape(0), single ? q.shape(0) : q.shape(1));
  py::array_t<double> result(single ? std::vector<py::ssize_t>{4, 4} : std::vector<py::ssize_t>{rows.rows(), 4, 4});
  Eigen::Map<SamplesX> out(result.mutable_data(), rows.rows(), 16);
  {
    const py::gil_scoped_release released;
    out = forward_kinematics_rows(chain, rows);
  }
  return result;
}

template <class Chain>
void bind_forward_kinematics(py::module_& m) {
  m.def("forward_kinematics", &poses<Chain>, py::arg("chain"), py::arg("q").noconvert(), forward_kinematics_doc);
  // Any other sequence of numbers, such as a list.
  m.def("forward_kinematics",
        [](const Chain& chain, const std::vector<double>& q) {
          return forward_kinematics(chain, Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Index>(q.size())));
        },
        py::arg("chain"), py::arg("q"), release_gil(), forward_kinematics_doc);
}

}  // namespace circlepoint::bindings
