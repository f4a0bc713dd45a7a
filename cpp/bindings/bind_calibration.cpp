#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "circlepoint/identification/sensor_from_gravity.hpp"

namespace circlepoint::bindings {
namespace {

void bind_sensor_from_gravity(py::module_& m) {
  py::class_<SensorFromGravity>(m, "SensorFromGravity", "Static sensor errors from the magnitude of gravity.")
      .def_readonly("sensor", &SensorFromGravity::sensor)
      .def_readonly("covariance", &SensorFromGravity::covariance, "(12, 12) of bias, scale, misalignment, second order")
      .def_readonly("prior_factor", &SensorFromGravity::prior_factor)
      .def_readonly("noise_std", &SensorFromGravity::noise_std, "m/s^2")
      .def_readonly("residual_rms", &SensorFromGravity::residual_rms, "m/s^2");
  m.def("fit_sensor_from_gravity", &fit_sensor_from_gravity, py::arg("dwell_specific_force").noconvert(),
        py::arg("specification"), py::arg("gravity") = standard_gravity, py::arg("adapt_prior") = false,
        py::arg("dwell_noise_std") = 0.0, release_gil(), R"(
Bias, scale, misalignment and second-order error from |f| = g at rest, with a prior.

Parameters
----------
dwell_specific_force : (K, 3) float64, C order
    Mean reading of each dwell, m/s^2.
specification : AccelerometerSpecification
    Prior standard deviations.
gravity : float
    Local magnitude, m/s^2.
adapt_prior : bool
    Let the dwells set the prior's common width.
dwell_noise_std : float
    Noise of a dwell's mean by the scatter of its own samples, m/s^2: the least that is assumed.

Returns
-------
SensorFromGravity

Raises
------
InvalidInput
    Gravity not positive, or a dwell without a finite reading.
)");
}

void bind_arm(py::module_& m) {
  py::native_enum<CalibrationMethod>(m, "CalibrationMethod", "enum.Enum", "How joints are estimated.")
      .value("position", CalibrationMethod::position)
      .value("velocity", CalibrationMethod::velocity)
      .value("joint", CalibrationMethod::joint)
      .finalize();
  py::class_<JointCalibrationOptions>(m, "JointCalibrationOptions", "Options of calibrate_joints.")
      .def(py::init<>())
      .def_readwrite("method", &JointCalibrationOptions::method)
      .def_readwrite("sensor", &JointCalibrationOptions::sensor, "prior on the individual sensor")
      .def_readwrite("adapt_sensor_prior", &JointCalibrationOptions::adapt_sensor_prior)
      .def_readwrite("gravity", &JointCalibrationOptions::gravity, "m/s^2")
      .def_readwrite("cutoff", &JointCalibrationOptions::cutoff, "Hz; 0: chosen per test")
      .def_readwrite("filter_order", &JointCalibrationOptions::filter_order)
      .def_readwrite("use_resting_encoders", &JointCalibrationOptions::use_resting_encoders)
      .def_readwrite("max_passes", &JointCalibrationOptions::max_passes)
      .def_readwrite("joint_types", &JointCalibrationOptions::joint_types)
      .def_readwrite("encoder_resolution", &JointCalibrationOptions::encoder_resolution, "(n,) rad or m a count; empty: from the data")
      .def_readwrite("reference_configuration", &JointCalibrationOptions::reference_configuration, "(n,) rad or m, or None");
  py::class_<TestFit>(m, "TestFit", "One joint test's fit, with the signals to look at it.")
      .def_readonly("joint", &TestFit::joint, "0-based")
      .def_readonly("test", &TestFit::test, "index into Segmentation.tests")
      .def_readonly("type", &TestFit::type)
      .def_readonly("configuration", &TestFit::configuration, "(n,) rad or m")
      .def_readonly("model", &TestFit::model)
      .def_readonly("noise_covariance", &TestFit::noise_covariance, "(4, 4) of the line's local coordinates")
      .def_readonly("percussion_distance_std", &TestFit::percussion_distance_std, "(3,) m")
      .def_readonly("acceleration_rms", &TestFit::acceleration_rms, "m/s^2, prismatic: of the joint, filtered")
      .def_readonly("acceleration_scale", &TestFit::acceleration_scale,
                    "prismatic: acceleration read by that of the encoder; 1 where both are right")
      .def_readonly("acceleration_scale_std", &TestFit::acceleration_scale_std, "noise and the sensor's scale")
      .def_readonly("cutoff", &TestFit::cutoff, "Hz")
      .def_readonly("dwell_noise_std", &TestFit::dwell_noise_std, "m/s^2, of a dwell's mean by its own samples")
      .def_readonly("static_noise_std", &TestFit::static_noise_std, "m/s^2")
      .def_readonly("dynamic_noise_std", &TestFit::dynamic_noise_std, "m/s^2")
      .def_readonly("correlation_factor", &TestFit::correlation_factor)
      .def_readonly("parameters", &TestFit::parameters)
      .def_readonly("rank", &TestFit::rank, "parameter combinations the data alone determine")
      .def_readonly("condition_number", &TestFit::condition_number)
      .def_readonly("gravity_share", &TestFit::gravity_share)
      .def_readonly("samples", &TestFit::samples)
      .def_readonly("knocks", &TestFit::knocks, "dynamic samples left out around residuals beyond six robust deviations")
      .def_readonly("iterations", &TestFit::iterations)
      .def_readonly("converged", &TestFit::converged)
      .def_readonly("time", &TestFit::time, "(M,) s")
      .def_readonly("position", &TestFit::position, "(M,) rad or m")
      .def_readonly("measured", &TestFit::measured, "(M, 3) m/s^2, filtered and corrected")
      .def_readonly("modelled", &TestFit::modelled, "(M, 3) m/s^2, through the same filter")
      .def_readonly("dwell_positions", &TestFit::dwell_positions, "(K,) rad or m")
      .def_readonly("dwell_measured", &TestFit::dwell_measured, "(K, 3) m/s^2")
      .def_readonly("dwell_modelled", &TestFit::dwell_modelled, "(K, 3) m/s^2");
  py::class_<JointEstimate>(m, "JointEstimate", "One joint's axis, or why there is none.")
      .def_readonly("joint", &JointEstimate::joint, "0-based")
      .def_readonly("axis", &JointEstimate::axis, "JointAxis at the reference configuration, or None")
      .def_readonly("reason", &JointEstimate::reason)
      .def_readonly("vague", &JointEstimate::vague,
                    "JointAxis too vague to be given, its direction known to 50 mrad at least (whole-arm), or None")
      .def_readonly("fit", &JointEstimate::fit, "index into JointCalibration.fits, -1 without one");
  py::class_<JointCalibration>(m, "JointCalibration", "Every joint's axis at one reference configuration.")
      .def_readonly("reference_configuration", &JointCalibration::reference_configuration, "(n,) rad or m")
      .def_readonly("joints", &JointCalibration::joints)
      .def_readonly("covariance", &JointCalibration::covariance, "(4n, 4n) of the lines' local coordinates")
      .def_readonly("up_gravity_sensor", &JointCalibration::up_gravity_sensor, "(3,) m/s^2")
      .def_readonly("sensor", &JointCalibration::sensor)
      .def_readonly("percussion_distance", &JointCalibration::percussion_distance, "(3,) m, of each channel")
      .def_readonly("percussion_distance_std", &JointCalibration::percussion_distance_std, "(3,) m")
      .def_readonly("fits", &JointCalibration::fits)
      .def_readonly("unseen", &JointCalibration::unseen)
      .def_readonly("passes", &JointCalibration::passes)
      .def_readonly("converged", &JointCalibration::converged)
      .def("complete", &JointCalibration::complete)
      .def("chain", &JointCalibration::chain, "The calibrated ScrewChain; raises NotIdentifiable naming missing joints.");
  m.def("calibrate_joints", &calibrate_joints, py::arg("recording"), py::arg("segmentation"),
        py::arg_v("options", JointCalibrationOptions{}, "JointCalibrationOptions()"), release_gil(), R"(
Every joint's axis, one joint at a time, from a segmented recording.

Parameters
----------
recording : Recording
segmentation : Segmentation
options : JointCalibrationOptions

Returns
-------
JointCalibration
    Joints that could not be estimated carry the reason instead of an axis.

Raises
------
InvalidInput
    Options that do not fit the recording.

References
----------
docs/method, sections 2 and 3.
)");
  m.def("end_point_std",
        py::overload_cast<const ScrewChain&, const Eigen::Ref<const Eigen::MatrixXd>&, const Eigen::Ref<const SamplesX>&>(&end_point_std),
        py::arg("chain"), py::arg("line_covariance"), py::arg("configurations"), release_gil(), R"(
Predicted standard deviation of the sensor's position.

Parameters
----------
chain : ScrewChain
line_covariance : (4n, 4n) float64
    Of the lines' local coordinates.
configurations : (P, n) float64
    rad or m.

Returns
-------
(P,) float64
    Root of the position covariance's trace, m.
)");
}

}  // namespace

void bind_calibration(py::module_& m) {
  bind_sensor_from_gravity(m);
  bind_arm(m);
}

}  // namespace circlepoint::bindings
