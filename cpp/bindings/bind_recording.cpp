#include <pybind11/native_enum.h>
#include <pybind11/operators.h>

#include "bindings.hpp"
#include "circlepoint/conditioning/clock_alignment.hpp"
#include "circlepoint/recording/interpolate.hpp"
#include "circlepoint/recording/recording.hpp"
#include "circlepoint/recording/timeline.hpp"

namespace circlepoint::bindings {
namespace {

SensorSamples sensor_samples(const Samples3& specific_force, const std::optional<Samples3>& angular_velocity,
                             const std::optional<Eigen::VectorXd>& temperature) {
  return {specific_force, angular_velocity, temperature};
}

void bind_timeline(py::module_& m) {
  py::class_<IndexRange>(m, "IndexRange", "Half-open range of sample indices [begin, end).")
      .def(py::init<Index, Index>(), py::arg("begin"), py::arg("end"))
      .def_readonly("begin", &IndexRange::begin)
      .def_readonly("end", &IndexRange::end)
      .def_property_readonly("size", &IndexRange::size)
      .def(py::self == py::self)
      .def("__hash__", [](const IndexRange& r) { return py::hash(py::make_tuple(r.begin, r.end)); })
      .def("__repr__", [](const IndexRange& r) { return py::str("IndexRange({}, {})").format(r.begin, r.end); });

  py::native_enum<StampRule>(m, "StampRule", "enum.Enum", "What became of the time stamps.")
      .value("regularised", StampRule::regularised, "samples kept, stamps replaced by the fitted clock")
      .value("believed", StampRule::believed, "stamps kept, samples interpolated at the clock's ticks")
      .finalize();

  py::class_<TimelineGap>(m, "TimelineGap", "Missing samples between two rows.")
      .def_readonly("index", &TimelineGap::index, "0-based input row after the gap")
      .def_readonly("start", &TimelineGap::start, "s, stamp of the row before it")
      .def_readonly("length", &TimelineGap::length, "s, between the rows on both sides")
      .def_readonly("missing", &TimelineGap::missing, "samples")
      .def_readonly("filled", &TimelineGap::filled, "interpolated; otherwise a new span starts after it");

  py::class_<StampOrder>(m, "StampOrder", "A stamp that does not come after the one before it.")
      .def_readonly("index", &StampOrder::index, "0-based input row")
      .def_readonly("previous", &StampOrder::previous, "s, stamp of the row before")
      .def_readonly("value", &StampOrder::value, "s");

  py::class_<TimelineReport>(m, "TimelineReport", "What was found in the time stamps of a log.")
      .def_readonly("samples", &TimelineReport::samples, "input rows")
      .def_readonly("duration", &TimelineReport::duration, "s")
      .def_readonly("sample_rate", &TimelineReport::sample_rate, "Hz, fitted")
      .def_readonly("jitter_std", &TimelineReport::jitter_std,
          "s, of the stamps against the uniform clock within spans")
      .def_readonly("jitter_max", &TimelineReport::jitter_max, "s, largest absolute value of the same")
      .def_readonly("resolution", &TimelineReport::resolution,
          "s, every stamp is a multiple of it; 0 where none was found")
      .def_readonly("rule", &TimelineReport::rule, "what became of the stamps")
      .def_readonly("late", &TimelineReport::late, "stamps more than half a period late, though no sample is missing")
      .def_readonly("filled", &TimelineReport::filled, "interpolated samples in gaps")
      .def_readonly("gaps", &TimelineReport::gaps)
      .def_readonly("repeated", &TimelineReport::repeated, "stamps equal to the one before")
      .def_readonly("backwards", &TimelineReport::backwards, "stamps before the one before")
      .def_readonly("surplus", &TimelineReport::surplus, "rows in excess of the clock's ticks")
      .def_readonly("notes", &TimelineReport::notes, "what was found and done, a sentence each");

  py::class_<TimelineOptions>(m, "TimelineOptions", "How gaps in a log are treated.")
      .def(py::init([](Index max_filled, double gap_threshold) { return TimelineOptions{max_filled, gap_threshold}; }),
           py::kw_only(), py::arg("max_filled") = TimelineOptions{}.max_filled,
           py::arg("gap_threshold") = TimelineOptions{}.gap_threshold)
      .def_readwrite("max_filled", &TimelineOptions::max_filled, "samples: longer gaps split")
      .def_readwrite("gap_threshold", &TimelineOptions::gap_threshold,
          "periods, for stamps too jittered to count ticks");

  m.def("analyse_timeline", &analyse_timeline, py::arg("time").noconvert(),
        py::arg_v("options", TimelineOptions{}, "TimelineOptions()"),
        release_gil(), R"(Sample rate, jitter, resolution and gaps of time stamps.

Parameters
----------
time : (N,) float64 array
    Stamps in seconds, at least 8.
options : TimelineOptions

Returns
-------
TimelineReport
    Time that runs backwards and rows written twice are listed, not raised.

Raises
------
InvalidInput
    Fewer than 8 stamps, or one that is not finite.)");

  m.def("interpolate_cubic", &interpolate_cubic, py::arg("knots").noconvert(), py::arg("values").noconvert(),
        py::arg("at").noconvert(), release_gil(), R"(Cubic not-a-knot spline through samples.

Parameters
----------
knots : (N,) float64 array
    Strictly increasing.
values : (N, channels) float64 array, C order
at : (M,) float64 array
    Where to evaluate; outside the knots the end pieces are continued.

Returns
-------
(M, channels) float64 array

Raises
------
InvalidInput
    Sizes differ or the knots do not increase.)");
}

void bind_recording_type(py::module_& m) {
  py::class_<Recording>(m, "Recording",
                        "Joint positions and specific force on one uniform clock, in gap-free spans; see "
                        "make_recording.")
      .def_readonly("time", &Recording::time, "(N,) s, read-only view")
      .def_readonly("joint_positions", &Recording::joint_positions, "(N, n) rad or m, read-only view")
      .def_readonly("specific_force", &Recording::specific_force, "(N, 3) m/s^2, at rest +g upwards; read-only view")
      .def_readonly("angular_velocity", &Recording::angular_velocity, "(N, 3) rad/s, or None")
      .def_readonly("temperature", &Recording::temperature, "(N,) degrees Celsius, or None")
      .def_readonly("sample_rate", &Recording::sample_rate, "Hz")
      .def_readonly("spans", &Recording::spans, "contiguous pieces, in order")
      .def_readonly("timeline", &Recording::timeline, "what was found in the stamps (two clocks: the sensor's)")
      .def_readonly("joint_timeline", &Recording::joint_timeline,
          "the joints' own stamps where they had a clock, or None")
      .def_property_readonly("is_static", &Recording::is_static, "whether every row is the mean of a rest, from make_static_recording()")
      .def_property_readonly("samples", &Recording::samples)
      .def_property_readonly("joints", &Recording::joints)
      .def("__repr__", [](const Recording& r) {
        return py::str("Recording({} samples, {} joints, {:.6g} Hz, {} spans)")
            .format(r.samples(), r.joints(), r.sample_rate, r.spans.size());
      });

  py::class_<ClockModel>(m, "ClockModel", "sensor_time = offset + rate * joint_time.")
      .def(py::init([](double offset, double rate) { return ClockModel{offset, rate}; }), py::arg("offset") = 0.0,
           py::arg("rate") = 1.0)
      .def_readonly("offset", &ClockModel::offset, "s")
      .def_readonly("rate", &ClockModel::rate, "sensor seconds a joint second")
      .def("__repr__", [](const ClockModel& c) { return py::str("ClockModel(offset={!r}, rate={!r})").format(c.offset,
          c.rate); });

  m.def(
      "make_recording",
      [](const Eigen::Ref<const Eigen::VectorXd>& time, const Eigen::Ref<const SamplesX>& joint_positions,
         const Eigen::Ref<const Samples3>& specific_force, const std::optional<Samples3>& angular_velocity,
         const std::optional<Eigen::VectorXd>& temperature, const TimelineOptions& options) {
        return make_recording(time, joint_positions, sensor_samples(specific_force, angular_velocity, temperature),
            options);
      },
      py::arg("time").noconvert(), py::arg("joint_positions").noconvert(), py::arg("specific_force").noconvert(),
          py::kw_only(),
      py::arg("angular_velocity").noconvert() = py::none(), py::arg("temperature").noconvert() = py::none(),
      py::arg_v("options", TimelineOptions{}, "TimelineOptions()"), release_gil(),
      R"(A recording from one log.

Rounded stamps are replaced by the uniform clock they fit; stamps with true jitter are believed and the samples
interpolated;
short gaps are filled and reported, longer ones split the recording into spans.

Parameters
----------
time : (N,) float64 array
    Seconds, N >= 8.
joint_positions : (N, n) float64 array, C order
    rad, or m for prismatic joints; raw encoder values.
specific_force : (N, 3) float64 array, C order
    m/s^2; at rest it reads +g upwards.
angular_velocity : (N, 3) float64 array, optional
    rad/s.
temperature : (N,) float64 array, optional
    Degrees Celsius.
options : TimelineOptions

Returns
-------
Recording

Raises
------
InvalidInput
    Sizes differ, a value is not finite (row, column), or time does not advance (row, both values).)");

  m.def(
      "make_recording",
      [](const Eigen::Ref<const Eigen::VectorXd>& joint_time, const Eigen::Ref<const SamplesX>& joint_positions,
         const Eigen::Ref<const Eigen::VectorXd>& sensor_time, const Eigen::Ref<const Samples3>& specific_force,
         const ClockModel& clock, const std::optional<Samples3>& angular_velocity,
         const std::optional<Eigen::VectorXd>& temperature, const TimelineOptions& options) {
        return make_recording(joint_time, joint_positions, sensor_time,
                              sensor_samples(specific_force, angular_velocity, temperature), clock, options);
      },
      py::arg("joint_time").noconvert(), py::arg("joint_positions").noconvert(), py::arg("sensor_time").noconvert(),
      py::arg("specific_force").noconvert(), py::arg("clock"), py::kw_only(),
      py::arg("angular_velocity").noconvert() = py::none(), py::arg("temperature").noconvert() = py::none(),
      py::arg_v("options", TimelineOptions{}, "TimelineOptions()"), release_gil(),
      R"(A recording from two logs with two clocks.

The sensor's samples are kept, the joints interpolated at them; time is the joint clock's.

Parameters
----------
joint_time : (N,) float64 array
    Seconds of the joint clock.
joint_positions : (N, n) float64 array, C order
    rad, or m for prismatic joints.
sensor_time : (M,) float64 array
    Seconds of the sensor clock.
specific_force : (M, 3) float64 array, C order
    m/s^2; at rest it reads +g upwards.
clock : ClockModel
    sensor_time = offset + rate * joint_time; see align_clocks.
angular_velocity : (M, 3) float64 array, optional
    rad/s.
temperature : (M,) float64 array, optional
    Degrees Celsius.
options : TimelineOptions

Returns
-------
Recording

Raises
------
InvalidInput
    As with one log, and where the logs do not overlap under the clock model.)");

  m.def(
      "make_static_recording",
      [](const Eigen::Ref<const SamplesX>& joint_positions, const Eigen::Ref<const Samples3>& specific_force,
         const std::optional<Samples3>& angular_velocity, const std::optional<Eigen::VectorXd>& temperature) {
        return make_static_recording(joint_positions, sensor_samples(specific_force, angular_velocity, temperature));
      },
      py::arg("joint_positions").noconvert(), py::arg("specific_force").noconvert(), py::kw_only(),
      py::arg("angular_velocity").noconvert() = py::none(), py::arg("temperature").noconvert() = py::none(), release_gil(),
      R"(A table of still poses, each row the mean of one rest, as a recording.

It shows the directions of revolute axes, not where they are. Every row is a span of its own; ``time`` counts the rows.

Parameters
----------
joint_positions : (P, n) float64 array, C order
    rad, or m for prismatic joints; P >= 3.
specific_force : (P, 3) float64 array, C order
    m/s^2, what the sensor read at rest, on average; +g upwards.
angular_velocity : (P, 3) float64 array, optional
    rad/s.
temperature : (P,) float64 array, optional
    Degrees Celsius.

Returns
-------
Recording

Raises
------
InvalidInput
    Sizes differ, there are fewer than 3 poses, or a value is not finite (row, column).)");

  m.def("concatenate", &concatenate, py::arg("recordings"), release_gil(), R"(Several recordings of one arm as one.

Each starts a new span; one that does not start after the one before it is moved to one second after its end, which
``timeline.notes`` says.

Parameters
----------
recordings : list of Recording
    Sample rates within 1 % of the first one's.

Returns
-------
Recording

Raises
------
InvalidInput
    None given, other joints, or sample rates that differ by more than 1 %.)");
}

void bind_clock_alignment(py::module_& m) {
  py::class_<DelayTest>(m, "DelayTest", "A stretch of motion whose delay was measured.")
      .def_readonly("joint", &DelayTest::joint, "0-based joint that moved alone; -1 where several moved")
      .def_readonly("joint_start", &DelayTest::joint_start, "s, joint clock")
      .def_readonly("joint_end", &DelayTest::joint_end, "s, joint clock")
      .def_readonly("joint_time", &DelayTest::joint_time, "s, joint clock: where the delay is measured")
      .def_readonly("sensor_time", &DelayTest::sensor_time, "s, sensor clock: the same instant")
      .def_readonly("std", &DelayTest::std, "s, of sensor_time, from this stretch alone")
      .def_readonly("residual", &DelayTest::residual, "s, sensor_time minus the fitted clock")
      .def_readonly("weight", &DelayTest::weight, "in the fit, 0 (outlier) to 1")
      .def_readonly("model_residual", &DelayTest::model_residual, "m/s^2, rms of what the motion does not explain");

  py::class_<ClockAlignmentOptions>(m, "ClockAlignmentOptions", "How two clocks are brought together.")
      .def(py::init([](double max_rate_deviation, double cutoff, double min_velocity, double min_travel,
          double others_ratio) {
             ClockAlignmentOptions options;
             options.max_rate_deviation = max_rate_deviation;
             options.cutoff = cutoff;
             options.min_velocity = min_velocity;
             options.min_travel = min_travel;
             options.others_ratio = others_ratio;
             return options;
           }),
           py::kw_only(), py::arg("max_rate_deviation") = ClockAlignmentOptions{}.max_rate_deviation,
           py::arg("cutoff") = ClockAlignmentOptions{}.cutoff, py::arg("min_velocity") =
               ClockAlignmentOptions{}.min_velocity,
           py::arg("min_travel") = ClockAlignmentOptions{}.min_travel,
           py::arg("others_ratio") = ClockAlignmentOptions{}.others_ratio)
      .def_readwrite("max_rate_deviation", &ClockAlignmentOptions::max_rate_deviation, "searched: 1 +- this")
      .def_readwrite("cutoff", &ClockAlignmentOptions::cutoff, "Hz, -3 dB of the low-pass both sides go through")
      .def_readwrite("min_velocity", &ClockAlignmentOptions::min_velocity, "rad/s or m/s: slower is at rest")
      .def_readwrite("min_travel", &ClockAlignmentOptions::min_travel, "rad or m: shorter motions are ignored")
      .def_readwrite("others_ratio", &ClockAlignmentOptions::others_ratio,
                     "others may move at this fraction of the moving joint");

  py::class_<ClockAlignment>(m, "ClockAlignment", "sensor_time = offset + rate * joint_time, with standard deviations.")
      .def_readonly("offset", &ClockAlignment::offset, "s")
      .def_readonly("rate", &ClockAlignment::rate, "sensor seconds a joint second")
      .def_readonly("offset_std", &ClockAlignment::offset_std, "s")
      .def_readonly("rate_std", &ClockAlignment::rate_std)
      .def_readonly("covariance", &ClockAlignment::covariance, "(2, 2) of offset and rate")
      .def_readonly("reference_time", &ClockAlignment::reference_time,
                    "s, joint clock: where the alignment is best known")
      .def_readonly("reference_std", &ClockAlignment::reference_std, "s, of the sensor time there")
      .def_readonly("tests", &ClockAlignment::tests)
      .def_readonly("single_joint", &ClockAlignment::single_joint,
          "measured on single-joint motions; otherwise on general ones")
      .def_readonly("rate_determined", &ClockAlignment::rate_determined,
          "by the data; otherwise 1 within the range searched")
      .def_readonly("converged", &ClockAlignment::converged)
      .def_readonly("residual", &ClockAlignment::residual, "s, weighted rms of the tests about the fitted clock")
      .def_readonly("notes", &ClockAlignment::notes, "what was used and what falls short, a sentence each")
      .def_property_readonly("clock", &ClockAlignment::clock, "ClockModel")
      .def("__repr__", [](const ClockAlignment& a) {
        return py::str("ClockAlignment(offset={:.6f} +- {:.2g} s, rate={:.7f} +- {:.2g}, {} tests)")
            .format(a.offset, a.offset_std, a.rate, a.rate_std, a.tests.size());
      });

  m.def("align_clocks", &align_clocks, py::arg("joint_time").noconvert(), py::arg("joint_positions").noconvert(),
        py::arg("sensor_time").noconvert(), py::arg("specific_force").noconvert(),
        py::arg_v("options", ClockAlignmentOptions{}, "ClockAlignmentOptions()"), release_gil(),
        R"(Offset and rate between joint and sensor clock.

No kinematic model is needed: while one joint moves alone, the specific force is linear in cos, sin, acceleration and
squared
speed of its angle, so that the delay is the only non-linear unknown of each such motion.

Parameters
----------
joint_time : (N,) float64 array
    Seconds of the joint clock.
joint_positions : (N, n) float64 array, C order
    rad, or m for prismatic joints.
sensor_time : (M,) float64 array
    Seconds of the sensor clock; another epoch is fine.
specific_force : (M, 3) float64 array, C order
    m/s^2.
options : ClockAlignmentOptions

Returns
-------
ClockAlignment

Raises
------
InvalidInput
    Sizes differ, values are not finite, or time does not advance.
NotIdentifiable
    No motion from which a delay could be measured; the message says what to record.)");
}

}  // namespace

void bind_recording(py::module_& m) {
  bind_timeline(m);
  bind_recording_type(m);
  bind_clock_alignment(m);
}

}  // namespace circlepoint::bindings
