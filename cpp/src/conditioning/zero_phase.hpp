#pragma once
// Forwards and backwards through second-order sections, in one pass over memory.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "circlepoint/conditioning/sosfilt.hpp"
#include "filter_kernels.hpp"
#include "scratch.hpp"

namespace circlepoint::detail {

/// Samples in rows with room for whole registers, in the scratch memory and yet to be written.
class RoomySamples {
 public:
  RoomySamples(Scratch& scratch, Index rows, Index channels)
      : rows_(rows), channels_(channels), step_((channels + row_room - 1) / row_room * row_room),
        values_(scratch.take(static_cast<std::size_t>(rows * step_))) {}

  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Eigen::Map<Eigen::RowVectorXd> row(Index i) const { return {values_ + i * step_, channels_}; }
  [[nodiscard]] Rows from(Index i) const { return {values_ + i * step_, step_}; }
  /// Backwards in time: the first of `count` rows is the last.
  [[nodiscard]] Rows back_from(Index count) const { return {values_ + (count - 1) * step_, -step_}; }
  /// What lies behind the channels becomes zeros.
  void clear_room() {
    for (Index i = 0; i < rows_; ++i) {
      Eigen::Map<Eigen::RowVectorXd>(values_ + i * step_ + channels_, step_ - channels_).setZero();
    }
  }

 private:
  Index rows_, channels_, step_;
  double* values_;
};

/// The sections of a zero-phase filter and the states they start from.
class Cascade {
 public:
  Cascade(std::vector<Section> sections, const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& steady);

  /// The state of every section and channel, steady for `start`.
  [[nodiscard]] SamplesX steady_state(const Eigen::Ref<const Eigen::RowVectorXd>& start) const;

  /// One or two runs over `rows` rows each; rows of `in` and `work` have room, those of `out` if `room`.
  void filter(std::initializer_list<FilterRun> runs, Index rows, Index channels, bool room) const;

  /// Rows after which any state has decayed below 1e-18 of itself, with half as much again for poles that coincide;
  /// nothing for a cascade that does not decay.
  [[nodiscard]] std::optional<Index> memory() const;

 private:
  std::vector<Section> sections_;
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> steady_;
  bool monic_ = true;
  const FilterKernels& kernels_ = filter_kernels();
};

/// Zero-phase filtering of `x` between its extensions `head` and `tail`.
void filter_zero_phase(const Cascade& cascade, Scratch& scratch, const RoomySamples& head, const Eigen::Ref<const SamplesX>& x,
                       const RoomySamples& tail, SamplesX& y);

}  // namespace circlepoint::detail
