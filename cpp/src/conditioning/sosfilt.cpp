#include "circlepoint/conditioning/sosfilt.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"
#include "sos_kernel.hpp"

namespace circlepoint {
namespace {

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

class Cascade {
 public:
  explicit Cascade(const Eigen::Ref<const SecondOrderSections>& sos) : sections_(checked_sections(sos)) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(sections_.size()); }

  void forwards(SamplesX& state, const Eigen::Ref<const SamplesX>& in, SamplesX& out) const {
    detail::filter_rows(sections_.data(), size(), state.data(), {in.data(), in.outerStride()},
                        {out.data(), out.cols()}, out.rows(), out.cols());
  }

  void backwards(SamplesX& state, SamplesX& rows) const {
    const Index channels = rows.cols();
    if (rows.rows() > 0) {
      double* last = rows.data() + (rows.rows() - 1) * channels;
      detail::filter_rows(sections_.data(), size(), state.data(), {last, -channels}, {last, -channels}, rows.rows(),
                          channels);
    }
  }

 private:
  std::vector<detail::Section> sections_;
};

}  // namespace

SamplesX sosfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x) {
  const Cascade cascade(sos);
  SamplesX state = SamplesX::Zero(2 * cascade.size(), x.cols());
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  cascade.forwards(state, x, y);
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
  const SectionStates zi = sosfilt_zi(sos);

  // The extension before the signal only sets the state: what the backward pass would make of it is cut off again.
  SamplesX head = extension(x, padtype, edge, false);
  SamplesX tail = extension(x, padtype, edge, true);
  SamplesX state = edge > 0 ? steady_state(zi, head.row(0)) : steady_state(zi, x.row(0));
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  cascade.forwards(state, head, head);
  cascade.forwards(state, x, y);
  cascade.forwards(state, tail, tail);
  state = edge > 0 ? steady_state(zi, tail.row(edge - 1)) : steady_state(zi, y.row(y.rows() - 1));
  cascade.backwards(state, tail);
  cascade.backwards(state, y);
  return y;
}

}  // namespace circlepoint
