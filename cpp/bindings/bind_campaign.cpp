#include <pybind11/functional.h>
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "circlepoint/campaign/comparison.hpp"
#include "circlepoint/campaign/trials.hpp"

namespace circlepoint::bindings {
namespace {

void bind_comparison(py::module_& m) {
  py::class_<LineComparison>(m, "LineComparison", "One line against the truth; NaN where there is no estimate.")
      .def_readonly("error", &LineComparison::error, "(4,) d1, d2, p1, p2: estimate minus truth, rad and m")
      .def_readonly("std", &LineComparison::std, "(4,) predicted")
      .def_readonly("nees", &LineComparison::nees, "normalised error squared per degree of freedom: 1 is honest");
  py::class_<SensorComparison>(m, "SensorComparison", "A sensor's figures against the truth, SI units.")
      .def_readonly("error", &SensorComparison::error, "(15,) in the order of sensor_figure_names(): estimate minus truth")
      .def_readonly("std", &SensorComparison::std, "(15,) predicted; 0 where a figure was taken as known");
  m.def("sensor_figure_names", &sensor_figure_names,
        "Names of a sensor's figures in the order of SensorComparison: bias_x to second_order_z.");
  m.def("compare_lines", &compare_lines, py::arg("calibration"), py::arg("truth"), release_gil(), R"(
Errors of the estimated lines, base to tip.

Parameters
----------
calibration : JointCalibration
truth : ScrewChain
    At any reference configuration; it is carried to the estimate's.

Returns
-------
list of LineComparison
    In the true line's tangent basis.

Raises
------
InvalidInput
    For another number of joints.
)");
  m.def("compare_sensor", &compare_sensor, py::arg("calibration"), py::arg("truth"), release_gil(), R"(
Errors of the estimated sensor figures.

Parameters
----------
calibration : JointCalibration
truth : AccelerometerModel

Returns
-------
SensorComparison
)");
  m.def("end_point_error", &end_point_error, py::arg("estimate"), py::arg("truth"),
        py::arg("configurations").noconvert(), release_gil(), R"(
Root mean square distance between estimated and true sensor position over configurations.

Parameters
----------
estimate, truth : ScrewChain
    Both are seen from the sensor's frame at the estimate's reference configuration.
configurations : (P, n) ndarray of float64, rad or m

Returns
-------
float
    m.

Raises
------
InvalidInput
    For numbers of joints that differ, and for no configuration.
)");
}

void bind_trials(py::module_& m) {
  py::native_enum<TrialOutcome>(m, "TrialOutcome", "enum.Enum", "How a trial ended.")
      .value("complete", TrialOutcome::complete)
      .value("incomplete", TrialOutcome::incomplete)
      .value("failed", TrialOutcome::failed)
      .finalize();
  py::class_<TrialConditions>(m, "TrialConditions", R"(What is common to the trials of one cell of a campaign.

Parameters
----------
experiment : Experiment
    What is simulated.
method : JointCalibrationOptions or WholeArmOptions
    How it is calibrated; each trial in one thread.
configurations : (P, n) ndarray of float64, rad or m
    The workspace over which the end-point is compared.
)")
      .def(py::init([](Experiment experiment, std::variant<JointCalibrationOptions, WholeArmOptions> method,
                       const Eigen::Ref<const SamplesX>& configurations) {
             return TrialConditions{std::move(experiment), std::move(method), configurations};
           }),
           py::arg("experiment"), py::arg("method"), py::arg("configurations").noconvert())
      .def_readonly("experiment", &TrialConditions::experiment)
      .def_readonly("method", &TrialConditions::method)
      .def_readonly("configurations", &TrialConditions::configurations, "(P, n) rad or m");
  py::class_<TrialResults>(m, "TrialResults", "Many trials, a row each; NaN where there is no figure.")
      .def_readonly("outcome", &TrialResults::outcome)
      .def_readonly("reason", &TrialResults::reason, "why it failed, or the first joint without a line and why")
      .def_readonly("converged", &TrialResults::converged)
      .def_readonly("iterations", &TrialResults::iterations)
      .def_readonly("line_error", &TrialResults::line_error, "(N, 4 n) d1, d2, p1, p2 of each joint: estimate minus truth")
      .def_readonly("line_std", &TrialResults::line_std, "(N, 4 n) predicted")
      .def_readonly("line_nees", &TrialResults::line_nees, "(N, n) per degree of freedom")
      .def_readonly("sensor_error", &TrialResults::sensor_error, "(N, 15) in the order of sensor_figure_names()")
      .def_readonly("sensor_std", &TrialResults::sensor_std, "(N, 15) predicted")
      .def_readonly("end_point_error", &TrialResults::end_point_error, "(N,) m, rms over the configurations")
      .def_readonly("end_point_std", &TrialResults::end_point_std, "(N,) m, predicted");
  m.def("run_trials",
        [](const TrialConditions& conditions, const std::vector<std::uint64_t>& seeds, unsigned threads,
           const std::optional<std::function<void(Index)>>& progress) {
          return run_trials(conditions, seeds, threads, progress.value_or(nullptr));
        },
        py::arg("conditions"), py::arg("seeds"), py::arg("threads") = 1, py::arg("progress") = py::none(), release_gil(),
        R"(
Simulate, calibrate, compare with the truth: one trial a seed, in threads of the core.

Parameters
----------
conditions : TrialConditions
seeds : sequence of int
    A trial is its conditions and its seed and nothing else.
threads : int
    They change the time, never a bit of the result.
progress : callable, optional
    Called on the calling thread with the number of trials done; what it raises stops the trials not yet begun.

Returns
-------
TrialResults

Raises
------
InvalidInput
    For conditions that cannot be simulated. Estimates that fail are results with their reason.
)");
}

}  // namespace

void bind_campaign(py::module_& m) {
  bind_comparison(m);
  bind_trials(m);
}

}  // namespace circlepoint::bindings
