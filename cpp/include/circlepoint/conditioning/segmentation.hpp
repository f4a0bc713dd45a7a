#pragma once
// Finding the tests in one continuous log: static dwells and single-joint motions, per joint.
//
// A dwell is a stretch in which every joint and the sensor are at rest (conditioning/static_intervals). A single-joint
// motion is a stretch in which one joint moves and the others stay where they are but for what the control loop lets
// them yield (milliradians, proportional to the moving joint's effort). It runs from rest to rest; momentary turning
// points within do not divide it. Where another joint joins later, or stops earlier, the part alone counts if it is
// long enough: it then begins or ends in motion, and says so. Thresholds come from the data: encoder step, sensor noise
// at rest, the moving joint's own speed and travel. Nothing crosses a gap. A prismatic joint's lengths are judged as angles
// at metres_per_radian (with its default 0.2 m: motions from 6 mm, the same configuration within 20 mm).
//
// A test collects what was recorded of one joint at one configuration of the others: dwells that differ in that joint
// only, and its motions. Dwells may belong to several tests (the home position does to all).

#include <Eigen/Core>
#include <vector>

#include "circlepoint/conditioning/static_intervals.hpp"
#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

struct StaticDwell {
  IndexRange samples;                  ///< settled samples only
  Eigen::VectorXd joint_positions;     ///< (n) mean, rad or m
  Eigen::Vector3d specific_force;      ///< mean, m/s^2
  Eigen::Vector3d specific_force_std;  ///< of the samples, m/s^2
};

struct SingleJointMotion {
  Index joint = 0;                  ///< 0-based
  IndexRange samples;               ///< from rest to rest, a little of either rest included
  double travel = 0.0;              ///< rad or m, peak to peak of the moving joint
  double peak_velocity = 0.0;       ///< rad/s or m/s, over half the rest window
  Eigen::VectorXd joint_positions;  ///< (n) mean over the motion, rad or m
  bool from_rest = false;           ///< the joint rests at the beginning; else it was moving already
  bool to_rest = false;             ///< the joint rests at the end; else it moves on, with others or unrecorded
};

/// Everything of one joint that was recorded while the other joints stood at one configuration.
struct JointTest {
  Index joint = 0;
  Eigen::VectorXd configuration;  ///< (n) rad or m: the other joints' rest; entry `joint` is the test's mean
  std::vector<Index> dwells;      ///< into Segmentation::dwells
  std::vector<Index> motions;     ///< into Segmentation::motions
  double dwell_span = 0.0;        ///< rad or m, range of the joint over its dwells
  double motion_span = 0.0;       ///< rad or m, largest travel of its motions
};

struct SegmentationOptions : StaticIntervalOptions {
  double others_ratio = 0.1;             ///< others may move at this fraction of the moving joint's speed and travel,
  double others_travel = 0.06;           ///< rad: but may not yield more than this over a motion
  double min_travel = 0.03;              ///< rad: shorter motions are ignored
  double min_partial = 0.5;              ///< s: shortest motion that does not run from rest to rest
  double configuration_tolerance = 0.1;  ///< rad: the same test, if every other joint is within this
};

struct Segmentation {
  std::vector<StaticDwell> dwells;         ///< in order of time
  std::vector<SingleJointMotion> motions;  ///< in order of time
  std::vector<JointTest> tests;  ///< at most one per joint and configuration, base to tip, largest span first
};

/// Finds dwells, single-joint motions and the tests they make up. A log without any gives empty lists, not an error; of still
/// poses every one is a dwell.
/// Throws InvalidInput where the recording's parts do not match, values are not finite or options are out of range.
Segmentation segment(const Recording& recording, const SegmentationOptions& options = {});

}  // namespace circlepoint
