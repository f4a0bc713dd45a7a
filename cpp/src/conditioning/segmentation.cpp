#include "circlepoint/conditioning/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "circlepoint/core/error.hpp"
#include "joint_tests.hpp"
#include "single_joint_motions.hpp"

namespace circlepoint {
namespace {

void check(const SegmentationOptions& options) {
  const auto not_negative = [](double value, const char* name) {
    require(std::isfinite(value) && value >= 0.0,
            std::string(name) + " is " + std::to_string(value) + "; it must be finite and not negative");
  };
  not_negative(options.others_ratio, "others_ratio");
  not_negative(options.others_travel, "others_travel");
  not_negative(options.min_travel, "min_travel");
  not_negative(options.min_partial, "min_partial");
  not_negative(options.configuration_tolerance, "configuration_tolerance");
}

StaticDwell describe(const Recording& recording, IndexRange samples) {
  const auto force = recording.specific_force.middleRows(samples.begin, samples.size());
  StaticDwell dwell;
  dwell.samples = samples;
  dwell.joint_positions = recording.joint_positions.middleRows(samples.begin, samples.size()).colwise().mean();
  dwell.specific_force = force.colwise().mean();
  const auto freedom = static_cast<double>(std::max<Index>(1, samples.size() - 1));
  dwell.specific_force_std =
      ((force.rowwise() - dwell.specific_force.transpose()).colwise().squaredNorm() / freedom).cwiseSqrt();
  return dwell;
}

}  // namespace

Segmentation segment(const Recording& recording, const SegmentationOptions& options) {
  check(options);
  Segmentation segmentation;
  if (recording.is_static()) {
    for (const IndexRange& pose : recording.spans) {
      segmentation.dwells.push_back(describe(recording, pose));
    }
  } else {
    const auto rests = joint_rests(recording, options);
    for (const IndexRange& interval : static_intervals(recording, rests, options)) {
      segmentation.dwells.push_back(describe(recording, interval));
    }
    segmentation.motions = single_joint_motions(recording, rests, options);
  }
  segmentation.tests = joint_tests(segmentation.dwells, segmentation.motions, recording.joints(), options);
  return segmentation;
}

}  // namespace circlepoint
