// Compiled once for each instruction set, as CIRCLEPOINT_KERNELS(regression_kernels) = regression_kernels_<path>.
//
// Samples go through in blocks: first to one array a regressor and a channel, in the first-level cache, with cosine and sine
// computed in vectors; then each sum runs over the block in four lanes, which are added up at its end. Four lanes on every
// path, and blocks of one size: the order of summation is the same everywhere.
#include "regression_kernels.hpp"

#include <utility>

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

// The minimax polynomials of W. J. Cody and W. Waite's range: sine and cosine to less than one unit in the last place on
// [-pi/4, pi/4] (coefficients of FreeBSD's msun, k_sin.c and k_cos.c).
inline __attribute__((always_inline)) void cosine_and_sine(const Vector& x, Vector& cosine, Vector& sine) {
  const Vector shifter = 6755399441055744.0 - Vector{};  // 1.5 * 2^52: adding it rounds to an integer in the low bits
  const Vector shifted = x * two_over_pi + shifter;
  const Vector n = shifted - shifter;
  const Integers quadrant = reinterpret_cast<Integers>(shifted);
  const Vector r = ((x - n * half_pi_first) - n * half_pi_second) - n * half_pi_third;
  const Vector z = r * r;
  const Vector s =
      r + (r * z) * (-1.66666666666666324348e-01 +
                     z * (8.33333333332248946124e-03 +
                          z * (-1.98412698298579493134e-04 +
                               z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const Vector half_z = 0.5 * z;
  const Vector w = 1.0 - half_z;
  const Vector c =
      w + (((1.0 - w) - half_z) +
           (z * z) * (4.16666666666666019037e-02 +
                      z * (-1.38888888888741095749e-03 +
                           z * (2.48015872894767294178e-05 +
                                z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))));
  const Integers swap = -(quadrant & 1);
  const Integers sine_sign = (quadrant & 2) << 62;
  const Integers cosine_sign = ((quadrant + 1) & 2) << 62;
  const Integers sine_bits = reinterpret_cast<Integers>(s);
  const Integers cosine_bits = reinterpret_cast<Integers>(c);
  sine = reinterpret_cast<Vector>(((sine_bits & ~swap) | (cosine_bits & swap)) ^ sine_sign);
  cosine = reinterpret_cast<Vector>(((cosine_bits & ~swap) | (sine_bits & swap)) ^ cosine_sign);
}

struct Block {
  alignas(64) double x[5][block_samples];  // x[0] unused where it is 1
  alignas(64) double y[3][block_samples];
};

constexpr size_t row_of[15] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 4};
constexpr size_t column_of[15] = {0, 1, 2, 3, 4, 1, 2, 3, 4, 2, 3, 4, 3, 4, 4};

// Entries First, First + 1, ... of the upper triangle, few enough for their sums to stay in registers; x_0 = 1 where Ones.
template <bool Ones, size_t First, size_t... Entry>
void add_information(const Block& block, ptrdiff_t samples, double* information, std::index_sequence<Entry...>) {
  Quad sums[sizeof...(Entry)] = {};
  const auto load = [&](size_t k, ptrdiff_t i) __attribute__((always_inline)) {
    Quad x;
    x.load(block.x[k] + i);
    return x;
  };
  const auto add = [&](Quad& sum, size_t k, size_t l, ptrdiff_t i) __attribute__((always_inline)) {
    const Quad right = load(l, i);
    const Quad left = Ones && k == 0 ? right : load(k, i);
#pragma GCC unroll 2
    for (size_t p = 0; p < Quad::count; ++p) {
      sum.part[p] += Ones && k == 0 ? right.part[p] : left.part[p] * right.part[p];
    }
  };
  for (ptrdiff_t i = 0; i < samples; i += static_cast<ptrdiff_t>(lanes)) {
    (add(sums[Entry], row_of[First + Entry], column_of[First + Entry], i), ...);
  }
  ((information[First + Entry] += total(sums[Entry])), ...);
}

// Of channel Channel: its products with the five regressors, with itself and the channels after it.
template <bool Ones, int Channel>
void add_channel(const Block& block, ptrdiff_t samples, double* score, double* squares) {
  Quad by_regressor[5] = {};
  Quad by_channel[3] = {};
  for (ptrdiff_t i = 0; i < samples; i += static_cast<ptrdiff_t>(lanes)) {
    Quad y;
    y.load(block.y[Channel] + i);
#pragma GCC unroll 5
    for (int k = 0; k < 5; ++k) {
      Quad x = y;
      if (!Ones || k > 0) {
        x.load(block.x[k] + i);
      }
      for (size_t p = 0; p < Quad::count; ++p) {
        by_regressor[k].part[p] += Ones && k == 0 ? y.part[p] : x.part[p] * y.part[p];
      }
    }
#pragma GCC unroll 3
    for (int other = Channel; other < 3; ++other) {
      Quad z;
      z.load(block.y[other] + i);
      for (size_t p = 0; p < Quad::count; ++p) {
        by_channel[other].part[p] += y.part[p] * z.part[p];
      }
    }
  }
  for (int k = 0; k < 5; ++k) {
    score[3 * k + Channel] += total(by_regressor[k]);
  }
  for (int other = Channel; other < 3; ++other) {
    squares[other - Channel] += total(by_channel[other]);
  }
}

// The block's rows beyond `samples`, up to a multiple of the lanes, become zeros and add nothing.
template <bool Ones>
void add_block(Block& block, ptrdiff_t samples, RegressionSums* sums) {
  ptrdiff_t filled = samples;
  for (; filled % static_cast<ptrdiff_t>(lanes) != 0; ++filled) {
    for (int k = 0; k < 5; ++k) {
      block.x[k][filled] = 0.0;
    }
    for (int channel = 0; channel < 3; ++channel) {
      block.y[channel][filled] = 0.0;
    }
  }
  if (Ones) {
    sums->information[0] += static_cast<double>(samples);
  }
  constexpr size_t first = Ones ? 1 : 0;
  add_information<Ones, first>(block, filled, sums->information, std::make_index_sequence<9 - first>{});
  add_information<Ones, 9>(block, filled, sums->information, std::make_index_sequence<6>{});
  add_channel<Ones, 0>(block, filled, sums->score, sums->squares);
  add_channel<Ones, 1>(block, filled, sums->score, sums->squares + 3);
  add_channel<Ones, 2>(block, filled, sums->score, sums->squares + 5);
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

bool within_reduction(const double* angle, ptrdiff_t samples) {
  bool within = true;
  for (ptrdiff_t i = 0; i < samples; ++i) {
    within &= __builtin_fabs(angle[i]) <= reduction_limit;
  }
  return within;
}

void add_motion(const double* angle, const double* rate, const double* acceleration, const double* readings, ptrdiff_t samples,
                RegressionSums* sums) {
  Block block;
  for (ptrdiff_t begin = 0; begin < samples; begin += block_samples) {
    const ptrdiff_t size = block_samples < samples - begin ? block_samples : samples - begin;
    const double* at = angle + begin;
    if (within_reduction(at, size)) {
      ptrdiff_t i = 0;
      for (; i < size; i += static_cast<ptrdiff_t>(Quad::width)) {
        Vector x = {};
        if (i + static_cast<ptrdiff_t>(Quad::width) <= size) {
          load_vector(x, at + i);
        } else {
          for (ptrdiff_t k = i; k < size; ++k) {
            x[k - i] = at[k];
          }
        }
        Vector cosine, sine;
        cosine_and_sine(x, cosine, sine);
        store_vector(block.x[1] + i, cosine);
        store_vector(block.x[2] + i, sine);
      }
    } else {
      for (ptrdiff_t i = 0; i < size; ++i) {
        block.x[1][i] = __builtin_cos(at[i]);
        block.x[2][i] = __builtin_sin(at[i]);
      }
    }
    for (ptrdiff_t i = 0; i < size; ++i) {
      block.x[3][i] = acceleration[begin + i];
      block.x[4][i] = rate[begin + i] * rate[begin + i];
    }
    separate(readings + 3 * begin, size, block);
    add_block<true>(block, size, sums);
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
    const double* first = readings + begin * readings_step;
    if (readings_step == 3) {
      separate(first, size, block);
    } else {
      for (ptrdiff_t i = 0; i < size; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
          block.y[channel][i] = first[i * readings_step + channel];
        }
      }
    }
    add_block<false>(block, size, sums);
  }
}

}  // namespace

const RegressionKernels CIRCLEPOINT_KERNELS(regression_kernels){add_motion, add_rows};

}  // namespace circlepoint::detail
