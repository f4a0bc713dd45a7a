#pragma once
// Low-passed positions and readings of one span between gaps, and how smooth each joint is taken to be.

#include <vector>

#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

// Whether some encoder is too coarse to see what its joint yields, in rad a count.
inline bool are_coarse(const Eigen::VectorXd& resolution) { return resolution.maxCoeff() > 1e-4; }

// The filter and the derivatives of everything here: a Butterworth low-pass of order 4 to and fro, and the sixth-degree polynomial
// through seven samples.
SamplesX low_passed(const Eigen::Ref<const SamplesX>& samples, double cutoff, double rate);
SamplesX differentiated(const Eigen::Ref<const SamplesX>& samples, int order, double rate);

// Positions are kept, derivatives taken where they are asked for: a long recording's would be most of the memory.
struct SmoothJoints {
  double cutoff = 0.0;  // Hz
  double rate = 0.0;    // Hz
  SamplesX position;

  // Derivative of one joint's position over rows [begin, begin + count) of the span.
  [[nodiscard]] Eigen::VectorXd derivative(int order, Index joint, Index begin, Index count) const;
  // The same at some rows of the span. order: 1 to 4.
  [[nodiscard]] Eigen::VectorXd derivative(int order, Index joint, const Eigen::ArrayXi& rows) const;
};

struct SmoothSpan {
  IndexRange samples;
  std::vector<SmoothJoints> joints;  // by falling cut-off, the common one first
  SmoothJoints sharp;                // with coarse encoders: a higher one, to see steps and where within its counts a joint is
  SamplesX reading;
  Index usable_begin = 0;  // first and last samples not spoilt by the span's ends, in the recording's indices
  Index usable_end = 0;
};

// Time reversal leaves the model as it is where all joints stand still: a mirrored continuation is then exact, and only a span
// that begins or ends in motion loses a filter length.
SmoothSpan smooth(const Recording& recording, const IndexRange& span, double cutoff, bool coarse, bool gyroscope);

// Which joints move on their own account: the one that moves alone (-1: none does), those that move by many counts, and, where none
// does, those that move most.
std::vector<bool> moving_joints(const SmoothSpan& span, const IndexRange& moving, Index alone, const Eigen::VectorXd& resolution);

// A joint that only yields shows as a staircase of few counts, and its steps differentiated twice are worse than nothing: what it
// really does follows the joints that do move, at a few times their frequency. Chooses the smoothing that passes that and no more.
std::size_t smoothing_for_yields(const SmoothSpan& span, const IndexRange& moving, const std::vector<bool>& movers);

struct MovingAlone {
  IndexRange samples;
  Index joint = 0;
};

// The parts of a moving range that hold no step of acceleration. A sampled step has no definite instant: readings there differ
// from the encoders' second difference by what lies above half the sample rate. It shows as a jerk far beyond the motion's own. What
// rings after it is left out too where coarse encoders do not show it. So is where a joint that moves alone creeps over a coarse
// encoder's counts, as it does beside every rest; `alone`: which one moves where, in order.
std::vector<IndexRange> without_steps(const SmoothSpan& span, const IndexRange& moving, const std::vector<MovingAlone>& alone,
                                      const Eigen::VectorXd& resolution, double rate);

}  // namespace circlepoint
