#include "circlepoint/core/instruction_set.hpp"
#include "regression_kernels.hpp"

namespace circlepoint::detail {

const RegressionKernels& regression_kernels() {
#ifdef __x86_64__
  switch (instruction_set()) {
    case InstructionSet::avx512: return regression_kernels_avx512;
    case InstructionSet::avx2: return regression_kernels_avx2;
    case InstructionSet::baseline: break;
  }
#endif
  return regression_kernels_baseline;
}

}  // namespace circlepoint::detail
