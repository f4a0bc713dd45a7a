// Compiled once for each instruction set, as CIRCLEPOINT_KERNELS(signal_kernels) = signal_kernels_<path>.
#include "signal_kernels.hpp"

#include "../core/vector_pack.hpp"

namespace circlepoint::detail {
namespace {

struct Uniform {
  double dx;
  double operator()(ptrdiff_t) const { return dx; }
};
struct Differences {
  const double* x;
  double operator()(ptrdiff_t i) const { return x[i + 1] - x[i]; }
};

// The rule of a cumulative integral: intervals [begin, end) of `Lanes` channels, whole registers read and written where the rows
// behind allow it.
struct Trapezoids {
  // Half the sum of the ends times the width, rounded as SciPy does: halving is exact.
  template <size_t Lanes, bool Over, typename Width>
  static void sum(ConstRows y, Rows integral, ptrdiff_t begin, ptrdiff_t end, const Width& width, double* sums, double offset) {
    using Values = Pack<Lanes>;
    Values sum, left, right, shift;
    shift.fill(offset);
    sum.load(sums);
    left.load(y.first + begin * y.step);
    for (ptrdiff_t i = begin; i < end; ++i) {
      load_row<Over>(right, y.first + (i + 1) * y.step);
      const double half = 0.5 * width(i);
      Values to;
#pragma GCC unroll 8
      for (size_t p = 0; p < Values::count; ++p) {
        sum.part[p] += half * (right.part[p] + left.part[p]);
        to.part[p] = sum.part[p] + shift.part[p];
      }
      store_row<Over>(to, integral.first + i * integral.step);
      left = right;
    }
    sum.store(sums);
  }
};

// The integral of the parabola through (near, middle, far) from near to middle is scale (w . samples).
struct ParabolaWeights {
  double scale, near, middle, far;

  template <typename Vector>
  inline __attribute__((always_inline)) Vector at(const Vector& y_near, const Vector& y_middle, const Vector& y_far) const {
    return scale * (near * y_near + middle * y_middle + far * y_far);
  }
};

ParabolaWeights parabola_weights(const Uniform& width, ptrdiff_t, ptrdiff_t) { return {width.dx / 3.0, 1.25, 2.0, -0.25}; }

ParabolaWeights parabola_weights(const Differences& width, ptrdiff_t near_interval, ptrdiff_t far_interval) {
  const double d_near = width(near_interval);
  const double d_far = width(far_interval);
  const double near_of_both = d_near / (d_near + d_far);
  const double product = near_of_both * (d_near / d_far);
  return {d_near / 6.0, 3.0 - near_of_both, 3.0 + product + near_of_both, -product};
}

struct Parabolas {
  // From an even `begin`; an odd last interval takes the parabola of the last three samples.
  template <size_t Lanes, bool Over, typename Width>
  static void sum(ConstRows y, Rows integral, ptrdiff_t begin, ptrdiff_t end, const Width& width, double* sums, double offset) {
    using Values = Pack<Lanes>;
    Values sum, y0, y1, y2, shift;
    shift.fill(offset);
    sum.load(sums);
    y0.load(y.first + begin * y.step);
    ptrdiff_t i = begin;
    for (; i + 2 <= end; i += 2) {
      const ParabolaWeights first = parabola_weights(width, i, i + 1);
      const ParabolaWeights second = parabola_weights(width, i + 1, i);
      load_row<Over>(y1, y.first + (i + 1) * y.step);
      load_row<Over>(y2, y.first + (i + 2) * y.step);
      Values to_first, to_second;
#pragma GCC unroll 8
      for (size_t p = 0; p < Values::count; ++p) {
        sum.part[p] += first.at(y0.part[p], y1.part[p], y2.part[p]);
        to_first.part[p] = sum.part[p] + shift.part[p];
        sum.part[p] += second.at(y2.part[p], y1.part[p], y0.part[p]);
        to_second.part[p] = sum.part[p] + shift.part[p];
      }
      store_row<Over>(to_first, integral.first + i * integral.step);
      store_row<Over>(to_second, integral.first + (i + 1) * integral.step);
      y0 = y2;
    }
    if (i < end) {
      const ParabolaWeights last = parabola_weights(width, i, i - 1);
      y0.load(y.first + (i - 1) * y.step);
      y1.load(y.first + i * y.step);
      y2.load(y.first + (i + 1) * y.step);
      Values to;
#pragma GCC unroll 8
      for (size_t p = 0; p < Values::count; ++p) {
        sum.part[p] += last.at(y2.part[p], y1.part[p], y0.part[p]);
        to.part[p] = sum.part[p] + shift.part[p];
      }
      to.store(integral.first + i * integral.step);
    }
    sum.store(sums);
  }
};

// Blocks of an even number of intervals, all channels of one block after another. A whole register that runs over the end of a
// row reads of, and writes to, the row behind, which is written next: not so in the last rows, nor where the channels need several turns.
template <typename Rule>
void integrate(ConstRows y, Rows integral, ptrdiff_t samples, ptrdiff_t channels, Intervals given, double* sums, double offset) {
  const ptrdiff_t intervals = samples - 1;
  const ptrdiff_t block = cached_rows(channels) / 2 * 2;
  const ptrdiff_t exact_from = intervals > 4 ? (intervals - 3) / 2 * 2 : 0;
  const auto sum = [&]<size_t Lanes, bool Over>(ptrdiff_t c, ptrdiff_t begin, ptrdiff_t end) {
    const ConstRows from{y.first + c, y.step};
    const Rows to{integral.first + c, integral.step};
    if (given.x == nullptr) {
      Rule::template sum<Lanes, Over>(from, to, begin, end, Uniform{given.dx}, sums + c, offset);
    } else {
      Rule::template sum<Lanes, Over>(from, to, begin, end, Differences{given.x}, sums + c, offset);
    }
  };
  for (ptrdiff_t begin = 0; begin < intervals;) {
    const bool over = begin < exact_from;
    const ptrdiff_t limit = over ? exact_from : intervals;
    const ptrdiff_t end = block < limit - begin ? begin + block : limit;
    for_groups(channels, [&]<size_t Lanes>(ptrdiff_t c) {
      if (over && static_cast<ptrdiff_t>(Lanes) == channels && Pack<Lanes>::tail != Pack<Lanes>::width) {
        sum.template operator()<Lanes, true>(c, begin, end);
      } else {
        sum.template operator()<Lanes, false>(c, begin, end);
      }
    });
    begin = end;
  }
}

template <size_t Lanes, bool Symmetric>
inline __attribute__((always_inline)) void correlate_tile(const double* x, double* y, const double* weights, ptrdiff_t half,
                                                          ptrdiff_t step) {
  using Values = Pack<Lanes>;
  Values sum;
  sum.load(x);
#pragma GCC unroll 8
  for (size_t p = 0; p < Values::count; ++p) {
    sum.part[p] *= weights[0];
  }
  for (ptrdiff_t j = 1; j <= half; ++j) {
    Values after, before;
    after.load(x + j * step);
    before.load(x - j * step);
#pragma GCC unroll 8
    for (size_t p = 0; p < Values::count; ++p) {
      sum.part[p] += weights[j] * (Symmetric ? after.part[p] + before.part[p] : after.part[p] - before.part[p]);
    }
  }
  sum.store(y);
}

template <bool Symmetric>
void correlate_all(const double* x, double* y, ptrdiff_t values, const double* weights, ptrdiff_t half, ptrdiff_t step) {
  constexpr ptrdiff_t tile = 4 * register_width;
  ptrdiff_t i = 0;
  for (; i + tile <= values; i += tile) {
    correlate_tile<tile, Symmetric>(x + i, y + i, weights, half, step);
  }
  for (; i < values; ++i) {
    correlate_tile<1, Symmetric>(x + i, y + i, weights, half, step);
  }
}

void correlate(const double* x, double* y, ptrdiff_t values, const double* weights, ptrdiff_t half, ptrdiff_t step,
               bool symmetric) {
  if (symmetric) {
    correlate_all<true>(x, y, values, weights, half, step);
  } else {
    correlate_all<false>(x, y, values, weights, half, step);
  }
}

}  // namespace

const SignalKernels CIRCLEPOINT_KERNELS(signal_kernels){integrate<Trapezoids>, integrate<Parabolas>, correlate};

}  // namespace circlepoint::detail
