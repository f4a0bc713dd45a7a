#include <string>

#include "bindings.hpp"
#include "circlepoint/core/types.hpp"
#include "circlepoint/core/version.hpp"

namespace {

/// What the package re-exports: every name that does not start with an underscore.
pybind11::list public_names(const pybind11::module_& m) {
  pybind11::list names;
  for (const auto& [name, value] : m.attr("__dict__").cast<pybind11::dict>()) {
    if (!name.cast<std::string>().starts_with('_')) {
      names.append(name);
    }
  }
  names.attr("sort")();
  return names;
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  using namespace circlepoint::bindings;
  m.doc() = "The C++ core of circlepoint; its public names are re-exported by the package.";
  m.attr("__version__") = circlepoint::version;
  m.attr("STANDARD_GRAVITY") = circlepoint::standard_gravity;
  bind_error(m);
  bind_instruction_set(m);
  bind_geometry(m);
  bind_sensor(m);
  bind_chain(m);
  bind_hayati(m);
  bind_recording(m);
  bind_filters(m);
  bind_segmentation(m);
  bind_regression(m);
  bind_calibration(m);
  bind_whole_arm(m);
  bind_acquisition(m);
  bind_simulation(m);
  bind_experiment(m);
  bind_campaign(m);
  m.attr("__all__") = public_names(m);
}
