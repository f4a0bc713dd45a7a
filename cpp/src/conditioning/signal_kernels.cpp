// Compiled once for each instruction set, as CIRCLEPOINT_KERNELS(signal_kernels) = signal_kernels_<path>.
#include "signal_kernels.hpp"

#include "../core/vector_pack.hpp"

namespace circlepoint::detail {
namespace {

constexpr ptrdiff_t block_values = 2048;  // values that go through all channels and sections while in the first-level cache

ptrdiff_t block_rows(ptrdiff_t channels) {
  const ptrdiff_t rows = block_values / (channels > 0 ? channels : 1);
  return rows > 32 ? rows : 32;
}

// Sections broadcast to vectors, as they are.
template <typename Values, size_t Sections>
struct DirectForm {
  using Vector = typename Values::Vector;
  Vector b0[Sections], b1[Sections], b2[Sections], a1[Sections], a2[Sections];

  inline __attribute__((always_inline)) void set(size_t s, const Section& section) {
    b0[s] = section.b0 - Vector{};
    b1[s] = section.b1 - Vector{};
    b2[s] = section.b2 - Vector{};
    a1[s] = section.a1 - Vector{};
    a2[s] = section.a2 - Vector{};
  }
  inline __attribute__((always_inline)) void step(size_t s, Vector& x, Vector& s0, Vector& s1) const {
    const Vector y = b0[s] * x + s0;
    s0 = b1[s] * x - a1[s] * y + s1;
    s1 = b2[s] * x - a2[s] * y;
    x = y;
  }
};

// With the answer eliminated from the recursion.
template <typename Values, size_t Sections>
struct ShortForm {
  using Vector = typename Values::Vector;
  Vector b0[Sections], c1[Sections], c2[Sections], a1[Sections], a2[Sections];

  inline __attribute__((always_inline)) void set(size_t s, const Section& section) {
    b0[s] = section.b0 - Vector{};
    c1[s] = (section.b1 - section.a1 * section.b0) - Vector{};
    c2[s] = (section.b2 - section.a2 * section.b0) - Vector{};
    a1[s] = section.a1 - Vector{};
    a2[s] = section.a2 - Vector{};
  }
  inline __attribute__((always_inline)) void step(size_t s, Vector& x, Vector& s0, Vector& s1) const {
    const Vector y = b0[s] * x + s0;
    const Vector next = (c1[s] * x + s1) - a1[s] * s0;
    s1 = c2[s] * x - a2[s] * s0;
    s0 = next;
    x = y;
  }
};

template <template <typename, size_t> class Form, size_t Lanes, size_t Sections>
void run(const Section* sections, double* state, ptrdiff_t state_step, ConstRows in, Rows out, ptrdiff_t rows) {
  using Values = Pack<Lanes>;
  const auto state_row = [&](size_t i) { return state + static_cast<ptrdiff_t>(i) * state_step; };
  Form<Values, Sections> form;
  Values s0[Sections], s1[Sections];
  for (size_t s = 0; s < Sections; ++s) {
    form.set(s, sections[s]);
    s0[s].load(state_row(2 * s));
    s1[s].load(state_row(2 * s + 1));
  }
  for (ptrdiff_t row = 0; row < rows; ++row) {
    Values x;
    x.load(in.first + row * in.step);
#pragma GCC unroll 4
    for (size_t s = 0; s < Sections; ++s) {
#pragma GCC unroll 4
      for (size_t p = 0; p < Values::count; ++p) {
        form.step(s, x.part[p], s0[s].part[p], s1[s].part[p]);
      }
    }
    x.store(out.first + row * out.step);
  }
  for (size_t s = 0; s < Sections; ++s) {
    s0[s].store(state_row(2 * s));
    s1[s].store(state_row(2 * s + 1));
  }
}

// As many sections at once as keep their states in registers.
template <template <typename, size_t> class Form, size_t Lanes>
void run_all(const Section* sections, ptrdiff_t section_count, double* state, ptrdiff_t state_step, ConstRows in,
             Rows out, ptrdiff_t rows) {
  constexpr ptrdiff_t at_once = Pack<Lanes>::count == 1 ? 4 : 2;
  for (ptrdiff_t s = 0; s < section_count;) {
    const ptrdiff_t left = section_count - s;
    const Section* first = sections + s;
    double* first_state = state + 2 * s * state_step;
    if (at_once == 4 && left >= 4) {
      run<Form, Lanes, at_once>(first, first_state, state_step, in, out, rows);
      s += 4;
    } else if (at_once == 4 && left == 3) {
      run<Form, Lanes, at_once == 4 ? 3 : 2>(first, first_state, state_step, in, out, rows);
      s += 3;
    } else if (left >= 2) {
      run<Form, Lanes, 2>(first, first_state, state_step, in, out, rows);
      s += 2;
    } else {
      run<Form, Lanes, 1>(first, first_state, state_step, in, out, rows);
      s += 1;
    }
    in = {out.first, out.step};
  }
}

template <template <typename, size_t> class Form>
void filter_rows(const Section* sections, ptrdiff_t section_count, double* state, ConstRows in, Rows out,
                 ptrdiff_t rows, ptrdiff_t channels) {
  const ptrdiff_t block = block_rows(channels);
  for (ptrdiff_t begin = 0; begin < rows; begin += block) {
    const ptrdiff_t size = block < rows - begin ? block : rows - begin;
    for_groups(channels, [&]<size_t Lanes>(ptrdiff_t c) {
      run_all<Form, Lanes>(sections, section_count, state + c, channels, {in.first + begin * in.step + c, in.step},
                           {out.first + begin * out.step + c, out.step}, size);
    });
  }
}

struct Uniform {
  double dx;
  double operator()(ptrdiff_t) const { return dx; }
};
struct Differences {
  const double* x;
  double operator()(ptrdiff_t i) const { return x[i + 1] - x[i]; }
};

template <size_t Lanes, typename Width>
void sum_trapezoids(ConstRows y, Rows integral, ptrdiff_t begin, ptrdiff_t end, const Width& width, double* sums, double offset) {
  using Values = Pack<Lanes>;
  Values sum, left, right, shift;
  shift.fill(offset);
  sum.load(sums);
  left.load(y.first + begin * y.step);
  for (ptrdiff_t i = begin; i < end; ++i) {
    right.load(y.first + (i + 1) * y.step);
    const double d = width(i);
    Values to;
#pragma GCC unroll 8
    for (size_t p = 0; p < Values::count; ++p) {
      sum.part[p] += d * (right.part[p] + left.part[p]) * 0.5;
      to.part[p] = sum.part[p] + shift.part[p];
    }
    to.store(integral.first + i * integral.step);
    left = right;
  }
  sum.store(sums);
}

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

// Intervals [begin, end) from an even `begin`; an odd last one takes the parabola of the last three samples.
template <size_t Lanes, typename Width>
void sum_parabolas(ConstRows y, Rows integral, ptrdiff_t begin, ptrdiff_t end, const Width& width, double* sums, double offset) {
  using Values = Pack<Lanes>;
  Values sum, y0, y1, y2, shift;
  shift.fill(offset);
  sum.load(sums);
  y0.load(y.first + begin * y.step);
  ptrdiff_t i = begin;
  for (; i + 2 <= end; i += 2) {
    const ParabolaWeights first = parabola_weights(width, i, i + 1);
    const ParabolaWeights second = parabola_weights(width, i + 1, i);
    y1.load(y.first + (i + 1) * y.step);
    y2.load(y.first + (i + 2) * y.step);
    Values to_first, to_second;
#pragma GCC unroll 8
    for (size_t p = 0; p < Values::count; ++p) {
      sum.part[p] += first.at(y0.part[p], y1.part[p], y2.part[p]);
      to_first.part[p] = sum.part[p] + shift.part[p];
      sum.part[p] += second.at(y2.part[p], y1.part[p], y0.part[p]);
      to_second.part[p] = sum.part[p] + shift.part[p];
    }
    to_first.store(integral.first + i * integral.step);
    to_second.store(integral.first + (i + 1) * integral.step);
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

// Blocks of an even number of intervals, all channels of one block after another.
template <typename Task>
void in_blocks(ptrdiff_t intervals, ptrdiff_t channels, const Task& task) {
  const ptrdiff_t block = block_rows(channels) / 2 * 2;
  for (ptrdiff_t begin = 0; begin < intervals; begin += block) {
    task(begin, block < intervals - begin ? begin + block : intervals);
  }
}

void trapezoids(ConstRows y, Rows integral, ptrdiff_t samples, ptrdiff_t channels, Intervals intervals, double* sums,
                double offset) {
  in_blocks(samples - 1, channels, [&](ptrdiff_t begin, ptrdiff_t end) {
    for_groups(channels, [&]<size_t Lanes>(ptrdiff_t c) {
      const ConstRows from{y.first + c, y.step};
      const Rows to{integral.first + c, integral.step};
      if (intervals.x == nullptr) {
        sum_trapezoids<Lanes>(from, to, begin, end, Uniform{intervals.dx}, sums + c, offset);
      } else {
        sum_trapezoids<Lanes>(from, to, begin, end, Differences{intervals.x}, sums + c, offset);
      }
    });
  });
}

void parabolas(ConstRows y, Rows integral, ptrdiff_t samples, ptrdiff_t channels, Intervals intervals, double* sums,
               double offset) {
  in_blocks(samples - 1, channels, [&](ptrdiff_t begin, ptrdiff_t end) {
    for_groups(channels, [&]<size_t Lanes>(ptrdiff_t c) {
      const ConstRows from{y.first + c, y.step};
      const Rows to{integral.first + c, integral.step};
      if (intervals.x == nullptr) {
        sum_parabolas<Lanes>(from, to, begin, end, Uniform{intervals.dx}, sums + c, offset);
      } else {
        sum_parabolas<Lanes>(from, to, begin, end, Differences{intervals.x}, sums + c, offset);
      }
    });
  });
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

const SignalKernels CIRCLEPOINT_KERNELS(signal_kernels){filter_rows<DirectForm>, filter_rows<ShortForm>, trapezoids, parabolas,
                                                        correlate};

}  // namespace circlepoint::detail
