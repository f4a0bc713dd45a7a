#pragma once
// A few adjacent doubles in vector registers, for the files that are compiled once for each instruction set.
//
// Those files include neither Eigen nor the standard library's templates: an inline function compiled for wide vectors in one
// file could be the copy the linker keeps for all. For the same reason everything here has internal linkage.

#include <cstddef>

#ifndef CIRCLEPOINT_VECTOR_WIDTH
#error "compiled by the circlepoint_vector_* targets only, which say how many doubles a register holds"
#endif

#define CIRCLEPOINT_JOINED(name, path) name##path
#define CIRCLEPOINT_EXPANDED(name, path) CIRCLEPOINT_JOINED(name, path)
/// signal_kernels -> signal_kernels_avx2 in the file compiled for AVX2.
#define CIRCLEPOINT_KERNELS(name) CIRCLEPOINT_EXPANDED(name, CIRCLEPOINT_VECTOR_PATH)

namespace circlepoint::detail {
namespace {

using std::ptrdiff_t;
using std::size_t;

constexpr size_t register_width = CIRCLEPOINT_VECTOR_WIDTH;

template <size_t Width>
struct VectorOf {
  typedef double type __attribute__((vector_size(Width * sizeof(double))));
  typedef double anywhere __attribute__((vector_size(Width * sizeof(double)), aligned(alignof(double)), may_alias));
  typedef long long integers __attribute__((vector_size(Width * sizeof(double))));
};
using Pair = VectorOf<2>::type;

// Through a type that may lie anywhere: the compiler would copy bytes in narrower registers.
template <typename Vector>
using Anywhere = typename VectorOf<sizeof(Vector) / sizeof(double)>::anywhere;

template <typename Vector>
inline __attribute__((always_inline)) void load_vector(Vector& to, const double* from) {
  to = *reinterpret_cast<const Anywhere<Vector>*>(from);
}
template <typename Vector>
inline __attribute__((always_inline)) void store_vector(double* to, const Vector& from) {
  *reinterpret_cast<Anywhere<Vector>*>(to) = from;
}

/// The narrowest registers that hold so many lanes without being many.
constexpr size_t width_for(size_t lanes) {
  if (lanes <= 2 || register_width == 2) {
    return 2;
  }
  return register_width == 8 && lanes % 8 == 0 ? 8 : 4;
}

template <size_t Lanes>
struct Pack {
  static constexpr size_t width = width_for(Lanes);
  static constexpr size_t count = (Lanes + width - 1) / width;
  static constexpr size_t tail = Lanes - (count - 1) * width;  // lanes in use in the last register
  using Vector = typename VectorOf<width>::type;
  Vector part[count];

  inline __attribute__((always_inline)) void load(const double* from) {
#pragma GCC unroll 8
    for (size_t p = 0; p + 1 < count; ++p) {
      load_vector(part[p], from + p * width);
    }
    const double* last = from + (count - 1) * width;
    Vector& to = part[count - 1];
    if constexpr (tail == width) {
      load_vector(to, last);
    } else if constexpr (width == 2) {
      to = Vector{last[0], 0.0};
    } else if constexpr (tail == 1) {
      to = Vector{last[0], 0.0, 0.0, 0.0};
    } else {
      Pair low;
      load_vector(low, last);
      const Pair high{tail == 3 ? last[tail - 1] : 0.0, 0.0};
      to = __builtin_shufflevector(low, high, 0, 1, 2, 3);
    }
  }

  /// Whole registers: reads as many values behind the lanes as the last register has lanes left over, of any value.
  inline __attribute__((always_inline)) void load_over(const double* from) {
#pragma GCC unroll 8
    for (size_t p = 0; p < count; ++p) {
      load_vector(part[p], from + p * width);
    }
  }
  /// Writes them too.
  inline __attribute__((always_inline)) void store_over(double* to) const {
#pragma GCC unroll 8
    for (size_t p = 0; p < count; ++p) {
      store_vector(to + p * width, part[p]);
    }
  }

  inline __attribute__((always_inline)) void store(double* to) const {
#pragma GCC unroll 8
    for (size_t p = 0; p + 1 < count; ++p) {
      store_vector(to + p * width, part[p]);
    }
    double* last = to + (count - 1) * width;
    const Vector& from = part[count - 1];
    if constexpr (tail == width) {
      store_vector(last, from);
    } else if constexpr (tail == 1) {
      last[0] = from[0];
    } else {
      store_vector(last, Pair(__builtin_shufflevector(from, from, 0, 1)));
      if constexpr (tail == 3) {
        last[2] = from[2];
      }
    }
  }

  inline __attribute__((always_inline)) void fill(double value) {
#pragma GCC unroll 8
    for (size_t p = 0; p < count; ++p) {
      part[p] = value - Vector{};
    }
  }
};

/// Whole registers or the lanes alone.
template <bool Over, typename Values>
inline __attribute__((always_inline)) void load_row(Values& values, const double* from) {
  if constexpr (Over) {
    values.load_over(from);
  } else {
    values.load(from);
  }
}
template <bool Over, typename Values>
inline __attribute__((always_inline)) void store_row(const Values& values, double* to) {
  if constexpr (Over) {
    values.store_over(to);
  } else {
    values.store(to);
  }
}

/// Calls task.operator()<lanes>(first channel) until all channels have had their turn.
template <typename Task>
inline __attribute__((always_inline)) void for_groups(ptrdiff_t channels, const Task& task) {
  constexpr ptrdiff_t most = register_width == 2 ? 4 : 8;
  for (ptrdiff_t c = 0; c < channels;) {
    const ptrdiff_t left = channels - c;
    const ptrdiff_t lanes = left < most ? left : most;
    switch (lanes) {
      case 1: task.template operator()<1>(c); break;
      case 2: task.template operator()<2>(c); break;
      case 3: task.template operator()<3>(c); break;
      case 4: task.template operator()<4>(c); break;
      default:
        if constexpr (most == 8) {
          switch (lanes) {
            case 5: task.template operator()<5>(c); break;
            case 6: task.template operator()<6>(c); break;
            case 7: task.template operator()<7>(c); break;
            default: task.template operator()<8>(c); break;
          }
        }
        break;
    }
    c += lanes;
  }
}

}  // namespace
}  // namespace circlepoint::detail
