#include "bindings.hpp"
#include "circlepoint/conditioning/autoregressive.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "signal_casters.hpp"

namespace circlepoint::bindings {
namespace {

void bind_options(py::module_& m) {
  py::class_<ParameterTreatment>(m, "ParameterTreatment", "How one group of parameters is treated: fixed, free, or with a prior.")
      .def(py::init<bool, double, bool>(), py::arg("estimated") = true, py::arg("std") = std::numeric_limits<double>::infinity(),
           py::arg("where_evident") = false)
      .def_readwrite("estimated", &ParameterTreatment::estimated, "False: fixed at its nominal value")
      .def_readwrite("std", &ParameterTreatment::std, "of the Gaussian prior about the nominal value; infinite: free")
      .def_readwrite("where_evident", &ParameterTreatment::where_evident,
                     "encoders' errors: only those that the data show by six standard deviations");
  py::class_<WholeArmOptions>(m, "WholeArmOptions", "Options of calibrate_whole_arm.")
      .def(py::init<>())
      .def_readwrite("sensor", &WholeArmOptions::sensor, "prior on the individual sensor")
      .def_readwrite("sensor_is_known", &WholeArmOptions::sensor_is_known,
                     "False: the specification is a guess, and nothing that rests on it alone is given")
      .def_readwrite("bias", &WholeArmOptions::bias, "m/s^2; std 0: the sensor's specification")
      .def_readwrite("scale", &WholeArmOptions::scale, "1; std 0: the sensor's specification")
      .def_readwrite("misalignment", &WholeArmOptions::misalignment, "rad; std 0: the sensor's specification")
      .def_readwrite("percussion_distance", &WholeArmOptions::percussion_distance, "m; std 0: the sensor's specification")
      .def_readwrite("second_order", &WholeArmOptions::second_order, "s^2/m; std 0: the sensor's specification")
      .def_readwrite("gravity", &WholeArmOptions::gravity, "m/s^2, the local magnitude; its direction is always free")
      .def_readwrite("clock_offset", &WholeArmOptions::clock_offset, "s, sensor behind the encoders")
      .def_readwrite("clock_rate", &WholeArmOptions::clock_rate, "1")
      .def_readwrite("encoder_gain", &WholeArmOptions::encoder_gain, "1")
      .def_readwrite("eccentricity", &WholeArmOptions::eccentricity, "rad")
      .def_readwrite("gyroscope_bias", &WholeArmOptions::gyroscope_bias, "rad/s")
      .def_readwrite("gyroscope_matrix", &WholeArmOptions::gyroscope_matrix, "1")
      .def_readwrite("gyroscope_delay", &WholeArmOptions::gyroscope_delay, "s, gyroscope behind the accelerometer")
      .def_readwrite("use_gyroscope", &WholeArmOptions::use_gyroscope)
      .def_readwrite("gravity_magnitude", &WholeArmOptions::gravity_magnitude, "m/s^2")
      .def_readwrite("cutoff", &WholeArmOptions::cutoff, "Hz; 0: chosen from rate and encoders")
      .def_readwrite("max_passes", &WholeArmOptions::max_passes, "of estimating parameters and noise in turn")
      .def_readwrite("random_starts", &WholeArmOptions::random_starts, "where tests give no start values")
      .def_readwrite("seed", &WholeArmOptions::seed, "of the random starts")
      .def_readwrite("threads", &WholeArmOptions::threads, "0: as many as the machine has; the result does not depend on it")
      .def_readwrite("min_travel", &WholeArmOptions::min_travel, "rad or m: joints that travel less have no line")
      .def_readwrite("joint_types", &WholeArmOptions::joint_types, "empty: all revolute")
      .def_readwrite("encoder_resolution", &WholeArmOptions::encoder_resolution, "(n,) rad or m a count; empty: from the data")
      .def_readwrite("reference_configuration", &WholeArmOptions::reference_configuration, "(n,) rad or m, or None");
}

void bind_results(py::module_& m) {
  py::class_<NamedParameter>(m, "NamedParameter", "One estimated number.")
      .def_readonly("name", &NamedParameter::name)
      .def_readonly("value", &NamedParameter::value, "lines: 0, their coordinates are taken at the estimate")
      .def_readonly("std", &NamedParameter::std)
      .def_readonly("data_std", &NamedParameter::data_std, "without priors; infinite where the data alone do not show it");
  py::class_<WeakCombination>(m, "WeakCombination", "Parameters the data hardly tell apart.")
      .def_readonly("information_ratio", &WeakCombination::information_ratio, "eigenvalue over the largest")
      .def_readonly("description", &WeakCombination::description, "parameters, numbers and what to record");
  py::class_<StretchResidual>(m, "StretchResidual", "Residuals of one kind of motion, or of the dwells.")
      .def_readonly("name", &StretchResidual::name)
      .def_readonly("begin", &StretchResidual::begin, "s")
      .def_readonly("end", &StretchResidual::end, "s")
      .def_readonly("samples", &StretchResidual::samples)
      .def_readonly("residual_rms", &StretchResidual::residual_rms, "m/s^2")
      .def_readonly("normalized_rms", &StretchResidual::normalized_rms, "whitened: 1 where model and noise hold")
      .def_readonly("held_out_rms", &StretchResidual::held_out_rms, "m/s^2, by estimates that did not see the stretch")
      .def_readonly("held_out_normalized_rms", &StretchResidual::held_out_normalized_rms)
      .def_readonly("held_out_samples", &StretchResidual::held_out_samples)
      .def_readonly("indispensable", &StretchResidual::indispensable, "stretches the rest cannot predict");
  py::class_<WholeArmCalibration>(m, "WholeArmCalibration", "The whole-arm estimate and what it says of itself.")
      .def_readonly("joints", &WholeArmCalibration::joints, "JointCalibration: lines, covariance, gravity, sensor, signals")
      .def_readonly("parameters", &WholeArmCalibration::parameters)
      .def_readonly("covariance", &WholeArmCalibration::covariance, "of `parameters`, in their order")
      .def_readonly("clock_offset", &WholeArmCalibration::clock_offset, "s, sensor behind the encoders")
      .def_readonly("clock_rate", &WholeArmCalibration::clock_rate)
      .def_readonly("encoder_gain", &WholeArmCalibration::encoder_gain, "(n,)")
      .def_readonly("eccentricity", &WholeArmCalibration::eccentricity, "(n, 2) rad")
      .def_readonly("gyroscope_bias", &WholeArmCalibration::gyroscope_bias, "(3,) rad/s")
      .def_readonly("gyroscope_matrix", &WholeArmCalibration::gyroscope_matrix, "(3, 3)")
      .def_readonly("gyroscope_delay", &WholeArmCalibration::gyroscope_delay, "s, behind the accelerometer")
      .def_readonly("gyroscope_used", &WholeArmCalibration::gyroscope_used)
      .def_readonly("rank", &WholeArmCalibration::rank, "parameter combinations the data alone determine")
      .def_readonly("condition_number", &WholeArmCalibration::condition_number)
      .def_readonly("weak", &WholeArmCalibration::weak)
      .def_readonly("stretches", &WholeArmCalibration::stretches)
      .def_readonly("cutoff", &WholeArmCalibration::cutoff, "Hz")
      .def_readonly("normalized_rms", &WholeArmCalibration::normalized_rms, "of all whitened residuals, before the inflation")
      .def_readonly("noise_inflation", &WholeArmCalibration::noise_inflation,
                    "of the motions' noise variance, so that it covers what stretches disagree by (docs/method, eq. (M31))")
      .def_readonly("samples", &WholeArmCalibration::samples)
      .def_readonly("rows", &WholeArmCalibration::rows)
      .def_readonly("outliers", &WholeArmCalibration::outliers)
      .def_readonly("starts_tried", &WholeArmCalibration::starts_tried)
      .def_readonly("iterations", &WholeArmCalibration::iterations)
      .def_readonly("unsettled", &WholeArmCalibration::unsettled,
                    "standard deviations: a parameter's step in the last pass or what is left to the minimum, the larger")
      .def_readonly("converged", &WholeArmCalibration::converged);
}

}  // namespace

void bind_whole_arm(py::module_& m) {
  bind_options(m);
  bind_results(m);
  m.def("calibrate_whole_arm", &calibrate_whole_arm, py::arg("recording"), py::arg("segmentation"),
        py::arg_v("options", WholeArmOptions{}, "WholeArmOptions()"), release_gil(), R"(
One maximum-likelihood estimate of all joint lines, gravity, the sensor's errors and the delay, from any motion.

Parameters
----------
recording : Recording
segmentation : Segmentation
    Its dwells and single-joint tests help to start; motions of several joints count as well.
options : WholeArmOptions

Returns
-------
WholeArmCalibration
    Joints that never move carry the reason instead of an axis.

Raises
------
InvalidInput
    Options that do not fit the recording.
NotIdentifiable
    Nothing moves, or no start leads to a model of the motion.

References
----------
docs/method, section 8.
)");
  m.def("end_point_std", py::overload_cast<const WholeArmCalibration&, const Eigen::Ref<const SamplesX>&>(&end_point_std),
        py::arg("calibration"), py::arg("configurations"), release_gil(), R"(
Predicted standard deviation of the sensor's position, from the lines' errors and those of the encoders' corrections.

Parameters
----------
calibration : WholeArmCalibration
configurations : (P, n) float64
    rad or m, as the joints stand when corrected for what their encoders were found to be off.

Returns
-------
(P,) float64
    Root of the position covariance's trace, m.

Raises
------
NotIdentifiable
    A joint has no axis.

References
----------
docs/method, sections 3.7 and 8.5.
)");
}

}  // namespace circlepoint::bindings
