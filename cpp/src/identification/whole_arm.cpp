#include "circlepoint/identification/whole_arm.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <thread>

#include "arm_problem.hpp"
#include "arm_report.hpp"
#include "arm_start.hpp"
#include "circlepoint/core/error.hpp"
#include "test_samples.hpp"

namespace circlepoint {
namespace {

constexpr double knock = 6.0;             // standard deviations
constexpr double model_failure = 0.2;     // share of rows beyond which knocks are none
constexpr double known_gravity_std = 2e-5;  // m/s^2: a known magnitude, without making the equations stiff
constexpr double still = 0.05;          // standard deviations a pass may still move a parameter by
constexpr double vague_gravity = 0.005;   // rad its direction may stay open by the data alone
constexpr double vague_direction = 0.02;  // rad, and
constexpr double vague_point = 0.02;      // m: a line less certain than this is not given

void validate(const Recording& recording, const WholeArmOptions& options) {
  const Index joints = recording.joints();
  require(options.joint_types.empty() || static_cast<Index>(options.joint_types.size()) == joints,
          "joint_types has " + std::to_string(options.joint_types.size()) + " entries for " + std::to_string(joints) +
              " joints; give one per joint, base to tip");
  require(options.encoder_resolution.size() == 0 || options.encoder_resolution.size() == joints,
          "encoder_resolution has " + std::to_string(options.encoder_resolution.size()) + " entries for " +
              std::to_string(joints) + " joints; give one per joint, or none");
  require(!options.reference_configuration || options.reference_configuration->size() == joints,
          "reference_configuration does not have one entry for each of " + std::to_string(joints) + " joints");
  require(options.gravity_magnitude > 0.0, "gravity_magnitude is " + std::to_string(options.gravity_magnitude) +
                                               " m/s^2; give the local magnitude, about 9.8");
  require(options.cutoff >= 0.0 && options.cutoff < 0.5 * recording.sample_rate,
          "cutoff is " + std::to_string(options.cutoff) + " Hz; give 0 (chosen) or less than half the sample rate of " +
              std::to_string(recording.sample_rate) + " Hz");
  require(options.max_passes > 0, "max_passes is " + std::to_string(options.max_passes) + "; give 1 or more");
}

JointCalibrationOptions joint_options(const WholeArmOptions& options) {
  JointCalibrationOptions joint;
  joint.sensor = options.sensor;
  joint.gravity = options.gravity_magnitude;
  joint.joint_types = options.joint_types;
  joint.encoder_resolution = options.encoder_resolution;
  joint.reference_configuration = options.reference_configuration;
  return joint;
}

ParameterTreatment settle(const ParameterTreatment& treatment, double specified) {
  ParameterTreatment settled = treatment;
  if (settled.std == 0.0) {
    settled.std = specified;
  }
  settled.estimated = settled.estimated && settled.std > 0.0;
  return settled;
}

void add_prior(ArmPrior& prior, Index column, const Eigen::VectorXd& mean, double std) {
  if (std::isfinite(std)) {
    prior.terms.push_back({column, mean, Eigen::MatrixXd(Eigen::MatrixXd::Identity(mean.size(), mean.size()) / std)});
  }
}

// Which columns there are, and what is known of them beforehand.
void lay_out(ArmProblem& problem, const ArmState& state, const std::vector<bool>& moves, const WholeArmOptions& options) {
  ArmLayout& layout = problem.layout;
  const auto joints = static_cast<Index>(moves.size());
  layout.lines.assign(moves.size(), -1);
  const auto claim = [&layout](Index count) {
    const Index column = layout.columns;
    layout.columns += count;
    return column;
  };
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i]) {
      layout.lines[i] = claim(state.axes[i].type == JointType::revolute ? 4 : 2);
    }
  }
  layout.up_gravity = claim(3);
  problem.prior.gravity = options.gravity_magnitude;
  problem.prior.gravity_known = !options.gravity.estimated;
  problem.prior.gravity_std = options.gravity.estimated ? options.gravity.std : known_gravity_std;
  const auto group = [&](Index& column, const ParameterTreatment& treatment, double specified, const Eigen::VectorXd& mean) {
    const ParameterTreatment settled = settle(treatment, specified);
    if (settled.estimated) {
      column = claim(mean.size());
      add_prior(problem.prior, column, mean, settled.std);
    }
  };
  const AccelerometerSpecification& sensor = options.sensor;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  group(layout.bias, options.bias, sensor.bias_std, zero);
  group(layout.scale, options.scale, sensor.scale_std, zero);
  group(layout.misalignment, options.misalignment, sensor.misalignment_std, zero);
  const ParameterTreatment percussion = settle(options.percussion_distance, sensor.percussion_distance_std);
  if (percussion.estimated) {
    layout.percussion_distance = claim(3);
    if (std::isfinite(percussion.std)) {
      const double spread = std::min(percussion.std, channel_spread_std);
      const Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(percussion.std * percussion.std) +
                                         spread * spread * Eigen::Matrix3d::Identity();
      const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
      problem.prior.terms.push_back({layout.percussion_distance, Eigen::Vector3d::Constant(sensor.percussion_distance),
                                     factor.matrixL().solve(Eigen::Matrix3d::Identity())});
    }
  }
  group(layout.second_order, options.second_order, sensor.second_order_std, zero);
  group(layout.clock_offset, options.clock_offset, 0.0, Eigen::VectorXd::Zero(1));
  if (layout.clock_offset >= 0) {
    group(layout.clock_rate, options.clock_rate, 0.0, Eigen::VectorXd::Ones(1));
  }
  group(layout.encoder_gain, options.encoder_gain, 0.0, Eigen::VectorXd::Zero(joints));
  group(layout.eccentricity, options.eccentricity, 0.0, Eigen::VectorXd::Zero(2 * joints));
  if (problem.rows.channels == 6) {
    group(layout.gyroscope_bias, options.gyroscope_bias, 0.0, zero);
    Eigen::VectorXd identity(9);
    identity << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    group(layout.gyroscope_matrix, options.gyroscope_matrix, 0.0, identity);
  }
}

// Kinds of motion: each joint alone, and all others; a kind too short for a noise model of its own joins the others.
void name_kinds(ArmRows& rows, Index joints) {
  constexpr Index shortest = 100;
  std::vector<Index> count(static_cast<std::size_t>(joints) + 1, 0);
  const auto slot = [joints](const MovingStretch& stretch) {
    return static_cast<std::size_t>(stretch.joint >= 0 ? stretch.joint : joints);
  };
  for (const MovingStretch& stretch : rows.stretches) {
    count[slot(stretch)] += stretch.rows();
  }
  std::vector<Index> kind(count.size(), -1);
  Index kinds = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] >= shortest) {
      kind[i] = kinds++;
    }
  }
  Index shared = -1;
  for (MovingStretch& stretch : rows.stretches) {
    Index& mine = kind[slot(stretch)];
    if (mine < 0) {
      shared = shared < 0 ? kinds++ : shared;
      mine = shared;
    }
    stretch.noise = mine;
  }
}

// Rows to leave out, a flag each, around whitened residuals beyond the limit.
Index cut_knocks(ArmRows& rows, const ArmResiduals& residuals) {
  constexpr Index margin = 4;
  constexpr Index shortest = 5;
  std::vector<MovingStretch> kept;
  Index removed = 0;
  Index total = 0;
  for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
    const MovingStretch& stretch = rows.stretches[i];
    const Eigen::MatrixXd& whitened = residuals.whitened[i];
    std::vector<bool> bad(static_cast<std::size_t>(stretch.rows()), false);
    for (Index row = 0; row < stretch.rows(); ++row) {
      if (whitened.row(row).cwiseAbs().maxCoeff() > knock) {
        for (Index k = std::max<Index>(0, row - margin); k < std::min(stretch.rows(), row + margin + 1); ++k) {
          bad[static_cast<std::size_t>(k)] = true;
        }
      }
    }
    total += stretch.rows();
    Index begin = 0;
    for (Index row = 0; row <= stretch.rows(); ++row) {
      const bool ends = row == stretch.rows() || bad[static_cast<std::size_t>(row)];
      if (!ends) {
        continue;
      }
      if (row - begin >= shortest) {
        std::vector<Index> good(static_cast<std::size_t>(row - begin));
        std::iota(good.begin(), good.end(), begin);
        kept.push_back(picked(stretch, good));
      } else {
        removed += row - begin;
      }
      removed += row < stretch.rows() ? 1 : 0;
      begin = row + 1;
    }
  }
  if (static_cast<double>(removed) > model_failure * static_cast<double>(total)) {
    return 0;
  }
  rows.stretches = std::move(kept);
  std::vector<DwellRow> dwells;
  for (std::size_t i = 0; i < rows.dwells.size(); ++i) {
    if (residuals.dwells_normalized.row(static_cast<Index>(i)).cwiseAbs().maxCoeff() <= knock) {
      dwells.push_back(rows.dwells[i]);
    }
  }
  const auto dropped = static_cast<Index>(rows.dwells.size() - dwells.size());
  if (static_cast<double>(dropped) <= model_failure * static_cast<double>(rows.dwells.size())) {
    rows.dwells = std::move(dwells);
    removed += dropped;
  }
  return removed;
}

ArmState initial_state(const Recording& recording, const JointCalibration& start, const WholeArmOptions& options) {
  const Index joints = recording.joints();
  ArmState state;
  state.reference = start.reference_configuration;
  state.up_gravity = start.up_gravity_sensor;
  state.sensor = start.sensor.sensor;
  state.sensor.percussion_distance = start.percussion_distance;
  state.encoder_gain = Eigen::VectorXd::Zero(joints);
  state.eccentricity = Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(joints, 2);
  for (Index j = 0; j < joints; ++j) {
    const auto& estimate = start.joints[static_cast<std::size_t>(j)];
    const JointType type = options.joint_types.empty() ? JointType::revolute : options.joint_types[static_cast<std::size_t>(j)];
    state.axes.push_back(estimate.axis ? estimate.axis->screw : ScrewAxis{type, Line{}});
  }
  return state;
}

// Parameters the options hold fixed keep their nominal values whatever the start says.
void hold_fixed(ArmState& state, const ArmLayout& layout, const AccelerometerSpecification& sensor) {
  const auto reset = [](Index column, Eigen::Vector3d& value, double nominal) {
    if (column < 0) {
      value.setConstant(nominal);
    }
  };
  reset(layout.bias, state.sensor.bias, 0.0);
  reset(layout.scale, state.sensor.scale, 0.0);
  reset(layout.misalignment, state.sensor.misalignment, 0.0);
  reset(layout.percussion_distance, state.sensor.percussion_distance, sensor.percussion_distance);
  reset(layout.second_order, state.sensor.second_order, 0.0);
}

double largest_step(const ArmState& before, const ArmState& after, const ArmLayout& layout, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd change = values(after, layout) - values(before, layout);
  for (std::size_t i = 0; i < before.axes.size(); ++i) {
    if (layout.lines[i] >= 0) {
      const Eigen::Vector4d local = local_coordinates(before.axes[i].line, after.axes[i].line);
      const Index count = before.axes[i].type == JointType::revolute ? 4 : 2;
      change.segment(layout.lines[i], count) = local.head(count);
    }
  }
  const Eigen::VectorXd std = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
  return change.cwiseAbs().cwiseQuotient(std).maxCoeff();
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd root = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  Eigen::MatrixXd scaled = root.cwiseInverse().asDiagonal() * information * root.cwiseInverse().asDiagonal();
  scaled.diagonal().array() += 1e-15;
  const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
  const Eigen::MatrixXd inverted = factor.solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols()));
  return root.cwiseInverse().asDiagonal() * inverted * root.cwiseInverse().asDiagonal();
}

// Why a line is not given although it was fitted; empty: it is. A linearised covariance means nothing where gravity's direction
// rests on the prior alone, or where it spans more than the linearisation.
std::string why_vague(const JointAxis& axis, bool gravity_seen) {
  const bool slides = axis.screw.type == JointType::prismatic;
  if (!gravity_seen && !slides) {
    return "gravity hardly turns in the sensor's frame in this recording, so neither its direction nor the sensor's bias can be told "
           "from the motion; hold still at six or more orientations of the sensor well apart, 1 s each";
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

// What a joint's motions alone and its dwells looked like, for the page.
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
        if (problem.rows.dwells[i].position == static_dwell.joint_positions) {
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

}  // namespace

WholeArmCalibration calibrate_whole_arm(const Recording& recording, const Segmentation& segmentation,
                                        const WholeArmOptions& options) {
  validate(recording, options);
  const Index joints = recording.joints();
  WholeArmCalibration result;
  const JointCalibrationOptions single = joint_options(options);
  result.joints = calibrate_joints(recording, segmentation, single);
  const Eigen::VectorXd resolution = encoder_resolution(recording, single);
  std::vector<bool> moves;
  std::vector<bool> known;
  for (Index j = 0; j < joints; ++j) {
    const auto column = recording.joint_positions.col(j);
    moves.push_back(column.maxCoeff() - column.minCoeff() > std::max(options.min_travel, 3.0 * resolution[j]));
    known.push_back(result.joints.joints[static_cast<std::size_t>(j)].axis.has_value());
  }
  if (std::none_of(moves.begin(), moves.end(), [](bool moved_at_all) { return moved_at_all; })) {
    throw NotIdentifiable("no joint moves by more than " + std::to_string(options.min_travel) +
                          " rad in this recording; nothing can be seen of the arm. Record motions of its joints");
  }

  ArmProblem problem;
  problem.threads = options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  result.gyroscope_used = options.use_gyroscope && recording.angular_velocity.has_value();
  result.cutoff = options.cutoff > 0.0 ? options.cutoff : choose_common_cutoff(recording, segmentation, resolution);
  problem.rows = make_rows(recording, segmentation, resolution, result.cutoff, result.gyroscope_used);
  result.samples = problem.rows.samples;
  if (problem.rows.stretches.empty()) {
    throw NotIdentifiable("the recording has no stretch of motion of a few tenths of a second without a gap; record longer motions");
  }
  name_kinds(problem.rows, joints);

  ArmState state = initial_state(recording, result.joints, options);
  problem.prior.gravity = options.gravity_magnitude;
  const ArmStart start = find_start(problem, state, known, moves, options.random_starts, options.seed);
  result.starts_tried = start.tried;
  if (!start.found) {
    for (JointEstimate& estimate : result.joints.joints) {
      if (!estimate.axis) {
        estimate.reason += "; nor does any of " + std::to_string(start.tried) + " starts explain the motions of several joints twice";
      }
    }
    return result;
  }
  state = start.state;
  lay_out(problem, state, moves, options);
  hold_fixed(state, problem.layout, options.sensor);

  problem.noise = white_noise(problem.rows, 0.1, 0.02, 0.01);
  Eigen::MatrixXd covariance;
  NormalEquations all;
  std::vector<PartEquations> parts;
  problem.offsets = Eigen::VectorXd::Zero(problem.rows.offset_covariance.rows());
  for (int pass = 0; pass < options.max_passes && !result.converged; ++pass) {
    const ArmSolution solution = solve(problem, state, 50);
    result.iterations += solution.iterations;
    const ArmState before = state;
    state = solution.state;
    parts = linearise_data(problem, state);
    all = marginal(problem, parts);
    problem.offsets = best_offsets(problem, parts);
    const NormalEquations prior = linearise_prior(problem, state);
    covariance = inverse(all.information + prior.information);
    result.converged = pass > 2 && solution.converged && largest_step(before, state, problem.layout, covariance) < still;
    ArmResiduals now = residuals(problem, state);
    if (pass > 0 && pass < 4) {
      const Index cut = cut_knocks(problem.rows, now);
      result.outliers += cut;
      now = residuals(problem, state);
    }
    if (!result.converged && pass + 1 < options.max_passes) {
      problem.noise = estimate_noise(problem.rows, now.moving, now.dwells, now.dwell_variance, static_cast<double>(problem.layout.columns));
    }
  }
  const ArmResiduals final_residuals = residuals(problem, state);
  const NormalEquations prior = linearise_prior(problem, state);
  double squares = final_residuals.dwells_normalized.squaredNorm();
  result.rows = final_residuals.dwells_normalized.size();
  for (const Eigen::MatrixXd& whitened : final_residuals.whitened) {
    squares += whitened.squaredNorm();
    result.rows += whitened.size();
  }
  result.normalized_rms = std::sqrt(squares / static_cast<double>(result.rows));

  const Eigen::MatrixXd covariance_information = all.information + prior.information;
  result.covariance = covariance;
  if (problem.prior.gravity_known) {
    all += linearise_gravity(problem, state);
  }
  const Identifiability seen = identifiability(all, covariance, state, problem.layout);
  result.rank = seen.rank;
  result.condition_number = seen.condition_number;
  result.weak = seen.weak;
  const std::vector<std::string> names = parameter_names(state, problem.layout);
  const Eigen::VectorXd value = values(state, problem.layout);
  for (Index k = 0; k < problem.layout.columns; ++k) {
    result.parameters.push_back({names[static_cast<std::size_t>(k)], value[k], std::sqrt(std::max(0.0, covariance(k, k))), seen.data_std[k]});
  }
  result.stretches = hold_out(problem, state, parts, covariance_information, final_residuals);

  result.clock_offset = state.clock_offset;
  result.clock_rate = state.clock_rate;
  result.encoder_gain = state.encoder_gain;
  result.eccentricity = state.eccentricity;
  result.gyroscope_bias = state.gyroscope_bias;
  result.gyroscope_matrix = state.gyroscope_matrix;

  const bool gravity_seen = seen.data_std.segment<3>(problem.layout.up_gravity).maxCoeff() < vague_gravity * options.gravity_magnitude;
  JointCalibration& estimate = result.joints;
  estimate.covariance = Eigen::MatrixXd::Zero(4 * joints, 4 * joints);
  for (Index i = 0; i < joints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Index column = problem.layout.lines[at];
    JointEstimate& mine = estimate.joints[at];
    mine.axis.reset();
    if (column < 0) {
      if (mine.reason.empty()) {
        mine.reason = "it hardly moves in this recording; move it, alone or with others";
      }
      continue;
    }
    const Index count = state.axes[at].type == JointType::revolute ? 4 : 2;
    for (Index k = 0; k < joints; ++k) {
      const Index other = problem.layout.lines[static_cast<std::size_t>(k)];
      if (other >= 0) {
        const Index other_count = state.axes[static_cast<std::size_t>(k)].type == JointType::revolute ? 4 : 2;
        estimate.covariance.block(4 * i, 4 * k, count, other_count) = covariance.block(column, other, count, other_count);
      }
    }
    mine.axis = JointAxis{state.axes[at], estimate.covariance.block<4, 4>(4 * i, 4 * i)};
    mine.reason = why_vague(*mine.axis, gravity_seen);
    if (!mine.reason.empty()) {
      mine.axis.reset();
    }
  }
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
  spread(problem.layout.bias, 0);
  spread(problem.layout.scale, 3);
  spread(problem.layout.misalignment, 6);
  spread(problem.layout.second_order, 9);
  if (problem.layout.percussion_distance >= 0) {
    estimate.percussion_distance_std = covariance.diagonal().segment<3>(problem.layout.percussion_distance).cwiseMax(0.0).cwiseSqrt();
  }
  estimate.converged = result.converged;
  estimate.unseen.clear();
  for (const WeakCombination& weak : result.weak) {
    estimate.unseen.push_back(weak.description);
  }
  record_signals(estimate, segmentation, problem, final_residuals);
  return result;
}

}  // namespace circlepoint
