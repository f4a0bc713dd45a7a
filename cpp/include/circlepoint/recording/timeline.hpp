#pragma once
// From raw time stamps to a uniform clock.
//
// Assumption: the source samples at one constant rate, t_i = o + T k_i + e_i with whole ticks k_i. What a logger writes
// differs from that in four ways, and each is treated by what it is:
//  - rounding: stamps in whole milliseconds of a 266 Hz sensor step 4, 4, 3 ms. The error e_i is explained by the
//    stamps' resolution, the samples are as regular as the fitted clock says: they are kept and get its times.
//  - late stamps: a few samples are stamped on arrival, late and in a bunch, and the stamps then catch up. The phase
//    after the bunch is the phase before it, so nothing is missing; the samples get their ticks' times.
//  - jitter: the samples really were taken off the grid. The stamps are believed and the samples are interpolated
//    (cubic spline) at the grid's times; those that bunch within a tenth of a period count as one, at their mean.
//  - gaps: the phase jumps by whole periods and stays. Up to `max_filled` missing samples are interpolated, more split
//    the recording into spans. The ticks are counted by tracking the phase, so a dropped sample shows even where
//    rounding is as large as half a period.
// Stamps with jitter above an eighth of a period (rounded ones: a quarter) cannot be counted in ticks: they are believed, and a gap
// is a step above `gap_threshold` periods plus three standard deviations of the steps.
// Failure: time that runs backwards, or repeated stamps that no late bunch explains (a row written twice).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "circlepoint/core/types.hpp"

namespace circlepoint {

struct TimelineGap {
  Index index = 0;       ///< 0-based input row after the gap
  double start = 0.0;    ///< s, stamp of the row before it
  double length = 0.0;   ///< s, between the rows on both sides
  Index missing = 0;     ///< samples
  bool filled = false;   ///< interpolated; otherwise a new span starts after it
};

/// A stamp that does not come after the one before it.
struct StampOrder {
  Index index = 0;        ///< 0-based input row
  double previous = 0.0;  ///< s, stamp of the row before
  double value = 0.0;     ///< s
};

enum class StampRule {
  regularised,  ///< samples kept, stamps replaced by the fitted clock
  believed,     ///< stamps kept, samples interpolated at the clock's ticks
};

struct TimelineReport {
  Index samples = 0;         ///< input rows
  double duration = 0.0;     ///< s, last stamp minus first
  double sample_rate = 0.0;  ///< Hz, fitted
  double jitter_std = 0.0;   ///< s, of the stamps against the uniform clock within spans
  double jitter_max = 0.0;   ///< s, largest absolute value of the same; of steps against the period where ticks cannot be counted
  double resolution = 0.0;   ///< s, every stamp is a multiple of it (within the stamp's own digits); 0: none found
  StampRule rule = StampRule::regularised;
  Index late = 0;             ///< stamps more than half a period after their tick, though no sample is missing
  Index filled = 0;           ///< interpolated samples in gaps
  std::vector<TimelineGap> gaps;
  std::vector<StampOrder> repeated;   ///< stamps equal to the one before
  std::vector<StampOrder> backwards;  ///< stamps before the one before
  std::vector<StampOrder> surplus;    ///< rows in excess of the clock's ticks: no late bunch explains them
  std::vector<std::string> notes;     ///< what was found and done, a sentence each
};

struct TimelineOptions {
  Index max_filled = 3;        ///< samples: longer gaps split
  double gap_threshold = 1.5;  ///< periods, for stamps too jittered to count ticks
};

/// A uniform clock fitted to stamps, and where on it each input row lies.
struct Timeline {
  TimelineReport report;
  Eigen::VectorXd time;           ///< (M) s, the uniform clock's times, spans one after the other
  std::vector<IndexRange> spans;  ///< of `time`
  std::vector<IndexRange> rows;   ///< input rows of each span
  Eigen::VectorXd row_time;       ///< (N) s, when each input row was taken
  std::vector<Index> row_sample;  ///< (N) index into `time` of each row; -1 where samples are interpolated
};

/// Fits a uniform clock to stamps (N) in seconds; N >= 8, finite. Raises InvalidInput otherwise, for time that runs
/// backwards, and for repeated stamps that no late bunch explains (naming the 1-based row).
Timeline make_timeline(const Eigen::Ref<const Eigen::VectorXd>& time, const TimelineOptions& options = {});

/// The report alone; it lists time running backwards and surplus rows instead of raising.
TimelineReport analyse_timeline(const Eigen::Ref<const Eigen::VectorXd>& time, const TimelineOptions& options = {});

/// Values (N, channels) of the input rows on the timeline's clock (M, channels).
SamplesX regularise(const Timeline& timeline, const Eigen::Ref<const SamplesX>& values);

}  // namespace circlepoint
