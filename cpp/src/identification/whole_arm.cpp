#include "circlepoint/identification/whole_arm.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "arm_kinds.hpp"
#include "arm_layout.hpp"
#include "arm_mirror.hpp"
#include "arm_report.hpp"
#include "arm_result.hpp"
#include "arm_settle.hpp"
#include "arm_solve.hpp"
#include "arm_start.hpp"
#include "arm_yield.hpp"
#include "circlepoint/core/error.hpp"
#include "test_samples.hpp"

namespace circlepoint {
namespace {

constexpr double poses_a_direction = 0.8; // rests for each coordinate of a direction and of gravity: 2.4 readings
constexpr double pinned_gravity = 1e-4;   // m/s^2

// What calibrate_joints does not check.
void validate(const Recording& recording, const WholeArmOptions& options) {
  require(options.cutoff >= 0.0 && options.cutoff < 0.5 * recording.sample_rate,
          "cutoff is " + std::to_string(options.cutoff) + " Hz; give 0 (chosen) or less than half the sample rate of " +
              std::to_string(recording.sample_rate) + " Hz");
  const auto check = [](const char* name, const ParameterTreatment& treatment, bool encoder = false) {
    require(encoder || !treatment.where_evident,
            std::string(name) + ": where_evident is for encoder_gain and eccentricity only; set estimated and std of the others");
    require(treatment.std >= 0.0, std::string(name) + ": std is " + std::to_string(treatment.std) + "; give a number from 0 to infinity");
  };
  check("bias", options.bias);
  check("scale", options.scale);
  check("misalignment", options.misalignment);
  check("percussion_distance", options.percussion_distance);
  check("second_order", options.second_order);
  check("gravity", options.gravity);
  check("clock_offset", options.clock_offset);
  check("clock_rate", options.clock_rate);
  check("encoder_gain", options.encoder_gain, true);
  check("eccentricity", options.eccentricity, true);
  check("gyroscope_bias", options.gyroscope_bias);
  check("gyroscope_matrix", options.gyroscope_matrix);
  check("gyroscope_delay", options.gyroscope_delay);
  require(options.clock_offset.estimated || !options.clock_rate.estimated,
          "clock_rate cannot be estimated while clock_offset is fixed; fix both or neither");
  for (Index joint = 0; joint < options.encoder_resolution.size(); ++joint) {
    const double count = options.encoder_resolution[joint];
    require(std::isfinite(count) && count >= 0.0,
            "encoder_resolution of joint " + std::to_string(joint + 1) + " is " + std::to_string(count) +
                "; give rad or m a count, or 0 for an exact encoder");
  }
  require(options.max_passes > 0, "max_passes is " + std::to_string(options.max_passes) + "; give 1 or more");
}

// Whether rests alone are enough to tell directions by: of few, several arms fit equally well.
void require_rests(std::size_t rests, Index turning, bool poses) {
  const auto enough = static_cast<std::size_t>(std::ceil(poses_a_direction * static_cast<double>(2 * turning + 3)));
  if (turning > 0 && rests >= enough) {
    return;
  }
  if (!poses) {
    throw NotIdentifiable("the recording has no stretch of motion of a few tenths of a second without a gap; record longer motions");
  }
  if (turning == 0) {
    throw NotIdentifiable("only sliding joints move, and rests show nothing of them; move each, such as 0.5 Hz over 0.3 m for 6 s");
  }
  throw NotIdentifiable(std::to_string(rests) + " still poses are too few to tell the directions of " + std::to_string(turning) +
                        " joints; record " + std::to_string(enough) + " at least, better " + std::to_string(2 * enough));
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

ArmState initial_state(const Recording& recording, const JointCalibration& start, const WholeArmOptions& options) {
  const Index joints = recording.joints();
  ArmState state;
  state.reference = start.reference_configuration;
  state.up_gravity = start.up_gravity_sensor;
  state.sensor = start.sensor.sensor;
  state.sensor.percussion_distance = start.percussion_distance;
  state.encoder_gain = Eigen::VectorXd::Zero(joints);
  state.eccentricity = Eigen::Matrix2Xd::Zero(2, joints);
  for (Index j = 0; j < joints; ++j) {
    const auto& estimate = start.joints[static_cast<std::size_t>(j)];
    const JointType type = options.joint_types.empty() ? JointType::revolute : options.joint_types[static_cast<std::size_t>(j)];
    state.axes.push_back(estimate.axis ? estimate.axis->screw : ScrewAxis{type, Line{}});
  }
  return state;
}

// rad, by the data alone or by what is known of the sensor. A magnitude that is estimated and that nothing shows hides no direction.
double gravity_direction_std(const ArmProblem& problem, const ArmState& state, const NormalEquations& data, const Identifiability& seen,
                             const Eigen::MatrixXd& covariance, bool sensor_is_known) {
  const Index at = problem.layout.up_gravity;
  const double magnitude = problem.prior.gravity;
  Eigen::Vector3d data_std = seen.data_std.segment<3>(at);
  if (!problem.prior.gravity_known) {
    NormalEquations with_magnitude = data;
    with_magnitude += linearise_gravity(problem.layout, state, magnitude, pinned_gravity);
    data_std = identifiability(with_magnitude, covariance, state, problem.layout).data_std.segment<3>(at);
  }
  double std = data_std.maxCoeff();
  if (sensor_is_known) {
    const Eigen::Vector3d up = state.up_gravity.normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - up * up.transpose();
    const Eigen::Matrix3d known = across * covariance.block<3, 3>(at, at) * across;
    std = std::min(std, std::sqrt(std::max(0.0, known.diagonal().maxCoeff())));
  }
  return std / magnitude;
}

}  // namespace

WholeArmCalibration calibrate_whole_arm(const Recording& recording, const Segmentation& segmentation,
                                        const WholeArmOptions& options) {
  validate(recording, options);
  const Index joints = recording.joints();
  WholeArmCalibration result;
  JointCalibrationOptions single = joint_options(options);
  if (single.encoder_resolution.size() == 0) {
    single.encoder_resolution = encoder_resolution(recording, single);  // once: all samples are looked at
  }
  JointCalibrationOptions quick = single;  // what is good enough to start from
  quick.use_resting_encoders = false;
  quick.max_passes = 2;
  result.joints = calibrate_joints(recording, segmentation, quick);
  const Eigen::VectorXd& resolution = single.encoder_resolution;
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
  result.gyroscope_used = options.use_gyroscope && recording.angular_velocity.has_value() && !recording.is_static();
  result.cutoff = options.cutoff > 0.0 ? options.cutoff : choose_common_cutoff(recording, segmentation, resolution);
  problem.rows = make_rows(recording, segmentation, resolution, result.cutoff, result.gyroscope_used);
  result.samples = problem.rows.samples;
  problem.layout.points = !problem.rows.stretches.empty();
  if (!problem.layout.points) {
    for (std::size_t j = 0; j < moves.size(); ++j) {
      moves[j] = moves[j] && (options.joint_types.empty() || options.joint_types[j] == JointType::revolute);
    }
    require_rests(problem.rows.dwells.size(), std::count(moves.begin(), moves.end(), true), recording.is_static());
  }
  name_kinds(problem.rows);

  ArmState state = initial_state(recording, result.joints, options);
  problem.prior.gravity = options.gravity_magnitude;
  const ArmStart start = find_start(problem, state, known, moves, options.random_starts, options.seed);
  result.starts_tried = start.tried;
  if (!start.found) {
    result.joints = calibrate_joints(recording, segmentation, single);
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

  constexpr double moving_guess = 0.1;  // m/s^2
  constexpr double dwell_guess = 0.02;  // m/s^2
  constexpr double rate_guess = 0.01;   // rad/s
  const auto begin_anew = [&] {
    problem.noise = white_noise(problem.rows, moving_guess, dwell_guess, rate_guess);
    problem.offsets = Eigen::VectorXd::Zero(problem.rows.offset_covariance.rows());
  };
  begin_anew();
  if (problem.rows.yields) {
    // Now that the lines are known, so are the loads that coarse encoders show their joints yield to.
    const ArmSolution first = solve(problem, state, most_iterations, last_change);
    result.iterations += first.iterations;
    state = first.state;
    const KnownArm arm{{state.axes, state.reference}, moves, state.up_gravity};
    ArmRows tied = make_rows(recording, segmentation, resolution, result.cutoff, result.gyroscope_used, &arm);
    if (!tied.stretches.empty()) {
      problem.rows = std::move(tied);
      result.samples = problem.rows.samples;
      name_kinds(problem.rows);
      begin_anew();
    }
  }
  ArmFit fit{std::move(problem), std::move(state)};
  const std::vector<bool> ambiguous = settle_among_mirrored(fit, moves, options);
  result.iterations += fit.iterations;
  result.outliers = fit.outliers;
  result.unsettled = fit.unsettled;
  result.converged = fit.converged;
  result.noise_inflation = fit.problem.noise.inflation;
  result.rows = fit.problem.rows.equations();
  result.normalized_rms = std::sqrt(normalised_squares(fit) / static_cast<double>(result.rows));

  result.covariance = fit.covariance;
  if (fit.problem.prior.gravity_known) {
    fit.data += linearise_gravity(fit.problem.layout, fit.state, fit.problem.prior.gravity, fit.problem.prior.gravity_std);
  }
  const Identifiability seen = identifiability(fit.data, fit.covariance, fit.state, fit.problem.layout);
  result.rank = seen.rank;
  result.condition_number = seen.condition_number;
  result.weak = seen.weak;
  const std::vector<std::string> names = parameter_names(fit.state, fit.problem.layout);
  const Eigen::VectorXd value = values(fit.state, fit.problem.layout);
  for (Index k = 0; k < fit.problem.layout.columns; ++k) {
    const double std = std::sqrt(std::max(0.0, fit.covariance(k, k)));
    result.parameters.push_back({names[static_cast<std::size_t>(k)], value[k], std, seen.data_std[k]});
  }
  result.stretches = hold_out(fit.problem, fit.state, fit.parts, fit.information, fit.now);

  result.clock_offset = fit.state.clock_offset;
  result.clock_rate = fit.state.clock_rate;
  result.encoder_gain = fit.state.encoder_gain;
  result.eccentricity = fit.state.eccentricity.transpose();
  result.gyroscope_bias = fit.state.gyroscope_bias;
  result.gyroscope_matrix = fit.state.gyroscope_matrix;
  result.gyroscope_delay = fit.state.gyroscope_delay;

  const double gravity_std = gravity_direction_std(fit.problem, fit.state, fit.data, seen, fit.covariance, options.sensor_is_known);
  const double rest_rms = fit.now.dwells.rows() > 0 ? std::sqrt(fit.now.dwells.leftCols<3>().cwiseAbs2().mean()) : 0.0;
  write_lines(result.joints, fit.problem.layout, fit.state, fit.covariance,
              {gravity_std, options.sensor_is_known, seen.data_std, rounding_share(fit.problem.rows, resolution), ambiguous,
               rest_rms});
  write_sensor(result.joints, fit.problem.layout, fit.state, fit.covariance);
  result.joints.converged = result.converged;
  result.joints.unseen.clear();
  for (const WeakCombination& weak : result.weak) {
    result.joints.unseen.push_back(weak.description);
  }
  record_signals(result.joints, segmentation, fit.problem, fit.now);
  return result;
}

}  // namespace circlepoint
