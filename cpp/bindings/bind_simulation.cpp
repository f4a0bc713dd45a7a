#include "bindings.hpp"

namespace circlepoint::bindings {

void bind_simulation(py::module_& m) {
  static_cast<void>(m);
}

}  // namespace circlepoint::bindings
