#include "bindings.hpp"

namespace circlepoint::bindings {

void bind_recording(py::module_& m) {
  static_cast<void>(m);
}

}  // namespace circlepoint::bindings
