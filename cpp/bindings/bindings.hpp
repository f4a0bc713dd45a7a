#pragma once
// One function a file; module.cpp calls them bottom to top. Declarations only: argument names, defaults, docstrings and
// call policy; no logic. Sample arrays are taken with noconvert() (a wrong dtype or layout is refused, never copied
// silently) and the GIL is released wherever the core filters, solves or simulates.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace circlepoint::bindings {

namespace py = pybind11;
using release_gil = py::call_guard<py::gil_scoped_release>;

void bind_error(py::module_& m);
void bind_instruction_set(py::module_& m);
void bind_geometry(py::module_& m);
void bind_chain(py::module_& m);
void bind_hayati(py::module_& m);
void bind_sensor(py::module_& m);
void bind_recording(py::module_& m);
void bind_filters(py::module_& m);
void bind_segmentation(py::module_& m);
void bind_regression(py::module_& m);
void bind_calibration(py::module_& m);
void bind_acquisition(py::module_& m);
void bind_simulation(py::module_& m);
void bind_whole_arm(py::module_& m);
void bind_experiment(py::module_& m);
void bind_campaign(py::module_& m);

}  // namespace circlepoint::bindings
