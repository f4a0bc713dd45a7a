#include "arm_kinds.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace circlepoint {
namespace {

constexpr Index shortest = 100;  // rows that pay for a noise model
constexpr double moves = 0.05;   // of a joint's travel in the recording, and
constexpr double still = 0.02;   // rad or m: joints at rest yield, and noise is no motion

struct Reach {
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

// Which rests a stretch lies between, by how many are before it.
Index run_of(const ArmRows& rows, const MovingStretch& stretch) {
  return std::count_if(rows.dwells.begin(), rows.dwells.end(), [&](const DwellRow& dwell) { return dwell.time < stretch.time[0]; });
}

// How far the joints go between each two rests, but for what one does alone.
std::map<Index, Reach> reach_of_runs(const ArmRows& rows) {
  std::map<Index, Reach> runs;
  for (const MovingStretch& stretch : rows.stretches) {
    if (stretch.joint >= 0) {
      continue;
    }
    const Eigen::VectorXd low = stretch.position.colwise().minCoeff().transpose();
    const Eigen::VectorXd high = stretch.position.colwise().maxCoeff().transpose();
    const auto [run, is_new] = runs.try_emplace(run_of(rows, stretch), Reach{low, high});
    if (!is_new) {
      run->second = {run->second.low.cwiseMin(low), run->second.high.cwiseMax(high)};
    }
  }
  return runs;
}

// Which joints move in each stretch's run, or alone.
std::vector<std::vector<bool>> joints_in_motion(const ArmRows& rows) {
  std::vector<std::vector<bool>> sets;
  if (rows.stretches.empty()) {
    return sets;
  }
  const Index joints = rows.stretches.front().position.cols();
  const Eigen::ArrayXd far = Eigen::ArrayXd::NullaryExpr(joints, [&](Index joint) { return std::max(still, moves * travel(rows, joint)); });
  std::map<Index, Reach> runs = reach_of_runs(rows);
  for (const MovingStretch& stretch : rows.stretches) {
    std::vector<bool>& set = sets.emplace_back(static_cast<std::size_t>(joints), false);
    if (stretch.joint >= 0) {
      set[static_cast<std::size_t>(stretch.joint)] = true;
      continue;
    }
    const Reach& reach = runs[run_of(rows, stretch)];
    for (Index joint = 0; joint < joints; ++joint) {
      set[static_cast<std::size_t>(joint)] = reach.high[joint] - reach.low[joint] > far[joint];
    }
  }
  return sets;
}

}  // namespace

void name_kinds(ArmRows& rows) {
  const std::vector<std::vector<bool>> sets = joints_in_motion(rows);
  std::map<std::vector<bool>, Index> lengths;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    lengths[sets[i]] += rows.stretches[i].rows();
  }
  std::map<std::vector<bool>, Index> kinds;  // the short ones' under no set
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::vector<bool> kind = lengths[sets[i]] < shortest ? std::vector<bool>() : sets[i];
    rows.stretches[i].noise = kinds.try_emplace(kind, static_cast<Index>(kinds.size())).first->second;
  }
}

}  // namespace circlepoint
