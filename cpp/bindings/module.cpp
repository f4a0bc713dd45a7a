#include "bindings.hpp"
#include "circlepoint/core/types.hpp"
#include "circlepoint/core/version.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace circlepoint::bindings;
  m.doc() = "The C++ core of circlepoint; its public names are re-exported by the package.";
  m.attr("__version__") = circlepoint::version;
  m.attr("STANDARD_GRAVITY") = circlepoint::standard_gravity;
  bind_error(m);
  bind_geometry(m);
  bind_sensor(m);
  bind_chain(m);
  bind_recording(m);
  bind_filters(m);
  bind_segmentation(m);
  bind_identification(m);
  bind_simulation(m);
}
