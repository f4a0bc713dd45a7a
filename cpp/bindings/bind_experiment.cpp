#include "bindings.hpp"
#include "circlepoint/simulation/experiment.hpp"

namespace circlepoint::bindings {

void bind_experiment(py::module_& m) {
  const Experiment experiment;
  const Eigen::VectorXd none(0);
  py::class_<Experiment>(m, "Experiment", R"(What is common to the repetitions of a simulated experiment.

Parameters
----------
chain : ScrewChain
    The arm as drawn; base frame = sensor frame at the reference configuration.
up_gravity_sensor : (3,) array_like, m/s^2
    What an ideal sensor reads at rest there.
sensor : AccelerometerSpecification
    The kind of sensor individuals are drawn from.
trajectory : JointTrajectory
simulation : SimulationOptions
    Its seed, and its acquisition's calibration sheet, are drawn anew every time.
corrected : bool
    With an acquisition: readings are corrected by the individual's sheet.
direction_std : float, rad
point_std : float, m
    Of a built arm's lines about the drawn ones, in each of their local coordinates.
start_spread : (n,) array_like, rad or m
    Joints start up to this beyond the trajectory, so that encoders round differently every time.
)")
      .def(py::init([](ScrewChain chain, const Eigen::Vector3d& up_gravity_sensor, AccelerometerSpecification sensor,
                       JointTrajectory trajectory, SimulationOptions simulation, bool corrected, double direction_std,
                       double point_std, Eigen::VectorXd start_spread) {
             return Experiment{std::move(chain),      up_gravity_sensor, std::move(sensor), std::move(trajectory),
                               std::move(simulation), corrected,         direction_std,     point_std,
                               std::move(start_spread)};
           }),
           py::kw_only(), py::arg("chain"), py::arg("up_gravity_sensor"), py::arg("sensor"), py::arg("trajectory"),
           py::arg_v("simulation", SimulationOptions{}, "SimulationOptions()"), py::arg("corrected") = experiment.corrected,
           py::arg("direction_std") = experiment.direction_std, py::arg("point_std") = experiment.point_std,
           py::arg("start_spread") = none)
      .def_readonly("chain", &Experiment::chain)
      .def_readonly("up_gravity_sensor", &Experiment::up_gravity_sensor, "(3,) m/s^2")
      .def_readonly("sensor", &Experiment::sensor)
      .def_readonly("trajectory", &Experiment::trajectory)
      .def_readonly("simulation", &Experiment::simulation)
      .def_readonly("corrected", &Experiment::corrected)
      .def_readonly("direction_std", &Experiment::direction_std, "rad")
      .def_readonly("point_std", &Experiment::point_std, "m")
      .def_readonly("start_spread", &Experiment::start_spread, "(n,) rad or m");
  py::class_<SimulatedExperiment>(m, "SimulatedExperiment", "One repetition: what was recorded, and what is true of it.")
      .def_readonly("recording", &SimulatedExperiment::recording)
      .def_readonly("chain", &SimulatedExperiment::chain, "of the arm as built")
      .def_readonly("up_gravity_sensor", &SimulatedExperiment::up_gravity_sensor,
                    "(3,) m/s^2, at rest at the chain's reference configuration")
      .def_readonly("sensor", &SimulatedExperiment::sensor, "as its readings are recorded")
      .def_readonly("sheet", &SimulatedExperiment::sheet, "its calibration sheet, with an acquisition; else None");
  m.def("simulate_experiment", &simulate_experiment, py::arg("experiment"), py::arg("seed"), release_gil(), R"(
The repetition a seed stands for: an individual sensor on an individual arm, and what it recorded.

Parameters
----------
experiment : Experiment
seed : int
    The same seed gives the same bytes.

Returns
-------
SimulatedExperiment

Raises
------
InvalidInput
    As `simulate`; for standard deviations below zero, and a start_spread that is not one a joint.
)");
}

}  // namespace circlepoint::bindings
