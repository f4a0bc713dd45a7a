#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "circlepoint/identification/axis_direction.hpp"
#include "circlepoint/identification/center_of_rotation.hpp"
#include "circlepoint/identification/circle_fit.hpp"
#include "circlepoint/identification/gravity_model.hpp"
#include "circlepoint/identification/joint_frame.hpp"
#include "circlepoint/identification/joint_regression.hpp"

namespace circlepoint::bindings {
namespace {

void bind_static_test(py::module_& m) {
  py::class_<AxisDirectionFit>(m, "AxisDirectionFit", "Direction of a joint axis from a static test.")
      .def_readonly("direction", &AxisDirectionFit::direction, "(3,) unit, in the sensor frame")
      .def_readonly("offset", &AxisDirectionFit::offset, "specific force along the axis, m/s^2")
      .def_readonly("covariance", &AxisDirectionFit::covariance, "(2, 2) rad^2, in tangent_basis(direction)")
      .def_readonly("residual_std", &AxisDirectionFit::residual_std, "m/s^2")
      .def_readonly("spread", &AxisDirectionFit::spread, "(3,) m/s^2, rms along the scatter's axes, ascending")
      .def_readonly("weights", &AxisDirectionFit::weights, "(N,) final weights, 1 for inliers")
      .def_readonly("iterations", &AxisDirectionFit::iterations)
      .def_readonly("converged", &AxisDirectionFit::converged);
  m.def("fit_axis_direction", &fit_axis_direction, py::arg("specific_force").noconvert(), release_gil(), R"(
Axis direction from static poses, closed form: the smallest eigenvector of the scatter.

Parameters
----------
specific_force : (N, 3) float64, C order
    Mean reading of each static pose, m/s^2.

Returns
-------
AxisDirectionFit
    The sign of the direction is arbitrary; see `orient_axis`.

Raises
------
InvalidInput
    Fewer than 3 poses, or a value that is not finite.
NotIdentifiable
    The poses do not spread over a plane: axis parallel to gravity, or hardly any turning.

References
----------
Canepa, Hollerbach and Boelen (1994), section 2.1, eq. (3); docs/method, section 2.
)");
  py::native_enum<AxisChart>(m, "AxisChart", "enum.Enum", "Which parameters the iteration moves an axis in.")
      .value("sphere", AxisChart::sphere)
      .value("hemisphere", AxisChart::hemisphere)
      .finalize();
  m.def(
      "fit_axis_direction_robust",
      [](const Eigen::Ref<const Samples3>& specific_force, double loss_scale, int max_iterations, AxisChart chart) {
        return fit_axis_direction_robust(specific_force, {loss_scale, max_iterations, chart});
      },
      py::arg("specific_force").noconvert(), py::arg("loss_scale") = RobustOptions{}.loss_scale,
      py::arg("max_iterations") = RobustOptions{}.max_iterations,
      py::arg_v("chart", RobustOptions{}.chart, "AxisChart.sphere"), release_gil(), R"(
Axis direction by iteration, with a Cauchy loss: poses disturbed by a knock are down-weighted.

Parameters
----------
specific_force : (N, 3) float64, C order
    Mean reading of each static pose, m/s^2.
loss_scale : float
    Residuals beyond this many robust standard deviations lose weight; infinity: plain least squares.
max_iterations : int
    Of the reweighting.
chart : AxisChart
    ``sphere``: the tangent plane. ``hemisphere``: the paper's l, m with n = sqrt(1 - l^2 - m^2), started at l = m = 0;
    an axis nearly in the sensor's x-y plane is reached slowly or not at all.

Returns
-------
AxisDirectionFit

Raises
------
InvalidInput, NotIdentifiable
    As `fit_axis_direction`; InvalidInput also when `loss_scale` is not positive.

References
----------
Canepa, Hollerbach and Boelen (1994), section 4, with its constraint corrected; docs/method, errata.
)");
  m.def("orient_axis", &orient_axis, py::arg("direction"), py::arg("angle").noconvert(), py::arg("specific_force").noconvert(),
        release_gil(), R"(
The direction or its opposite, whichever turns the samples the way the joint turned.

Parameters
----------
direction : (3,) float64
    Unit axis, sensor frame.
angle : (N,) float64
    Joint angle of each pose, rad.
specific_force : (N, 3) float64, C order
    m/s^2.

Returns
-------
(3,) float64
)");
  m.def("joint_frame", &joint_frame, py::arg("axis_direction"), R"(
The frame O_w of a joint: columns x_w, y_w, z_w in the sensor frame.

Parameters
----------
axis_direction : (3,) float64
    Any length but zero.

Returns
-------
(3, 3) float64
    R_sensor_joint, eq. (1) of Canepa, Hollerbach and Boelen (1994).
)");
  py::class_<GravityModel>(m, "GravityModel", "Static reading against joint angle: A + B cos + C sin.")
      .def_readonly("constant", &GravityModel::constant, "(3,) A, m/s^2")
      .def_readonly("cosine", &GravityModel::cosine, "(3,) B, m/s^2")
      .def_readonly("sine", &GravityModel::sine, "(3,) C, m/s^2")
      .def_readonly("covariance", &GravityModel::covariance, "(3, 3) of (A, B, C) of one channel, (m/s^2)^2")
      .def_readonly("residual_std", &GravityModel::residual_std, "m/s^2")
      .def("evaluate", &GravityModel::evaluate, py::arg("angle"), "Specific force (N, 3) m/s^2 at each angle (N,) rad.");
  m.def("fit_gravity_model", &fit_gravity_model, py::arg("angle").noconvert(), py::arg("specific_force").noconvert(),
        release_gil(), R"(
Least-squares gravity model of one joint's static sweep.

Parameters
----------
angle : (N,) float64
    rad.
specific_force : (N, 3) float64, C order
    m/s^2.

Returns
-------
GravityModel

Raises
------
NotIdentifiable
    Fewer than three distinct angles.
)");
}

void bind_dynamic_test(py::module_& m) {
  py::class_<CircleFit>(m, "CircleFit", "Circle through points of a plane.")
      .def_readonly("center", &CircleFit::center, "(2,)")
      .def_readonly("radius", &CircleFit::radius)
      .def_readonly("rms", &CircleFit::rms, "of the distances to the circle")
      .def_readonly("covariance", &CircleFit::covariance, "(2, 2) of the centre, for independent point errors")
      .def_readonly("iterations", &CircleFit::iterations)
      .def_readonly("converged", &CircleFit::converged);
  m.def("fit_circle", &fit_circle, py::arg("points").noconvert(), release_gil(), R"(
Geometric least-squares circle.

Parameters
----------
points : (N, 2) float64, C order
    Any unit.

Returns
-------
CircleFit

Raises
------
InvalidInput
    Fewer than 3 points, or a value that is not finite.
NotIdentifiable
    The points lie on a line.
)");
  py::class_<CenterOptions>(m, "CenterOptions", "Options of the paper's two methods.")
      .def(py::init<>())
      .def_readwrite("cutoff", &CenterOptions::cutoff, "Hz, zero-phase Butterworth low-pass")
      .def_readwrite("filter_order", &CenterOptions::filter_order)
      .def_readwrite("percussion_distance", &CenterOptions::percussion_distance, "m")
      .def_readwrite("least_squares", &CenterOptions::least_squares, "velocity method: least squares instead of means")
      .def_readwrite("position_window", &CenterOptions::position_window, "s of record the position method uses; 0 for all")
      .def_readwrite("significant_rate", &CenterOptions::significant_rate, "fraction of the peak rate below which samples are left out")
      .def_readwrite("max_iterations", &CenterOptions::max_iterations)
      .def_readwrite("tolerance", &CenterOptions::tolerance, "m");
  py::class_<CenterOfRotation>(m, "CenterOfRotation", "Centre of rotation by one of the paper's methods.")
      .def_readonly("lever_sensor", &CenterOfRotation::lever_sensor, "(3,) m, from the axis to the sensor, sensor frame")
      .def_readonly("center_joint", &CenterOfRotation::center_joint, "(2,) m, the centre in O_w seen from the sensor at angle zero")
      .def_readonly("radius", &CenterOfRotation::radius, "m")
      .def_readonly("point_std", &CenterOfRotation::point_std, "m, the residual taken as fully correlated")
      .def_readonly("residual_rms", &CenterOfRotation::residual_rms, "m (position) or m/s (velocity)")
      .def_readonly("iterations", &CenterOfRotation::iterations, "of the centre-of-percussion correction")
      .def_readonly("converged", &CenterOfRotation::converged)
      .def_readonly("path", &CenterOfRotation::path, "(M, 3) position (m) or velocity (m/s) in O_w as integrated");
  m.def("center_by_position", &center_by_position, py::arg("angle").noconvert(), py::arg("specific_force").noconvert(),
        py::arg("sample_rate"), py::arg("axis_direction"), py::arg("gravity"),
        py::arg_v("options", CenterOptions{}, "CenterOptions()"),
        release_gil(), R"(
Centre of rotation by double integration and a circle (the paper's first method).

Parameters
----------
angle : (N,) float64
    Joint angle, uniformly sampled from rest, rad.
specific_force : (N, 3) float64, C order
    Sensor frame, m/s^2.
sample_rate : float
    Hz.
axis_direction : (3,) float64
    Unit axis in the sensor frame.
gravity : GravityModel
    Static model of the same joint, angles from the same zero.
options : CenterOptions

Returns
-------
CenterOfRotation

Raises
------
NotIdentifiable
    The joint does not move enough.

References
----------
Canepa, Hollerbach and Boelen (1994), eq. (4)-(8), (9)-(10); docs/method, section 2.
)");
  m.def("center_by_velocity", &center_by_velocity, py::arg("angle").noconvert(), py::arg("specific_force").noconvert(),
        py::arg("sample_rate"), py::arg("axis_direction"), py::arg("gravity"),
        py::arg_v("options", CenterOptions{}, "CenterOptions()"),
        release_gil(), R"(
Centre of rotation by single integration and the encoder's rate (the paper's second method).

Parameters and errors as `center_by_position`.

Returns
-------
CenterOfRotation

References
----------
Canepa, Hollerbach and Boelen (1994), section 2.2; docs/method, section 2.
)");
}

void bind_joint_regression(py::module_& m) {
  m.def("joint_regressors", &joint_regressors, py::arg("angle").noconvert(), py::arg("rate").noconvert(),
        py::arg("acceleration").noconvert(), release_gil(), R"(
Regressors 1, cos(angle), sin(angle), acceleration, rate^2 of one joint's motion.

Parameters
----------
angle, rate, acceleration : (N,) float64
    rad, rad/s, rad/s^2.

Returns
-------
(N, 5) float64

References
----------
docs/method, section 3.
)");
  py::class_<RegressionStatistics>(m, "RegressionStatistics", "Sufficient statistics of a joint test; pieces add up.")
      .def(py::init<>())
      .def_readonly("information", &RegressionStatistics::information, "(5, 5) sum x x^T")
      .def_readonly("score", &RegressionStatistics::score, "(5, 3) sum x y^T")
      .def_readonly("squares", &RegressionStatistics::squares, "(3,) sum y^2")
      .def_readonly("count", &RegressionStatistics::count)
      .def("add", &RegressionStatistics::add, py::arg("regressors").noconvert(), py::arg("readings").noconvert(),
           py::arg("weight") = 1.0, release_gil(), "Add samples: regressors (N, 5), readings (N, 3) m/s^2, common weight.")
      .def("scaled", &RegressionStatistics::scaled, py::arg("weight"), "The statistics times a weight.")
      .def("__add__", [](RegressionStatistics a, const RegressionStatistics& b) { return a += b; });
  m.def("joint_statistics", &joint_statistics, py::arg("angle").noconvert(), py::arg("rate").noconvert(),
        py::arg("acceleration").noconvert(), py::arg("readings").noconvert(),
        py::arg_v("rotation", Eigen::Matrix3d(Eigen::Matrix3d::Identity()), "numpy.eye(3)"), release_gil(), R"(
Statistics of one motion: its regressors by the readings, in one pass and without the regressors in memory.

Parameters
----------
angle, rate, acceleration : (N,) float64
    rad, rad/s, rad/s^2.
readings : (N, 3) float64
    m/s^2.
rotation : (3, 3) float64
    Turns the readings from the sensor frame to that of the result.

Returns
-------
RegressionStatistics
    As `add` with `joint_regressors` and the turned readings.

Raises
------
InvalidInput
    On unequal lengths.

References
----------
docs/method, section 3.
)");
  py::class_<JointModel>(m, "JointModel", "What one joint's tests determine, in the sensor frame.")
      .def_readonly("axis", &JointModel::axis, "(3,) unit")
      .def_readonly("lever", &JointModel::lever, "(3,) m, from the axis to the sensor")
      .def_readonly("gravity", &JointModel::gravity, "(3,) m/s^2, up-gravity orthogonal to the axis at angle zero")
      .def_readonly("constant", &JointModel::constant, "(3,) m/s^2, up-gravity along the axis plus bias")
      .def_readonly("percussion_distance", &JointModel::percussion_distance, "(3,) m, of each channel")
      .def("coefficients", &JointModel::coefficients, "(5, 3) rows A, B, C, E, F of the regression.")
      .def("line", &JointModel::line, "The axis as a Line in the sensor frame.");
  py::class_<JointModelPrior>(m, "JointModelPrior", "What is known of a joint's readings beforehand.")
      .def(py::init<>())
      .def_readwrite("bias_std", &JointModelPrior::bias_std, "m/s^2")
      .def_readwrite("gravity", &JointModelPrior::gravity, "m/s^2")
      .def_readwrite("gravity_std", &JointModelPrior::gravity_std, "m/s^2")
      .def_readwrite("percussion_distance", &JointModelPrior::percussion_distance, "m")
      .def_readwrite("percussion_distance_std", &JointModelPrior::percussion_distance_std, "m; 0 fixes it");
  py::class_<JointModelFit>(m, "JointModelFit", "A joint model and its information.")
      .def_readonly("model", &JointModelFit::model)
      .def_readonly("information", &JointModelFit::information, "(12, 12) data and prior")
      .def_readonly("data_information", &JointModelFit::data_information, "(12, 12) data alone")
      .def_readonly("iterations", &JointModelFit::iterations)
      .def_readonly("converged", &JointModelFit::converged);
  m.def("fit_joint_model", &fit_joint_model, py::arg("weighted"),
        py::arg_v("prior", JointModelPrior{}, "JointModelPrior()"), release_gil(), R"(
Maximum-likelihood joint model from sufficient statistics.

Parameters
----------
weighted : RegressionStatistics
    Divided by the noise variance: weights 1/sigma^2.
prior : JointModelPrior

Returns
-------
JointModelFit
    Parameters of the information: direction (2), gravity (2), lever (2) in tangent_basis(axis), constant (3),
    percussion distances (3).

Raises
------
NotIdentifiable
    The joint never accelerated, or its readings do not change.

References
----------
docs/method, section 3.
)");
}

}  // namespace

void bind_regression(py::module_& m) {
  bind_static_test(m);
  bind_dynamic_test(m);
  bind_joint_regression(m);
}

}  // namespace circlepoint::bindings
