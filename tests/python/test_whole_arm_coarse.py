"""The whole-arm estimate with encoders so coarse that resting joints yield by a few counts."""

import numpy as np
import pytest

import circlepoint as cp

UP = np.array([1.2, -3.1, 9.2])
JOINTS = 3


def arm():
    random = np.random.default_rng(5)
    axes = []
    for _ in range(JOINTS):
        direction = random.normal(size=3)
        line = cp.make_line(direction / np.linalg.norm(direction), random.normal(0, 0.3, 3))
        axes.append(cp.ScrewAxis(type=cp.JointType.revolute, line=line))
    return cp.ScrewChain(axes=axes, reference_configuration=np.zeros(JOINTS))


def recording(counts, seed):
    # Another start, another place within the counts.
    start = np.random.default_rng(seed).uniform(-0.02, 0.02, JOINTS)
    pieces = [cp.Dwell(1.5)]
    for joint in range(JOINTS):
        pieces += [cp.SteppedSweep(joint=joint, span=2.6, steps=10), cp.Dwell(1.0)]
        pieces += [cp.RaisedCosine(joint=joint, span=2.6), cp.Dwell(1.5)]
    trajectory = cp.joint_trajectory(start, pieces, 250.0)
    options = cp.SimulationOptions(
        noise_std=2e-3,
        encoder_counts_per_revolution=[counts] * JOINTS,
        compliance=[4e-4] * JOINTS,
        seed=seed,
    )
    return cp.simulate(arm(), UP, cp.AccelerometerModel(), trajectory, options)


def estimate(counts, seed):
    log = recording(counts, seed)
    options = cp.WholeArmOptions()
    options.encoder_resolution = np.full(JOINTS, 2 * np.pi / counts)
    joints = cp.calibrate_whole_arm(log, cp.segment(log), options).joints
    truth = cp.rebase(arm(), joints.reference_configuration)
    error = np.concatenate(
        [cp.local_coordinates(a.line, b.line) for a, b in zip(joints.chain().axes, truth.axes, strict=True)]
    )
    return error, joints.covariance


@pytest.mark.parametrize("counts", [1024, 4096])
def test_errors_are_within_the_intervals_and_the_lines_far_within_a_count_times_the_reach(counts):
    squares = []
    for seed in range(3):
        error, covariance = estimate(counts, seed)
        squares.append(error @ np.linalg.solve(covariance, error) / error.size)
        assert np.abs(error / np.sqrt(np.diag(covariance))).max() < 4.5
        assert np.abs(error).max() < 2 * np.pi / counts
    assert np.mean(squares) < 2.0


def test_resting_joints_do_yield_by_counts_in_these_recordings():
    log = recording(4096, 0)
    count = 2 * np.pi / 4096
    motion = max(cp.segment(log).motions, key=lambda motion: motion.travel)
    part = log.joint_positions[motion.samples.begin : motion.samples.end]
    others = np.delete(np.ptp(part, axis=0), motion.joint)
    assert count < others.max() < 50 * count
