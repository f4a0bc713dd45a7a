#pragma once
// Memory for results as long as a recording.

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <thread>

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

/// Fresh memory is cleared by the system, page by page as it is first written: of a result of hundreds of megabytes that is half of
/// the time. While this lives, another thread has the pages cleared ahead of the writer, who meets none that is missing. `fronts`: the
/// rows are written from so many equally spaced places on, at the same pace. Does nothing for small results, on one processor, or
/// where the system cannot (Linux from 5.14).
class ClearedAhead {
 public:
  explicit ClearedAhead(SamplesX& samples, Index fronts = 1) {
#ifdef MADV_POPULATE_WRITE
    constexpr std::size_t large = std::size_t{1} << 25U;
    const std::size_t size = static_cast<std::size_t>(samples.size()) * sizeof(double);
    if (size >= large && std::thread::hardware_concurrency() > 1) {
      auto* first = reinterpret_cast<char*>(samples.data());
      try {
        thread_ = std::thread([this, first, size, fronts] { clear(first, size, static_cast<std::size_t>(fronts)); });
      } catch (const std::system_error&) {
        // No thread to be had: the writer clears its pages itself.
      }
    }
#else
    static_cast<void>(samples);
    static_cast<void>(fronts);
#endif
  }
  ClearedAhead(const ClearedAhead&) = delete;
  ClearedAhead& operator=(const ClearedAhead&) = delete;
  ~ClearedAhead() {
    if (thread_.joinable()) {
      done_ = true;
      thread_.join();
    }
  }

 private:
  void clear(char* first, std::size_t size, std::size_t fronts) const {
#ifdef MADV_POPULATE_WRITE
    constexpr std::size_t chunk = std::size_t{1} << 22U;  // two huge pages
    const std::size_t share = size / fronts;
    for (std::size_t at = 0; at < share; at += chunk) {
      for (std::size_t front = 0; front < fronts; ++front) {
        const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(first) + front * share + at;
        auto* aligned = reinterpret_cast<char*>((begin + chunk - 1) / chunk * chunk);
        if (done_ || aligned + chunk > first + size || madvise(aligned, chunk, MADV_POPULATE_WRITE) != 0) {
          return;
        }
      }
    }
#else
    static_cast<void>(first);
    static_cast<void>(size);
    static_cast<void>(fronts);
#endif
  }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace circlepoint::detail
