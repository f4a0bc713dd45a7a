#include "circlepoint/identification/joint_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "circlepoint/core/error.hpp"
#include "joint_work.hpp"
#include "prismatic_fit.hpp"
#include "reference_configuration.hpp"

namespace circlepoint {
namespace {

constexpr double degree = 0.017453292519943295;

std::string one_decimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

std::string joint_name(Index joint) { return "joint " + std::to_string(joint + 1); }

// Still poses that differ by more than encoders and control loops make them.
Index distinct_angles(Eigen::VectorXd angles) {
  std::sort(angles.begin(), angles.end());
  Index distinct = angles.size() > 0 ? 1 : 0;
  for (Index i = 1; i < angles.size(); ++i) {
    distinct += angles[i] - angles[i - 1] > 3.0 * degree ? 1 : 0;
  }
  return distinct;
}

void validate(const Recording& recording, const JointCalibrationOptions& options) {
  const Index joints = recording.joints();
  require(options.joint_types.empty() || static_cast<Index>(options.joint_types.size()) == joints,
          "joint_types has " + std::to_string(options.joint_types.size()) + " entries for " + std::to_string(joints) +
              " joints; give one per joint, base to tip");
  require(options.encoder_resolution.size() == 0 || options.encoder_resolution.size() == joints,
          "encoder_resolution has " + std::to_string(options.encoder_resolution.size()) + " entries for " +
              std::to_string(joints) + " joints; give one per joint, or none");
  require(!options.reference_configuration || options.reference_configuration->size() == joints,
          "reference_configuration has " +
              std::to_string(options.reference_configuration ? options.reference_configuration->size() : 0) + " entries for " +
              std::to_string(joints) + " joints; give one per joint, base to tip");
  require(options.gravity > 0.0, "gravity is " + std::to_string(options.gravity) + " m/s^2; give the local magnitude, about 9.8");
  require(options.cutoff >= 0.0 && options.cutoff < 0.5 * recording.sample_rate,
          "cutoff is " + std::to_string(options.cutoff) + " Hz; give 0 (chosen per test) or less than half the sample rate of " +
              std::to_string(recording.sample_rate) + " Hz");
}

Samples3 dwell_means(const Segmentation& segmentation) {
  Samples3 means(static_cast<Index>(segmentation.dwells.size()), 3);
  for (Index i = 0; i < means.rows(); ++i) {
    means.row(i) = segmentation.dwells[static_cast<std::size_t>(i)].specific_force;
  }
  return means;
}

// Of a dwell's mean, by the scatter of its own samples; the median dwell.
double dwell_noise(const Segmentation& segmentation) {
  std::vector<double> noise;
  for (const StaticDwell& dwell : segmentation.dwells) {
    noise.push_back(dwell.specific_force_std.norm() / std::sqrt(3.0 * static_cast<double>(std::max<Index>(1, dwell.samples.size()))));
  }
  if (noise.empty()) {
    return 0.0;
  }
  const auto middle = noise.begin() + static_cast<std::ptrdiff_t>(noise.size() / 2);
  std::nth_element(noise.begin(), middle, noise.end());
  return *middle;
}

// Of a joint's tests the one with the widest motion; the others differ in the configuration of the other joints.
std::optional<Index> best_test(const Segmentation& segmentation, Index joint) {
  std::optional<Index> best;
  for (Index i = 0; i < static_cast<Index>(segmentation.tests.size()); ++i) {
    const JointTest& test = segmentation.tests[static_cast<std::size_t>(i)];
    if (test.joint != joint || test.motions.empty()) {
      continue;
    }
    if (!best || test.motion_span > segmentation.tests[static_cast<std::size_t>(*best)].motion_span) {
      best = i;
    }
  }
  return best;
}

// What to record of a joint that has no test of its own.
std::string missing_test(JointType type, double travel) {
  const bool slides = type == JointType::prismatic;
  const std::string remedy = slides ? "move it alone, such as 0.5 Hz over 0.3 m for 6 s"
                                    : "turn it alone, still poses and a motion such as 0.5 Hz over 150 degrees for 6 s";
  if (travel < (slides ? 0.002 : 0.01)) {
    return "it never moves in this recording; " + remedy;
  }
  return "it never moves alone in this recording (it travels " +
         (slides ? one_decimal(1e3 * travel) + " mm" : one_decimal(travel / degree) + " degrees") +
         ", always together with others or too short); " + remedy;
}

std::vector<JointWork> gather_all(const Recording& recording, const Segmentation& segmentation, const SensorFromGravity& sensor,
                                  const JointCalibrationOptions& options) {
  const Eigen::VectorXd resolution = encoder_resolution(recording, options);
  std::vector<JointWork> work(static_cast<std::size_t>(recording.joints()));
  for (Index joint = 0; joint < recording.joints(); ++joint) {
    JointWork& mine = work[static_cast<std::size_t>(joint)];
    mine.type = options.joint_types.empty() ? JointType::revolute : options.joint_types[static_cast<std::size_t>(joint)];
    const std::optional<Index> test = best_test(segmentation, joint);
    if (test) {
      mine.samples = gather(recording, segmentation, *test, sensor.sensor, resolution, options);
      mine.regression = make_regression(*mine.samples, options.filter_order);
      continue;
    }
    const auto column = recording.joint_positions.col(joint);
    mine.reason = missing_test(mine.type, column.maxCoeff() - column.minCoeff());
  }
  return work;
}

JointModelPrior prior_for(const SensorFromGravity& sensor, const JointCalibrationOptions& options, double static_std) {
  JointModelPrior prior;
  const double bias = std::sqrt(sensor.covariance.diagonal().head<3>().mean());
  const double scale = std::sqrt(sensor.covariance.diagonal().segment<3>(3).mean());
  const double floor = std::max(static_std, 1e-4);
  prior.bias_std = std::hypot(bias, floor);
  prior.gravity = options.gravity;
  prior.gravity_std = std::hypot(prior.bias_std, scale * options.gravity);
  prior.percussion_distance = options.sensor.percussion_distance;
  prior.percussion_distance_std = options.sensor.percussion_distance_std;
  return prior;
}

// Fits every joint that has a test, corrected for yielding by `chain` unless it is null; a test that does not determine its
// joint leaves the reason.
void fit_all(std::vector<JointWork>& work, const PartialChain* chain, const SensorFromGravity& sensor,
             const JointCalibrationOptions& options, double sample_rate) {
  for (JointWork& mine : work) {
    if (!mine.samples) {
      continue;
    }
    try {
      const TestNoise noise = mine.fitted ? mine.fitted->noise : TestNoise{};
      const bool slides = mine.type == JointType::prismatic;
      if (options.method != CalibrationMethod::joint) {
        mine.fitted = slides ? fit_prismatic_by_paper(*mine.samples, mine.regression, sample_rate, options)
                             : fit_by_paper(*mine.samples, mine.regression, options.method, sample_rate, options);
        continue;
      }
      const TestRegression regression =
          chain != nullptr ? without_yielding(mine.regression, *mine.samples, *chain, options.filter_order) : mine.regression;
      mine.fitted = slides ? fit_prismatic(*mine.samples, regression, noise, options)
                           : fit_by_regression(*mine.samples, regression, prior_for(sensor, options, noise.static_std), noise);
    } catch (const NotIdentifiable& error) {
      mine.reason = error.what();
      mine.samples.reset();
      mine.fitted.reset();
    }
  }
}

Placed place(std::vector<JointWork>& work, const Eigen::VectorXd& reference, const ArmJoints& arm) {
  Placed placed;
  placed.axes.resize(work.size());
  placed.types = arm.types;
  std::vector<bool> known(work.size(), false);
  placed.configurations.resize(work.size());
  for (std::size_t i = work.size(); i-- > 0;) {
    if (!work[i].fitted) {
      continue;
    }
    placed.configurations[i] = work[i].fitted->fit.configuration;
    const std::optional<Index> obstacle = obstacle_between(known, placed.configurations[i], reference, static_cast<Index>(i), arm);
    if (obstacle) {
      work[i].reason = "its own test stands, but its line cannot be carried to the reference configuration: " +
                       joint_name(*obstacle) + " beyond it stood elsewhere then and is not known; record " +
                       joint_name(*obstacle) + " moving alone";
    } else {
      work[i].reason.clear();
      placed.axes[i] = ScrewAxis{work[i].type, work[i].fitted->fit.model.line()};
      known[i] = true;
    }
  }
  placed.chain = carry_all(placed.axes, placed.configurations, reference);
  return placed;
}

// Mean of the dwells' readings in base coordinates, over dwells whose unknown joints stand at the reference.
Eigen::Vector3d mean_up_gravity(const PartialChain& chain, const Segmentation& segmentation, const AccelerometerModel& sensor,
                                const Eigen::VectorXd& tolerance) {
  std::vector<Index> columns;
  const ScrewChain known = chain.known(columns);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const StaticDwell& dwell : segmentation.dwells) {
    bool usable = true;
    for (Index j = 0; j < chain.size(); ++j) {
      usable = usable && (chain.knows(j) || std::abs(dwell.joint_positions[j] - chain.reference_configuration[j]) < tolerance[j]);
    }
    if (usable) {
      const RigidTransform pose = forward_kinematics(known, dwell.joint_positions(columns));
      sum += pose.linear() * sensor.correct(dwell.specific_force, Eigen::Vector3d::Zero());
      weight += 1.0;
    }
  }
  return weight > 0.0 ? Eigen::Vector3d(sum / weight) : Eigen::Vector3d::Zero();
}

bool shows_percussion(const JointWork& work) {
  return work.fitted && work.fitted->fit.percussion_distance_std.minCoeff() > 0.0;
}

void combine_percussion(const std::vector<JointWork>& work, const JointCalibrationOptions& options, JointCalibration& result) {
  Eigen::Array3d weight = Eigen::Array3d::Zero();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const JointWork& mine : work) {
    if (shows_percussion(mine)) {
      const Eigen::Array3d w = mine.fitted->fit.percussion_distance_std.array().square().inverse();
      weight += w;
      sum += w * mine.fitted->fit.model.percussion_distance.array();
    }
  }
  if (weight.minCoeff() > 0.0) {
    // The sensor's static errors are common to all joints and do not average out.
    Eigen::Array3d by_sensor = Eigen::Array3d::Zero();
    for (const JointWork& mine : work) {
      if (shows_percussion(mine)) {
        const PercussionJacobian& jacobian = mine.fitted->percussion_jacobian;
        const Eigen::Array3d w = mine.fitted->fit.percussion_distance_std.array().square().inverse() / weight;
        by_sensor += w * (jacobian * result.sensor.covariance * jacobian.transpose()).diagonal().array();
      }
    }
    result.percussion_distance = sum / weight;
    result.percussion_distance_std = (weight.inverse() + by_sensor).sqrt();
  } else {
    result.percussion_distance.setConstant(options.sensor.percussion_distance);
    result.percussion_distance_std.setConstant(options.sensor.percussion_distance_std);
  }
}

double largest_change(const Placed& before, const Placed& after, const std::vector<JointWork>& work) {
  double largest = 0.0;
  for (std::size_t i = 0; i < after.axes.size(); ++i) {
    if (!after.chain.axes[i] || !before.chain.axes[i]) {
      largest = std::max(largest, before.chain.axes[i].has_value() == after.chain.axes[i].has_value() ? 0.0 : 1e9);
      continue;
    }
    const Eigen::Vector4d change = local_coordinates(before.chain.axes[i]->line, after.chain.axes[i]->line);
    const Eigen::Vector4d std = work[i].fitted->fit.noise_covariance.diagonal().cwiseMax(1e-16).cwiseSqrt();
    largest = std::max(largest, change.cwiseAbs().cwiseQuotient(std).maxCoeff());
  }
  return largest;
}

void name_unseen_sliding(JointCalibration& result, const TestFit& fit) {
  constexpr double well_seen = 5e-3;  // rad
  const double direction_std = std::sqrt(fit.noise_covariance.diagonal().head<2>().maxCoeff());
  if (direction_std > well_seen) {
    result.unseen.push_back(joint_name(fit.joint) + " direction: it accelerated by " + one_decimal(1e3 * fit.acceleration_rms) +
                            " mm/s^2 rms only, which shows its direction to " + one_decimal(1e3 * direction_std) +
                            " mrad; move it faster, such as 0.5 Hz over 0.3 m");
  }
}

void name_unseen(JointCalibration& result, const Segmentation& segmentation) {
  for (const TestFit& fit : result.fits) {
    const JointTest& test = segmentation.tests[static_cast<std::size_t>(fit.test)];
    if (fit.type == JointType::prismatic) {
      name_unseen_sliding(result, fit);
      continue;
    }
    if (fit.gravity_share < 0.1) {
      result.unseen.push_back(joint_name(fit.joint) + " direction x bias: its axis is within " +
                              one_decimal(std::asin(std::min(1.0, fit.gravity_share)) / degree) +
                              " degrees of gravity, so a tilt of it reads like a bias; tilt the base, or estimate the bias "
                              "from tests of the other joints");
    }
    if (const Index angles = distinct_angles(fit.dwell_positions); angles < 3) {
      result.unseen.push_back(joint_name(fit.joint) + " direction x centre: still at " + std::to_string(angles) +
                              (angles == 1 ? " angle" : " angles") +
                              " only, and in motion cos(angle) looks like acceleration; hold the joint still at more angles, "
                              "1 s each");
    }
    if (std::max(test.motion_span, test.dwell_span) < 0.5) {
      result.unseen.push_back(joint_name(fit.joint) + " line: it turned by " +
                              one_decimal(std::max(test.motion_span, test.dwell_span) / degree) +
                              " degrees only; a wider arc shows its line better");
    }
  }
}

}  // namespace

bool JointCalibration::complete() const {
  return std::all_of(joints.begin(), joints.end(), [](const JointEstimate& joint) { return joint.axis.has_value(); });
}

ScrewChain JointCalibration::chain() const {
  ScrewChain chain;
  std::string missing;
  for (const JointEstimate& joint : joints) {
    if (joint.axis) {
      chain.axes.push_back(joint.axis->screw);
    } else {
      missing += (missing.empty() ? "" : ", ") + joint_name(joint.joint);
    }
  }
  if (!missing.empty()) {
    throw NotIdentifiable("no chain: " + missing + " could not be estimated; see the reason of each");
  }
  chain.reference_configuration = reference_configuration;
  return chain;
}

JointCalibration calibrate_joints(const Recording& recording, const Segmentation& segmentation,
                                  const JointCalibrationOptions& options) {
  validate(recording, options);
  SegmentationOptions thresholds;
  thresholds.joint_types = options.joint_types;
  const ArmJoints arm{
      options.joint_types.empty() ? std::vector<JointType>(static_cast<std::size_t>(recording.joints()), JointType::revolute)
                                  : options.joint_types,
      thresholds.configuration_tolerance * threshold_units(thresholds, recording.joints())};
  JointCalibration result;
  result.sensor = fit_sensor_from_gravity(dwell_means(segmentation), options.sensor, options.gravity,
                                          options.adapt_sensor_prior, dwell_noise(segmentation));
  const bool regression = options.method == CalibrationMethod::joint;
  if (!regression) {
    // The paper's methods take the readings as they are; its subtraction of the static model removes the bias. The whole
    // error then stays in them: its second moment takes the place of the covariance about an estimate.
    Eigen::Matrix<double, sensor_errors, 1> left_in;
    left_in << result.sensor.sensor.bias, result.sensor.sensor.scale, result.sensor.sensor.misalignment,
        result.sensor.sensor.second_order;
    result.sensor.covariance += left_in * left_in.transpose();
    result.sensor.sensor = AccelerometerModel{};
  }
  std::vector<JointWork> work = gather_all(recording, segmentation, result.sensor, options);

  fit_all(work, nullptr, result.sensor, options, recording.sample_rate);
  std::vector<std::optional<Eigen::VectorXd>> tested;
  for (const JointWork& mine : work) {
    tested.push_back(mine.fitted ? std::optional(mine.fitted->fit.configuration) : std::nullopt);
  }
  result.reference_configuration =
      options.reference_configuration ? *options.reference_configuration
                                      : choose_reference(segmentation, tested, recording.joint_positions.row(0), arm);
  Placed placed = place(work, result.reference_configuration, arm);
  const auto complete_chain = [&] {
    combine_percussion(work, options, result);
    placed.chain.percussion_distance = result.percussion_distance;
    placed.chain.up_gravity = mean_up_gravity(placed.chain, segmentation, result.sensor.sensor, arm.tolerance);
  };
  complete_chain();
  result.passes = 1;
  result.converged = !regression;
  while (regression && result.passes < options.max_passes && !result.converged) {
    fit_all(work, options.use_resting_encoders ? &placed.chain : nullptr, result.sensor, options, recording.sample_rate);
    Placed next = place(work, result.reference_configuration, arm);
    // The noise that weighs the fits also settles: two passes at least.
    result.converged = result.passes > 1 && largest_change(placed, next, work) < 0.01;
    placed = std::move(next);
    complete_chain();
    ++result.passes;
  }

  result.up_gravity_sensor = placed.chain.up_gravity;
  result.covariance = covariance_at_reference(work, placed, result.sensor, encoder_resolution(recording, options),
                                              regression && options.use_resting_encoders);
  for (Index i = 0; i < recording.joints(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    JointEstimate estimate;
    estimate.joint = i;
    estimate.reason = work[at].reason;
    if (work[at].fitted) {
      estimate.fit = static_cast<Index>(result.fits.size());
      const auto& by_sensor = work[at].fitted->acceleration_scale_jacobian;
      const double variance = (by_sensor * result.sensor.covariance * by_sensor.transpose()).value();
      work[at].fitted->fit.acceleration_scale_std = std::hypot(work[at].fitted->fit.acceleration_scale_std, std::sqrt(variance));
      result.fits.push_back(std::move(work[at].fitted->fit));
    }
    if (placed.chain.axes[at]) {
      estimate.axis = JointAxis{*placed.chain.axes[at], result.covariance.block<4, 4>(4 * i, 4 * i)};
    }
    result.joints.push_back(std::move(estimate));
  }
  name_unseen(result, segmentation);
  return result;
}

}  // namespace circlepoint
