#pragma once
// What belongs together: dwells and motions of one joint at one configuration of the others.

#include <vector>

#include "circlepoint/conditioning/segmentation.hpp"

namespace circlepoint {

/// Base to tip, largest span first. Motions always make a test; dwells alone do where that joint spans more than the
/// configuration's tolerance and the others yielded no more than others_ratio of it.
std::vector<JointTest> joint_tests(const std::vector<StaticDwell>& dwells,
                                   const std::vector<SingleJointMotion>& motions, Index joints,
                                   const SegmentationOptions& options);

}  // namespace circlepoint
