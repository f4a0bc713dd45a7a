#pragma once
// One joint test's samples, conditioned for the regression: dwell means and smoothed motions of all joints.

#include <vector>

#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/identification/joint_calibration.hpp"
#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

struct MotionSamples {
  Eigen::VectorXd time;      // (M) s
  SamplesX position;         // (M, n), smoothed
  SamplesX velocity;         // (M, n)
  SamplesX acceleration;     // (M, n)
  Samples3 specific_force;   // (M, 3), corrected for the sensor's static errors
  Index trim_begin = 0;      // samples spoilt by the filter's start where the motion does not start at rest
  Index trim_end = 0;
};

struct TestSamples {
  Index joint = 0;
  Index test = 0;
  Eigen::VectorXd configuration;  // (n)
  double cutoff = 0.0;            // Hz
  SamplesX dwell_positions;       // (K, n)
  Samples3 dwell_force;           // (K, 3), corrected
  double dwell_floor = 0.0;       // m/s^2, standard deviation of a dwell's mean by its own samples
  std::vector<MotionSamples> motions;
};

// The motion with the largest travel. Raises NotIdentifiable where there is none.
const MotionSamples& widest_motion(const TestSamples& samples);

// Each joint's encoder count, rad or m: from options, or what its steps are multiples of (0: a joint at rest, or nothing shows one).
Eigen::VectorXd encoder_resolution(const Recording& recording, const JointCalibrationOptions& options);

// Low-pass for both sides of the regression, Hz: 10, less where the encoder's counts, differentiated twice, would drown the
// readings, but never below six times the motion's own frequency.
double choose_cutoff(const Recording& recording, const Segmentation& segmentation, const JointTest& test, double resolution);

TestSamples gather(const Recording& recording, const Segmentation& segmentation, Index test,
                   const AccelerometerModel& sensor, const Eigen::VectorXd& resolution, const JointCalibrationOptions& options);

}  // namespace circlepoint
