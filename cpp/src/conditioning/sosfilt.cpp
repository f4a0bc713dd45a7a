#include "circlepoint/conditioning/sosfilt.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"
#include "zero_phase.hpp"

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
detail::RoomySamples extension(detail::Scratch& scratch, const Eigen::Ref<const SamplesX>& x, PadType padtype, Index edge,
                               bool at_end) {
  detail::RoomySamples rows(scratch, edge, x.cols());
  rows.clear_room();
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

}  // namespace

SamplesX sosfilt(const Eigen::Ref<const SecondOrderSections>& sos, const Eigen::Ref<const SamplesX>& x) {
  const std::vector<detail::Section> sections = checked_sections(sos);
  SamplesX state = SamplesX::Zero(2 * sos.rows(), x.cols());
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  const detail::Rows out{y.data(), y.cols()};
  detail::filter_kernels().direct(sections.data(), sos.rows(), {state.data(), {x.data(), x.outerStride()}, out, out}, x.rows(),
                                  x.cols());
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
  const detail::Cascade cascade(checked_sections(sos), sosfilt_zi(sos));
  const Index edge = padtype == PadType::none ? 0 : padlen.value_or(default_padlen(sos));
  require(edge >= 0, "padlen is " + std::to_string(edge) + "; give a number of samples, zero or more");
  require(x.rows() > edge, "the signal has " + std::to_string(x.rows()) + " samples, the extension at each end " +
                               std::to_string(edge) + "; give a longer signal or a smaller padlen");
  SamplesX y = detail::unwritten_samples(x.rows(), x.cols());
  const detail::ClearedAhead ahead(y, 2);
  detail::Scratch scratch;
  const detail::RoomySamples head = extension(scratch, x, padtype, edge, false);
  const detail::RoomySamples tail = extension(scratch, x, padtype, edge, true);
  detail::filter_zero_phase(cascade, scratch, head, x, tail, y);
  return y;
}

}  // namespace circlepoint
