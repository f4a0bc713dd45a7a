#include "circlepoint/core/instruction_set.hpp"
#include "filter_kernels.hpp"
#include "signal_kernels.hpp"

namespace circlepoint::detail {

const SignalKernels& signal_kernels() {
#ifdef __x86_64__
  switch (instruction_set()) {
    case InstructionSet::avx512: return signal_kernels_avx512;
    case InstructionSet::avx2: return signal_kernels_avx2;
    case InstructionSet::baseline: break;
  }
#endif
  return signal_kernels_baseline;
}

const FilterKernels& filter_kernels() {
#ifdef __x86_64__
  switch (instruction_set()) {
    case InstructionSet::avx512: return filter_kernels_avx512;
    case InstructionSet::avx2: return filter_kernels_avx2;
    case InstructionSet::baseline: break;
  }
#endif
  return filter_kernels_baseline;
}

}  // namespace circlepoint::detail
