#pragma once
// Tests that begin and end at one home position, the functions their resting joints' motion is made of (arm_yield), and what the
// counts tell of these.

#include <Eigen/Core>
#include <vector>

#include "arm_rows.hpp"
#include "arm_smooth.hpp"

namespace circlepoint {

// One test's motion of its joint.
struct TestMotion {
  Index test = 0;
  Index joint = 0;
  std::vector<std::size_t> stretches;
  std::vector<std::size_t> dwells;   // its own, home excepted
  Eigen::RowVectorXd home;           // (functions) at home
  Eigen::MatrixXd combination;       // (functions, r): of unit rms and uncorrelated over the test
  Eigen::MatrixXd resolve;           // (r, functions): its inverse
  std::vector<Eigen::MatrixXd> phi;  // of every stretch, at its lead-in and each of its samples: raw, relative to home
  std::vector<Index> lead;           // samples of the lead-in
  double quiet = 0.0;                // counts rms that a joint at rest may deflect by, where none changes its count; else 0
};

// All tests that share one home position.
struct HomeGroup {
  Eigen::VectorXd home;  // (n)
  std::vector<std::size_t> dwells;
  std::vector<TestMotion> tests;
};

struct HomeTests {
  std::vector<HomeGroup> groups;
  Index changed = 0;  // pairs of a test and a joint at rest that changes its count in it
};

HomeTests find_home_tests(const ArmRows& rows, const Recording& recording, const Segmentation& segmentation,
                          const std::vector<SmoothSpan>& spans, const Eigen::VectorXd& resolution);

// The test's combined functions at a dwell (1, r).
Eigen::MatrixXd dwell_functions(const TestMotion& motion, const DwellRow& dwell);

// The same at each of a stretch's samples (M, r), as a joint shows them that follows its torque with a time constant, s: exact for
// motion that is linear between samples.
Eigen::MatrixXd functions_of(const TestMotion& motion, std::size_t stretch, double lag, double rate);

// What all resting joints' counts tell in a group's tests.
class GroupReader {
 public:
  GroupReader(const HomeGroup& group, const ArmRows& rows, const Recording& recording, const Segmentation& segmentation)
      : group_(group), rows_(rows), recording_(recording), segmentation_(segmentation) {}

  // One joint, which follows its torque with a time constant, s. Where no joint changes its count in a test, all functions together
  // are small, or each is where they are told `apart`.
  [[nodiscard]] RestingFit read(Index joint, double count, double lag, bool apart) const;

 private:
  const HomeGroup& group_;
  const ArmRows& rows_;
  const Recording& recording_;
  const Segmentation& segmentation_;
};

}  // namespace circlepoint
