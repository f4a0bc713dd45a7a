#include "joint_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace circlepoint {
namespace {

bool others_agree(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Index joint, const Eigen::VectorXd& tolerance) {
  for (Index other = 0; other < a.size(); ++other) {
    if (other != joint && std::abs(a[other] - b[other]) > tolerance[other]) {
      return false;
    }
  }
  return true;
}

/// How far the others strayed between a test's dwells, in radians of the thresholds.
double others_range(const JointTest& test, const std::vector<StaticDwell>& dwells, const Eigen::VectorXd& units) {
  double range = 0.0;
  for (Index other = 0; other < test.configuration.size(); ++other) {
    if (other == test.joint) {
      continue;
    }
    const auto [low, high] = std::minmax_element(test.dwells.begin(), test.dwells.end(), [&](Index a, Index b) {
      return dwells[static_cast<std::size_t>(a)].joint_positions[other] <
             dwells[static_cast<std::size_t>(b)].joint_positions[other];
    });
    range = std::max(range, (dwells[static_cast<std::size_t>(*high)].joint_positions[other] -
                             dwells[static_cast<std::size_t>(*low)].joint_positions[other]) /
                                units[other]);
  }
  return range;
}

/// Fills in what follows from a test's members.
void summarise(JointTest& test, const std::vector<StaticDwell>& dwells, const std::vector<SingleJointMotion>& motions) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(test.configuration.size());
  double low = 0.0;
  double high = 0.0;
  for (std::size_t k = 0; k < test.dwells.size(); ++k) {
    const Eigen::VectorXd& positions = dwells[static_cast<std::size_t>(test.dwells[k])].joint_positions;
    sum += positions;
    low = k == 0 ? positions[test.joint] : std::min(low, positions[test.joint]);
    high = k == 0 ? positions[test.joint] : std::max(high, positions[test.joint]);
  }
  for (const Index k : test.motions) {
    sum += motions[static_cast<std::size_t>(k)].joint_positions;
    test.motion_span = std::max(test.motion_span, motions[static_cast<std::size_t>(k)].travel);
  }
  test.configuration = sum / static_cast<double>(test.dwells.size() + test.motions.size());
  test.dwell_span = high - low;
}

std::vector<JointTest> tests_of(Index joint, const std::vector<StaticDwell>& dwells,
                                const std::vector<SingleJointMotion>& motions,
                                const Eigen::VectorXd& units, const SegmentationOptions& options) {
  const Eigen::VectorXd tolerance = options.configuration_tolerance * units;
  const double shortest = std::max(tolerance[joint], options.min_travel * units[joint]);
  std::vector<JointTest> tests;
  const auto matching = [&](const Eigen::VectorXd& positions) {
    return std::find_if(tests.begin(), tests.end(), [&](const JointTest& test) {
      return others_agree(test.configuration, positions, joint, tolerance);
    });
  };
  const auto found = [&](const Eigen::VectorXd& positions) -> JointTest& {
    const auto test = matching(positions);
    if (test != tests.end()) {
      return *test;
    }
    JointTest fresh;
    fresh.joint = joint;
    fresh.configuration = positions;
    tests.push_back(fresh);
    return tests.back();
  };
  // The longest motion names the configuration: it is the one the test stands on.
  std::vector<std::size_t> order(motions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return motions[a].travel > motions[b].travel; });
  for (const std::size_t k : order) {
    if (motions[k].joint == joint) {
      found(motions[k].joint_positions).motions.push_back(static_cast<Index>(k));
    }
  }
  for (std::size_t k = 0; k < dwells.size(); ++k) {
    found(dwells[k].joint_positions).dwells.push_back(static_cast<Index>(k));
  }
  for (JointTest& test : tests) {
    std::sort(test.motions.begin(), test.motions.end());
    summarise(test, dwells, motions);
  }
  std::erase_if(tests, [&](const JointTest& test) {
    return test.motions.empty() && (test.dwell_span < shortest ||
                                    others_range(test, dwells, units) >
                                        options.others_ratio * test.dwell_span / units[joint]);
  });
  std::stable_sort(tests.begin(), tests.end(), [](const JointTest& a, const JointTest& b) {
    return std::max(a.dwell_span, a.motion_span) > std::max(b.dwell_span, b.motion_span);
  });
  return tests;
}

}  // namespace

std::vector<JointTest> joint_tests(const std::vector<StaticDwell>& dwells,
                                   const std::vector<SingleJointMotion>& motions, Index joints,
                                   const SegmentationOptions& options) {
  const Eigen::VectorXd units = threshold_units(options, joints);
  std::vector<JointTest> tests;
  for (Index joint = 0; joint < joints; ++joint) {
    const auto of_joint = tests_of(joint, dwells, motions, units, options);
    tests.insert(tests.end(), of_joint.begin(), of_joint.end());
  }
  return tests;
}

}  // namespace circlepoint
