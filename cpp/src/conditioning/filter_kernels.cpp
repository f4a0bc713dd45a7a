// Compiled once for each instruction set, as CIRCLEPOINT_KERNELS(filter_kernels) = filter_kernels_<path>.
#include "filter_kernels.hpp"

#include "../core/vector_pack.hpp"

namespace circlepoint::detail {
namespace {

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
  inline __attribute__((always_inline)) void enter(Vector&) const {}
  inline __attribute__((always_inline)) void step(size_t s, Vector& x, Vector& s0, Vector& s1) const {
    const Vector y = b0[s] * x + s0;
    s0 = b1[s] * x - a1[s] * y + s1;
    s1 = b2[s] * x - a2[s] * y;
    x = y;
  }
};

// With the answer eliminated from the recursion, and one multiplication for the gain of all sections.
template <typename Values, size_t Sections>
struct MonicForm {
  using Vector = typename Values::Vector;
  Vector gain, c1[Sections], c2[Sections], a1[Sections], a2[Sections];

  inline __attribute__((always_inline)) void set(size_t s, const Section& section) {
    if (s == 0) {
      gain = section.b0 - Vector{};
    }
    c1[s] = (section.b1 - section.a1) - Vector{};
    c2[s] = (section.b2 - section.a2) - Vector{};
    a1[s] = section.a1 - Vector{};
    a2[s] = section.a2 - Vector{};
  }
  inline __attribute__((always_inline)) void enter(Vector& x) const { x *= gain; }
  inline __attribute__((always_inline)) void step(size_t s, Vector& x, Vector& s0, Vector& s1) const {
    const Vector y = x + s0;
    const Vector next = (c1[s] * x + s1) - a1[s] * s0;
    s1 = c2[s] * x - a2[s] * s0;
    s0 = next;
    x = y;
  }
};

// The form of the sections and the room of the rows.
template <template <typename, size_t> class FormOf, bool RoomIn, bool RoomOut>
struct Recursion {
  template <typename Values, size_t Sections>
  using Form = FormOf<Values, Sections>;
  static constexpr bool room_in = RoomIn, room_out = RoomOut;
  using Between = Recursion<FormOf, RoomIn, RoomIn>;
};

template <typename Kind, size_t Lanes, size_t Sections, size_t Runs>
void run(const Section* sections, const FilterRun* runs, ptrdiff_t state_step, ptrdiff_t rows) {
  using Values = Pack<Lanes>;
  typename Kind::template Form<Values, Sections> form;
  FilterRun at[Runs];
  Values s0[Runs][Sections], s1[Runs][Sections];
  const auto state_row = [&](size_t r, size_t i) { return at[r].state + static_cast<ptrdiff_t>(i) * state_step; };
  for (size_t s = 0; s < Sections; ++s) {
    form.set(s, sections[s]);
  }
  for (size_t r = 0; r < Runs; ++r) {
    at[r] = runs[r];
    for (size_t s = 0; s < Sections; ++s) {
      s0[r][s].load(state_row(r, 2 * s));
      s1[r][s].load(state_row(r, 2 * s + 1));
    }
  }
  for (ptrdiff_t row = 0; row < rows; ++row) {
#pragma GCC unroll 2
    for (size_t r = 0; r < Runs; ++r) {
      Values x;
      load_row<Kind::room_in>(x, at[r].in.first + row * at[r].in.step);
#pragma GCC unroll 4
      for (size_t p = 0; p < Values::count; ++p) {
        form.enter(x.part[p]);
      }
#pragma GCC unroll 4
      for (size_t s = 0; s < Sections; ++s) {
#pragma GCC unroll 4
        for (size_t p = 0; p < Values::count; ++p) {
          form.step(s, x.part[p], s0[r][s].part[p], s1[r][s].part[p]);
        }
      }
      store_row<Kind::room_out>(x, at[r].out.first + row * at[r].out.step);
    }
  }
  for (size_t r = 0; r < Runs; ++r) {
    for (size_t s = 0; s < Sections; ++s) {
      s0[r][s].store(state_row(r, 2 * s));
      s1[r][s].store(state_row(r, 2 * s + 1));
    }
  }
}

// As many sections at once as keep their states in registers.
template <typename Kind, size_t Lanes, size_t Runs>
void run_all(const Section* sections, ptrdiff_t section_count, const FilterRun* given, ptrdiff_t state_step, ptrdiff_t rows) {
  constexpr ptrdiff_t at_once = Pack<Lanes>::count * Runs == 1 ? 4 : 2;
  FilterRun runs[Runs];
  for (size_t r = 0; r < Runs; ++r) {
    runs[r] = given[r];
  }
  ptrdiff_t s = 0;
  for (; section_count - s > at_once; s += at_once) {
    for (size_t r = 0; r < Runs; ++r) {
      runs[r].out = runs[r].work;
    }
    run<typename Kind::Between, Lanes, at_once, Runs>(sections + s, runs, state_step, rows);
    for (size_t r = 0; r < Runs; ++r) {
      runs[r].state += 2 * at_once * state_step;
      runs[r].in = {runs[r].work.first, runs[r].work.step};
    }
  }
  for (size_t r = 0; r < Runs; ++r) {
    runs[r].out = given[r].out;
  }
  const Section* last = sections + s;
  switch (section_count - s) {
    case 4: run<Kind, Lanes, at_once, Runs>(last, runs, state_step, rows); break;
    case 3: run<Kind, Lanes, at_once == 4 ? 3 : 2, Runs>(last, runs, state_step, rows); break;
    case 2: run<Kind, Lanes, 2, Runs>(last, runs, state_step, rows); break;
    default: run<Kind, Lanes, 1, Runs>(last, runs, state_step, rows); break;
  }
}

FilterRun from(const FilterRun& run, ptrdiff_t row, ptrdiff_t channel) {
  return {run.state + channel,
          {run.in.first + row * run.in.step + channel, run.in.step},
          {run.work.first + row * run.work.step + channel, run.work.step},
          {run.out.first + row * run.out.step + channel, run.out.step}};
}

template <typename Kind>
void filter(const Section* sections, ptrdiff_t section_count, const FilterRun* runs, ptrdiff_t run_count, ptrdiff_t rows,
            ptrdiff_t channels) {
  const ptrdiff_t block = cached_rows(channels);
  for (ptrdiff_t begin = 0; begin < rows; begin += block) {
    const ptrdiff_t size = block < rows - begin ? block : rows - begin;
    for_groups(channels, [&]<size_t Lanes>(ptrdiff_t c) {
      if constexpr (Pack<Lanes>::count == 1) {
        if (run_count == 2) {
          const FilterRun both[2] = {from(runs[0], begin, c), from(runs[1], begin, c)};
          run_all<Kind, Lanes, 2>(sections, section_count, both, channels, size);
          return;
        }
      }
      for (ptrdiff_t r = 0; r < run_count; ++r) {
        const FilterRun one = from(runs[r], begin, c);
        run_all<Kind, Lanes, 1>(sections, section_count, &one, channels, size);
      }
    });
  }
}

void direct(const Section* sections, ptrdiff_t section_count, const FilterRun& run, ptrdiff_t rows, ptrdiff_t channels) {
  filter<Recursion<DirectForm, false, false>>(sections, section_count, &run, 1, rows, channels);
}

}  // namespace

const FilterKernels CIRCLEPOINT_KERNELS(filter_kernels){direct, filter<Recursion<MonicForm, true, true>>,
                                                        filter<Recursion<MonicForm, true, false>>};

}  // namespace circlepoint::detail
