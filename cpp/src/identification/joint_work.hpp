#pragma once
// What the calibration of an arm works on, joint by joint, and the covariance of its result.

#include <optional>
#include <string>
#include <vector>

#include "partial_chain.hpp"
#include "test_fit.hpp"
#include "test_samples.hpp"

namespace circlepoint {

// Everything one joint contributes; `reason` is empty while it can be estimated.
struct JointWork {
  JointType type = JointType::revolute;
  std::optional<TestSamples> samples;
  TestRegression regression;  // of the samples, where there are any
  std::optional<FittedTest> fitted;
  std::string reason;
};

struct Placed {
  std::vector<std::optional<ScrewAxis>> axes;  // at the tests' configurations; absent where missing or not to be carried
  std::vector<Eigen::VectorXd> configurations;
  std::vector<JointType> types;
  PartialChain chain;
};

// Axes at their tests' configurations -> chain at the reference configuration, tip to base. A prismatic axis' point is zero.
PartialChain carry_all(const std::vector<std::optional<ScrewAxis>>& axes, const std::vector<Eigen::VectorXd>& configurations,
                       const Eigen::VectorXd& reference);

// Covariance (4n, 4n) of the placed lines' local coordinates: noise of the tests, the sensor's static errors (shared by all
// joints), the carrying, encoder resolution, and yielding where it was not corrected.
Eigen::MatrixXd covariance_at_reference(const std::vector<JointWork>& work, const Placed& placed, const SensorFromGravity& sensor,
                                        const Eigen::VectorXd& resolution, bool yielding_corrected);

}  // namespace circlepoint
