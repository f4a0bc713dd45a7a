#include "bindings.hpp"
#include "circlepoint/core/random.hpp"
#include "circlepoint/simulation/excitation.hpp"
#include "circlepoint/simulation/simulate.hpp"

namespace circlepoint::bindings {
namespace {

constexpr const char* trajectory_doc = R"(Joint positions with exact derivatives on a uniform clock.

Made by `joint_trajectory` or `static_poses`, or from arrays of your own.

Parameters
----------
time : (N,) ndarray, s
position, velocity, acceleration : (N, n) ndarray of float64, rad or m and their time derivatives
sample_rate : float, Hz
)";

constexpr const char* joint_trajectory_doc = R"(Pieces of motion in order, sampled on a uniform clock.

Derivatives are those of the formulas, never differences.

Parameters
----------
start : (n,) array_like, rad or m
    Where the joints are before the first piece.
pieces : sequence of Dwell, PointToPointMove, SteppedSweep, RaisedCosine or MultiJointMotion
    Each begins where the one before ended.
sample_rate : float, Hz
rest : float, s
    The joints rest this long before the first piece, between any two and after the last.

Returns
-------
JointTrajectory

Raises
------
InvalidInput
    For durations or rates that are not positive, joints that do not exist, values that are not finite, and a raised
    cosine of a fractional number of cycles.

References
----------
Canepa, Hollerbach, Boelen 1994, eq. (11); Flash and Hogan 1985 (minimum jerk).
)";

constexpr const char* static_poses_doc = R"(One sample a pose, at rest: the means of a static test's dwells.

Parameters
----------
poses : (N, n) ndarray of float64, rad or m
sample_rate : float, Hz

Returns
-------
JointTrajectory

Raises
------
InvalidInput
    For no poses, or values that are not finite.
)";

constexpr const char* follow_doc = R"(The motion that held joints make of a commanded one.

Parameters
----------
commanded : JointTrajectory
joints : HeldJoints

Returns
-------
JointTrajectory

Raises
------
InvalidInput
    For another number of joints, or a frequency that is negative or too low to ring.

References
----------
docs/method, (M22).
)";

constexpr const char* vibration_doc = R"(Structural vibration while the arm moves: sinusoids of random phase.

Parameters
----------
tangential_amplitude : float, m/s^2
    Root sum of squares of the components' amplitudes along the sensor's direction of motion.
orthogonal_amplitude : float, m/s^2
    The same for each of the two directions orthogonal to it.
frequency_min, frequency_max : float, Hz
    Below half the sample rate.
components : int
    Sinusoids a direction.
ramp : float, s
    Fading in after the start and out before the end of every stretch of motion.

References
----------
Canepa, Hollerbach, Boelen 1994, sec. 4.
)";

constexpr const char* options_doc = R"(What the simulated arm and its instruments add to the ideal recording.

Parameters
----------
noise_std : float, m/s^2
    White noise per sample.
range : float, m/s^2
    Readings clip at plus and minus this; 0 for no clipping.
encoder_counts_per_revolution : (n,) array_like
    Per metre for a prismatic joint; 0 for an exact encoder; empty for all exact.
bias_drift : (3,) array_like, m/s^2
    Reached linearly from zero over the recording.
compliance : (n,) array_like, rad per m^2/s^2 (prismatic: m per m/s^2)
    How far each joint gives way to the weight of a unit mass at the sensor; empty for a rigid arm.
vibration : VibrationOptions
seed : int
held_joints : HeldJoints
    Joints that follow their command late and ring.
temperature : TemperatureProfile, optional
    Of the sensor while it records; the recording then has a temperature. None: the sensor is at its reference.
angular_velocity_noise_std : float, rad/s, optional
    White noise per sample of a gyroscope at the sensor; None: there is no gyroscope.
acquisition : AcquisitionOptions, optional
    What lies between sensor and log; the trajectory is then given at the analogue rate.
)";

constexpr const char* simulate_doc = R"(The recording a real arm and a real sensor would have made of a motion.

Parameters
----------
chain : ScrewChain
    Lines in the sensor frame at the reference configuration.
up_gravity_sensor : (3,) array_like, m/s^2
    What an ideal sensor reads at rest at the reference configuration.
sensor : AccelerometerModel
trajectory : JointTrajectory
    Commanded motion.
options : SimulationOptions

Returns
-------
Recording
    The same seed gives the same bytes.

Raises
------
InvalidInput
    Where sizes do not match the chain or an option is out of its range.

References
----------
Canepa, Hollerbach, Boelen 1994, sec. 4.
)";

void bind_excitation(py::module_& m) {
  py::class_<JointTrajectory>(m, "JointTrajectory", trajectory_doc)
      .def(py::init([](const Eigen::VectorXd& time, const SamplesX& position, const SamplesX& velocity,
                       const SamplesX& acceleration, double sample_rate) {
             return JointTrajectory{time, position, velocity, acceleration, sample_rate};
           }),
           py::arg("time"), py::arg("position").noconvert(), py::arg("velocity").noconvert(),
           py::arg("acceleration").noconvert(), py::arg("sample_rate"))
      .def_readonly("time", &JointTrajectory::time, "(N,) s")
      .def_readonly("position", &JointTrajectory::position, "(N, n) rad or m")
      .def_readonly("velocity", &JointTrajectory::velocity, "(N, n) rad/s or m/s")
      .def_readonly("acceleration", &JointTrajectory::acceleration, "(N, n) rad/s^2 or m/s^2")
      .def_readonly("sample_rate", &JointTrajectory::sample_rate, "Hz")
      .def_property_readonly("samples", &JointTrajectory::samples, "Number of samples N.")
      .def_property_readonly("joints", &JointTrajectory::joints, "Number of joints n.");

  const Dwell dwell;
  py::class_<Dwell>(m, "Dwell", "All joints rest for `duration` seconds.")
      .def(py::init([](double duration) { return Dwell{duration}; }), py::arg("duration") = dwell.duration)
      .def_readonly("duration", &Dwell::duration, "s");

  const PointToPointMove move;
  py::class_<PointToPointMove>(m, "PointToPointMove",
                               "All joints move to `target` (n,) together in `duration` seconds by the minimum-jerk "
                               "quintic, rest to rest.")
      .def(py::init([](const Eigen::VectorXd& target, double duration) { return PointToPointMove{target, duration}; }),
           py::arg("target"), py::arg("duration") = move.duration)
      .def_readonly("target", &PointToPointMove::target, "(n,) rad or m")
      .def_readonly("duration", &PointToPointMove::duration, "s");

  const SteppedSweep sweep;
  py::class_<SteppedSweep>(m, "SteppedSweep",
                           "One joint rests `dwell` seconds at each of `steps` equally spaced positions over the "
                           "signed `span` (rad or m), moving `move` seconds between two, and returns in "
                           "`return_duration` seconds (0: stays).")
      .def(py::init([](Index joint, double span, Index steps, double dwell_duration, double move_duration,
                       double return_duration) {
             return SteppedSweep{joint, steps, span, dwell_duration, move_duration, return_duration};
           }),
           py::arg("joint"), py::arg("span"), py::arg("steps") = sweep.steps, py::arg("dwell") = sweep.dwell,
           py::arg("move") = sweep.move, py::arg("return_duration") = sweep.return_duration)
      .def_readonly("joint", &SteppedSweep::joint, "index, base to tip")
      .def_readonly("span", &SteppedSweep::span, "rad or m")
      .def_readonly("steps", &SteppedSweep::steps, "positions, both ends included")
      .def_readonly("dwell", &SteppedSweep::dwell, "s")
      .def_readonly("move", &SteppedSweep::move, "s")
      .def_readonly("return_duration", &SteppedSweep::return_duration, "s");

  const RaisedCosine cosine;
  py::class_<RaisedCosine>(m, "RaisedCosine",
                           "theta_0 + span (1 - cos(2 pi frequency t)) / 2 of one joint for a whole number of cycles: "
                           "eq. (11) of Canepa, Hollerbach, Boelen 1994.")
      .def(py::init([](Index joint, double span, double frequency, double duration) {
             return RaisedCosine{joint, span, frequency, duration};
           }),
           py::arg("joint"), py::arg("span"), py::arg("frequency") = cosine.frequency,
           py::arg("duration") = cosine.duration)
      .def_readonly("joint", &RaisedCosine::joint, "index, base to tip")
      .def_readonly("span", &RaisedCosine::span, "rad or m")
      .def_readonly("frequency", &RaisedCosine::frequency, "Hz")
      .def_readonly("duration", &RaisedCosine::duration, "s");

  const MultiJointMotion free;
  py::class_<MultiJointMotion>(m, "MultiJointMotion",
                               "All joints at once: per joint the mean of `harmonics` sinusoids of random frequency "
                               "and phase within plus and minus `amplitude` (n,), faded in and out over `ramp` "
                               "seconds.")
      .def(py::init([](double duration, const Eigen::VectorXd& amplitude, double frequency_min, double frequency_max,
                       Index harmonics, double ramp, std::uint64_t seed) {
             return MultiJointMotion{duration, amplitude, frequency_min, frequency_max, harmonics, ramp, seed};
           }),
           py::arg("duration"), py::arg("amplitude"), py::arg("frequency_min") = free.frequency_min,
           py::arg("frequency_max") = free.frequency_max, py::arg("harmonics") = free.harmonics,
           py::arg("ramp") = free.ramp, py::arg("seed") = free.seed)
      .def_readonly("duration", &MultiJointMotion::duration, "s")
      .def_readonly("amplitude", &MultiJointMotion::amplitude, "(n,) rad or m")
      .def_readonly("frequency_min", &MultiJointMotion::frequency_min, "Hz")
      .def_readonly("frequency_max", &MultiJointMotion::frequency_max, "Hz")
      .def_readonly("harmonics", &MultiJointMotion::harmonics, "sinusoids a joint")
      .def_readonly("ramp", &MultiJointMotion::ramp, "s")
      .def_readonly("seed", &MultiJointMotion::seed);

  m.def("joint_trajectory", &joint_trajectory, py::arg("start"), py::arg("pieces"), py::arg("sample_rate"),
        py::arg("rest") = 0.0, release_gil(), joint_trajectory_doc);
  m.def("static_poses", &static_poses, py::arg("poses").noconvert(), py::arg("sample_rate") = 1.0, release_gil(),
        static_poses_doc);
  m.def("follow", &follow, py::arg("commanded"), py::arg("joints"), release_gil(), follow_doc);
}

}  // namespace

void bind_simulation(py::module_& m) {
  bind_excitation(m);

  const VibrationOptions vibration;
  py::class_<VibrationOptions>(m, "VibrationOptions", vibration_doc)
      .def(py::init([](double tangential_amplitude, double orthogonal_amplitude, double frequency_min,
                       double frequency_max, Index components, double ramp) {
             return VibrationOptions{tangential_amplitude, orthogonal_amplitude, frequency_min,
                                     frequency_max,        components,           ramp};
           }),
           py::kw_only(), py::arg("tangential_amplitude") = vibration.tangential_amplitude,
           py::arg("orthogonal_amplitude") = vibration.orthogonal_amplitude,
           py::arg("frequency_min") = vibration.frequency_min, py::arg("frequency_max") = vibration.frequency_max,
           py::arg("components") = vibration.components, py::arg("ramp") = vibration.ramp)
      .def_readonly("tangential_amplitude", &VibrationOptions::tangential_amplitude, "m/s^2")
      .def_readonly("orthogonal_amplitude", &VibrationOptions::orthogonal_amplitude, "m/s^2")
      .def_readonly("frequency_min", &VibrationOptions::frequency_min, "Hz")
      .def_readonly("frequency_max", &VibrationOptions::frequency_max, "Hz")
      .def_readonly("components", &VibrationOptions::components, "sinusoids a direction")
      .def_readonly("ramp", &VibrationOptions::ramp, "s");

  const SimulationOptions options;
  const Eigen::VectorXd none(0);
  py::class_<SimulationOptions>(m, "SimulationOptions", options_doc)
      .def(py::init([](double noise_std, double range, const Eigen::VectorXd& counts, const Eigen::Vector3d& bias_drift,
                       const Eigen::VectorXd& compliance, const VibrationOptions& vibration_options,
                       std::uint64_t seed, const HeldJoints& held_joints,
                       const std::optional<TemperatureProfile>& temperature,
                       std::optional<double> angular_velocity_noise_std,
                       const std::optional<AcquisitionOptions>& acquisition) {
             return SimulationOptions{noise_std, range,       counts,      bias_drift,
                                      compliance, vibration_options, seed, held_joints,
                                      temperature, angular_velocity_noise_std, acquisition};
           }),
           py::kw_only(), py::arg("noise_std") = options.noise_std, py::arg("range") = options.range,
           py::arg("encoder_counts_per_revolution") = none, py::arg("bias_drift") = options.bias_drift,
           py::arg("compliance") = none, py::arg_v("vibration", vibration, "VibrationOptions()"),
           py::arg("seed") = options.seed, py::arg_v("held_joints", HeldJoints{}, "HeldJoints()"),
           py::arg("temperature") = py::none(), py::arg("angular_velocity_noise_std") = py::none(),
           py::arg("acquisition") = py::none())
      .def_readonly("noise_std", &SimulationOptions::noise_std, "m/s^2 per sample")
      .def_readonly("range", &SimulationOptions::range, "m/s^2; 0: no clipping")
      .def_readonly("encoder_counts_per_revolution", &SimulationOptions::encoder_counts_per_revolution, "(n,)")
      .def_readonly("bias_drift", &SimulationOptions::bias_drift, "(3,) m/s^2 over the recording")
      .def_readonly("compliance", &SimulationOptions::compliance, "(n,) rad per m^2/s^2")
      .def_readonly("vibration", &SimulationOptions::vibration)
      .def_readonly("seed", &SimulationOptions::seed)
      .def_readonly("held_joints", &SimulationOptions::held_joints)
      .def_readonly("temperature", &SimulationOptions::temperature, "of the sensor, or None")
      .def_readonly("angular_velocity_noise_std", &SimulationOptions::angular_velocity_noise_std, "rad/s, or None")
      .def_readonly("acquisition", &SimulationOptions::acquisition, "or None");

  m.def("simulate", &simulate, py::arg("chain"), py::arg("up_gravity_sensor"), py::arg("sensor"), py::arg("trajectory"),
        py::arg_v("options", options, "SimulationOptions()"), release_gil(), simulate_doc);
  m.def("derive_seed", &derive_seed, py::arg("seed"), py::arg("index"),
        "Seed of stream `index` of a parent seed: trial i of a campaign, say, on whatever machine it runs.");
}

}  // namespace circlepoint::bindings
