#include "circlepoint/identification/joint_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "circlepoint/core/error.hpp"
#include "support/matchers.hpp"
#include "support/recorded_arm.hpp"

namespace circlepoint {
namespace {

using support::four_joints;
using testing::HasSubstr;
using testing::IsEmpty;

const Eigen::Vector3d up = support::up_gravity_four_joints;
const AccelerometerSpecification good_sensor{.bias_std = 2e-3, .scale_std = 1e-4, .misalignment_std = 5e-5,
                                             .percussion_distance = 0.0182, .percussion_distance_std = 2.5e-4};

JointCalibration calibrated(const Recording& recording, const JointCalibrationOptions& options = {}) {
  return calibrate_joints(recording, segment(recording), options);
}

// Local coordinates of the true line at the estimated one, in standard deviations.
Eigen::Vector4d errors_in_std(const JointEstimate& estimate, const ScrewChain& truth) {
  const Line& line = truth.axes[static_cast<std::size_t>(estimate.joint)].line;
  const Eigen::Vector4d error = local_coordinates(estimate.axis->screw.line, line);
  return error.cwiseQuotient(estimate.axis->covariance.diagonal().cwiseSqrt());
}

std::vector<Excitation> all_tests() { return support::joint_tests({0, 1, 2, 3}); }

class CalibrationMethods : public testing::TestWithParam<CalibrationMethod> {};

TEST_P(CalibrationMethods, LinesAreWithinTheirOwnStandardDeviations) {
  const ScrewChain chain = four_joints();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const AccelerometerModel sensor = draw_accelerometer(good_sensor, seed);
    const Recording recording = support::record_tests(
        chain, up, all_tests(), sensor,
        {.noise_std = 1e-3, .encoder_counts_per_revolution = Eigen::Vector4d::Constant(4e5), .seed = seed});
    JointCalibrationOptions options;
    options.method = GetParam();
    options.sensor = good_sensor;
    const JointCalibration result = calibrated(recording, options);
    ASSERT_TRUE(result.complete());
    EXPECT_TRUE(result.converged);
    const ScrewChain truth = rebase(chain, result.reference_configuration);
    for (const JointEstimate& estimate : result.joints) {
      EXPECT_LT(errors_in_std(estimate, truth).cwiseAbs().maxCoeff(), 4.5) << "joint " << estimate.joint << ", seed " << seed;
      const double angle = (estimate.axis->screw.line.direction - truth.axes[static_cast<std::size_t>(estimate.joint)].line.direction).norm();
      EXPECT_LT(angle, 1e-3);
      EXPECT_LT(estimate.axis->point_std(), GetParam() == CalibrationMethod::joint ? 1e-3 : 0.05);
      EXPECT_THAT(estimate.reason, IsEmpty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Identification, CalibrationMethods,
                         testing::Values(CalibrationMethod::position, CalibrationMethod::velocity, CalibrationMethod::joint),
                         [](const auto& instance) {
                           return std::string(instance.param == CalibrationMethod::position   ? "Position"
                                              : instance.param == CalibrationMethod::velocity ? "Velocity"
                                                                                          : "Joint");
                         });

TEST(JointCalibration, ExactReadingsGiveTheChainAndItsGravity) {
  const ScrewChain chain = four_joints();
  const JointCalibration result = calibrated(support::record_tests(chain, up, all_tests()));
  const ScrewChain truth = rebase(chain, result.reference_configuration);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(result.joints[i].axis->screw.line, support::LineNear(truth.axes[i].line, 5e-5)) << "joint " << i;
  }
  const RigidTransform pose = forward_kinematics(chain, result.reference_configuration);
  EXPECT_THAT(result.up_gravity_sensor, support::EntriesNear(pose.linear().transpose() * up, 1e-4));
}

TEST(JointCalibration, AnotherReferenceConfigurationGivesTheSameChain) {
  const ScrewChain chain = four_joints();
  const Recording recording = support::record_tests(chain, up, all_tests(), {}, {.noise_std = 1e-3, .seed = 4});
  const JointCalibration chosen = calibrated(recording);
  JointCalibrationOptions options;
  options.reference_configuration = Eigen::Vector4d(0.3, -0.8, 1.4, 0.2);
  const JointCalibration asked = calibrated(recording, options);
  EXPECT_EQ(asked.reference_configuration, *options.reference_configuration);
  const ScrewChain carried = rebase(chosen.chain(), asked.reference_configuration);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(asked.joints[i].axis->screw.line, support::LineNear(carried.axes[i].line, 1e-7)) << "joint " << i;
  }
  const RigidTransform carry = forward_kinematics(chosen.chain(), asked.reference_configuration);
  EXPECT_THAT(asked.up_gravity_sensor,
              support::EntriesNear(carry.linear().transpose() * chosen.up_gravity_sensor, 1e-6));
}

TEST(JointCalibration, JointsThatYieldAreCorrectedByTheirEncoders) {
  const ScrewChain chain = four_joints();
  const Recording recording =
      support::record_tests(chain, up, all_tests(), {}, {.compliance = Eigen::Vector4d::Constant(3e-4)});
  const auto worst = [&](bool use_resting_encoders) {
    JointCalibrationOptions options;
    options.use_resting_encoders = use_resting_encoders;
    const JointCalibration result = calibrated(recording, options);
    const ScrewChain truth = rebase(chain, result.reference_configuration);
    double angle = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      angle = std::max(angle, (result.joints[i].axis->screw.line.direction - truth.axes[i].line.direction).norm());
    }
    return angle;
  };
  EXPECT_LT(worst(true), 3e-5);
  EXPECT_GT(worst(false), 10.0 * worst(true));
}

TEST(JointCalibration, AJointThatNeverMovedAloneHasAReasonAndTheOthersAreThere) {
  const ScrewChain chain = four_joints();
  const Recording recording = support::record_tests(chain, up, support::joint_tests({0, 2, 3}));
  const JointCalibration result = calibrated(recording);
  EXPECT_FALSE(result.complete());
  EXPECT_FALSE(result.joints[1].axis);
  EXPECT_THAT(result.joints[1].reason, HasSubstr("never moves"));
  EXPECT_EQ(result.covariance.middleRows(4, 4).norm(), 0.0);
  const ScrewChain truth = rebase(chain, result.reference_configuration);
  for (const std::size_t i : {0U, 2U, 3U}) {
    ASSERT_TRUE(result.joints[i].axis) << result.joints[i].reason;
    EXPECT_THAT(result.joints[i].axis->screw.line, support::LineNear(truth.axes[i].line, 5e-5)) << "joint " << i;
  }
  try {
    static_cast<void>(result.chain());
    FAIL() << "a chain with a joint missing was given";
  } catch (const NotIdentifiable& error) {
    EXPECT_THAT(error.what(), HasSubstr("joint 2"));
  }
}

TEST(JointCalibration, ALineBeyondWhichAnUnknownJointStoodElsewhereIsRefused) {
  // Joint 3 is never alone; it stands 0.7 rad elsewhere, with joint 2, during the test of joint 1.
  std::vector<Excitation> pieces = support::joint_tests({3, 1});
  pieces.emplace_back(PointToPointMove{Eigen::Vector4d(-1.2, -0.5, -0.5, -1.2), 2.0});
  support::append_joint_test(pieces, 0);
  const ScrewChain chain = four_joints();
  const JointCalibration result = calibrated(support::record_tests(chain, up, pieces));
  EXPECT_THAT(result.joints[2].reason, HasSubstr("never moves alone"));
  EXPECT_FALSE(result.joints[0].axis);
  EXPECT_THAT(result.joints[0].reason, HasSubstr("joint 3 beyond it stood elsewhere"));
  EXPECT_GE(result.joints[0].fit, 0);
  const ScrewChain truth = rebase(chain, result.reference_configuration);
  for (const std::size_t i : {1U, 3U}) {
    ASSERT_TRUE(result.joints[i].axis) << result.joints[i].reason;
    EXPECT_THAT(result.joints[i].axis->screw.line, support::LineNear(truth.axes[i].line, 5e-5)) << "joint " << i;
  }
}

TEST(JointCalibration, StillPosesWithoutAMotionAreRefusedWithWhatToRecord) {
  std::vector<Excitation> pieces = support::joint_tests({1, 2, 3});
  const ScrewChain chain = four_joints();
  const JointCalibration result = calibrated(support::record_tests(chain, up, pieces));
  EXPECT_THAT(result.joints[0].reason, HasSubstr("turn it alone"));
}

TEST(JointCalibration, AVerticalAxisIsFoundAndItsWeaknessNamed) {
  ScrewChain chain = four_joints();
  const Recording recording = support::record_tests(
      chain, standard_gravity * forward_kinematics(chain, Eigen::VectorXd(Eigen::Vector4d(0.0, -1.2, -1.2, -1.2))).linear() *
                 axis_in_sensor_frame(chain, 0, Eigen::Vector4d(0.0, -1.2, -1.2, -1.2)).line.direction,
      all_tests(), {}, {.noise_std = 1e-3, .seed = 6});
  const JointCalibration result = calibrated(recording);
  ASSERT_TRUE(result.complete());
  const ScrewChain truth = rebase(chain, result.reference_configuration);
  EXPECT_LT(errors_in_std(result.joints[0], truth).cwiseAbs().maxCoeff(), 4.5);
  ASSERT_FALSE(result.unseen.empty());
  EXPECT_THAT(result.unseen.front(), HasSubstr("joint 1 direction x bias"));
}

TEST(JointCalibration, ASlidingJointShowsItsDirectionByItsAcceleration) {
  for (const std::size_t slides : {0U, 2U}) {
    ScrewChain chain = four_joints();
    chain.axes[slides].type = JointType::prismatic;
    std::vector<Excitation> pieces;
    JointCalibrationOptions options;
    for (Index joint = 0; joint < 4; ++joint) {
      const bool turns = joint != static_cast<Index>(slides);
      options.joint_types.push_back(turns ? JointType::revolute : JointType::prismatic);
      if (turns) {
        support::append_joint_test(pieces, joint);
      } else {
        pieces.emplace_back(RaisedCosine{.joint = joint, .span = 0.3, .frequency = 0.5, .duration = 4.0});
      }
    }
    SegmentationOptions thresholds;
    thresholds.joint_types = options.joint_types;
    const Recording recording = support::record_tests(chain, up, pieces);
    const JointCalibration result = calibrate_joints(recording, segment(recording, thresholds), options);
    ASSERT_TRUE(result.complete()) << result.joints[slides].reason;
    EXPECT_TRUE(result.converged);
    const ScrewChain truth = rebase(chain, result.reference_configuration);
    for (std::size_t i = 0; i < 4; ++i) {
      const Line& line = result.joints[i].axis->screw.line;
      EXPECT_THAT(line.direction, support::EntriesNear(truth.axes[i].line.direction, 5e-5)) << "joint " << i;
      EXPECT_THAT(line.point, support::EntriesNear(i == slides ? Eigen::Vector3d::Zero() : truth.axes[i].line.point, 5e-5));
    }
    EXPECT_EQ(result.joints[slides].axis->point_std(), 0.0);
  }
}

TEST(JointCalibration, OptionsThatDoNotFitTheRecordingAreRefused) {
  const Recording recording = support::record_tests(four_joints(), up, {Dwell{1.0}});
  const auto with = [](auto&& change) {
    JointCalibrationOptions options;
    change(options);
    return options;
  };
  for (const JointCalibrationOptions& options :
       {with([](auto& o) { o.joint_types = {JointType::revolute}; }),
        with([](auto& o) { o.encoder_resolution = Eigen::Vector2d(1e-5, 1e-5); }),
        with([](auto& o) { o.reference_configuration = Eigen::Vector3d::Zero(); }), with([](auto& o) { o.gravity = 0.0; }),
        with([](auto& o) { o.cutoff = 100.0; })}) {
    EXPECT_THROW(calibrated(recording, options), InvalidInput);
  }
}

}  // namespace
}  // namespace circlepoint
