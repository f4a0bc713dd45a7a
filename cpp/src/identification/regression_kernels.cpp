// Compiled once for each instruction set, as CIRCLEPOINT_KERNELS(regression_kernels) = regression_kernels_<path>.
//
// Samples go through in blocks: first to one array a regressor and a channel, in the first-level cache, with cosine and sine
// computed in vectors; then the sums run over the block in four lanes, as many at once as there are registers, which are added up
// at its end. Four lanes on every path, and blocks of one size: the order of summation is the same everywhere. While the sums run,
// the next block is fetched.
#include "regression_kernels.hpp"

#include "../core/vector_pack.hpp"

namespace circlepoint::detail {
namespace {

constexpr size_t lanes = 4;
using Quad = Pack<lanes>;
using Vector = Quad::Vector;
using Integers = VectorOf<Quad::width>::integers;
constexpr ptrdiff_t block_samples = 256;

double total(const Quad& sum) {
  double values[lanes];
  sum.store(values);
  return (values[0] + values[2]) + (values[1] + values[3]);
}

// x - n pi/2 with |result| <= pi/4, n = round(x 2/pi): pi/2 in three parts of 33 bits, so that products with n are exact up to
// |x| = reduction_limit.
constexpr double reduction_limit = 1e5;
constexpr double two_over_pi = 0.63661977236758138;
constexpr double half_pi_first = 1.57079632673412561417e+00;
constexpr double half_pi_second = 6.07710050630396597660e-11;
constexpr double half_pi_third = 2.02226624879595063154e-21;

// The quadrant n, in the low bits of `shifted`, and r = x - n pi/2.
inline __attribute__((always_inline)) void reduce(const Vector& x, Vector& shifted, Vector& r) {
  const Vector shifter = 6755399441055744.0 - Vector{};  // 1.5 * 2^52: adding it rounds to an integer in the low bits
  shifted = two_over_pi * x + shifter;
  const Vector n = shifted - shifter;
  r = ((x - half_pi_first * n) - half_pi_second * n) - half_pi_third * n;
}

// The minimax polynomials of W. J. Cody and W. Waite's range: sine and cosine to about one unit in the last place on
// [-pi/4, pi/4] (coefficients of FreeBSD's msun, k_sin.c and k_cos.c). Pairs of terms side by side (G. Estrin's scheme): in
// W. G. Horner's every step would wait for the one before.
inline __attribute__((always_inline)) void cosine_and_sine(const Vector& shifted, const Vector& r, Vector& cosine, Vector& sine) {
  const Vector z = r * r;
  const Vector z2 = z * z;
  const Vector z4 = z2 * z2;
  const Vector s = r + (r * z) * (((-1.66666666666666324348e-01 + 8.33333333332248946124e-03 * z) +
                                   z2 * (-1.98412698298579493134e-04 + 2.75573137070700676789e-06 * z)) +
                                  z4 * (-2.50507602534068634195e-08 + 1.58969099521155010221e-10 * z));
  const Vector c = (1.0 - 0.5 * z) + z2 * (((4.16666666666666019037e-02 + -1.38888888888741095749e-03 * z) +
                                            z2 * (2.48015872894767294178e-05 + -2.75573143513906633035e-07 * z)) +
                                           z4 * (2.08757232129817482790e-09 + -1.13596475577881948265e-11 * z));
  constexpr long long sign = static_cast<long long>(1ULL << 63);
  const Integers first_bit = reinterpret_cast<Integers>(shifted) << 63;  // of the quadrant: cosine and sine change places
  const Integers second_bit = reinterpret_cast<Integers>(shifted) << 62;
  const Vector to_sine = first_bit < 0 ? c : s;
  const Vector to_cosine = first_bit < 0 ? s : c;
  sine = reinterpret_cast<Vector>(reinterpret_cast<Integers>(to_sine) ^ (second_bit & sign));
  cosine = reinterpret_cast<Vector>(reinterpret_cast<Integers>(to_cosine) ^ ((first_bit ^ second_bit) & sign));
}

struct Block {
  alignas(64) double x[5][block_samples];  // x[0] unused where it is 1
  alignas(64) double y[3][block_samples];
};

// What memory the next block comes from: three arrays and one of three times the size.
struct Ahead {
  static constexpr bool ones = true;  // x_0 = 1
  const double* single[3];
  const double* triple;

  template <ptrdiff_t Part>
  inline __attribute__((always_inline)) void fetch(ptrdiff_t i) const {
    if constexpr (Part == 0) {
      __builtin_prefetch(triple + 2 * i);
    } else if constexpr (Part == 1) {
      __builtin_prefetch(triple + 2 * block_samples + i);
      __builtin_prefetch(single[0] + i);
    } else {
      __builtin_prefetch(single[1] + i);
      __builtin_prefetch(single[2] + i);
    }
  }
};
struct Nothing {
  static constexpr bool ones = false;

  template <ptrdiff_t>
  inline __attribute__((always_inline)) void fetch(ptrdiff_t) const {}
};

// Sums of products of two rows of the block, one of a row alone; `row` < 5 is a regressor, 5 ... 7 a channel.
constexpr int none = -1;
struct Term {
  int left, right;
};

inline __attribute__((always_inline)) const double* row_of(const Block& block, int row) {
  return row < 5 ? block.x[row] : block.y[row - 5];
}

template <Term Of>
inline __attribute__((always_inline)) void add_term(Quad& sum, const Block& block, ptrdiff_t i) {
  Quad left, right;
  left.load(row_of(block, Of.left) + i);
  if constexpr (Of.right == none) {
#pragma GCC unroll 2
    for (size_t p = 0; p < Quad::count; ++p) {
      sum.part[p] += left.part[p];
    }
  } else {
    right.load(row_of(block, Of.right) + i);
#pragma GCC unroll 2
    for (size_t p = 0; p < Quad::count; ++p) {
      sum.part[p] += left.part[p] * right.part[p];
    }
  }
}

// As many terms as leave their sums in registers.
template <ptrdiff_t Part, Term... Of, typename Next>
inline __attribute__((always_inline)) void add_terms(const Block& block, ptrdiff_t samples, const Next& next, double* to) {
  Quad sums[sizeof...(Of)] = {};
  for (ptrdiff_t i = 0; i < samples; i += static_cast<ptrdiff_t>(lanes)) {
    next.template fetch<Part>(i);
    size_t k = 0;
    (add_term<Of>(sums[k++], block, i), ...);
  }
  for (size_t k = 0; k < sizeof...(Of); ++k) {
    to[k] = total(sums[k]);
  }
}

// The block's rows beyond `samples`, up to a multiple of the lanes, become zeros and add nothing.
ptrdiff_t fill_up(Block& block, ptrdiff_t samples) {
  ptrdiff_t filled = samples;
  for (; filled % static_cast<ptrdiff_t>(lanes) != 0; ++filled) {
    for (int k = 0; k < 5; ++k) {
      block.x[k][filled] = 0.0;
    }
    for (int channel = 0; channel < 3; ++channel) {
      block.y[channel][filled] = 0.0;
    }
  }
  return filled;
}

// With the sums of x_0 times the regressors and the channels in `first`.
template <typename Next>
void add_products(const Block& block, ptrdiff_t filled, const Next& next, double (&first)[8], RegressionSums* sums) {
  double score[11], products[11], squares[11];
  add_terms<0, Term{1, 5}, Term{1, 6}, Term{1, 7}, Term{2, 5}, Term{2, 6}, Term{2, 7}, Term{3, 5}, Term{3, 6}, Term{3, 7},
            Term{4, 5}, Term{4, 6}>(block, filled, next, score);
  add_terms<1, Term{1, 1}, Term{1, 2}, Term{1, 3}, Term{1, 4}, Term{2, 2}, Term{2, 3}, Term{2, 4}, Term{3, 3}, Term{3, 4},
            Term{4, 4}, Term{4, 7}>(block, filled, next, products);
  constexpr bool ones = Next::ones;
  if constexpr (ones) {
    add_terms<2, Term{5, 5}, Term{5, 6}, Term{5, 7}, Term{6, 6}, Term{6, 7}, Term{7, 7}, Term{1, none}, Term{2, none},
              Term{5, none}, Term{6, none}, Term{7, none}>(block, filled, next, squares);
    first[1] = squares[6];
    first[2] = squares[7];
    first[5] = squares[8];
    first[6] = squares[9];
    first[7] = squares[10];
  } else {
    add_terms<2, Term{5, 5}, Term{5, 6}, Term{5, 7}, Term{6, 6}, Term{6, 7}, Term{7, 7}>(block, filled, next, squares);
    add_terms<2, Term{0, 0}, Term{0, 1}, Term{0, 2}, Term{0, 3}, Term{0, 4}, Term{0, 5}, Term{0, 6}, Term{0, 7}>(block, filled, next,
                                                                                                              first);
  }
  for (size_t k = 0; k < 5; ++k) {
    sums->information[k] += first[k];
  }
  for (size_t k = 0; k < 10; ++k) {
    sums->information[5 + k] += products[k];
  }
  for (size_t k = 0; k < 3; ++k) {
    sums->score[k] += first[5 + k];
  }
  for (size_t k = 0; k < 11; ++k) {
    sums->score[3 + k] += score[k];
  }
  sums->score[14] += products[10];
  for (size_t k = 0; k < 6; ++k) {
    sums->squares[k] += squares[k];
  }
}

// Three adjacent readings a sample to one array a channel.
void separate(const double* readings, ptrdiff_t samples, Block& block) {
  ptrdiff_t i = 0;
#if CIRCLEPOINT_VECTOR_WIDTH >= 4
  for (; i + 4 <= samples; i += 4) {
    Vector a, b, c;
    load_vector(a, readings + 3 * i);
    load_vector(b, readings + 3 * i + 4);
    load_vector(c, readings + 3 * i + 8);
    const Vector first = __builtin_shufflevector(a, b, 0, 3, 6, 6);
    const Vector second = __builtin_shufflevector(a, b, 1, 4, 7, 7);
    const Vector third = __builtin_shufflevector(a, b, 2, 5, 5, 5);
    store_vector(block.y[0] + i, Vector(__builtin_shufflevector(first, c, 0, 1, 2, 5)));
    store_vector(block.y[1] + i, Vector(__builtin_shufflevector(second, c, 0, 1, 2, 6)));
    store_vector(block.y[2] + i, Vector(__builtin_shufflevector(third, c, 0, 1, 4, 7)));
  }
#endif
  for (; i < samples; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      block.y[channel][i] = readings[3 * i + channel];
    }
  }
}

// All angles reduced first, then all polynomials: each loop's chain of operations is short enough for the processor to have the
// next ones under way.
void fill_cosine_and_sine(const double* angle, ptrdiff_t samples, Block& block) {
  constexpr ptrdiff_t width = Quad::width;
  constexpr long long magnitude = ~static_cast<long long>(1ULL << 63);
  Integers beyond = {};
  double rest[width] = {};
  const ptrdiff_t whole = samples / width * width;
  for (ptrdiff_t k = whole; k < samples; ++k) {
    rest[k - whole] = angle[k];
  }
  const auto fill = [&](ptrdiff_t i, const double* from) __attribute__((always_inline)) {
    Vector x, shifted, r;
    load_vector(x, from);
    beyond |= reinterpret_cast<Vector>(reinterpret_cast<Integers>(x) & magnitude) > reduction_limit;
    reduce(x, shifted, r);
    store_vector(block.x[1] + i, r);
    store_vector(block.x[2] + i, shifted);
  };
  for (ptrdiff_t i = 0; i < whole; i += width) {
    fill(i, angle + i);
  }
  if (whole < samples) {
    fill(whole, rest);
  }
  for (ptrdiff_t i = 0; i < samples; i += width) {
    Vector shifted, r, cosine, sine;
    load_vector(r, block.x[1] + i);
    load_vector(shifted, block.x[2] + i);
    cosine_and_sine(shifted, r, cosine, sine);
    store_vector(block.x[1] + i, cosine);
    store_vector(block.x[2] + i, sine);
  }
  for (size_t k = 0; k < Quad::width; ++k) {
    if (beyond[k] != 0) {
      for (ptrdiff_t i = 0; i < samples; ++i) {
        block.x[1][i] = __builtin_cos(angle[i]);
        block.x[2][i] = __builtin_sin(angle[i]);
      }
      return;
    }
  }
}

// Accelerations and squared rates, and their sums: rows up to a multiple of the lanes.
void fill_motion(const double* rate, const double* acceleration, ptrdiff_t samples, Block& block, double (&first)[8]) {
  Quad accelerations = {}, squares = {};
  ptrdiff_t i = 0;
  const auto fill = [&](const double* rate_at, const double* acceleration_at) __attribute__((always_inline)) {
    Quad r, a;
    r.load(rate_at);
    a.load(acceleration_at);
#pragma GCC unroll 2
    for (size_t p = 0; p < Quad::count; ++p) {
      r.part[p] *= r.part[p];
      accelerations.part[p] += a.part[p];
      squares.part[p] += r.part[p];
    }
    a.store(block.x[3] + i);
    r.store(block.x[4] + i);
  };
  for (; i + static_cast<ptrdiff_t>(lanes) <= samples; i += static_cast<ptrdiff_t>(lanes)) {
    fill(rate + i, acceleration + i);
  }
  if (i < samples) {
    double rest[2][lanes] = {};
    for (ptrdiff_t k = i; k < samples; ++k) {
      rest[0][k - i] = rate[k];
      rest[1][k - i] = acceleration[k];
    }
    fill(rest[0], rest[1]);
  }
  first[3] = total(accelerations);
  first[4] = total(squares);
}

void add_motion(const double* angle, const double* rate, const double* acceleration, const double* readings, ptrdiff_t samples,
                RegressionSums* sums) {
  Block block;
  for (ptrdiff_t begin = 0; begin < samples; begin += block_samples) {
    const ptrdiff_t size = block_samples < samples - begin ? block_samples : samples - begin;
    double first[8];
    first[0] = static_cast<double>(size);
    fill_cosine_and_sine(angle + begin, size, block);
    fill_motion(rate + begin, acceleration + begin, size, block, first);
    separate(readings + 3 * begin, size, block);
    const ptrdiff_t next = begin + size;
    add_products(block, fill_up(block, size), Ahead{{angle + next, rate + next, acceleration + next}, readings + 3 * next}, first,
                 sums);
  }
}

void add_rows(const double* regressors, ptrdiff_t regressors_step, const double* readings, ptrdiff_t readings_step,
              ptrdiff_t samples, RegressionSums* sums) {
  Block block;
  for (ptrdiff_t begin = 0; begin < samples; begin += block_samples) {
    const ptrdiff_t size = block_samples < samples - begin ? block_samples : samples - begin;
    for (ptrdiff_t i = 0; i < size; ++i) {
      const double* row = regressors + (begin + i) * regressors_step;
      for (int k = 0; k < 5; ++k) {
        block.x[k][i] = row[k];
      }
    }
    const double* reading = readings + begin * readings_step;
    if (readings_step == 3) {
      separate(reading, size, block);
    } else {
      for (ptrdiff_t i = 0; i < size; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
          block.y[channel][i] = reading[i * readings_step + channel];
        }
      }
    }
    double first[8];
    add_products(block, fill_up(block, size), Nothing{}, first, sums);
  }
}

}  // namespace

const RegressionKernels CIRCLEPOINT_KERNELS(regression_kernels){add_motion, add_rows};

}  // namespace circlepoint::detail
