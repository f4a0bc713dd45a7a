#include "bindings.hpp"
#include <pybind11/complex.h>

#include "circlepoint/sensor/accelerometer.hpp"
#include "circlepoint/sensor/calibrated_accelerometer.hpp"

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
temperature : TemperatureModel
    How bias and scale follow the temperature.

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
resolution : float, m/s^2
    The smallest change that shows; 0 for any.
current_scale_factor : float, A s^2/m
    Nominal; 0 for a sensor without current output.
uncorrected : UncorrectedErrors
    What the sensor's own calibration sheet corrects; the errors above are what is left then.
noise_bands : list of NoiseBand
response_bands : list of ResponseBand
)";

constexpr const char* measure_doc = R"(What the sensor reads at every sample, without noise.

Parameters
----------
model : AccelerometerModel
specific_force : (N, 3) ndarray of float64, m/s^2
    At the sensor frame's origin, in the sensor frame; at rest +g upwards.
angular_velocity : (N, 3) ndarray of float64, rad/s
    In the sensor frame.
temperature : (N,) ndarray of float64, degrees Celsius, optional
    Of the sensor; without it the sensor is at its model's reference.

Returns
-------
(N, 3) ndarray, m/s^2

Raises
------
InvalidInput
    When the arrays differ in their number of samples, or a temperature is not finite.

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
temperature : (N,) ndarray of float64, degrees Celsius, optional
    Of the sensor; without it the sensor is at its model's reference.

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

constexpr const char* temperature_doc = R"(How bias and scale factor follow the temperature: third-order polynomials.

Parameters
----------
reference : float, degrees Celsius
    Where bias and scale are those of the accelerometer's model.
bias : (3, 3) array_like
    Row k of channel k: m/s^2 per degC, degC^2, degC^3.
scale : (3, 3) array_like
    Row k of channel k: relative, per degC, degC^2, degC^3.

References
----------
docs/method, (M14).
)";

constexpr const char* band_noise_doc = R"(Three independent channels of Gaussian noise stated by band, flat within each.

Parameters
----------
bands : list of NoiseBand
samples : int
sample_rate : float, Hz
    What lies above half of it folds back.
seed : int

Returns
-------
(samples, 3) ndarray, m/s^2

Raises
------
InvalidInput
    For an empty band, an rms below zero, no samples or a rate that is not positive.

References
----------
docs/method, (M17).
)";

constexpr const char* response_doc = R"(A mass on a damped spring: ``1 / (1 - x**2 + 2j damping x)``, x = f / natural_frequency.

Parameters
----------
natural_frequency : float, Hz
damping : float
    Of critical.

References
----------
docs/method, (M16).
)";

constexpr const char* draw_calibrated_doc = R"(One individual sensor of a kind with the calibration sheet that came with it.

Correcting the actual sensor's readings by the sheet leaves what a sensor with the residual errors alone reads.

Parameters
----------
specification : AccelerometerSpecification
seed : int
    `residual` is what `draw_accelerometer` draws with it.

Returns
-------
CalibratedAccelerometer

Raises
------
InvalidInput
    For a standard deviation that is negative or not finite.

References
----------
docs/method, (M15).
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

void bind_parts(py::module_& m) {
  const Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
  const TemperatureModel temperature;
  py::class_<TemperatureModel>(m, "TemperatureModel", temperature_doc)
      .def(py::init([](double reference, const Eigen::Matrix3d& bias, const Eigen::Matrix3d& scale) {
             return TemperatureModel{reference, bias, scale};
           }),
           py::kw_only(), py::arg("reference") = temperature.reference, py::arg("bias") = none, py::arg("scale") = none)
      .def_readonly("reference", &TemperatureModel::reference, "degrees Celsius")
      .def_readonly("bias", &TemperatureModel::bias, "(3, 3) m/s^2 per degC, degC^2, degC^3")
      .def_readonly("scale", &TemperatureModel::scale, "(3, 3) per degC, degC^2, degC^3")
      .def("bias_change", &TemperatureModel::bias_change, py::arg("temperature"), "(3,) m/s^2 from the reference.")
      .def("scale_change", &TemperatureModel::scale_change, py::arg("temperature"), "(3,) from the reference.");

  py::class_<NoiseBand>(m, "NoiseBand", "Noise of `rms` m/s^2 between `low` and `high` Hz.")
      .def(py::init([](double low, double high, double rms) { return NoiseBand{low, high, rms}; }), py::arg("low"),
           py::arg("high"), py::arg("rms"))
      .def_readonly("low", &NoiseBand::low, "Hz")
      .def_readonly("high", &NoiseBand::high, "Hz")
      .def_readonly("rms", &NoiseBand::rms, "m/s^2");

  py::class_<ResponseBand>(m, "ResponseBand", "Gain within plus and minus `tolerance` (relative) from `low` to `high` Hz.")
      .def(py::init([](double low, double high, double tolerance) { return ResponseBand{low, high, tolerance}; }),
           py::arg("low"), py::arg("high"), py::arg("tolerance"))
      .def_readonly("low", &ResponseBand::low, "Hz")
      .def_readonly("high", &ResponseBand::high, "Hz")
      .def_readonly("tolerance", &ResponseBand::tolerance, "relative");

  py::class_<SecondOrderResponse>(m, "SecondOrderResponse", response_doc)
      .def(py::init([](double natural_frequency, double damping) {
             return SecondOrderResponse{natural_frequency, damping};
           }),
           py::kw_only(), py::arg("natural_frequency"), py::arg("damping"))
      .def_readonly("natural_frequency", &SecondOrderResponse::natural_frequency, "Hz")
      .def_readonly("damping", &SecondOrderResponse::damping, "of critical")
      .def("at", &SecondOrderResponse::at, py::arg("frequency"), "Complex gain at `frequency` (Hz).");

  m.def("band_noise", &band_noise, py::arg("bands"), py::arg("samples"), py::arg("sample_rate"), py::arg("seed"),
        release_gil(), band_noise_doc);
  m.def("draw_response", &draw_response, py::arg("bands"), py::arg("seed"),
        "One individual's frequency response, within all bands; InvalidInput where there is none.");
  m.def("used_tolerance", &used_tolerance, py::arg("response"), py::arg("bands"),
        "The largest part of a band's tolerance that a response uses: at most 1 when it keeps within all.");
  m.def("response_section", &response_section, py::arg("response"), py::arg("sample_rate"), py::arg("exact_at"),
        "(1, 6) second-order section of a sampled response, exact at 0 and at `exact_at` Hz.");
}

}  // namespace

void bind_sensor(py::module_& m) {
  bind_parts(m);
  const Vector3 zero = Vector3::Zero();
  py::class_<AccelerometerModel>(m, "AccelerometerModel", model_doc)
      .def(py::init([](const Vector3& bias, const Vector3& scale, const Vector3& misalignment,
                       const Vector3& percussion_distance, const Vector3& second_order,
                       const TemperatureModel& temperature) {
             return AccelerometerModel{bias, scale, misalignment, percussion_distance, second_order, temperature};
           }),
           py::kw_only(), py::arg("bias") = zero, py::arg("scale") = zero, py::arg("misalignment") = zero,
           py::arg("percussion_distance") = zero, py::arg("second_order") = zero,
           py::arg_v("temperature", TemperatureModel{}, "TemperatureModel()"))
      .def_readonly("bias", &AccelerometerModel::bias, "(3,) m/s^2")
      .def_readonly("scale", &AccelerometerModel::scale, "(3,) relative scale-factor error")
      .def_readonly("misalignment", &AccelerometerModel::misalignment, "(3,) rad: (yx, zx, zy)")
      .def_readonly("percussion_distance", &AccelerometerModel::percussion_distance, "(3,) m")
      .def_readonly("second_order", &AccelerometerModel::second_order, "(3,) s^2/m")
      .def_readonly("temperature", &AccelerometerModel::temperature, "of bias and scale")
      .def("at", &AccelerometerModel::at, py::arg("degrees"),
           "The same sensor held at a temperature, degrees Celsius: bias and scale are those there.")
      .def("misalignment_matrix", &AccelerometerModel::misalignment_matrix, "(3, 3) unit lower triangular matrix M.");

  const UncorrectedErrors errors;
  py::class_<UncorrectedErrors>(m, "UncorrectedErrors",
                                "Standard deviations of what a sensor's own calibration sheet corrects.")
      .def(py::init([](double bias_std, double scale_std, const Vector3& bias_temperature_std,
                       const Vector3& scale_temperature_std, double reference_temperature) {
             return UncorrectedErrors{bias_std, scale_std, bias_temperature_std, scale_temperature_std,
                                      reference_temperature};
           }),
           py::kw_only(), py::arg("bias_std") = 0.0, py::arg("scale_std") = 0.0, py::arg("bias_temperature_std") = zero,
           py::arg("scale_temperature_std") = zero, py::arg("reference_temperature") = errors.reference_temperature)
      .def_readonly("bias_std", &UncorrectedErrors::bias_std, "m/s^2")
      .def_readonly("scale_std", &UncorrectedErrors::scale_std, "1")
      .def_readonly("bias_temperature_std", &UncorrectedErrors::bias_temperature_std,
                    "(3,) m/s^2 per degC, degC^2, degC^3")
      .def_readonly("scale_temperature_std", &UncorrectedErrors::scale_temperature_std, "(3,) per degC, degC^2, degC^3")
      .def_readonly("reference_temperature", &UncorrectedErrors::reference_temperature, "degrees Celsius");

  using Specification = AccelerometerSpecification;
  py::class_<Specification>(m, "AccelerometerSpecification", specification_doc)
      .def(py::init([](double bias_std, double scale_std, double misalignment_std, double percussion_distance,
                       double percussion_distance_std, double second_order_std, double noise_std, double range,
                       double resolution, double current_scale_factor, const UncorrectedErrors& uncorrected,
                       const std::vector<NoiseBand>& noise_bands, const std::vector<ResponseBand>& response_bands) {
             return Specification{bias_std,         scale_std,  misalignment_std, percussion_distance,
                                  percussion_distance_std, second_order_std, noise_std, range,
                                  resolution,       current_scale_factor, uncorrected, noise_bands,
                                  response_bands};
           }),
           py::kw_only(), py::arg("bias_std") = 0.0, py::arg("scale_std") = 0.0, py::arg("misalignment_std") = 0.0,
           py::arg("percussion_distance") = 0.0, py::arg("percussion_distance_std") = 0.0,
           py::arg("second_order_std") = 0.0, py::arg("noise_std") = 0.0, py::arg("range") = 0.0,
           py::arg("resolution") = 0.0, py::arg("current_scale_factor") = 0.0,
           py::arg_v("uncorrected", UncorrectedErrors{}, "UncorrectedErrors()"),
           py::arg("noise_bands") = std::vector<NoiseBand>{}, py::arg("response_bands") = std::vector<ResponseBand>{})
      .def_readonly("bias_std", &Specification::bias_std, "m/s^2")
      .def_readonly("scale_std", &Specification::scale_std, "1")
      .def_readonly("misalignment_std", &Specification::misalignment_std, "rad")
      .def_readonly("percussion_distance", &Specification::percussion_distance, "m, nominal")
      .def_readonly("percussion_distance_std", &Specification::percussion_distance_std, "m")
      .def_readonly("second_order_std", &Specification::second_order_std, "s^2/m")
      .def_readonly("noise_std", &Specification::noise_std, "m/s^2 per sample")
      .def_readonly("range", &Specification::range, "m/s^2; 0: no clipping")
      .def_readonly("resolution", &Specification::resolution, "m/s^2; 0: any change shows")
      .def_readonly("current_scale_factor", &Specification::current_scale_factor, "A s^2/m, nominal")
      .def_readonly("uncorrected", &Specification::uncorrected, "before correction by the calibration sheet")
      .def_readonly("noise_bands", &Specification::noise_bands)
      .def_readonly("response_bands", &Specification::response_bands);

  py::class_<CalibratedAccelerometer>(m, "CalibratedAccelerometer",
                                      "An individual sensor, its calibration sheet, and what correcting by it leaves.")
      .def_readonly("actual", &CalibratedAccelerometer::actual, "what the individual does")
      .def_readonly("sheet", &CalibratedAccelerometer::sheet, "bias, scale and temperature as delivered")
      .def_readonly("residual", &CalibratedAccelerometer::residual, "what is left after correction by the sheet");

  using Samples = Eigen::Ref<const Samples3>;
  m.def("measure", py::overload_cast<const AccelerometerModel&, const Samples&, const Samples&>(&measure),
        py::arg("model"), py::arg("specific_force").noconvert(), py::arg("angular_velocity").noconvert(), release_gil(),
        measure_doc);
  m.def("correct", py::overload_cast<const AccelerometerModel&, const Samples&, const Samples&>(&correct),
        py::arg("model"), py::arg("reading").noconvert(), py::arg("angular_velocity").noconvert(), release_gil(),
        correct_doc);
  using Degrees = Eigen::Ref<const Eigen::VectorXd>;
  m.def("measure",
        py::overload_cast<const AccelerometerModel&, const Samples&, const Samples&, const Degrees&>(&measure),
        py::arg("model"), py::arg("specific_force").noconvert(), py::arg("angular_velocity").noconvert(),
        py::arg("temperature").noconvert(), release_gil(), measure_doc);
  m.def("correct",
        py::overload_cast<const AccelerometerModel&, const Samples&, const Samples&, const Degrees&>(&correct),
        py::arg("model"), py::arg("reading").noconvert(), py::arg("angular_velocity").noconvert(),
        py::arg("temperature").noconvert(), release_gil(), correct_doc);
  m.def("output_current", &output_current, py::arg("reading").noconvert(), py::arg("current_scale_factor"),
        "(N, 3) A: what a servo accelerometer of that scale factor (A s^2/m) gives out for readings (N, 3) m/s^2.");
  m.def("reading_from_current", &reading_from_current, py::arg("current").noconvert(), py::arg("current_scale_factor"),
        "(N, 3) m/s^2: the readings behind currents (N, 3) A.");
  m.def("draw_calibrated_accelerometer", &draw_calibrated_accelerometer, py::arg("specification"), py::arg("seed"),
        draw_calibrated_doc);
  m.def("draw_accelerometer", &draw_accelerometer, py::arg("specification"), py::arg("seed"), draw_doc);
}

}  // namespace circlepoint::bindings
