#include <utility>

#include "bindings.hpp"
#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/conditioning/static_intervals.hpp"

namespace circlepoint::bindings {
namespace {

constexpr const char* encoder_step_doc = R"(The step of an encoder, as its readings show it.

Parameters
----------
positions : (N,) ndarray, rad or m
    One joint's raw readings.

Returns
-------
float
    The least difference of two values each held for two samples in succession, rad or m; 0 where that exceeds
    1/512 of a revolution or the joint never moves.
)";

constexpr const char* rest_band_doc = R"(The band a revolute joint at rest stays in for `rest_window` seconds.

Parameters
----------
encoder_step : float, rad
options : StaticIntervalOptions

Returns
-------
float
    The larger of 1.5 encoder steps and `min_velocity * rest_window`, rad.
)";

constexpr const char* joint_rests_doc = R"(For each joint, the intervals in which it rests.

Parameters
----------
recording : Recording
options : StaticIntervalOptions

Returns
-------
list of list of IndexRange
    One list a joint, in order of time. No interval crosses a gap; momentary turning points and slow creeping are not
    rests.

Raises
------
InvalidInput
    Where the recording's parts do not match, values are not finite or an option is out of its range.
)";

constexpr const char* static_intervals_doc = R"(The intervals in which every joint rests and the sensor is quiet.

The settling tail is dropped where the standard error of the interval's mean is smallest.

Parameters
----------
recording : Recording
options : StaticIntervalOptions

Returns
-------
list of IndexRange
    In order of time, none shorter than `min_dwell`. No interval crosses a gap.

Raises
------
InvalidInput
    Where the recording's parts do not match, values are not finite or an option is out of its range.

References
----------
White, K. P., "An effective truncation heuristic for bias reduction in simulation output", Simulation 69(6), 1997.
)";

constexpr const char* segment_doc = R"(Finds the dwells, single-joint motions and tests in one continuous log.

Parameters
----------
recording : Recording
options : SegmentationOptions

Returns
-------
Segmentation
    Dwells and motions in order of time, tests base to tip with the largest span first. A log without any gives empty
    lists.

Raises
------
InvalidInput
    Where the recording's parts do not match, values are not finite or an option is out of its range.
)";

void bind_static_intervals(py::module_& m) {
  const StaticIntervalOptions options;
  py::class_<StaticIntervalOptions>(m, "StaticIntervalOptions", "What counts as standing still.")
      .def(py::init([](double min_dwell, double settle, double min_velocity, double rest_window, double quiet_ratio,
                       double quiet_std, std::vector<JointType> joint_types, double metres_per_radian) {
             return StaticIntervalOptions{min_dwell,   settle,    min_velocity,           rest_window,
                                          quiet_ratio, quiet_std, std::move(joint_types), metres_per_radian};
           }),
           py::kw_only(), py::arg("min_dwell") = options.min_dwell, py::arg("settle") = options.settle,
           py::arg("min_velocity") = options.min_velocity, py::arg("rest_window") = options.rest_window,
           py::arg("quiet_ratio") = options.quiet_ratio, py::arg("quiet_std") = options.quiet_std,
           py::arg("joint_types") = options.joint_types, py::arg("metres_per_radian") = options.metres_per_radian)
      .def_readonly("min_dwell", &StaticIntervalOptions::min_dwell, "s, shortest static interval")
      .def_readonly("settle", &StaticIntervalOptions::settle, "s, dropped after the joints came to rest")
      .def_readonly("min_velocity", &StaticIntervalOptions::min_velocity, "rad/s: what is slower is at rest")
      .def_readonly("rest_window", &StaticIntervalOptions::rest_window, "s, shortest rest of a joint")
      .def_readonly("quiet_ratio", &StaticIntervalOptions::quiet_ratio,
                    "quiet: the sensor's scatter is within this multiple of the quietest rests' scatter")
      .def_readonly("quiet_std", &StaticIntervalOptions::quiet_std, "or below this, m/s^2 rms over the channels")
      .def_readonly("joint_types", &StaticIntervalOptions::joint_types, "base to tip; empty: all revolute")
      .def_readonly("metres_per_radian", &StaticIntervalOptions::metres_per_radian,
                    "m: a prismatic joint's travel that counts as a radian of every threshold");

  m.attr("max_encoder_step") = max_encoder_step;
  m.def("encoder_step", &encoder_step, py::arg("positions").noconvert(), release_gil(), encoder_step_doc);
  m.def("rest_band", &rest_band, py::arg("encoder_step"), py::arg_v("options", options, "StaticIntervalOptions()"),
        rest_band_doc);
  m.def("joint_rests", &joint_rests, py::arg("recording"), py::arg_v("options", options, "StaticIntervalOptions()"),
        release_gil(), joint_rests_doc);
  m.def("static_intervals",
        py::overload_cast<const Recording&, const StaticIntervalOptions&>(&static_intervals), py::arg("recording"),
        py::arg_v("options", options, "StaticIntervalOptions()"), release_gil(), static_intervals_doc);
}

void bind_segmentation_results(py::module_& m) {
  py::class_<StaticDwell>(m, "StaticDwell", "A stretch in which every joint and the sensor are at rest.")
      .def_readonly("samples", &StaticDwell::samples, "settled samples only")
      .def_readonly("joint_positions", &StaticDwell::joint_positions, "(n,) mean, rad or m")
      .def_readonly("specific_force", &StaticDwell::specific_force, "(3,) mean, m/s^2")
      .def_readonly("specific_force_std", &StaticDwell::specific_force_std, "(3,) of the samples, m/s^2");

  py::class_<SingleJointMotion>(m, "SingleJointMotion", "A stretch in which one joint moves and the others stay.")
      .def_readonly("joint", &SingleJointMotion::joint, "0-based")
      .def_readonly("samples", &SingleJointMotion::samples, "from rest to rest, a little of either rest included")
      .def_readonly("travel", &SingleJointMotion::travel, "rad or m, peak to peak of the moving joint")
      .def_readonly("peak_velocity", &SingleJointMotion::peak_velocity, "rad/s or m/s")
      .def_readonly("joint_positions", &SingleJointMotion::joint_positions, "(n,) mean over the motion, rad or m")
      .def_readonly("from_rest", &SingleJointMotion::from_rest, "the joint rests at the beginning")
      .def_readonly("to_rest", &SingleJointMotion::to_rest, "the joint rests at the end");

  py::class_<JointTest>(m, "JointTest", "What was recorded of one joint at one configuration of the others.")
      .def_readonly("joint", &JointTest::joint, "0-based")
      .def_readonly("configuration", &JointTest::configuration,
                    "(n,) rad or m: the other joints' rest; entry `joint` is the test's mean")
      .def_readonly("dwells", &JointTest::dwells, "into Segmentation.dwells")
      .def_readonly("motions", &JointTest::motions, "into Segmentation.motions")
      .def_readonly("dwell_span", &JointTest::dwell_span, "rad or m, range of the joint over its dwells")
      .def_readonly("motion_span", &JointTest::motion_span, "rad or m, largest travel of its motions");

  py::class_<Segmentation>(m, "Segmentation", "The dwells, single-joint motions and tests of a recording.")
      .def_readonly("dwells", &Segmentation::dwells, "list of StaticDwell, in order of time")
      .def_readonly("motions", &Segmentation::motions, "list of SingleJointMotion, in order of time")
      .def_readonly("tests", &Segmentation::tests, "list of JointTest, base to tip, largest span first");
}

}  // namespace

void bind_segmentation(py::module_& m) {
  bind_static_intervals(m);
  bind_segmentation_results(m);

  const SegmentationOptions options;
  py::class_<SegmentationOptions, StaticIntervalOptions>(m, "SegmentationOptions",
                                                         "What counts as a dwell, a single-joint motion and a test.")
      .def(py::init([](double min_dwell, double settle, double min_velocity, double rest_window, double quiet_ratio,
                       double quiet_std, double others_ratio, double others_travel, double min_travel,
                       double min_partial, double configuration_tolerance, std::vector<JointType> joint_types,
                       double metres_per_radian) {
             return SegmentationOptions{{min_dwell, settle, min_velocity, rest_window, quiet_ratio, quiet_std,
                                         std::move(joint_types), metres_per_radian},
                                        others_ratio, others_travel, min_travel, min_partial,
                                        configuration_tolerance};
           }),
           py::kw_only(), py::arg("min_dwell") = options.min_dwell, py::arg("settle") = options.settle,
           py::arg("min_velocity") = options.min_velocity, py::arg("rest_window") = options.rest_window,
           py::arg("quiet_ratio") = options.quiet_ratio, py::arg("quiet_std") = options.quiet_std,
           py::arg("others_ratio") = options.others_ratio, py::arg("others_travel") = options.others_travel,
           py::arg("min_travel") = options.min_travel, py::arg("min_partial") = options.min_partial,
           py::arg("configuration_tolerance") = options.configuration_tolerance,
           py::arg("joint_types") = options.joint_types, py::arg("metres_per_radian") = options.metres_per_radian)
      .def_readonly("others_ratio", &SegmentationOptions::others_ratio,
                    "others may move at this fraction of the moving joint's speed and travel")
      .def_readonly("others_travel", &SegmentationOptions::others_travel,
                    "rad: others may not yield more than this over a motion")
      .def_readonly("min_travel", &SegmentationOptions::min_travel, "rad: shorter motions are ignored")
      .def_readonly("min_partial", &SegmentationOptions::min_partial,
                    "s: shortest motion that does not run from rest to rest")
      .def_readonly("configuration_tolerance", &SegmentationOptions::configuration_tolerance,
                    "rad: the same test, if every other joint is within this");

  m.def("segment", &segment, py::arg("recording"), py::arg_v("options", options, "SegmentationOptions()"),
        release_gil(), segment_doc);
}

}  // namespace circlepoint::bindings
