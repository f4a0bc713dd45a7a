"""The whole-arm estimate with encoders so coarse that resting joints yield by a few counts."""

import json

import numpy as np
import pytest

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor


def load(folder):
    log = read_recording([folder / "log.csv"], load_arm(folder / "arm.yaml")).recording
    truth = json.loads((folder / "truth.json").read_text())
    axes = [
        cp.ScrewAxis(
            type=cp.JointType.revolute,
            line=cp.make_line(np.array(joint["direction_sensor"]), np.array(joint["point_sensor"])),
        )
        for joint in truth["joints"]
    ]
    return log, cp.ScrewChain(axes, np.array(truth["reference_configuration"]))


def requantised(log, counts):
    count = 2 * np.pi / counts
    positions = np.round(np.array(log.joint_positions) / count) * count
    return cp.make_recording(np.array(log.time), positions, np.array(log.specific_force))


def estimate(log, truth, counts):
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.encoder_resolution = np.full(log.joint_positions.shape[1], 2 * np.pi / counts)
    joints = cp.calibrate_whole_arm(log, cp.segment(log), options).joints
    there = cp.rebase(truth, joints.reference_configuration)
    pairs = zip(joints.chain().axes, there.axes, strict=True)
    error = np.concatenate([cp.local_coordinates(a.line, b.line) for a, b in pairs])
    return error, joints.covariance


@pytest.mark.parametrize(
    ("folder", "counts"),
    [
        ("physics-arm7-sweeps-coarse", 4096),
        ("physics-arm7-sweeps-qa700", 4096),
        ("physics-arm7-sweeps-qa700", 1024),
        ("physics-arm6-free-qa700", 4096),
    ],
)
def test_errors_are_as_large_as_the_covariance_says_and_below_half_a_count(shared_data, folder, counts):
    log, truth = load(shared_data / folder)
    error, covariance = estimate(requantised(log, counts), truth, counts)
    assert error @ np.linalg.solve(covariance, error) / error.size < 2.5
    assert np.abs(error).max() < 0.5 * 2 * np.pi / counts
