#include "bindings.hpp"

namespace circlepoint::bindings {

void bind_filters(py::module_& m) {
  static_cast<void>(m);
}

}  // namespace circlepoint::bindings
