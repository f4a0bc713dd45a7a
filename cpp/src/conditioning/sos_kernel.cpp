#include "sos_kernel.hpp"

#include <algorithm>
#include <cstring>

namespace circlepoint::detail {
namespace {

using std::ptrdiff_t;
using std::size_t;

constexpr size_t width = 2;  // doubles in a vector of the baseline instruction set
using Vector = double __attribute__((vector_size(width * sizeof(double))));
constexpr ptrdiff_t block_values = 2048;  // values that go through all sections while in the first-level cache

template <size_t Lanes>
struct Pack {
  static constexpr size_t count = (Lanes + width - 1) / width;
  Vector part[count];

  void load(const double* from) {
    for (size_t p = 0; p < count; ++p) {
      if (Lanes >= (p + 1) * width) {
        std::memcpy(&part[p], from + p * width, sizeof(Vector));
      } else {
        part[p] = Vector{from[p * width], 0.0};
      }
    }
  }
  void store(double* to) const {
    for (size_t p = 0; p < count; ++p) {
      if (Lanes >= (p + 1) * width) {
        std::memcpy(to + p * width, &part[p], sizeof(Vector));
      } else {
        to[p * width] = part[p][0];
      }
    }
  }
};

template <size_t Lanes, size_t Sections>
void run(const Section* sections, double* state, ptrdiff_t state_step, ConstRows in, Rows out, ptrdiff_t rows) {
  using Values = Pack<Lanes>;
  const auto state_row = [&](size_t i) { return state + static_cast<ptrdiff_t>(i) * state_step; };
  Vector b0[Sections], b1[Sections], b2[Sections], a1[Sections], a2[Sections];
  Values s0[Sections], s1[Sections];
  for (size_t s = 0; s < Sections; ++s) {
    b0[s] = Vector{sections[s].b0, sections[s].b0};
    b1[s] = Vector{sections[s].b1, sections[s].b1};
    b2[s] = Vector{sections[s].b2, sections[s].b2};
    a1[s] = Vector{sections[s].a1, sections[s].a1};
    a2[s] = Vector{sections[s].a2, sections[s].a2};
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
        const Vector y = b0[s] * x.part[p] + s0[s].part[p];
        s0[s].part[p] = b1[s] * x.part[p] - a1[s] * y + s1[s].part[p];
        s1[s].part[p] = b2[s] * x.part[p] - a2[s] * y;
        x.part[p] = y;
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
template <size_t Lanes>
void run_all(const Section* sections, ptrdiff_t section_count, double* state, ptrdiff_t state_step, ConstRows in,
             Rows out, ptrdiff_t rows) {
  constexpr ptrdiff_t at_once = Lanes <= width ? 4 : 2;
  for (ptrdiff_t s = 0; s < section_count;) {
    const ptrdiff_t left = section_count - s;
    const Section* first = sections + s;
    double* first_state = state + 2 * s * state_step;
    if (at_once == 4 && left >= 4) {
      run<Lanes, 4>(first, first_state, state_step, in, out, rows);
      s += 4;
    } else if (at_once == 4 && left == 3) {
      run<Lanes, 3>(first, first_state, state_step, in, out, rows);
      s += 3;
    } else if (left >= 2) {
      run<Lanes, 2>(first, first_state, state_step, in, out, rows);
      s += 2;
    } else {
      run<Lanes, 1>(first, first_state, state_step, in, out, rows);
      s += 1;
    }
    in = {out.first, out.step};
  }
}

}  // namespace

void filter_rows(const Section* sections, ptrdiff_t section_count, double* state, ConstRows in, Rows out,
                 ptrdiff_t rows, ptrdiff_t channels) {
  const ptrdiff_t block = std::max<ptrdiff_t>(block_values / std::max<ptrdiff_t>(channels, 1), 32);
  for (ptrdiff_t begin = 0; begin < rows; begin += block) {
    const ptrdiff_t size = std::min(block, rows - begin);
    for (ptrdiff_t c = 0; c < channels;) {
      const ptrdiff_t left = channels - c;
      const ConstRows from{in.first + begin * in.step + c, in.step};
      const Rows to{out.first + begin * out.step + c, out.step};
      double* lane_state = state + c;
      if (left >= 4) {
        run_all<4>(sections, section_count, lane_state, channels, from, to, size);
      } else if (left == 3) {
        run_all<3>(sections, section_count, lane_state, channels, from, to, size);
      } else if (left == 2) {
        run_all<2>(sections, section_count, lane_state, channels, from, to, size);
      } else {
        run_all<1>(sections, section_count, lane_state, channels, from, to, size);
      }
      c += std::min<ptrdiff_t>(left, 4);
    }
  }
}

}  // namespace circlepoint::detail
