#include "circlepoint/conditioning/sosfilt.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"
#include "signal_kernels.hpp"

namespace circlepoint {
namespace {

constexpr Index smallest_block = 4096;  // rows filtered forwards and backwards while in the cache

using SectionStates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

std::vector<detail::Section> checked_sections(const Eigen::Ref<const SecondOrderSections>& sos) {
  require(sos.rows() > 0, "sos has no sections; give at least one row b0, b1, b2, 1, a1, a2");
  std::vector<detail::Section> sections;
  for (Index i = 0; i < sos.rows(); ++i) {
    require(sos(i, 3) == 1.0, "sos row " + std::to_string(i) + " has a0 = " + std::to_string(sos(i, 3)) +
                                  "; divide the row by a0 so that it is 1");
    sections.push_back({sos(i, 0), sos(i, 1), sos(i, 2), sos(i, 4), sos(i, 5)});
  }
  return sections;
}

Index default_padlen(const Eigen::Ref<const SecondOrderSections>& sos) {
  const Index without = std::min((sos.col(2).array() == 0.0).count(), (sos.col(5).array() == 0.0).count());
  return 3 * (2 * sos.rows() + 1 - without);
}

// `edge` rows that continue x before its first row (or, with x reversed, after its last), in order of time.
SamplesX extension(const Eigen::Ref<const SamplesX>& x, PadType padtype, Index edge, bool at_end) {
  SamplesX rows(edge, x.cols());
  const auto end_value = x.row(at_end ? x.rows() - 1 : 0);
  for (Index i = 0; i < edge; ++i) {
    const auto mirrored = x.row(at_end ? x.rows() - 2 - i : edge - i);
    if (padtype == PadType::odd) {
      rows.row(i) = 2.0 * end_value - mirrored;
    } else if (padtype == PadType::even) {
      rows.row(i) = mirrored;
    } else {
      rows.row(i) = end_value;
    }
  }
  return rows;
}

// The state of every section and channel, steady for `start`.
SamplesX steady_state(const SectionStates& zi, const Eigen::Ref<const Eigen::RowVectorXd>& start) {
  SamplesX state(2 * zi.rows(), start.size());
  for (Index i = 0; i < zi.rows(); ++i) {
    state.row(2 * i) = zi(i, 0) * start;
    state.row(2 * i + 1) = zi(i, 1) * start;
  }
  return state;
}

// One direction of the zero-phase filter over rows anywhere in memory.
class Cascade {
 public:
  explicit Cascade(const Eigen::Ref<const SecondOrderSections>& sos) : sections_(checked_sections(sos)) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(sections_.size()); }

  void forwards(SamplesX& state, const Eigen::Ref<const SamplesX>& in, Eigen::Ref<SamplesX> out) const {
    kernels_.filter_rows_short(sections_.data(), size(), state.data(), {in.data(), in.outerStride()},
                               {out.data(), out.outerStride()}, in.rows(), in.cols());
  }

  void backwards(SamplesX& state, const Eigen::Ref<const SamplesX>& in, Eigen::Ref<SamplesX> out) const {
    if (in.rows() > 0) {
      kernels_.filter_rows_short(sections_.data(), size(), state.data(),
                                 {in.data() + (in.rows() - 1) * in.outerStride(), -in.outerStride()},
                                 {out.data() + (out.rows() - 1) * out.outerStride(), -out.outerStride()}, in.rows(), in.cols());
    }
  }

  // Rows after which any state has decayed below 1e-18 of itself, with half as much again for poles that coincide;
  // nothing for a cascade that does not decay.
  [[nodiscard]] std::optional<Index> memory() const {
    double radius = 0.0;
    for (const detail::Section& s : sections_) {
      const double discriminant = s.a1 * s.a1 - 4.0 * s.a2;
      radius = std::max(radius, discriminant < 0.0 ? std::sqrt(s.a2) : 0.5 * (std::abs(s.a1) + std::sqrt(discriminant)));
    }
    const double decay = -std::log(std::max(radius, 1e-3));
    const double rows = 16.0 + 1.5 * std::log(1e18) / decay;
    return decay > 0.0 && rows < 1e5 ? std::optional(static_cast<Index>(rows)) : std::nullopt;
  }

 private:
  std::vector<detail::Section> sections_;
  const detail::SignalKernels& kernels_ = detail::signal_kernels();
};

// Zero-phase filtering of a signal between its extensions.
struct ZeroPhase {
  const Cascade& cascade;
  const SectionStates zi;
  const SamplesX head, tail;  // the extensions before and after

  // The state in which the first row of the signal finds the cascade. What the backward pass would make of the extension
  // before the signal is cut off again.
  [[nodiscard]] SamplesX at_start(const Eigen::Ref<const SamplesX>& x) const {
    SamplesX state = head.rows() > 0 ? steady_state(zi, head.row(0)) : steady_state(zi, x.row(0));
    SamplesX filtered(head.rows(), head.cols());
    cascade.forwards(state, head, filtered);
    return state;
  }

  // The state in which the last row finds the cascade running backwards; `state` is left by the forward pass, which gave
  // `last`.
  [[nodiscard]] SamplesX at_end(SamplesX state, const Eigen::Ref<const Eigen::RowVectorXd>& last) const {
    SamplesX filtered(tail.rows(), tail.cols());
    cascade.forwards(state, tail, filtered);
    state = filtered.rows() > 0 ? steady_state(zi, filtered.row(filtered.rows() - 1)) : steady_state(zi, last);
    cascade.backwards(state, filtered, filtered);
    return state;
  }

  void in_two_passes(const Eigen::Ref<const SamplesX>& x, SamplesX& y) const {
    SamplesX state = at_start(x);
    cascade.forwards(state, x, y);
    state = at_end(state, y.row(y.rows() - 1));
    cascade.backwards(state, y, y);
  }

  // One pass over memory: while the cache holds them, blocks are filtered forwards and the block before backwards. Backwards
  // a block starts from where the first `memory` rows of the next one lead from any state.
  // False where the forward pass met what does not decay (NaN, infinity): y is then not the result.
  [[nodiscard]] bool in_one_pass(const Eigen::Ref<const SamplesX>& x, SamplesX& y, Index memory, Index block) const {
    const Index n = x.rows();
    const Index blocks = n / block;  // the last one takes what is left over
    SamplesX forward = at_start(x);
    SamplesX current(2 * block, x.cols()), previous(2 * block, x.cols()), discarded(memory, x.cols());
    const auto rows_of = [&](Index k) { return k + 1 < blocks ? block : n - k * block; };
    for (Index k = 0; k < blocks; ++k) {
      cascade.forwards(forward, x.middleRows(k * block, rows_of(k)), current.topRows(rows_of(k)));
      if (k > 0) {
        SamplesX backward = steady_state(zi, current.row(memory - 1));
        cascade.backwards(backward, current.topRows(memory), discarded);
        cascade.backwards(backward, previous.topRows(block), y.middleRows((k - 1) * block, block));
      }
      current.swap(previous);
    }
    if (!forward.allFinite()) {
      return false;
    }
    const Index last = rows_of(blocks - 1);
    SamplesX backward = at_end(forward, previous.row(last - 1));
    cascade.backwards(backward, previous.topRows(last), y.bottomRows(last));
    return true;
  }
};

}  // namespace

SamplesX sosfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x) {
  const std::vector<detail::Section> sections = checked_sections(sos);
  SamplesX state = SamplesX::Zero(2 * sos.rows(), x.cols());
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  detail::signal_kernels().filter_rows(sections.data(), sos.rows(), state.data(), {x.data(), x.outerStride()},
                                       {y.data(), y.cols()}, x.rows(), x.cols());
  return y;
}

SectionStates sosfilt_zi(const Eigen::Ref<const SecondOrderSections>& sos) {
  const std::vector<detail::Section> sections = checked_sections(sos);
  SectionStates zi(sos.rows(), 2);
  double scale = 1.0;
  for (Index i = 0; i < zi.rows(); ++i) {
    const detail::Section& s = sections[static_cast<std::size_t>(i)];
    const double denominator = 1.0 + s.a1 + s.a2;
    require(denominator != 0.0, "sos row " + std::to_string(i) +
                                    " has a pole at z = 1 and no steady state; it cannot be started from one");
    const double drive1 = s.b1 - s.a1 * s.b0;
    const double drive2 = s.b2 - s.a2 * s.b0;
    const double first = (drive1 + drive2) / denominator;
    zi.row(i) << scale * first, scale * ((1.0 + s.a1) * first - drive1);
    scale *= (s.b0 + s.b1 + s.b2) / denominator;
  }
  return zi;
}

SamplesX sosfiltfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x,
                     PadType padtype, std::optional<Index> padlen) {
  const Cascade cascade(sos);
  const Index edge = padtype == PadType::none ? 0 : padlen.value_or(default_padlen(sos));
  require(edge >= 0, "padlen is " + std::to_string(edge) + "; give a number of samples, zero or more");
  require(x.rows() > edge, "the signal has " + std::to_string(x.rows()) + " samples, the extension at each end " +
                               std::to_string(edge) + "; give a longer signal or a smaller padlen");
  const ZeroPhase filter{cascade, sosfilt_zi(sos), extension(x, padtype, edge, false), extension(x, padtype, edge, true)};
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  const std::optional<Index> memory = cascade.memory();
  const Index block = std::max(smallest_block, 8 * memory.value_or(0));
  if (!memory || x.rows() < 8 * block || !filter.in_one_pass(x, y, *memory, block)) {
    filter.in_two_passes(x, y);
  }
  return y;
}

}  // namespace circlepoint
