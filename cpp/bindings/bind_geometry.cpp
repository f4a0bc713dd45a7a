#include "bindings.hpp"

namespace circlepoint::bindings {

void bind_geometry(py::module_& m) {
  static_cast<void>(m);
}

}  // namespace circlepoint::bindings
