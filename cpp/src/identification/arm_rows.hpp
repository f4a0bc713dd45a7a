#pragma once
// A recording as what the whole-arm estimate compares: means of dwells, and low-passed, thinned-out moving stretches.

#include <string>
#include <vector>

#include "arm_tie.hpp"
#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

// An unknown error of a joint's position: a parameter times a shape that the row or stretch gives.
struct OffsetTerm {
  Index joint = 0;
  Index parameter = 0;  // into ArmRows::offset_covariance
};

// Shapes of a stretch's offset terms, a column each, with their time derivatives.
struct OffsetShapes {
  Eigen::MatrixXd position;      // (M, terms) 1
  Eigen::MatrixXd velocity;      // (M, terms) 1/s
  Eigen::MatrixXd acceleration;  // (M, terms) 1/s^2
};

// What a coarse encoder adds to the smoothed motion of a joint that crosses its counts.
struct PositionError {
  Index joint = 0;
  Eigen::MatrixXf covariance;  // (3 M, 3 M) of position, velocity and acceleration: rad, s
};

struct MovingStretch {
  Index joint = -1;        // the one joint that moves, or -1
  Index test = -1;         // of that joint, into Segmentation::tests, or -1
  Index noise = 0;         // kind of motion: stretches of one kind share their noise model
  Eigen::ArrayXi sample;   // (M) of the recording
  Eigen::VectorXd time;    // (M) s
  SamplesX position;       // (M, n)
  SamplesX velocity;       // (M, n)
  SamplesX acceleration;   // (M, n)
  SamplesX jerk;           // (M, n)
  SamplesX snap;           // (M, n), for delays of milliseconds
  SamplesX reading;        // (M, 3), or (M, 6) with angular rate
  std::vector<OffsetTerm> offsets;  // of the joints that rest meanwhile
  OffsetShapes shapes;
  std::vector<bool> follows;        // (n) the joint's yield is modelled (arm_yield)
  std::vector<PositionError> errors;  // where some encoder is coarse
  [[nodiscard]] Index rows() const { return time.size(); }
};

struct DwellRow {
  Eigen::VectorXd position;                             // (n)
  Eigen::VectorXd position_variance;                    // (n), of what the encoders do not resolve, for this dwell only
  std::vector<OffsetTerm> offsets;                      // that other rows share
  Eigen::VectorXd shape;                                // of each offset term
  std::vector<bool> follows;                            // (n) as a stretch's
  Eigen::VectorXd reading;                              // (3) or (6)
  Eigen::VectorXd variance;                             // (3) or (6), of the mean by its samples' scatter
  double time = 0.0;                                    // s, middle
  IndexRange samples;                                   // of the recording
};

// Resting joints' motion that is tied to loads on a known arm (arm_yield).
struct YieldTie {
  std::vector<RestingFit> fits;  // what the counts tell
  ArmAtHome arm;
  LoadPoint point;
  Eigen::VectorXd estimate;      // of all coefficients, as the rows have them
  Eigen::MatrixXd reduce;        // (parameters, coefficients)
  Index offset = 0;              // the first of the parameters, shared offsets
};

// A joint at rest stands somewhere within its encoder's count, and stays there: whatever shares that rest shares the error. Such
// offsets are parameters with the count as their prior; a rest of a single dwell is noise of its row.
struct ArmRows {
  std::vector<DwellRow> dwells;
  std::vector<MovingStretch> stretches;
  Eigen::MatrixXd offset_covariance;   // (K, K) prior of the shared offsets, mean zero
  Eigen::MatrixXd offset_information;  // its inverse
  std::vector<YieldTie> ties;
  double cutoff = 0.0;      // Hz
  double rate = 0.0;        // Hz, of the thinned-out rows
  double sample_rate = 0.0; // Hz, of the recording
  double middle = 0.0;      // s
  bool yields = false;      // with coarse encoders: some joint at rest changes its count while another moves
  Index channels = 3;       // 6 with a gyroscope
  Index samples = 0;        // of the recording, used

  // Scalar residuals.
  [[nodiscard]] Index equations() const;
};

constexpr double one_rest = 0.75;  // counts that positions of one rest may differ by

// The given rows of a stretch.
MovingStretch picked(const MovingStretch& stretch, const std::vector<Index>& rows);

// Hz: twenty times the fastest motion's frequency, which passes all a rigid arm's readings hold, or ten times with coarse encoders, whose
// noise rises faster than what the readings tell; not more than 12, above which arms bend and ring (the paper takes 10), nor less than 4;
// less where coarse counts, differentiated twice, would drown the readings or a weak motion, but four times the motion's frequency, eight
// times where arcs are long.
double choose_common_cutoff(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution);

// By how much a joint's position differs over all rows, rad or m.
double travel(const ArmRows& rows, Index joint);

// (n) The share of its counts' rounding in the variance of each joint's acceleration, where it moves: what lets lines shrink towards
// the sensor (errors in variables) once the weights no longer tell one from the other. One where a joint moves by fewer counts than make
// noise of their rounding.
constexpr double fewest_counts = 20.0;
Eigen::VectorXd rounding_share(const ArmRows& rows, const Eigen::VectorXd& resolution);

// Where the arm is known, joints at rest yield to the loads they bear (arm_yield).
ArmRows make_rows(const Recording& recording, const Segmentation& segmentation, const Eigen::VectorXd& resolution, double cutoff,
                  bool gyroscope, const KnownArm* arm = nullptr);

}  // namespace circlepoint
