#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>

#include <sstream>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "circlepoint/chain/align_lines.hpp"
#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/core/error.hpp"
#include "pose_arrays.hpp"
#include "rigid_transform_caster.hpp"

namespace circlepoint::bindings {
namespace {

std::string repr(const DhRow& row) {
  std::ostringstream text;
  text << "DhRow(a=" << row.a << ", alpha=" << row.alpha << ", d=" << row.d << ", theta=" << row.theta << ")";
  return text.str();
}

void bind_screw_chain(py::module_& m) {
  py::class_<FrameMotion>(m, "FrameMotion", "Pose of the sensor frame and its time derivatives.")
      .def_property_readonly("T_base_sensor", [](const FrameMotion& motion) { return motion.T_base_sensor; }, "(4, 4).")
      .def_readonly("angular_velocity_sensor", &FrameMotion::angular_velocity_sensor, "(3,), rad/s.")
      .def_readonly("angular_acceleration_sensor", &FrameMotion::angular_acceleration_sensor, "(3,), rad/s^2.")
      .def_readonly("velocity_base", &FrameMotion::velocity_base, "(3,), m/s, of the sensor origin.")
      .def_readonly("acceleration_base", &FrameMotion::acceleration_base, "(3,), m/s^2, of the sensor origin.");
  py::class_<ScrewChain>(m, "ScrewChain", R"(A serial chain as a product of exponentials.

``T_base_sensor(q) = exp(xi_1 (q_1 - r_1)) ... exp(xi_n (q_n - r_n)) home``. In a calibration result the base frame is the
sensor frame at the reference configuration r, so home is the identity.

Parameters
----------
axes : list of ScrewAxis
    Base to tip, in the base frame at the reference configuration.
reference_configuration : (n,) array
    rad or m, raw encoder values.
home : (4, 4) array
    T_base_sensor at the reference configuration.)")
      .def(py::init<std::vector<ScrewAxis>, Eigen::VectorXd, RigidTransform>(), py::arg("axes"),
           py::arg("reference_configuration"), py::arg("home") = RigidTransform(RigidTransform::Identity()))
      .def_readonly("axes", &ScrewChain::axes)
      .def_readonly("reference_configuration", &ScrewChain::reference_configuration, "(n,), rad or m.")
      .def_property_readonly("home", [](const ScrewChain& chain) { return chain.home; }, "(4, 4).")
      .def("size", &ScrewChain::size, "Number of joints.")
      .def("__len__", &ScrewChain::size)
      .def("__repr__", [](const ScrewChain& chain) { return "<ScrewChain of " + std::to_string(chain.size()) + " joints>"; })
      .def(py::pickle(
          [](const ScrewChain& chain) { return py::make_tuple(chain.axes, chain.reference_configuration, chain.home); },
          [](const py::tuple& state) {
            return ScrewChain{state[0].cast<std::vector<ScrewAxis>>(), state[1].cast<Eigen::VectorXd>(),
                              state[2].cast<RigidTransform>()};
          }));
  bind_forward_kinematics<ScrewChain>(m);
  m.def("frame_motion", &frame_motion, py::arg("chain"), py::arg("q"), py::arg("q_dot"), py::arg("q_ddot"), release_gil(),
        R"(Pose, velocity and acceleration of the sensor frame.

Parameters
----------
chain : ScrewChain
q, q_dot, q_ddot : (n,) array
    Joint positions (rad or m), rates and accelerations.

Returns
-------
FrameMotion

Raises
------
InvalidInput
    An array does not have one entry per joint.)");
  m.def("specific_force", &specific_force, py::arg("motion"), py::arg("up_gravity_base"),
        R"(Specific force at the sensor origin, in the sensor frame, (3,), m/s^2.

Parameters
----------
motion : FrameMotion
up_gravity_base : (3,) array
    -g in base coordinates, m/s^2: what an ideal sensor at rest reads there.)");
  m.def("axis_in_sensor_frame", &axis_in_sensor_frame, py::arg("chain"), py::arg("joint"), py::arg("q"),
        R"(The axis of one joint (from 0) in the sensor frame at configuration q (n,); it depends on the joints beyond only.

Raises
------
InvalidInput
    The joint does not exist, or q does not have one entry per joint.)");
  m.def("rebase", &rebase, py::arg("chain"), py::arg("reference_configuration"),
        R"(The same chain at another reference configuration (n,), in the sensor frame there; home is the identity.

Raises
------
InvalidInput
    reference_configuration does not have one entry per joint.)");
}

template <class DhChain>
void bind_dh_convention(py::module_& m, const char* chain_name, const char* conversion_name, const char* doc) {
  py::class_<DhChain>(m, chain_name, doc)
      .def(py::init<std::vector<DhRow>, std::vector<JointType>, RigidTransform, RigidTransform>(), py::arg("rows"),
           py::arg("types"), py::arg("base") = RigidTransform(RigidTransform::Identity()),
           py::arg("tool") = RigidTransform(RigidTransform::Identity()))
      .def_readonly("rows", &DhChain::rows, "Base to tip.")
      .def_readonly("types", &DhChain::types, "One a row.")
      .def_property_readonly("base", [](const DhChain& chain) { return chain.base; }, "T_base_0, (4, 4).")
      .def_property_readonly("tool", [](const DhChain& chain) { return chain.tool; }, "T_n_sensor, (4, 4).")
      .def("size", &DhChain::size, "Number of joints.")
      .def("__len__", &DhChain::size)
      .def("__repr__",
           [chain_name](const DhChain& chain) {
             std::ostringstream text;
             text << chain_name << "(rows=[";
             for (std::size_t i = 0; i < chain.rows.size(); ++i) {
               text << (i > 0 ? ", " : "") << repr(chain.rows[i]);
             }
             text << "])";
             return text.str();
           })
      .def(py::pickle(
          [](const DhChain& chain) { return py::make_tuple(chain.rows, chain.types, chain.base, chain.tool); },
          [](const py::tuple& state) {
            return DhChain{state[0].cast<std::vector<DhRow>>(), state[1].cast<std::vector<JointType>>(),
                           state[2].cast<RigidTransform>(), state[3].cast<RigidTransform>()};
          }));
  py::class_<DhConversion<DhChain>>(m, conversion_name, "DH parameters read from joint axes, and which of them are a choice.")
      .def_readonly("chain", &DhConversion<DhChain>::chain, "With base and tool: moves as the screw chain does.")
      .def_property_readonly("rows", [](const DhConversion<DhChain>& result) { return result.chain.rows; })
      .def_property_readonly("base", [](const DhConversion<DhChain>& result) { return result.chain.base; }, "(4, 4).")
      .def_property_readonly("tool", [](const DhConversion<DhChain>& result) { return result.chain.tool; }, "(4, 4).")
      .def_readonly("free", &DhConversion<DhChain>::free,
                    "(n, 4) bool, order a, alpha, d, theta: a choice, not determined by the axes.")
      .def_readonly("near_parallel", &DhConversion<DhChain>::near_parallel, "List of NearParallel, base to tip.");
  bind_forward_kinematics<DhChain>(m);
  m.def("to_screws",
        py::overload_cast<const DhChain&, const Eigen::Ref<const Eigen::VectorXd>&, BaseFrame>(&to_screws),
        py::arg("chain"), py::arg("reference_configuration"), py::arg("base_frame"),
        R"(The screw chain of a DH chain.

Parameters
----------
chain : StandardDhChain or ModifiedDhChain
reference_configuration : (n,) array
    rad or m, raw encoder values.
base_frame : BaseFrame
    ``chain_base``: lines in the DH chain's base frame; ``sensor_at_reference``: in the sensor frame at the reference
    configuration, home identity.

Raises
------
InvalidInput
    reference_configuration or types do not have one entry per row.)");
  m.def("dh_parameter_jacobian",
        py::overload_cast<const ScrewChain&, const DhConversion<DhChain>&, double>(&dh_parameter_jacobian),
        py::arg("chain"), py::arg("at"), py::arg("step") = 1e-6, release_gil(),
        R"(Derivative of the DH parameters by the axes' local coordinates.

Parameters
----------
chain : ScrewChain
at : StandardDhConversion or ModifiedDhConversion
    The conversion of this chain.
step : float
    Of the central differences, rad and m; less is used where neighbours are near-parallel.

Returns
-------
(4 n, 4 n) array
    Rows a, alpha, d, theta of each DH row; columns d1, d2, p1, p2 of each axis (see JointAxis). The covariance of the
    parameters is J C J^T. Rows of free parameters are zero; rows of parameters without a derivative, because their
    neighbours are exactly parallel, are NaN.

Raises
------
InvalidInput
    The conversion is of another number of joints, or the step is not a small positive number.)");
}

template <class DhChain>
auto conversion_with(DhConversion<DhChain> (*convert)(const ScrewChain&, const DhOptions<DhChain>&)) {
  return [convert](const ScrewChain& chain, const std::optional<DhChain>& nominal, double parallel_tolerance,
                   double near_parallel_threshold) {
    return convert(chain, {nominal, parallel_tolerance, near_parallel_threshold});
  };
}

constexpr const char* to_dh_doc = R"(Denavit-Hartenberg parameters of a screw chain, by common normals.

Parameters
----------
chain : ScrewChain
nominal : StandardDhChain or ModifiedDhChain, optional
    Of the convention asked for. Chooses the branch (nearest) and the values of free parameters; without it free
    parameters are zero, alpha is in [0, pi] and theta in (-pi, pi].
parallel_tolerance : float
    rad, neighbours within it count as exactly parallel.
near_parallel_threshold : float
    rad, neighbours within it are reported.

Returns
-------
StandardDhConversion or ModifiedDhConversion

Raises
------
InvalidInput
    The chain has no joints, or the nominal chain has another number or other types of joints.

References
----------
Denavit and Hartenberg, "A kinematic notation for lower-pair mechanisms based on matrices", J. Appl. Mech. 22, 1955.
Craig, "Introduction to Robotics: Mechanics and Control", 1986.)";

}  // namespace

void bind_chain(py::module_& m) {
  bind_screw_chain(m);
  py::class_<DhRow>(m, "DhRow", "One row of DH parameters; theta (revolute) or d (prismatic) at q = 0.")
      .def(py::init<double, double, double, double>(), py::arg("a") = 0.0, py::arg("alpha") = 0.0, py::arg("d") = 0.0,
           py::arg("theta") = 0.0)
      .def_readonly("a", &DhRow::a, "m.")
      .def_readonly("alpha", &DhRow::alpha, "rad.")
      .def_readonly("d", &DhRow::d, "m.")
      .def_readonly("theta", &DhRow::theta, "rad.")
      .def("__repr__", &repr)
      .def("__eq__", [](const DhRow& row, const DhRow& other) { return row == other; }, py::is_operator())
      .def("__hash__", [](const DhRow& row) { return py::hash(py::make_tuple(row.a, row.alpha, row.d, row.theta)); })
      .def(py::pickle([](const DhRow& row) { return py::make_tuple(row.a, row.alpha, row.d, row.theta); },
                      [](const py::tuple& state) {
                        return DhRow{state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),
                                     state[3].cast<double>()};
                      }));
  m.def("standard_dh_transform", &standard_dh_transform, py::arg("row"), py::arg("type"), py::arg("q"),
        "T_i-1_i (4, 4) of one row at joint value q: Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha).");
  m.def("modified_dh_transform", &modified_dh_transform, py::arg("row"), py::arg("type"), py::arg("q"),
        "T_i-1_i (4, 4) of one row at joint value q: Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d).");
  py::native_enum<BaseFrame>(m, "BaseFrame", "enum.Enum", "Which frame the lines of a screw chain are given in.")
      .value("chain_base", BaseFrame::chain_base)
      .value("sensor_at_reference", BaseFrame::sensor_at_reference)
      .finalize();
  py::class_<NearParallel>(m, "NearParallel", "Neighbouring axes whose directions are nearly parallel or anti-parallel.")
      .def_readonly("first", &NearParallel::first, "Joint (from 0); the other is the next.")
      .def_readonly("angle", &NearParallel::angle, "rad, 0 to pi/2.")
      .def_readonly("parallel", &NearParallel::parallel, "Within parallel_tolerance.")
      .def("__repr__", [](const NearParallel& pair) {
        std::ostringstream text;
        text << "NearParallel(first=" << pair.first << ", angle=" << pair.angle
             << ", parallel=" << (pair.parallel ? "True" : "False") << ")";
        return text.str();
      });
  m.def("align_lines", &align_lines, py::arg("target"), py::arg("source"), py::arg("length") = 0.5,
        py::arg("types") = std::vector<JointType>{}, release_gil(), R"(
The rigid transform that brings lines closest to their counterparts, such as nominal axes to calibrated ones.

Parameters
----------
target, source : list of Line
    In correspondence, m.
length : float
    m; weighs a radian of direction against a metre of position.
types : list of JointType
    One a line, or none: all revolute. Of a prismatic joint's line only the direction counts.

Returns
-------
(4, 4) float64
    T_target_source; the smallest displacement where the lines leave freedom.

Raises
------
InvalidInput
    Different numbers of lines or types, or no lines.
)");
  bind_dh_convention<StandardDhChain>(m, "StandardDhChain", "StandardDhConversion", R"(A serial chain in the standard DH convention.

``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``; a revolute joint adds q to theta, a prismatic one to d.)");
  bind_dh_convention<ModifiedDhChain>(m, "ModifiedDhChain", "ModifiedDhConversion", R"(A serial chain in the modified (Craig) DH convention.

A row holds the a and alpha that come before its joint; ``T_base_sensor(q) = base T_0_1(q_1) ... T_n-1_n(q_n) tool``.)");
  m.def("to_standard_dh", conversion_with(&to_standard_dh), py::arg("chain"), py::arg("nominal") = py::none(),
        py::arg("parallel_tolerance") = 1e-8, py::arg("near_parallel_threshold") = 1e-3, to_dh_doc);
  m.def("to_modified_dh", conversion_with(&to_modified_dh), py::arg("chain"), py::arg("nominal") = py::none(),
        py::arg("parallel_tolerance") = 1e-8, py::arg("near_parallel_threshold") = 1e-3, to_dh_doc);
}

}  // namespace circlepoint::bindings
