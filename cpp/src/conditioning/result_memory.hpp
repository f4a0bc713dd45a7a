#pragma once
// Memory for results as long as a recording.

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstddef>
#include <cstdint>

#include "circlepoint/core/types.hpp"

namespace circlepoint::detail {

/// Samples yet to be written. Touching fresh memory a small page at a time costs more than the cheapest kernels do, so
/// for large results huge pages are asked for (only advice: the kernel may decline).
inline SamplesX unwritten_samples(Index rows, Index channels) {
  SamplesX samples(rows, channels);
#ifdef __linux__
  constexpr std::size_t large = std::size_t{1} << 22U;
  const std::size_t size = static_cast<std::size_t>(samples.size()) * sizeof(double);
  if (size >= large) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t skipped = (page - reinterpret_cast<std::uintptr_t>(samples.data()) % page) % page;
    static_cast<void>(madvise(reinterpret_cast<char*>(samples.data()) + skipped, size - skipped, MADV_HUGEPAGE));
  }
#endif
  return samples;
}

}  // namespace circlepoint::detail
