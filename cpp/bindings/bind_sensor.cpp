#include "bindings.hpp"
#include "circlepoint/sensor/accelerometer.hpp"

namespace circlepoint::bindings {
namespace {

using Vector3 = Eigen::Vector3d;

constexpr const char* model_doc = R"(One individual triaxial accelerometer.

Channel k reads ``(1 + scale[k]) u[k] + second_order[k] u[k]**2 + bias[k]`` with
``u = M (f - D (|w|**2 - w**2))``: f the specific force at the frame's origin, w the angular velocity, both in the
sensor frame, M unit lower triangular, D the percussion distances.

Parameters
----------
bias : (3,) array_like, m/s^2
scale : (3,) array_like
    Relative scale-factor error.
misalignment : (3,) array_like, rad
    The entries (yx, zx, zy) of M.
percussion_distance : (3,) array_like, m
    Where each channel measures along its own axis.
second_order : (3,) array_like, s^2/m

References
----------
Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
)";

constexpr const char* specification_doc = R"(What a data sheet says of a kind of accelerometer.

Standard deviations of the individual errors around nominal values: the estimators' prior and the simulator's source of
individual sensors.

Parameters
----------
bias_std : float, m/s^2
scale_std : float
misalignment_std : float, rad
percussion_distance : float, m
    Nominal value, the same for the three channels.
percussion_distance_std : float, m
second_order_std : float, s^2/m
noise_std : float, m/s^2
    White noise per sample.
range : float, m/s^2
    Readings clip at plus and minus this; 0 for no clipping.
)";

constexpr const char* measure_doc = R"(What the sensor reads at every sample, without noise.

Parameters
----------
model : AccelerometerModel
specific_force : (N, 3) ndarray of float64, m/s^2
    At the sensor frame's origin, in the sensor frame; at rest +g upwards.
angular_velocity : (N, 3) ndarray of float64, rad/s
    In the sensor frame.

Returns
-------
(N, 3) ndarray, m/s^2

Raises
------
InvalidInput
    When the arrays differ in their number of samples.

References
----------
Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
)";

constexpr const char* correct_doc = R"(The specific force behind every reading: the exact inverse of `measure`.

Parameters
----------
model : AccelerometerModel
reading : (N, 3) ndarray of float64, m/s^2
angular_velocity : (N, 3) ndarray of float64, rad/s
    In the sensor frame.

Returns
-------
(N, 3) ndarray, m/s^2
    Specific force at the sensor frame's origin.

Raises
------
InvalidInput
    When the arrays differ in their number of samples, or for a reading the model cannot produce.

References
----------
Canepa, Hollerbach, Boelen 1994, eqs. (9) and (10).
)";

constexpr const char* draw_doc = R"(One individual sensor of a kind.

Parameters
----------
specification : AccelerometerSpecification
seed : int
    The same seed draws the same sensor.

Returns
-------
AccelerometerModel

Raises
------
InvalidInput
    For a standard deviation that is negative or not finite.
)";

}  // namespace

void bind_sensor(py::module_& m) {
  const Vector3 zero = Vector3::Zero();
  py::class_<AccelerometerModel>(m, "AccelerometerModel", model_doc)
      .def(py::init([](const Vector3& bias, const Vector3& scale, const Vector3& misalignment,
                       const Vector3& percussion_distance, const Vector3& second_order) {
             return AccelerometerModel{bias, scale, misalignment, percussion_distance, second_order};
           }),
           py::kw_only(), py::arg("bias") = zero, py::arg("scale") = zero, py::arg("misalignment") = zero,
           py::arg("percussion_distance") = zero, py::arg("second_order") = zero)
      .def_readonly("bias", &AccelerometerModel::bias, "(3,) m/s^2")
      .def_readonly("scale", &AccelerometerModel::scale, "(3,) relative scale-factor error")
      .def_readonly("misalignment", &AccelerometerModel::misalignment, "(3,) rad: (yx, zx, zy)")
      .def_readonly("percussion_distance", &AccelerometerModel::percussion_distance, "(3,) m")
      .def_readonly("second_order", &AccelerometerModel::second_order, "(3,) s^2/m")
      .def("misalignment_matrix", &AccelerometerModel::misalignment_matrix, "(3, 3) unit lower triangular matrix M.");

  py::class_<AccelerometerSpecification>(m, "AccelerometerSpecification", specification_doc)
      .def(py::init([](double bias_std, double scale_std, double misalignment_std, double percussion_distance,
                       double percussion_distance_std, double second_order_std, double noise_std, double range) {
             return AccelerometerSpecification{bias_std,         scale_std,
                                               misalignment_std, percussion_distance,
                                               percussion_distance_std, second_order_std,
                                               noise_std,        range};
           }),
           py::kw_only(), py::arg("bias_std") = 0.0, py::arg("scale_std") = 0.0, py::arg("misalignment_std") = 0.0,
           py::arg("percussion_distance") = 0.0, py::arg("percussion_distance_std") = 0.0,
           py::arg("second_order_std") = 0.0, py::arg("noise_std") = 0.0, py::arg("range") = 0.0)
      .def_readonly("bias_std", &AccelerometerSpecification::bias_std, "m/s^2")
      .def_readonly("scale_std", &AccelerometerSpecification::scale_std, "1")
      .def_readonly("misalignment_std", &AccelerometerSpecification::misalignment_std, "rad")
      .def_readonly("percussion_distance", &AccelerometerSpecification::percussion_distance, "m, nominal")
      .def_readonly("percussion_distance_std", &AccelerometerSpecification::percussion_distance_std, "m")
      .def_readonly("second_order_std", &AccelerometerSpecification::second_order_std, "s^2/m")
      .def_readonly("noise_std", &AccelerometerSpecification::noise_std, "m/s^2 per sample")
      .def_readonly("range", &AccelerometerSpecification::range, "m/s^2; 0: no clipping");

  m.def("measure", &measure, py::arg("model"), py::arg("specific_force").noconvert(),
        py::arg("angular_velocity").noconvert(), release_gil(), measure_doc);
  m.def("correct", &correct, py::arg("model"), py::arg("reading").noconvert(), py::arg("angular_velocity").noconvert(),
        release_gil(), correct_doc);
  m.def("draw_accelerometer", &draw_accelerometer, py::arg("specification"), py::arg("seed"), draw_doc);
}

}  // namespace circlepoint::bindings
