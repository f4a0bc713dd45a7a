#pragma once
// When the arm stands still: from the joints' encoders and the scatter of the sensor.
//
// A joint is at rest where its encoder stays within one band for `rest_window` seconds: the band is what the slowest
// motion (`min_velocity`) covers in that time, and never less than one and a half encoder counts, so that a joint
// hovering between two counts of a coarse encoder is at rest. Unlike a differentiated encoder this has no noise to
// threshold, and its ends are sharp. Two things stay in the band without resting, and are told apart by scale alone:
//   creeping         a rest that drifts by several bands is judged again with half the band, down to an eighth or the
//                    encoder's step, and where the step forbids that, with a window twice as long;
//   a turning point  q - q_0 grows with the square of time on both sides: leaving the rest by half its length on
//                    either side, a parabola is still within four bands, while a joint that stood has gone far.
//
// The arm is static where all joints rest. The sensor is still settling then (vibration, a control loop's tail), so the
// interval is cut at both ends where the standard error of its mean is smallest: the marginal standard error rule
// (White 1997, "An effective truncation heuristic for bias reduction in simulation output"), on the variance of the
// samples plus that of short batch means, glitches clipped. What is left must be quiet against the quietest rests of
// the same recording.
//
// Thresholds are angles. A prismatic joint's lengths are held against them at metres_per_radian: as if it moved the sensor
// by a lever of that length.
//
// Fails: a resting joint whose encoder is noisier than the band (a potentiometer) is never at rest: raise min_velocity.

#include <Eigen/Core>
#include <vector>

#include "circlepoint/geometry/screw_axis.hpp"
#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

struct StaticIntervalOptions {
  double min_dwell = 0.25;      ///< s, shortest static interval
  double settle = 0.1;          ///< s, dropped after the joints came to rest, before the sensor is judged
  double min_velocity = 0.005;  ///< rad/s: what is slower is at rest
  double rest_window = 0.2;     ///< s, shortest rest of a joint
  double quiet_ratio = 5.0;     ///< quiet: the sensor's scatter is within this multiple of the quietest rests' scatter,
  double quiet_std = 0.05;      ///< or below this, m/s^2 rms over the channels
  std::vector<JointType> joint_types{};  ///< base to tip; empty: all revolute
  double metres_per_radian = 0.2;        ///< m: a prismatic joint's travel that counts as a radian
};

/// (n) what a radian of the thresholds is in each joint's own unit: 1 for a revolute joint, metres_per_radian for a
/// prismatic one. Raises InvalidInput where joint_types are not as many as the joints.
Eigen::VectorXd threshold_units(const StaticIntervalOptions& options, Index joints);

/// The encoder's step (rad or m): the least difference of two values each held for two samples in succession; 0 where
/// that exceeds max_encoder_step (the joint hardly hovers, its steps are other things) or the joint never moves.
double encoder_step(const Eigen::Ref<const Eigen::VectorXd>& positions);

/// Coarser encoders than 512 counts a revolution are not told from motion.
inline constexpr double max_encoder_step = 6.283185307179586 / 512.0;

/// The band a revolute joint at rest stays in, rad; a prismatic joint's is this with its step in radians of
/// threshold_units, times the unit.
double rest_band(double encoder_step, const StaticIntervalOptions& options = {});

/// For each joint, the intervals in which it rests; none crosses a gap.
std::vector<std::vector<IndexRange>> joint_rests(const Recording& recording, const StaticIntervalOptions& options = {});

/// The intervals in which every joint rests and the sensor has settled and is quiet.
std::vector<IndexRange> static_intervals(const Recording& recording, const StaticIntervalOptions& options = {});

/// The same, from joint rests already found.
std::vector<IndexRange> static_intervals(const Recording& recording, const std::vector<std::vector<IndexRange>>& rests,
                                         const StaticIntervalOptions& options = {});

}  // namespace circlepoint
