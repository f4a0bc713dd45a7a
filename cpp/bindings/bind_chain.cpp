#include "bindings.hpp"

namespace circlepoint::bindings {

void bind_chain(py::module_& m) {
  static_cast<void>(m);
}

}  // namespace circlepoint::bindings
