#pragma once
// Which vector instructions the kernels use (filters, cumulative integrals, normal equations).
//
// One binary holds every path; the widest one the processor has is chosen at the first call, unless the environment variable
// CIRCLEPOINT_INSTRUCTION_SET names another. All paths do the same operations in the same order and round alike (no fused
// multiply-add, sums in four fixed lanes), so results are the same to the last bit whichever is chosen, NaN included.
// Processors other than x86-64 have one path, `baseline`, in the vectors of the compiler's target (NEON on AArch64).

#include <string_view>
#include <vector>

namespace circlepoint {

enum class InstructionSet {
  baseline,  ///< what every processor of the architecture has: SSE2, NEON
  avx2,
  avx512,
};

/// The paths this processor can run, narrowest first.
std::vector<InstructionSet> available_instruction_sets();

/// The path in use.
InstructionSet instruction_set();

/// Chooses a path for the whole process. Raises InvalidInput for one this processor cannot run.
void use_instruction_set(InstructionSet path);

/// "baseline", "avx2", "avx512".
std::string_view to_string(InstructionSet path);

}  // namespace circlepoint
