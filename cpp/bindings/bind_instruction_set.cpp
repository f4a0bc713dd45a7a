#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "circlepoint/core/instruction_set.hpp"

namespace circlepoint::bindings {

void bind_instruction_set(py::module_& m) {
  py::native_enum<InstructionSet>(m, "InstructionSet", "enum.Enum", "Vector instructions of the kernels.")
      .value("baseline", InstructionSet::baseline)
      .value("avx2", InstructionSet::avx2)
      .value("avx512", InstructionSet::avx512)
      .finalize();
  m.def("available_instruction_sets", &available_instruction_sets, R"(
The vector instructions this processor can run, narrowest first.

Returns
-------
list of InstructionSet
)");
  m.def("instruction_set", &instruction_set, R"(
The vector instructions in use: the widest, or what CIRCLEPOINT_INSTRUCTION_SET named when the first kernel ran.

Returns
-------
InstructionSet
)");
  m.def("use_instruction_set", &use_instruction_set, py::arg("path"), R"(
Choose the vector instructions for the whole process; results stay the same to the last bit.

Parameters
----------
path : InstructionSet

Raises
------
InvalidInput
    If the processor does not have them.
)");
}

}  // namespace circlepoint::bindings
