#pragma once
// What an encoder's counts tell of a joint that moves by few of them, as the coefficients of given functions.
//
// Where the count changes, the position is the boundary between the two, to a small part of a count; elsewhere it is within the
// count, which is worth one observation of a count's scatter and not one a sample. The scatter of the changes about the fit is
// learnt from them; repeated changes of one boundary share the model's error and count once. Tests whose changes do not fit are
// left out.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

// Rows of one test about one resting joint, in counts from home's.
struct CountRows {
  Eigen::MatrixXd change_functions;  // where the count changes
  Eigen::MatrixXd change_motion;     // of the functions, from the sample before to the one after
  Eigen::VectorXd change_moved;      // counts meanwhile, by the fit
  Eigen::VectorXd change;
  Eigen::VectorXd change_size;       // counts
  Eigen::VectorXd upward;            // 1 or 0
  Eigen::VectorXd repeats;           // changes of the same count the same way: they repeat the model's error
  Eigen::MatrixXd within_functions;  // everywhere
  Eigen::VectorXd within;
  double change_std = 0.1;           // counts, beyond what passes between samples
  double within_std = 1.0 / std::sqrt(12.0);  // counts rms
  bool small = true;                 // where no count changes, all functions together are within it; else each is
};

// h and c of one joint in all tests of a group in which it rests, in counts.
struct JointFit {
  std::vector<std::size_t> tests;  // of the group
  std::vector<Index> first;        // column of each test's c; column 0 is h
  Eigen::VectorXd estimate;
  Eigen::MatrixXd covariance;
};

// Appends a stretch: functions at its samples (M, r), encoder (M) in counts from home's; every thinning-th sample as within.
void read_counts(CountRows& counts, const Eigen::MatrixXd& phi, const Eigen::Ref<const Eigen::VectorXd>& encoder, Index thinning);

// After the last stretch.
void count_repeats(CountRows& counts);

// Fits, learns how well the count changes fit, drops tests in which the model does not hold, until nothing changes.
JointFit fit_and_judge(std::vector<CountRows>& counts, std::vector<std::size_t> tests);

}  // namespace circlepoint
