#include <pybind11/native_enum.h>

#include <sstream>

#include "bindings.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/geometry/rigid_transform.hpp"
#include "rigid_transform_caster.hpp"

namespace circlepoint::bindings {
namespace {

std::string triple(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
  return text.str();
}

std::string repr(const Line& line) {
  return "Line(direction=" + triple(line.direction) + ", point=" + triple(line.point) + ")";
}

std::string repr(const ScrewAxis& axis) {
  return std::string("ScrewAxis(type=JointType.") + (axis.type == JointType::revolute ? "revolute" : "prismatic") +
         ", line=" + repr(axis.line) + ")";
}

std::string repr(const JointAxis& axis) {
  std::ostringstream text;
  text << "JointAxis(screw=" << repr(axis.screw) << ", direction_std=" << axis.direction_std()
       << ", point_std=" << axis.point_std() << ")";
  return text.str();
}

void bind_rigid_transform(py::module_& m) {
  m.def("make_rigid_transform", &make_rigid_transform, py::arg("matrix"), py::arg("tolerance") = 1e-9,
        R"(A homogeneous matrix, checked to be a rigid transform.

Parameters
----------
matrix : (4, 4) array
    ``[[R, p], [0, 1]]``, p in m.
tolerance : float
    Largest entry of ``R R^T - I`` and of the last row's error.

Returns
-------
(4, 4) array

Raises
------
InvalidInput
    An entry is not finite, the last row is not (0, 0, 0, 1), or R is not a proper rotation.)");
  m.def("skew", &skew, py::arg("v"), "Skew-symmetric (3, 3) matrix of a (3,) vector: ``skew(v) @ u == cross(v, u)``.");
  m.def("rotation_exp", &rotation_exp, py::arg("rotation_vector"),
        "Rotation matrix (3, 3) of a rotation vector (3,), rad.");
  m.def("rotation_log", &rotation_log, py::arg("rotation"),
        "Rotation vector (3,), rad, of norm at most pi, of a proper rotation matrix (3, 3).");
  m.def("tangent_basis", &tangent_basis, py::arg("z"),
        R"(Two unit vectors (columns of a (3, 2) array) that complete the unit vector z (3,) to a right-handed frame [u v z].

u is the part of e_x orthogonal to z (of e_y where ``abs(z[0]) > 0.9``), ``v = cross(z, u)``. Every tangent-plane
coordinate and covariance of an axis is in this basis.)");
}

void bind_line(py::module_& m) {
  py::class_<Line>(m, "Line", "A directed line: unit direction and the point of it nearest the origin.")
      .def(py::init(&make_line), py::arg("direction"), py::arg("point_on_line"), "Same as make_line.")
      .def_readonly("direction", &Line::direction, "(3,), unit.")
      .def_readonly("point", &Line::point, "(3,), m, the point nearest the origin.")
      .def("moment", &Line::moment, "Pluecker moment ``cross(point, direction)``, (3,), m.")
      .def("__repr__", py::overload_cast<const Line&>(&repr))
      .def(py::pickle([](const Line& line) { return py::make_tuple(line.direction, line.point); },
                      [](const py::tuple& state) {
                        return Line{state[0].cast<Eigen::Vector3d>(), state[1].cast<Eigen::Vector3d>()};
                      }));
  m.def("make_line", &make_line, py::arg("direction"), py::arg("point_on_line"),
        R"(Line through a point along a direction.

Parameters
----------
direction : (3,) array
    Any length but zero.
point_on_line : (3,) array
    m, any point of the line.

Raises
------
InvalidInput
    The direction is zero, or something is not finite.)");
  m.def("line_from_pluecker", &line_from_pluecker, py::arg("direction"), py::arg("moment"),
        R"(Line from Pluecker coordinates, direction (3,) and moment (3,), m.

The part of the moment along the direction is dropped.

Raises
------
InvalidInput
    The direction is zero, or something is not finite.)");
  py::class_<CommonNormal>(m, "CommonNormal", "The common normal of two lines.")
      .def_readonly("foot_first", &CommonNormal::foot_first, "(3,), m, its foot on the first line.")
      .def_readonly("foot_second", &CommonNormal::foot_second, "(3,), m, its foot on the second line.")
      .def_readonly("direction", &CommonNormal::direction,
                    "(3,), unit, from first to second; of intersecting lines ``cross(first, second)``.")
      .def_readonly("distance", &CommonNormal::distance, "m, along direction.")
      .def_readonly("angle", &CommonNormal::angle, "rad, from first to second direction about ``direction``.")
      .def_readonly("parallel", &CommonNormal::parallel, "True when the feet are a choice: nearest ``foot_hint``.");
  m.def("common_normal", &common_normal, py::arg("first"), py::arg("second"), py::arg("foot_hint"),
        py::arg("parallel_tolerance") = 1e-9,
        R"(Common normal of two lines.

Parameters
----------
first, second : Line
foot_hint : (3,) array
    m, where the feet are taken when the lines are parallel.
parallel_tolerance : float
    rad; lines that enclose less (or as much less than pi) count as parallel, their angle is 0 or pi exactly.

Returns
-------
CommonNormal)");
}

void bind_axis(py::module_& m) {
  py::native_enum<JointType>(m, "JointType", "enum.Enum", "Kind of a joint.")
      .value("revolute", JointType::revolute)
      .value("prismatic", JointType::prismatic)
      .finalize();
  py::class_<ScrewAxis>(m, "ScrewAxis", "A joint as a screw axis: rotation about a line or translation along it.")
      .def(py::init<JointType, Line>(), py::arg("type"), py::arg("line"))
      .def_readonly("type", &ScrewAxis::type)
      .def_readonly("line", &ScrewAxis::line, "Prismatic: only the direction acts.")
      .def("twist", &ScrewAxis::twist, "Twist (angular, linear) of unit joint rate, (6,).")
      .def("__repr__", py::overload_cast<const ScrewAxis&>(&repr))
      .def(py::pickle([](const ScrewAxis& axis) { return py::make_tuple(axis.type, axis.line); },
                      [](const py::tuple& state) {
                        return ScrewAxis{state[0].cast<JointType>(), state[1].cast<Line>()};
                      }));
  m.def("screw_exp", &screw_exp, py::arg("axis"), py::arg("q"),
        "Displacement (4, 4) of everything beyond the joint when it moves by q (rad or m).");
  py::class_<JointAxis>(m, "JointAxis", R"(An estimated axis and the covariance of its local coordinates.

The coordinates are (d1, d2, p1, p2), rad and m: the direction turns by d towards, and the line shifts by p along, the
columns of ``tangent_basis(direction)``.)")
      .def(py::init<ScrewAxis, Eigen::Matrix4d>(), py::arg("screw"),
           py::arg("covariance") = Eigen::Matrix4d(Eigen::Matrix4d::Zero()))
      .def_readonly("screw", &JointAxis::screw)
      .def_readonly("covariance", &JointAxis::covariance, "(4, 4), rad^2, rad m, m^2.")
      .def("direction_std", &JointAxis::direction_std, "Larger principal standard deviation of the direction, rad.")
      .def("point_std", &JointAxis::point_std, "Larger principal standard deviation of the nearest point, m.")
      .def("__repr__", py::overload_cast<const JointAxis&>(&repr))
      .def(py::pickle([](const JointAxis& axis) { return py::make_tuple(axis.screw, axis.covariance); },
                      [](const py::tuple& state) {
                        return JointAxis{state[0].cast<ScrewAxis>(), state[1].cast<Eigen::Matrix4d>()};
                      }));
  m.def("retract", &retract, py::arg("line"), py::arg("local"),
        "The line displaced by local coordinates (d1, d2, p1, p2), (4,), rad and m.");
  m.def("local_coordinates", &local_coordinates, py::arg("line"), py::arg("other"),
        R"(Local coordinates (4,) of a line at another: ``retract(line, local_coordinates(line, other)) == other``.

Raises
------
InvalidInput
    The lines are at right angles.)");
  m.def("local_coordinates_jacobian", &local_coordinates_jacobian, py::arg("T_a_b"), py::arg("axis_b"),
        "Derivative (4, 4) of the local coordinates in a by those in b; rows and columns p of a prismatic axis are zero.");
}

void bind_transform(py::module_& m) {
  constexpr const char* doc = R"(A line or axis given in b-coordinates, in a-coordinates.

Parameters
----------
T_a_b : (4, 4) array
    Maps b-coordinates to a.

Raises
------
InvalidInput
    T_a_b is not a rigid transform.)";
  m.def("transform", py::overload_cast<const RigidTransform&, const Line&>(&transform), py::arg("T_a_b"),
        py::arg("line_b"), doc);
  m.def("transform", py::overload_cast<const RigidTransform&, const ScrewAxis&>(&transform), py::arg("T_a_b"),
        py::arg("axis_b"), doc);
  m.def("transform", py::overload_cast<const RigidTransform&, const JointAxis&>(&transform), py::arg("T_a_b"),
        py::arg("axis_b"), doc);
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_rigid_transform(m);
  bind_line(m);
  bind_axis(m);
  bind_transform(m);
}

}  // namespace circlepoint::bindings
