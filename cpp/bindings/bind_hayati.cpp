#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "circlepoint/chain/align_chain.hpp"
#include "circlepoint/chain/hayati_chain.hpp"
#include "circlepoint/chain/screws_to_hayati.hpp"
#include "pose_arrays.hpp"
#include "rigid_transform_caster.hpp"

namespace circlepoint::bindings {
namespace {

std::string repr(const HayatiRow& row) {
  std::ostringstream text;
  text << "HayatiRow(a=" << row.a << ", alpha=" << row.alpha << ", d=" << row.d << ", theta=" << row.theta
       << ", beta=" << row.beta << ", form=RowForm." << (row.form == RowForm::dh ? "dh" : "hayati") << ")";
  return text.str();
}

void bind_hayati_chain(py::module_& m) {
  py::native_enum<RowForm>(m, "RowForm", "enum.Enum", "Which four of a row's five parameters it has.")
      .value("dh", RowForm::dh)
      .value("hayati", RowForm::hayati)
      .finalize();
  py::class_<HayatiRow>(m, "HayatiRow", "A Denavit-Hartenberg row (beta = 0) or a Hayati row (d = 0), at q = 0.")
      .def(py::init<double, double, double, double, double, RowForm>(), py::arg("a") = 0.0, py::arg("alpha") = 0.0,
           py::arg("d") = 0.0, py::arg("theta") = 0.0, py::arg("beta") = 0.0,
           py::arg_v("form", RowForm::dh, "RowForm.dh"))
      .def_readonly("a", &HayatiRow::a, "m.")
      .def_readonly("alpha", &HayatiRow::alpha, "rad.")
      .def_readonly("d", &HayatiRow::d, "m.")
      .def_readonly("theta", &HayatiRow::theta, "rad.")
      .def_readonly("beta", &HayatiRow::beta, "rad.")
      .def_readonly("form", &HayatiRow::form)
      .def("__repr__", &repr)
      .def("__eq__", [](const HayatiRow& row, const HayatiRow& other) { return row == other; }, py::is_operator())
      .def("__hash__",
           [](const HayatiRow& row) { return py::hash(py::make_tuple(row.a, row.alpha, row.d, row.theta, row.beta)); })
      .def(py::pickle(
          [](const HayatiRow& row) { return py::make_tuple(row.a, row.alpha, row.d, row.theta, row.beta, row.form); },
          [](const py::tuple& state) {
            return HayatiRow{state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),
                             state[3].cast<double>(), state[4].cast<double>(), state[5].cast<RowForm>()};
          }));
  m.def("hayati_transform", &hayati_transform, py::arg("row"), py::arg("type"), py::arg("q"),
        "T_i-1_i (4, 4) of one row at joint value q: Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) Rot_y(beta).");
  py::class_<HayatiChain>(m, "HayatiChain", R"(A serial chain of Denavit-Hartenberg and Hayati rows.

``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``; a revolute joint adds q to theta, a prismatic one to d.)")
      .def(py::init<std::vector<HayatiRow>, std::vector<JointType>, RigidTransform, RigidTransform>(), py::arg("rows"),
           py::arg("types"), py::arg("base") = RigidTransform(RigidTransform::Identity()),
           py::arg("tool") = RigidTransform(RigidTransform::Identity()))
      .def_readonly("rows", &HayatiChain::rows, "Base to tip.")
      .def_readonly("types", &HayatiChain::types, "One a row.")
      .def_property_readonly("base", [](const HayatiChain& chain) { return chain.base; }, "T_base_0, (4, 4).")
      .def_property_readonly("tool", [](const HayatiChain& chain) { return chain.tool; }, "T_n_sensor, (4, 4).")
      .def("size", &HayatiChain::size, "Number of joints.")
      .def("__len__", &HayatiChain::size)
      .def("__repr__", [](const HayatiChain& chain) { return "<HayatiChain of " + std::to_string(chain.size()) + " joints>"; })
      .def(py::pickle(
          [](const HayatiChain& chain) { return py::make_tuple(chain.rows, chain.types, chain.base, chain.tool); },
          [](const py::tuple& state) {
            return HayatiChain{state[0].cast<std::vector<HayatiRow>>(), state[1].cast<std::vector<JointType>>(),
                               state[2].cast<RigidTransform>(), state[3].cast<RigidTransform>()};
          }));
  bind_forward_kinematics<HayatiChain>(m);
}

void bind_conversion(py::module_& m) {
  py::class_<HayatiConversion>(m, "HayatiConversion", "Rows read from joint axes, and which parameters are a choice.")
      .def_readonly("chain", &HayatiConversion::chain, "With base and tool: moves as the screw chain does.")
      .def_readonly("free", &HayatiConversion::free,
                    "(n, 5) bool, order a, alpha, d, theta, beta: a choice, not determined by the axes.");
  m.def("to_hayati",
        [](const ScrewChain& chain, const std::optional<StandardDhChain>& nominal, double near_parallel_threshold,
           const std::vector<RowForm>& forms) {
          return to_hayati(chain, {nominal, near_parallel_threshold, forms});
        },
        py::arg("chain"), py::arg("nominal") = py::none(), py::arg("near_parallel_threshold") = 0.05,
        py::arg("forms") = std::vector<RowForm>{}, R"(Denavit-Hartenberg rows, with a Hayati row before nearly parallel axes.

Parameters
----------
chain : ScrewChain
nominal : StandardDhChain, optional
    Chooses the branch, the values of free parameters and where the base is.
near_parallel_threshold : float
    rad; neighbours within it get a Hayati row.
forms : list of RowForm
    One a row (the last is ignored) instead of the choice by the threshold.

Returns
-------
HayatiConversion

Raises
------
InvalidInput
    The chain has no joints; the nominal chain or forms have another size, or joints of other types; a form asked for
    breaks down at its axes.

References
----------
Hayati and Mirmirani, "Improving the absolute positioning accuracy of robot manipulators", J. Robotic Systems 2, 1985.)");
  m.def("hayati_parameter_jacobian", &hayati_parameter_jacobian, py::arg("chain"), py::arg("at"), py::arg("step") = 1e-6,
        release_gil(), R"(Derivative of the rows' parameters by the axes' local coordinates.

Parameters
----------
chain : ScrewChain
at : HayatiConversion
    The conversion of this chain.
step : float
    Of the central differences, rad and m.

Returns
-------
(5 n, 4 n) array
    Rows a, alpha, d, theta, beta of each row; columns d1, d2, p1, p2 of each axis. Rows of free parameters, and of the d
    or beta a row does not have, are zero.

Raises
------
InvalidInput
    The conversion is of another number of joints, or the step is not a small positive number.)");
}

void bind_alignment(py::module_& m) {
  py::class_<ChainAlignment>(m, "ChainAlignment", "Where one arm's chain lies on another's, and how far its encoders are off.")
      .def_property_readonly("T_target_source", [](const ChainAlignment& found) { return found.T_target_source; }, "(4, 4).")
      .def_readonly("joint_offsets", &ChainAlignment::joint_offsets, "(n,), rad or m; zero where no axis shows them.")
      .def_readonly("direction_rms", &ChainAlignment::direction_rms, "rad, left between the axes.")
      .def_readonly("distance_rms", &ChainAlignment::distance_rms, "m, left between the revolute axes.")
      .def_readonly("converged", &ChainAlignment::converged);
  m.def("align_chain", &align_chain, py::arg("target"), py::arg("source"), py::arg("length") = 0.5, release_gil(),
        R"(Place a chain on another by a rigid transform and offsets of its joints, least squares over the axes.

Parameters
----------
target, source : ScrewChain
    The same joints at the same reference configuration, such as the calibrated and the nominal arm.
length : float
    m; weighs a radian of direction against a metre.

Returns
-------
ChainAlignment

Raises
------
InvalidInput
    Different joints or reference configurations, no joints, or a length that is not positive.)");
}

}  // namespace

void bind_hayati(py::module_& m) {
  bind_hayati_chain(m);
  bind_conversion(m);
  bind_alignment(m);
}

}  // namespace circlepoint::bindings
