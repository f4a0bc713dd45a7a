#pragma once
// From a segmented recording to every joint's axis, one joint at a time.
//
//   joint      the regression of joint_regression.hpp on each joint's dwells and motions, weighted by the noise found in
//              the residuals. Joints that should stand still yield to the control loop; their encoders tell, so once all axes
//              are known the readings are corrected by the difference between the whole chain's predicted reading and the
//              one with that joint alone, and the fits repeated until nothing changes.
//   position, velocity
//              the paper's two methods as printed (with the errata of docs/method): axis by the static plane fit, centre by
//              double or single integration, no correction for the other joints.
//
// A prismatic joint does not turn the sensor: it reads y = A + E s_ddot, and the direction is that of E. By the regression, or
// (position, velocity) as the straight line the integrated readings follow. It needs a motion and no rests; its line's point
// does not act, is zero, and has no variance.
//
// Each test gives its axis as a line in the sensor frame at the test's configuration; from tip to base the lines are carried
// to one reference configuration. Two joints of a chain can be estimated where the others cannot: what is missing is
// reported with its reason, and only lines that need an unknown joint to be carried are lost with it.
//
// Covariance: noise (blocks of correlated residuals, a sandwich), the sensor's remaining static errors (shared by all
// joints), encoder resolution, and the carrying. Sensor errors come from the dwells' magnitude (sensor_from_gravity.hpp).

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "circlepoint/chain/screw_chain.hpp"
#include "circlepoint/conditioning/segmentation.hpp"
#include "circlepoint/geometry/joint_axis.hpp"
#include "circlepoint/identification/joint_regression.hpp"
#include "circlepoint/identification/sensor_from_gravity.hpp"
#include "circlepoint/recording/recording.hpp"

namespace circlepoint {

enum class CalibrationMethod { position, velocity, joint };

struct JointCalibrationOptions {
  CalibrationMethod method = CalibrationMethod::joint;
  AccelerometerSpecification sensor;     ///< prior on the individual sensor
  bool adapt_sensor_prior = false;       ///< let the dwells set the prior's width (for an unspecified sensor)
  double gravity = standard_gravity;     ///< m/s^2, local magnitude
  double cutoff = 0.0;                   ///< Hz, of the filter both sides go through; 0: chosen per test
  int filter_order = 4;
  bool use_resting_encoders = true;      ///< correct for joints that yield
  int max_passes = 12;
  std::vector<JointType> joint_types;    ///< empty: all revolute
  Eigen::VectorXd encoder_resolution;    ///< (n) rad or m a count; empty: what steps are multiples of, none in still poses
  std::optional<Eigen::VectorXd> reference_configuration;  ///< (n) rad or m; absent: the dwell that serves most joints
};

/// One test's fit, in the sensor frame at the test's configuration, with what is needed to look at it.
struct TestFit {
  Index joint = 0;
  Index test = 0;                      ///< into Segmentation::tests
  JointType type = JointType::revolute;
  Eigen::VectorXd configuration;       ///< (n) rad or m
  JointModel model;                    ///< prismatic: axis and constant (up-gravity and bias) only
  Eigen::Matrix4d noise_covariance = Eigen::Matrix4d::Zero();  ///< of the line's local coordinates
  Eigen::Vector3d percussion_distance_std = Eigen::Vector3d::Zero();  ///< m
  double acceleration_rms = 0.0;        ///< m/s^2, prismatic: of the joint, filtered, about its mean
  double acceleration_scale = 1.0;      ///< prismatic: acceleration read by that of the encoder; 1 where both are right
  double acceleration_scale_std = 0.0;  ///< noise and the sensor's scale
  double cutoff = 0.0;                 ///< Hz
  double dwell_noise_std = 0.0;        ///< m/s^2, of a dwell's mean by the scatter of its own samples
  double static_noise_std = 0.0;       ///< m/s^2, of a dwell's mean about the model
  double dynamic_noise_std = 0.0;      ///< m/s^2, of filtered samples about the model
  double correlation_factor = 1.0;     ///< variance inflation of sums of dynamic residuals
  int parameters = 0;                  ///< of the model: line 4, gravity and bias 5, percussion distances 3; prismatic 6
  int rank = 0;                        ///< parameter combinations the data alone determine
  double condition_number = 0.0;       ///< of the scaled information matrix, data alone
  double gravity_share = 0.0;          ///< |up-gravity orthogonal to the axis| / g
  Index samples = 0;
  Index knocks = 0;                    ///< dynamic samples left out around residuals beyond six robust deviations
  int iterations = 0;
  bool converged = false;
  Eigen::VectorXd time;                ///< (M) s, dynamic samples
  Eigen::VectorXd position;            ///< (M) rad or m
  Samples3 measured;                   ///< (M, 3) m/s^2, filtered, corrected for sensor errors and yielding joints
  Samples3 modelled;                   ///< (M, 3) m/s^2, through the same filter
  Eigen::VectorXd dwell_positions;     ///< (K) rad or m
  Samples3 dwell_measured;             ///< (K, 3) m/s^2
  Samples3 dwell_modelled;             ///< (K, 3) m/s^2
};

struct JointEstimate {
  Index joint = 0;
  std::optional<JointAxis> axis;  ///< in the sensor frame at the reference configuration
  std::string reason;             ///< why there is none, and what to record
  std::optional<JointAxis> vague; ///< whole-arm: what is known of an axis too vague to be given, its direction to 50 mrad at least
  Index fit = -1;                 ///< into JointCalibration::fits
};

struct JointCalibration {
  Eigen::VectorXd reference_configuration;  ///< (n) rad or m
  std::vector<JointEstimate> joints;        ///< base to tip
  Eigen::MatrixXd covariance;               ///< (4n, 4n) of the lines' local coordinates, of lines given; points of rests: zero
  Eigen::Vector3d up_gravity_sensor = Eigen::Vector3d::Zero();  ///< m/s^2, an ideal sensor's reading at the reference
  SensorFromGravity sensor;
  Eigen::Vector3d percussion_distance = Eigen::Vector3d::Zero();      ///< m, of each channel
  Eigen::Vector3d percussion_distance_std = Eigen::Vector3d::Zero();  ///< m
  std::vector<TestFit> fits;
  std::vector<std::string> unseen;  ///< parameter combinations the data hardly show, in words
  int passes = 0;
  bool converged = false;

  [[nodiscard]] bool complete() const;
  /// The calibrated chain. Raises NotIdentifiable naming the missing joints.
  [[nodiscard]] ScrewChain chain() const;
};

/// Raises InvalidInput for options that do not fit the recording. Joints that cannot be estimated are results with a reason.
JointCalibration calibrate_joints(const Recording& recording, const Segmentation& segmentation,
                                  const JointCalibrationOptions& options = {});

/// Predicted standard deviation of the sensor's position over configurations (P, n): (P) m, the root of the covariance's
/// trace, from the lines' covariance alone (whole_arm.hpp: with the encoders').
Eigen::VectorXd end_point_std(const ScrewChain& chain, const Eigen::Ref<const Eigen::MatrixXd>& line_covariance,
                              const Eigen::Ref<const SamplesX>& configurations);

}  // namespace circlepoint
