#include "arm_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace circlepoint {
namespace {

constexpr double vague_direction = 0.02;    // rad, and
constexpr double vague_point = 0.02;        // m: a line less certain than this is not given
constexpr double vague_gravity = 0.005;     // rad its direction may stay open
constexpr double unknown_direction = 0.05;  // rad: beyond, a linearised covariance means little
constexpr double unknown_place = 1.0;       // m: beyond, as if rests alone were there
constexpr double told_apart = 4.0;          // standard deviations
constexpr double drowned = 0.015;           // of the acceleration's variance, by its counts' rounding
constexpr double unexplained = 0.015;       // of gravity, that still poses may differ from the model by

// Why a line is not given although it was fitted; empty: it is. A linearised covariance means nothing where gravity's direction
// rests on the prior alone, or where it spans more than the linearisation.
std::string why_vague(const JointAxis& axis, double gravity_std) {
  const bool slides = axis.screw.type == JointType::prismatic;
  if (!std::isfinite(axis.point_std())) {
    return "rests alone show directions and no distances; move it, such as 0.5 Hz over 150 degrees for 6 s";
  }
  if (gravity_std > vague_gravity && !slides) {
    return "gravity hardly turns in the sensor's frame in this recording, or about one axis only, so its direction cannot be told from the "
           "sensor's bias; hold still at six or more orientations of the sensor well apart, 1 s each, or name the sensor if its data sheet "
           "is known";
  }
  std::array<char, 160> text{};
  if (slides && axis.direction_std() > vague_direction) {
    std::snprintf(text.data(), text.size(), "its direction is known to +- %.1f mrad only", 1e3 * axis.direction_std());
    return std::string(text.data()) + "; too little acceleration: move it faster, such as 0.5 Hz over 0.3 m for 6 s";
  }
  if (axis.direction_std() > vague_direction || axis.point_std() > vague_point) {
    std::snprintf(text.data(), text.size(), "its line is known to +- %.1f mrad and +- %.1f mm only", 1e3 * axis.direction_std(),
                  1e3 * axis.point_std());
    return std::string(text.data()) + "; move it alone, farther and faster, such as 0.5 Hz over 150 degrees for 6 s";
  }
  return {};
}

// Why a line and its covariance mean nothing, whatever they are; empty: they do.
std::string why_untold(const Seen& seen, Index joint) {
  const double rounding = seen.rounding[joint];
  if (rounding > drowned) {
    std::array<char, 200> text{};
    if (rounding < 1.0) {
      std::snprintf(text.data(), text.size(), "the rounding of its encoder's counts is %.0f %% of the acceleration it shows, so its line",
                    100.0 * std::sqrt(rounding));
    } else {
      std::snprintf(text.data(), text.size(), "it moves by less than %.0f of its encoder's counts, so its line", fewest_counts);
    }
    return std::string(text.data()) + " cannot be told; move it farther or faster";
  }
  if (seen.ambiguous[static_cast<std::size_t>(joint)]) {
    return "another line, with its axis mirrored at the horizontal plane, explains its short motion about as well; move it farther, "
           "over 70 degrees or more";
  }
  return {};
}

// As where rests alone were recorded.
void forget_place(JointAxis& axis) {
  axis.covariance.rightCols<2>().setZero();
  axis.covariance.bottomRows<2>().setZero();
  axis.covariance.diagonal().tail<2>().setConstant(std::numeric_limits<double>::infinity());
}

}  // namespace

void write_lines(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance,
                 const Seen& seen) {
  const auto joints = static_cast<Index>(state.axes.size());
  estimate.covariance = Eigen::MatrixXd::Zero(4 * joints, 4 * joints);
  for (Index i = 0; i < joints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Index column = layout.lines[at];
    JointEstimate& mine = estimate.joints[at];
    mine.axis.reset();
    mine.vague.reset();
    if (column < 0) {
      if (mine.reason.empty()) {
        mine.reason = "it hardly moves in this recording; move it, alone or with others";
      }
      if (!layout.points && state.axes[at].type == JointType::prismatic) {
        mine.reason = "rests show nothing of a joint that slides; move it, such as 0.5 Hz over 0.3 m for 6 s";
      }
      continue;
    }
    const Index count = layout.line_columns(state.axes[at]);
    for (Index k = 0; k < joints; ++k) {
      const Index other = layout.lines[static_cast<std::size_t>(k)];
      if (other >= 0) {
        const Index other_count = layout.line_columns(state.axes[static_cast<std::size_t>(k)]);
        estimate.covariance.block(4 * i, 4 * k, count, other_count) = covariance.block(column, other, count, other_count);
      }
    }
    mine.axis = JointAxis{state.axes[at], estimate.covariance.block<4, 4>(4 * i, 4 * i)};
    if (!layout.points) {
      forget_place(*mine.axis);
    }
    mine.reason = why_untold(seen, i);
    if (!mine.reason.empty()) {
      mine.axis.reset();
      continue;
    }
    mine.reason = why_vague(*mine.axis, seen.gravity_std);
    if (!mine.reason.empty()) {
      // What is supposed of the sensor would tell most of it.
      if ((seen.gravity_std > vague_gravity || !layout.points) && !seen.sensor_is_known) {
        mine.axis->covariance.topLeftCorner(count, count) = seen.data_std.segment(column, count).cwiseAbs2().asDiagonal();
      }
      const double direction_std = mine.axis->direction_std();
      const double off_gravity = std::asin(std::min(1.0, state.up_gravity.normalized().cross(state.axes[at].line.direction).norm()));
      if (!layout.points && seen.rest_rms > unexplained * state.up_gravity.norm()) {
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(), "no arm that was found explains the still poses to better than %.2f m/s^2", seen.rest_rms);
        mine.reason = std::string(text.data()) + "; check the columns, their signs and the joints' order, or record more poses";
      } else if (!layout.points && off_gravity < told_apart * direction_std && direction_std < unknown_direction) {
        mine.reason = "its axis is along gravity, and rests show neither which way it turns nor where it is; move it, such as 0.5 Hz "
                      "over 150 degrees for 6 s";
      } else if (seen.gravity_std < unknown_direction && direction_std < unknown_direction) {
        mine.vague = mine.axis;
        if (!(mine.vague->point_std() < unknown_place)) {
          forget_place(*mine.vague);
        }
      }
      mine.axis.reset();
    }
  }
}

void write_sensor(JointCalibration& estimate, const ArmLayout& layout, const ArmState& state, const Eigen::MatrixXd& covariance) {
  estimate.up_gravity_sensor = state.up_gravity;
  estimate.sensor.sensor = state.sensor;
  estimate.percussion_distance = state.sensor.percussion_distance;
  estimate.percussion_distance_std.setZero();
  estimate.sensor.covariance.setZero();
  const auto spread = [&](Index column, Index at) {
    if (column >= 0) {
      estimate.sensor.covariance.block<3, 3>(at, at) = covariance.block<3, 3>(column, column);
    }
  };
  spread(layout.bias, 0);
  spread(layout.scale, 3);
  spread(layout.misalignment, 6);
  spread(layout.second_order, 9);
  if (layout.percussion_distance >= 0) {
    estimate.percussion_distance_std = covariance.diagonal().segment<3>(layout.percussion_distance).cwiseMax(0.0).cwiseSqrt();
  }
}

void record_signals(JointCalibration& joints, const Segmentation& segmentation, const ArmProblem& problem,
                    const ArmResiduals& residuals) {
  joints.fits.clear();
  for (JointEstimate& estimate : joints.joints) {
    estimate.fit = -1;
    Index rows = 0;
    for (const MovingStretch& stretch : problem.rows.stretches) {
      rows += stretch.joint == estimate.joint ? stretch.rows() : 0;
    }
    Index test = -1;
    for (std::size_t i = 0; i < segmentation.tests.size() && test < 0; ++i) {
      test = segmentation.tests[i].joint == estimate.joint ? static_cast<Index>(i) : -1;
    }
    if (rows == 0 || test < 0 || !estimate.axis) {
      continue;
    }
    TestFit fit;
    fit.joint = estimate.joint;
    fit.test = test;
    fit.type = estimate.axis->screw.type;
    fit.configuration = segmentation.tests[static_cast<std::size_t>(test)].configuration;
    fit.cutoff = problem.rows.cutoff;
    fit.time.resize(rows);
    fit.position.resize(rows);
    fit.measured.resize(rows, 3);
    fit.modelled.resize(rows, 3);
    Index at = 0;
    for (std::size_t i = 0; i < problem.rows.stretches.size(); ++i) {
      const MovingStretch& stretch = problem.rows.stretches[i];
      if (stretch.joint != estimate.joint) {
        continue;
      }
      fit.time.segment(at, stretch.rows()) = stretch.time;
      fit.position.segment(at, stretch.rows()) = stretch.position.col(estimate.joint);
      fit.measured.middleRows(at, stretch.rows()) = stretch.reading.leftCols<3>();
      fit.modelled.middleRows(at, stretch.rows()) = stretch.reading.leftCols<3>() + residuals.moving[i].leftCols<3>();
      at += stretch.rows();
    }
    fit.dynamic_noise_std = std::sqrt((fit.measured - fit.modelled).squaredNorm() / (3.0 * static_cast<double>(rows)));
    std::vector<Index> mine;
    for (const Index dwell : segmentation.tests[static_cast<std::size_t>(test)].dwells) {
      const StaticDwell& static_dwell = segmentation.dwells[static_cast<std::size_t>(dwell)];
      for (std::size_t i = 0; i < problem.rows.dwells.size(); ++i) {
        if (problem.rows.dwells[i].samples.begin == static_dwell.samples.begin) {
          mine.push_back(static_cast<Index>(i));
          break;
        }
      }
    }
    const auto count = static_cast<Index>(mine.size());
    fit.dwell_positions.resize(count);
    fit.dwell_measured.resize(count, 3);
    fit.dwell_modelled.resize(count, 3);
    for (Index k = 0; k < count; ++k) {
      const DwellRow& dwell = problem.rows.dwells[static_cast<std::size_t>(mine[static_cast<std::size_t>(k)])];
      fit.dwell_positions[k] = dwell.position[estimate.joint];
      fit.dwell_measured.row(k) = dwell.reading.head<3>();
      fit.dwell_modelled.row(k) = dwell.reading.head<3>().transpose() + residuals.dwells.row(mine[static_cast<std::size_t>(k)]).head<3>();
    }
    if (count > 0) {
      fit.static_noise_std = std::sqrt((fit.dwell_measured - fit.dwell_modelled).squaredNorm() / (3.0 * static_cast<double>(count)));
    }
    fit.samples = rows + count;
    const Eigen::Vector3d& z = estimate.axis->screw.line.direction;
    fit.gravity_share = joints.up_gravity_sensor.cross(z).norm() / std::max(1e-12, joints.up_gravity_sensor.norm());
    fit.converged = true;
    estimate.fit = static_cast<Index>(joints.fits.size());
    joints.fits.push_back(std::move(fit));
  }
}

}  // namespace circlepoint
