#include "bindings.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint::bindings {
namespace {

// InvalidInput is a ValueError as well, so that callers who expect Python's own kind catch it.
py::object new_exception(py::module_& m, const char* name, const py::tuple& bases, const char* doc) {
  const std::string qualified = std::string("circlepoint._core.") + name;
  auto type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(qualified.c_str(), doc, bases.ptr(), nullptr));
  if (!type) {
    throw py::error_already_set();
  }
  m.attr(name) = type;
  return type;
}

struct ErrorTypes {
  py::object error, invalid_input, not_identifiable, did_not_converge;
};

ErrorTypes& error_types() {
  static auto* types = new ErrorTypes;  // lives as long as the interpreter
  return *types;
}

}  // namespace

void bind_error(py::module_& m) {
  ErrorTypes& types = error_types();
  const py::object exception = py::reinterpret_borrow<py::object>(PyExc_Exception);
  const py::object value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  types.error = new_exception(m, "Error", py::make_tuple(exception), "Base of every error circlepoint raises on purpose.");
  types.invalid_input = new_exception(m, "InvalidInput", py::make_tuple(types.error, value_error),
                                      "Data or arguments cannot be used as they are.");
  types.not_identifiable = new_exception(m, "NotIdentifiable", py::make_tuple(types.error),
                                         "The data do not determine the parameter asked for.");
  types.did_not_converge = new_exception(m, "DidNotConverge", py::make_tuple(types.error),
                                         "An iteration ended without reaching its tolerance.");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
    } catch (const InvalidInput& e) {
      py::set_error(error_types().invalid_input, e.what());
    } catch (const NotIdentifiable& e) {
      py::set_error(error_types().not_identifiable, e.what());
    } catch (const DidNotConverge& e) {
      py::set_error(error_types().did_not_converge, e.what());
    } catch (const Error& e) {
      py::set_error(error_types().error, e.what());
    }
  });
}

}  // namespace circlepoint::bindings
