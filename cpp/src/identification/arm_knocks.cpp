#include "arm_knocks.hpp"

#include <algorithm>
#include <numeric>

namespace circlepoint {

namespace {

constexpr double knock = 6.0;          // standard deviations
constexpr double model_failure = 0.2;  // share of rows beyond which knocks are none

}  // namespace

Index cut_knocks(ArmRows& rows, const StretchResiduals& whitened_residuals, const Eigen::MatrixXd& dwells_normalized) {
  constexpr Index margin = 4;
  constexpr Index shortest = 5;
  std::vector<MovingStretch> kept;
  Index removed = 0;
  Index total = 0;
  for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
    const MovingStretch& stretch = rows.stretches[i];
    const Eigen::MatrixXd& whitened = whitened_residuals[i];
    std::vector<bool> bad(static_cast<std::size_t>(stretch.rows()), false);
    for (Index row = 0; row < stretch.rows(); ++row) {
      if (whitened.row(row).cwiseAbs().maxCoeff() > knock) {
        for (Index k = std::max<Index>(0, row - margin); k < std::min(stretch.rows(), row + margin + 1); ++k) {
          bad[static_cast<std::size_t>(k)] = true;
        }
      }
    }
    total += stretch.rows();
    Index begin = 0;
    for (Index row = 0; row <= stretch.rows(); ++row) {
      const bool ends = row == stretch.rows() || bad[static_cast<std::size_t>(row)];
      if (!ends) {
        continue;
      }
      if (row - begin >= shortest) {
        std::vector<Index> good(static_cast<std::size_t>(row - begin));
        std::iota(good.begin(), good.end(), begin);
        kept.push_back(picked(stretch, good));
      } else {
        removed += row - begin;
      }
      removed += row < stretch.rows() ? 1 : 0;
      begin = row + 1;
    }
  }
  if (static_cast<double>(removed) > model_failure * static_cast<double>(total)) {
    return 0;
  }
  rows.stretches = std::move(kept);
  std::vector<DwellRow> dwells;
  for (std::size_t i = 0; i < rows.dwells.size(); ++i) {
    if (dwells_normalized.row(static_cast<Index>(i)).cwiseAbs().maxCoeff() <= knock) {
      dwells.push_back(rows.dwells[i]);
    }
  }
  const auto dropped = static_cast<Index>(rows.dwells.size() - dwells.size());
  if (static_cast<double>(dropped) <= model_failure * static_cast<double>(rows.dwells.size())) {
    rows.dwells = std::move(dwells);
    removed += dropped;
  }
  return removed;
}

}  // namespace circlepoint
