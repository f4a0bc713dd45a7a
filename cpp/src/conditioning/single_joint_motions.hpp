#pragma once
// One joint moves, the others stay but for what their control loops let them yield.

#include <vector>

#include "circlepoint/conditioning/segmentation.hpp"

namespace circlepoint {

/// In order of time; `rests` are the joint_rests of the recording.
std::vector<SingleJointMotion> single_joint_motions(const Recording& recording,
                                                    const std::vector<std::vector<IndexRange>>& rests,
                                                    const SegmentationOptions& options);

}  // namespace circlepoint
