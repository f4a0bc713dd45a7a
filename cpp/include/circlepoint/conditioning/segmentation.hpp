#pragma once
// Finding the tests in one continuous log: static dwells and single-joint motions, per joint.
//
// A dwell is a stretch in which every joint and the sensor are at rest. A single-joint motion is a stretch in which one
// joint moves and the others stay where they are but for what the control loop lets them yield (milliradians,
// proportional to the moving joint's effort). Thresholds come from the data: encoder resolution, sensor noise at rest.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

struct StaticDwell {
  IndexRange samples;                ///< settled samples only
  Eigen::VectorXd joint_positions;   ///< (n) mean, rad or m
  Eigen::Vector3d specific_force;    ///< mean, m/s^2
  Eigen::Vector3d specific_force_std;  ///< of the samples, m/s^2
};

struct SingleJointMotion {
  Index joint = 0;                  ///< 0-based
  IndexRange samples;               ///< from rest to rest
  double travel = 0.0;              ///< rad or m, peak to peak of the moving joint
  double peak_velocity = 0.0;       ///< rad/s or m/s
  Eigen::VectorXd joint_positions;  ///< (n) mean over the motion, rad or m
};

/// Everything of one joint that was recorded while the other joints stood at one configuration.
struct JointTest {
  Index joint = 0;
  Eigen::VectorXd configuration;    ///< (n) rad or m: the other joints' rest; entry `joint` is the test's mean
  std::vector<Index> dwells;        ///< into Segmentation::dwells
  std::vector<Index> motions;       ///< into Segmentation::motions
  double dwell_span = 0.0;          ///< rad or m, range of the joint over its dwells
  double motion_span = 0.0;         ///< rad or m, largest travel of its motions
};

struct SegmentationOptions {
  double min_dwell = 0.25;             ///< s
  double settle = 0.1;                 ///< s, dropped at the start of a dwell
  double min_velocity = 0.02;          ///< rad/s or m/s: slower than this is at rest
  double others_ratio = 0.05;          ///< others may move at this fraction of the moving joint's speed
  double others_travel = 0.06;         ///< rad or m: others may yield this much over a motion
  double min_travel = 0.03;            ///< rad or m: shorter motions are ignored
  double configuration_tolerance = 0.1;  ///< rad or m: the same test, if every other joint is within this
};

struct Segmentation {
  std::vector<StaticDwell> dwells;
  std::vector<SingleJointMotion> motions;
  std::vector<JointTest> tests;  ///< at most one per joint and configuration, base to tip, largest span first
};

/// Finds dwells, single-joint motions and the tests they make up. A log without any gives empty lists, not an error.
Segmentation segment(const Recording& recording, const SegmentationOptions& options = {});

}  // namespace circlepoint
