#include "bindings.hpp"
#include "circlepoint/simulation/acquisition.hpp"
#include "circlepoint/simulation/held_joints.hpp"

namespace circlepoint::bindings {
namespace {

constexpr const char* temperature_doc = R"(Of the sensor while it records: ``start + rise (1 - exp(-t / time_constant))``.

Parameters
----------
start, rise : float, degrees Celsius
time_constant : float, s
sensor_offset, sensor_noise_std : float, degrees Celsius
    Of the internal thermometer; the noise is white per sample.
)";

constexpr const char* held_joints_doc = R"(Joints held by a proportional-derivative loop.

Parameters
----------
natural_frequency : (n,) array_like, Hz
    0 for a joint that follows exactly; empty for all.
settling_time : float, s
    Until oscillations have decayed to 2 %.
)";

constexpr const char* acquisition_doc = R"(What lies between the sensor and the log; everything is off by default.

The trajectory is given at the analogue rate, `oversampling` times the recording's rate.

Parameters
----------
oversampling : int
    Analogue instants a sample.
noise_bands : list of NoiseBand
    Of the sensor.
response_bands : list of ResponseBand
    Each channel's frequency response is drawn within them.
resolution : float, m/s^2
    Of the sensor; 0: any change shows.
signal_cutoff, temperature_cutoff : float, Hz
    -3 dB of the conditioning unit's causal Butterworth filters; 0: none.
filter_order : int
    Of both.
cable_noise_std : float, m/s^2
    White, per sample.
pickup_amplitude : float, m/s^2
pickup_frequency : float, Hz
channel_skew : float, s
    Between channels x, y, z, temperature of the multiplexed converter.
converter_bits : int
    0: no quantisation.
converter_range : float, m/s^2
    Full scale is plus and minus this at gain 1.
converter_gain : float
encoder_rate : float, Hz
    At which encoders are read; each sample holds the last reading. 0: at every sample.
sheet : AccelerometerModel, optional
    What readings are corrected by, at the recorded temperature; None: they stay raw.

References
----------
Canepa, Hollerbach, Boelen 1994, sec. 3.
)";

constexpr const char* compliance_doc = R"(How far joints of a stiffness give way: `SimulationOptions.compliance`.

Parameters
----------
stiffness : (n,) array_like, N m/rad (prismatic: N/m)
mass : float, kg
    The load at the sensor.

Returns
-------
(n,) ndarray

Raises
------
InvalidInput
    For a stiffness that is not positive or a negative mass.
)";

}  // namespace

void bind_acquisition(py::module_& m) {
  const TemperatureProfile profile;
  py::class_<TemperatureProfile>(m, "TemperatureProfile", temperature_doc)
      .def(py::init([](double start, double rise, double time_constant, double sensor_offset, double sensor_noise_std) {
             return TemperatureProfile{start, rise, time_constant, sensor_offset, sensor_noise_std};
           }),
           py::kw_only(), py::arg("start") = profile.start, py::arg("rise") = profile.rise,
           py::arg("time_constant") = profile.time_constant, py::arg("sensor_offset") = profile.sensor_offset,
           py::arg("sensor_noise_std") = profile.sensor_noise_std)
      .def_readonly("start", &TemperatureProfile::start, "degrees Celsius")
      .def_readonly("rise", &TemperatureProfile::rise, "degrees Celsius")
      .def_readonly("time_constant", &TemperatureProfile::time_constant, "s")
      .def_readonly("sensor_offset", &TemperatureProfile::sensor_offset, "degrees Celsius")
      .def_readonly("sensor_noise_std", &TemperatureProfile::sensor_noise_std, "degrees Celsius")
      .def("at", &TemperatureProfile::at, py::arg("time"), "True temperature after `time` seconds, degrees Celsius.");

  const HeldJoints held;
  py::class_<HeldJoints>(m, "HeldJoints", held_joints_doc)
      .def(py::init([](const Eigen::VectorXd& natural_frequency, double settling_time) {
             return HeldJoints{natural_frequency, settling_time};
           }),
           py::kw_only(), py::arg("natural_frequency") = held.natural_frequency,
           py::arg("settling_time") = held.settling_time)
      .def_readonly("natural_frequency", &HeldJoints::natural_frequency, "(n,) Hz")
      .def_readonly("settling_time", &HeldJoints::settling_time, "s");

  using Options = AcquisitionOptions;
  const Options options;
  py::class_<Options>(m, "AcquisitionOptions", acquisition_doc)
      .def(py::init([](Index oversampling, const std::vector<NoiseBand>& noise_bands,
                       const std::vector<ResponseBand>& response_bands, double resolution, double signal_cutoff,
                       double temperature_cutoff, int filter_order, double cable_noise_std, double pickup_amplitude,
                       double pickup_frequency, double channel_skew, int converter_bits, double converter_range,
                       double converter_gain, double encoder_rate, const std::optional<AccelerometerModel>& sheet) {
             return Options{oversampling,   noise_bands,        response_bands, resolution,
                            signal_cutoff,  temperature_cutoff, filter_order,   cable_noise_std,
                            pickup_amplitude, pickup_frequency, channel_skew,   converter_bits,
                            converter_range, converter_gain,    encoder_rate,   sheet};
           }),
           py::kw_only(), py::arg("oversampling") = options.oversampling,
           py::arg("noise_bands") = std::vector<NoiseBand>{}, py::arg("response_bands") = std::vector<ResponseBand>{},
           py::arg("resolution") = options.resolution, py::arg("signal_cutoff") = options.signal_cutoff,
           py::arg("temperature_cutoff") = options.temperature_cutoff, py::arg("filter_order") = options.filter_order,
           py::arg("cable_noise_std") = options.cable_noise_std, py::arg("pickup_amplitude") = options.pickup_amplitude,
           py::arg("pickup_frequency") = options.pickup_frequency, py::arg("channel_skew") = options.channel_skew,
           py::arg("converter_bits") = options.converter_bits, py::arg("converter_range") = options.converter_range,
           py::arg("converter_gain") = options.converter_gain, py::arg("encoder_rate") = options.encoder_rate,
           py::arg("sheet") = py::none())
      .def_readwrite("oversampling", &Options::oversampling, "analogue instants a sample")
      .def_readwrite("noise_bands", &Options::noise_bands, "of the sensor")
      .def_readwrite("response_bands", &Options::response_bands, "of the sensor")
      .def_readwrite("resolution", &Options::resolution, "m/s^2; 0: any change shows")
      .def_readwrite("signal_cutoff", &Options::signal_cutoff, "Hz; 0: none")
      .def_readwrite("temperature_cutoff", &Options::temperature_cutoff, "Hz; 0: none")
      .def_readwrite("filter_order", &Options::filter_order)
      .def_readwrite("cable_noise_std", &Options::cable_noise_std, "m/s^2 per sample")
      .def_readwrite("pickup_amplitude", &Options::pickup_amplitude, "m/s^2")
      .def_readwrite("pickup_frequency", &Options::pickup_frequency, "Hz")
      .def_readwrite("channel_skew", &Options::channel_skew, "s")
      .def_readwrite("converter_bits", &Options::converter_bits, "0: no quantisation")
      .def_readwrite("converter_range", &Options::converter_range, "m/s^2 at gain 1")
      .def_readwrite("converter_gain", &Options::converter_gain)
      .def_readwrite("encoder_rate", &Options::encoder_rate, "Hz; 0: at every sample")
      .def_readwrite("sheet", &Options::sheet, "what readings are corrected by, or None");

  m.def("joint_compliance", &joint_compliance, py::arg("stiffness"), py::arg("mass"), compliance_doc);
  m.def("paper_acquisition", &paper_acquisition,
        "The acquisition chain of Canepa, Hollerbach, Boelen 1994, sec. 3: 250 Hz and 1 Hz filters, channels 25 us apart, "
        "encoders at 1 kHz; assumed: 16 bits over +-300 m/s^2 at gain 8, filters of second order, 8 analogue instants a "
        "sample. Sensor noise and response are not in it.");
}

}  // namespace circlepoint::bindings
