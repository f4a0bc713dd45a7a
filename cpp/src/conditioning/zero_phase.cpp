#include "zero_phase.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace circlepoint::detail {
namespace {

constexpr Index smallest_block = 4096;  // rows filtered forwards, then backwards, while in the cache

// Whether sections may be scaled to b0 = 1 without their other coefficients losing digits to it.
bool can_be_monic(const std::vector<Section>& sections) {
  return std::all_of(sections.begin(), sections.end(), [](const Section& s) {
    return std::abs(s.b0) > 1e-3 * std::max(std::abs(s.b1), std::abs(s.b2));
  });
}

ConstRows reading(const Rows& rows) { return {rows.first, rows.step}; }

// The state a row of the signal finds, forwards: rows of x have room, but for the last one.
class Forwards {
 public:
  Forwards(const Cascade& cascade, Scratch& scratch, const Eigen::Ref<const SamplesX>& x)
      : cascade_(cascade), x_(x), last_(scratch, 1, x.cols()) {
    last_.row(0) = x.row(x.rows() - 1);
    last_.clear_room();
  }

  void operator()(SamplesX& state, Index begin, Index end, Rows out) const {
    const Index roomy = std::min(end, x_.rows() - 1);
    cascade_.filter({{state.data(), from(begin), out, out}}, roomy - begin, x_.cols(), true);
    if (end > roomy) {
      const Rows last_out{out.first + (roomy - begin) * out.step, out.step};
      cascade_.filter({{state.data(), reading(last_.from(0)), last_out, last_out}}, 1, x_.cols(), true);
    }
  }

  // Rows [a, a + rows) and [b, b + rows), not the last of all.
  void operator()(SamplesX& state_a, Index a, Rows out_a, SamplesX& state_b, Index b, Rows out_b, Index rows) const {
    cascade_.filter({{state_a.data(), from(a), out_a, out_a}, {state_b.data(), from(b), out_b, out_b}}, rows, x_.cols(), true);
  }

 private:
  const Cascade& cascade_;
  const Eigen::Ref<const SamplesX>& x_;
  RoomySamples last_;

  [[nodiscard]] ConstRows from(Index row) const { return {x_.data() + row * x_.outerStride(), x_.outerStride()}; }
};

class ZeroPhase {
 public:
  ZeroPhase(const Cascade& cascade, Scratch& scratch, const RoomySamples& head, const Eigen::Ref<const SamplesX>& x,
            const RoomySamples& tail, SamplesX& y)
      : cascade_(cascade), scratch_(scratch), head_(head), x_(x), tail_(tail), y_(y), forwards_(cascade, scratch, x) {}

  void in_two_passes() {
    const Index n = x_.rows();
    RoomySamples filtered(scratch_, n, channels());
    SamplesX state = at_start();
    forwards_(state, 0, n, filtered.from(0));
    state = at_end(state, filtered.row(n - 1));
    cascade_.filter({backwards(state, filtered, n, 0)}, n, channels(), false);
  }

  // One pass over memory, through both halves of the signal side by side: while the cache holds them, blocks are filtered
  // forwards and the block before backwards. The second half, and backwards every block, starts from where `memory` rows before
  // it lead from any state. False where the forward pass met what does not decay (NaN, infinity): y is then not the result.
  [[nodiscard]] bool in_one_pass(Index memory) {
    const Index half = x_.rows() / 2;  // rows of each stream; an odd one over is the last block's
    const Index blocks = std::max<Index>(1, half / std::max(smallest_block, 8 * memory));
    const Index block = half / blocks;
    const auto rows_of = [&](Index k) { return k + 1 < blocks ? block : half - k * block; };
    const Index most = rows_of(blocks - 1) + 1;
    Stream a(scratch_, most, channels(), blocks > 1), b(scratch_, most, channels(), blocks > 1);
    RoomySamples spare_a(scratch_, memory, channels()), spare_b(scratch_, memory, channels());
    a.forward = at_start();
    b.forward = cascade_.steady_state(x_.row(half - memory));
    forwards_(b.forward, half - memory, half, spare_b.from(0));
    for (Index k = 0; k < blocks; ++k) {
      const Index begin = k * block;
      const bool last = k + 1 == blocks;
      const Index rows = last ? rows_of(k) - 1 : block;  // the last row of all has no room
      forwards_(a.forward, begin, a.current.from(0), b.forward, half + begin, b.current.from(0), rows);
      if (last) {
        forwards_(a.forward, begin + rows, half, a.current.from(rows));
        forwards_(b.forward, half + begin + rows, x_.rows(), b.current.from(rows));
      }
      if (k > 0) {
        SamplesX state_a = cascade_.steady_state(a.current.row(memory - 1));
        SamplesX state_b = cascade_.steady_state(b.current.row(memory - 1));
        cascade_.filter({discarding(state_a, a.current, memory, spare_a), discarding(state_b, b.current, memory, spare_b)}, memory,
                        channels(), true);
        cascade_.filter({backwards(state_a, a.previous, block, begin - block),
                         backwards(state_b, b.previous, block, half + begin - block)},
                        block, channels(), false);
      }
      std::swap(a.current, a.previous);
      std::swap(b.current, b.previous);
    }
    const Index begin = (blocks - 1) * block;
    const Index rows_a = half - begin;
    const Index rows_b = x_.rows() - half - begin;
    forwards_(a.forward, half, half + memory, spare_a.from(0));
    if (!a.forward.allFinite() || !b.forward.allFinite()) {
      return false;
    }
    SamplesX state_a = cascade_.steady_state(spare_a.row(memory - 1));
    cascade_.filter({discarding(state_a, spare_a, memory, spare_a)}, memory, channels(), true);
    SamplesX state_b = at_end(b.forward, b.previous.row(rows_b - 1));
    if (rows_b > rows_a) {
      cascade_.filter({backwards(state_b, b.previous, rows_b, half + begin)}, 1, channels(), false);
    }
    cascade_.filter({backwards(state_a, a.previous, rows_a, begin), backwards(state_b, b.previous, rows_a, half + begin)}, rows_a,
                    channels(), false);
    return true;
  }

 private:
  struct Stream {
    RoomySamples current, previous;
    SamplesX forward;
    Stream(Scratch& scratch, Index rows, Index channels, bool alternate)
        : current(scratch, rows, channels), previous(scratch, alternate ? rows : 0, channels) {}
  };

  const Cascade& cascade_;
  Scratch& scratch_;
  const RoomySamples& head_;
  const Eigen::Ref<const SamplesX>& x_;
  const RoomySamples& tail_;
  SamplesX& y_;
  Forwards forwards_;

  [[nodiscard]] Index channels() const { return x_.cols(); }

  // The state in which the first row of the signal finds the cascade. What the backward pass would make of the extension
  // before the signal is cut off again.
  [[nodiscard]] SamplesX at_start() const {
    SamplesX state = head_.rows() > 0 ? cascade_.steady_state(head_.row(0)) : cascade_.steady_state(x_.row(0));
    RoomySamples filtered(scratch_, head_.rows(), channels());
    cascade_.filter({{state.data(), reading(head_.from(0)), filtered.from(0), filtered.from(0)}}, head_.rows(), channels(), true);
    return state;
  }

  // The state in which the last row finds the cascade running backwards; `state` is left by the forward pass, which gave
  // `last`.
  [[nodiscard]] SamplesX at_end(SamplesX state, const Eigen::Ref<const Eigen::RowVectorXd>& last) const {
    const Index n = tail_.rows();
    if (n == 0) {
      return cascade_.steady_state(last);
    }
    RoomySamples filtered(scratch_, n, channels());
    cascade_.filter({{state.data(), reading(tail_.from(0)), filtered.from(0), filtered.from(0)}}, n, channels(), true);
    state = cascade_.steady_state(filtered.row(n - 1));
    cascade_.filter({discarding(state, filtered, n, filtered)}, n, channels(), true);
    return state;
  }

  // From row `count` of `filtered` backwards to the rows of y that end before begin + count.
  FilterRun backwards(SamplesX& state, RoomySamples& filtered, Index count, Index begin) const {
    const Rows in = filtered.back_from(count);
    return {state.data(), reading(in), in, {y_.data() + (begin + count - 1) * y_.cols(), -y_.cols()}};
  }

  // From row `count` of `filtered` backwards, for the sake of the state.
  static FilterRun discarding(SamplesX& state, RoomySamples& filtered, Index count, RoomySamples& into) {
    const Rows in = filtered.back_from(count);
    const Rows out = into.back_from(count);
    return {state.data(), reading(in), out, out};
  }
};

}  // namespace

Cascade::Cascade(std::vector<Section> sections, const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& steady)
    : sections_(std::move(sections)), steady_(steady), monic_(can_be_monic(sections_)) {
  if (!monic_) {
    return;
  }
  // Section i finds its input undivided by the gains of those after it: its state scales with theirs.
  double gain = 1.0;
  for (std::size_t i = sections_.size(); i-- > 0;) {
    Section& s = sections_[i];
    const double b0 = std::exchange(s.b0, 1.0);
    s.b1 /= b0;
    s.b2 /= b0;
    steady_.row(static_cast<Index>(i)) *= gain;
    gain *= b0;
  }
  sections_.front().b0 = gain;
}

SamplesX Cascade::steady_state(const Eigen::Ref<const Eigen::RowVectorXd>& start) const {
  SamplesX state(2 * steady_.rows(), start.size());
  for (Index i = 0; i < steady_.rows(); ++i) {
    state.row(2 * i) = steady_(i, 0) * start;
    state.row(2 * i + 1) = steady_(i, 1) * start;
  }
  return state;
}

void Cascade::filter(std::initializer_list<FilterRun> runs, Index rows, Index channels, bool room) const {
  const auto sections = static_cast<Index>(sections_.size());
  if (monic_) {
    const auto kernel = room ? kernels_.monic_to_room : kernels_.monic;
    kernel(sections_.data(), sections, runs.begin(), static_cast<Index>(runs.size()), rows, channels);
    return;
  }
  for (const FilterRun& run : runs) {
    kernels_.direct(sections_.data(), sections, run, rows, channels);
  }
}

std::optional<Index> Cascade::memory() const {
  double radius = 0.0;
  for (const Section& s : sections_) {
    const double discriminant = s.a1 * s.a1 - 4.0 * s.a2;
    radius = std::max(radius, discriminant < 0.0 ? std::sqrt(s.a2) : 0.5 * (std::abs(s.a1) + std::sqrt(discriminant)));
  }
  const double decay = -std::log(std::max(radius, 1e-3));
  const double rows = 16.0 + 1.5 * std::log(1e18) / decay;
  return decay > 0.0 && rows < 1e5 ? std::optional(static_cast<Index>(rows)) : std::nullopt;
}

void filter_zero_phase(const Cascade& cascade, Scratch& scratch, const RoomySamples& head, const Eigen::Ref<const SamplesX>& x,
                       const RoomySamples& tail, SamplesX& y) {
  ZeroPhase filter(cascade, scratch, head, x, tail, y);
  const std::optional<Index> memory = cascade.memory();
  // What beginning in the middle costs is won back at once where one register holds all channels, and on long signals otherwise.
  const Index fewest = x.cols() <= row_room ? 6 : 50;
  if (!memory || x.rows() < fewest * *memory || !filter.in_one_pass(*memory)) {
    filter.in_two_passes();
  }
}

}  // namespace circlepoint::detail
