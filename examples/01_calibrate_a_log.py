"""Calibrate an arm from one log: simulate it, find the tests in it, estimate all axes with their uncertainty."""

import numpy as np

import circlepoint as cp

rows = [cp.DhRow(0.02, 1.55, 0.30, 0.0), cp.DhRow(0.40, 0.01, 0.0, 0.0), cp.DhRow(0.10, 1.20, 0.25, 0.0)]
rest = np.array([0.2, -0.5, 0.9])
arm = cp.to_screws(cp.StandardDhChain(rows, [cp.JointType.revolute] * 3), rest, cp.BaseFrame.sensor_at_reference)
tests = [test for joint in range(3) for test in (cp.SteppedSweep(joint, span=2.5), cp.RaisedCosine(joint, span=2.5))]
motion = cp.joint_trajectory(rest, tests, sample_rate=250.0, rest=0.5)
up_gravity = cp.STANDARD_GRAVITY * np.array([0.48, 0.60, 0.64])
sensor = cp.AccelerometerModel(bias=[0.004, -0.006, 0.002], percussion_distance=[0.0182] * 3)
log = cp.simulate(arm, up_gravity, sensor, motion, cp.SimulationOptions(noise_std=0.01, seed=1))

options = cp.WholeArmOptions()
options.sensor = cp.AccelerometerSpecification(bias_std=0.005, percussion_distance_std=0.03)
result = cp.calibrate_whole_arm(log, cp.segment(log), options).joints

print("joint  direction                    nearest point, mm         std mrad, mm   error mrad, mm")
for joint, truth in zip(result.joints, cp.rebase(arm, result.reference_configuration).axes, strict=True):
    axis, line = joint.axis, joint.axis.screw.line
    error = cp.local_coordinates(truth.line, line)
    print(
        f"{joint.joint + 1:5d}  {line.direction[0]:8.4f} {line.direction[1]:8.4f} {line.direction[2]:8.4f}"
        f"  {1e3 * line.point[0]:7.2f} {1e3 * line.point[1]:7.2f} {1e3 * line.point[2]:7.2f}"
        f"  {1e3 * axis.direction_std():6.3f} {1e3 * axis.point_std():6.3f}"
        f"  {1e3 * np.linalg.norm(error[:2]):7.3f} {1e3 * np.linalg.norm(error[2:]):7.3f}"
    )
