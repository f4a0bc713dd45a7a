// Calibrate an arm from one log: simulate it, find the tests in it, estimate all axes with their uncertainty.
#include <cstdio>

#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/identification/whole_arm.hpp"
#include "circlepoint/simulation/simulate.hpp"

namespace cp = circlepoint;

int main() {
  const cp::StandardDhChain dh{{{0.02, 1.55, 0.30, 0.0}, {0.40, 0.01, 0.0, 0.0}, {0.10, 1.20, 0.25, 0.0}},
                               {cp::JointType::revolute, cp::JointType::revolute, cp::JointType::revolute}};
  const Eigen::Vector3d rest(0.2, -0.5, 0.9);
  const cp::ScrewChain arm = cp::to_screws(dh, rest, cp::BaseFrame::sensor_at_reference);
  std::vector<cp::Excitation> tests;
  for (cp::Index joint = 0; joint < 3; ++joint) {
    tests.emplace_back(cp::SteppedSweep{.joint = joint, .span = 2.5});
    tests.emplace_back(cp::RaisedCosine{.joint = joint, .span = 2.5});
  }
  const cp::JointTrajectory motion = cp::joint_trajectory(rest, tests, 250.0, 0.5);
  const Eigen::Vector3d up_gravity = cp::standard_gravity * Eigen::Vector3d(0.48, 0.60, 0.64);
  cp::AccelerometerModel sensor;
  sensor.bias = {0.004, -0.006, 0.002};
  sensor.percussion_distance.setConstant(0.0182);
  const cp::Recording log = cp::simulate(arm, up_gravity, sensor, motion, {.noise_std = 0.01, .seed = 1});

  cp::WholeArmOptions options;
  options.sensor.bias_std = 0.005;
  options.sensor.percussion_distance_std = 0.03;
  const cp::JointCalibration result = cp::calibrate_whole_arm(log, cp::segment(log), options).joints;

  std::puts("joint  direction                    nearest point, mm         std mrad, mm   error mrad, mm");
  const cp::ScrewChain truth = cp::rebase(arm, result.reference_configuration);
  for (const cp::JointEstimate& joint : result.joints) {
    const cp::JointAxis& axis = joint.axis.value();
    const cp::Line& line = axis.screw.line;
    const Eigen::Vector4d error = cp::local_coordinates(truth.axes[static_cast<std::size_t>(joint.joint)].line, line);
    std::printf("%5d  %8.4f %8.4f %8.4f  %7.2f %7.2f %7.2f  %6.3f %6.3f  %7.3f %7.3f\n",
                static_cast<int>(joint.joint) + 1, line.direction.x(), line.direction.y(), line.direction.z(),
                1e3 * line.point.x(), 1e3 * line.point.y(), 1e3 * line.point.z(), 1e3 * axis.direction_std(),
                1e3 * axis.point_std(), 1e3 * error.head<2>().norm(), 1e3 * error.tail<2>().norm());
  }
}
