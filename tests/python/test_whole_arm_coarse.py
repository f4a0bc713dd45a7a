"""The whole-arm estimate with encoders so coarse that resting joints yield by a few counts."""

import json

import numpy as np
import pytest
from whole_arm_support import LINES, START, UP, chain_of

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


def requantised(log, counts, zero=0.0):
    """Return the log as encoders of so many counts would read it, whose zeros lie at these parts (n) of a count."""
    count = 2 * np.pi / counts
    positions = (np.round(np.array(log.joint_positions) / count + zero) - zero) * count
    return cp.make_recording(np.array(log.time), positions, np.array(log.specific_force))


def estimate(log, truth, counts):
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.encoder_resolution = np.full(log.joint_positions.shape[1], 2 * np.pi / counts)
    result = cp.calibrate_whole_arm(log, cp.segment(log), options)
    joints = result.joints
    there = cp.rebase(truth, joints.reference_configuration)
    pairs = zip(joints.chain().axes, there.axes, strict=True)
    error = np.concatenate([cp.local_coordinates(a.line, b.line) for a, b in pairs])
    return error, joints.covariance, result


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
    error, covariance, _ = estimate(requantised(log, counts), truth, counts)
    assert error @ np.linalg.solve(covariance, error) / error.size < 2.5
    assert np.abs(error).max() < 0.5 * 2 * np.pi / counts


def test_seven_joints_at_4096_counts_are_found_to_0_08_mrad_and_0_3_mm(shared_data):
    log, truth = load(shared_data / "physics-arm7-sweeps-coarse")
    error, _, result = estimate(log, truth, 4096)
    lines = error.reshape(-1, 4)
    assert np.linalg.norm(lines[:, :2], axis=1).max() < 8e-5
    assert np.linalg.norm(lines[:, 2:], axis=1).max() < 2.4e-4
    poses = np.random.default_rng(0).uniform(-np.pi, np.pi, (200, log.joints))
    there = cp.rebase(truth, result.joints.reference_configuration)
    assert cp.end_point_error(result.joints.chain(), there, poses) < 3e-4
    assert all(fit.dwell_positions.size >= 10 for fit in result.joints.fits)  # though joints at rest are followed


def test_a_joint_that_stands_where_no_dwell_was_seen_stands_within_its_count(shared_data):
    log, truth = load(shared_data / "physics-arm7-sweeps-qa700")
    zero = np.random.default_rng(16).uniform(size=log.joints)
    error, covariance, _ = estimate(requantised(log, 8192, zero), truth, 8192)  # counts flicker in one of the rests
    assert error @ np.linalg.solve(covariance, error) / error.size < 2.0


@pytest.mark.parametrize("seed", [5, 37])
def test_a_joint_whose_counts_never_change_may_yet_yield(shared_data, seed):
    log, truth = load(shared_data / "physics-arm7-sweeps-qa700")
    zero = np.random.default_rng(seed).uniform(
        size=log.joints
    )  # joint 6 yields by 0.6 counts in test 5, within one count
    error, covariance, result = estimate(requantised(log, 4096, zero), truth, 4096)
    assert error @ np.linalg.solve(covariance, error) / error.size < 2.0
    assert not [p.name for p in result.parameters if "gain" in p.name or "eccentricity" in p.name]


@pytest.mark.parametrize("counts", [1024, 2048, 4096])
def test_moves_of_a_few_dozen_counts_and_steps_of_acceleration_are_neither_knocks_nor_encoder_errors(counts):
    chain = chain_of(LINES)
    count = 2 * np.pi / counts
    squares, end_point, predicted = [], [], []
    for seed in range(4):
        start = START + np.random.default_rng(seed).uniform(0.0, count, 3)
        pieces = []
        for joint in range(3):
            pieces.append(cp.SteppedSweep(joint=joint, steps=16, span=np.radians(150), dwell=0.8, move=0.6))
            pieces.append(cp.RaisedCosine(joint=joint, span=np.radians(150), frequency=0.5, duration=4.0))
        motion = cp.joint_trajectory(start, pieces, 500.0, 0.6)
        simulation = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(3, counts), seed=seed)
        log = cp.simulate(chain, UP, cp.draw_accelerometer(load_sensor("qa700"), seed), motion, simulation)
        error, covariance, result = estimate(log, chain, counts)
        squares.append(error @ np.linalg.solve(covariance, error) / error.size)
        assert not [p.name for p in result.parameters if "gain" in p.name or "eccentricity" in p.name]
        assert result.outliers <= 10
        poses = np.random.default_rng(0).uniform(-np.pi, np.pi, (50, 3))
        there = cp.rebase(chain, result.joints.reference_configuration)
        end_point.append(cp.end_point_error(result.joints.chain(), there, poses))
        predicted.append(np.sqrt(np.mean(cp.end_point_std(result, poses) ** 2)))
    assert np.mean(squares) < 2.0
    assert np.sqrt(np.mean(np.square(end_point))) < 1.5 * np.sqrt(np.mean(np.square(predicted)))
    assert max(predicted) < 5e-4


def weak_motion(counts, seed, up=UP):
    """Return the estimate of a log at 1,024 counts in which all joints move together by so many of them."""
    amplitude = np.full(3, 0.5 * counts * 2 * np.pi / 1024)
    motion = cp.joint_trajectory(
        START + 3e-4, [cp.MultiJointMotion(duration=40.0, amplitude=amplitude, seed=seed)], 200.0, 0.6
    )
    simulation = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(3, 1024.0), seed=seed)
    log = cp.simulate(chain_of(LINES), up, cp.draw_accelerometer(load_sensor("qa700"), seed), motion, simulation)
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.reference_configuration = START
    options.encoder_resolution = np.full(3, 2 * np.pi / 1024)
    return cp.calibrate_whole_arm(log, cp.segment(log), options)


@pytest.mark.parametrize(("counts", "seed"), [(40, 1), (40, 3), (40, 5), (60, 3), (60, 5), (60, 6)])
def test_motions_of_a_few_dozen_counts_shrink_no_line_and_mirror_none(counts, seed):
    result = weak_motion(counts, seed)
    given = 0
    for estimate, axis in zip(result.joints.joints, chain_of(LINES).axes, strict=True):
        if estimate.axis is None:
            continue
        given += 1
        error = cp.local_coordinates(estimate.axis.screw.line, axis.line)
        assert np.abs(error / np.sqrt(np.diag(estimate.axis.covariance))).max() < 4.0
    assert given >= 2


@pytest.mark.parametrize("seed", range(4))
def test_a_base_joint_along_gravity_that_moves_little_is_not_given_reversed(seed):
    vertical = np.array(chain_of(LINES).axes[0].line.direction)
    result = weak_motion(25, seed, up=vertical * cp.STANDARD_GRAVITY)
    base = result.joints.joints[0]
    assert base.axis is None or np.dot(base.axis.screw.line.direction, vertical) > 0.9
    assert base.vague is None or np.dot(base.vague.screw.line.direction, vertical) > 0.9


def test_a_motion_slower_than_a_count_in_a_tenth_of_a_second_is_no_error():
    amplitude = np.full(3, 0.15)
    pieces = [cp.MultiJointMotion(duration=40.0, amplitude=amplitude, seed=2, frequency_min=0.05, frequency_max=0.1)]
    motion = cp.joint_trajectory(START + 3e-4, pieces, 200.0, 0.6)
    simulation = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(3, 256.0), seed=1)
    log = cp.simulate(chain_of(LINES), UP, cp.AccelerometerModel(), motion, simulation)
    options = cp.WholeArmOptions()
    options.encoder_resolution = np.full(3, 2 * np.pi / 256)
    assert cp.calibrate_whole_arm(log, cp.segment(log), options).cutoff >= 1.0


def test_a_step_across_a_gap_is_no_count():
    chain = chain_of(LINES)
    logs = []
    for k in range(2):
        pieces = [cp.RaisedCosine(joint=joint, span=1.5, frequency=0.5, duration=6.0) for joint in range(2)]
        motion = cp.joint_trajectory(START + np.array([0.0, 0.0, 0.7 * k]), pieces, 200.0, 0.6)
        sensor = cp.draw_accelerometer(load_sensor("qa700"), 1)
        logs.append(cp.simulate(chain, UP, sensor, motion, cp.SimulationOptions(noise_std=0.01, seed=k)))
    log = cp.concatenate(logs)
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    result = cp.calibrate_whole_arm(log, cp.segment(log), options)
    assert result.cutoff > 9.0
    assert all(estimate.axis is not None for estimate in result.joints.joints[:2])


def test_a_motion_that_drowns_in_its_counts_is_named():
    result = weak_motion(8, 0)
    for estimate in result.joints.joints:
        assert estimate.axis is None
        assert estimate.vague is None
        assert "it moves by less than 20 of its encoder's counts" in estimate.reason


def test_a_joint_that_moves_by_few_counts_beside_others_is_not_told():
    pieces = [cp.MultiJointMotion(duration=40.0, amplitude=np.array([0.05, 0.2, 0.2]), seed=3)]
    motion = cp.joint_trajectory(START + 3e-4, pieces, 200.0, 0.6)
    simulation = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(3, 1024.0), seed=1)
    log = cp.simulate(chain_of(LINES), UP, cp.draw_accelerometer(load_sensor("qa700"), 1), motion, simulation)
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.encoder_resolution = np.full(3, 2 * np.pi / 1024)
    first, *others = cp.calibrate_whole_arm(log, cp.segment(log), options).joints.joints
    assert "less than 20 of its encoder's counts" in first.reason
    assert first.vague is None  # its direction came out 0.2 rad off, stated to 0.04
    assert all(estimate.axis is not None for estimate in others)


def test_fast_motions_over_long_arcs_keep_their_harmonics():
    chain = chain_of(LINES)
    squares = []
    for seed in range(6):  # at 4.8 Hz, which rounding alone asks for, squares are 8.6 in the mean
        start = START + np.random.default_rng(seed).uniform(0.0, 2 * np.pi / 1024, 3)
        pieces = [cp.RaisedCosine(joint=joint, span=2.4, frequency=1.0, duration=8.0) for joint in range(3)]
        motion = cp.joint_trajectory(start, pieces, 500.0, 0.6)
        simulation = cp.SimulationOptions(noise_std=0.01, encoder_counts_per_revolution=np.full(3, 1024.0), seed=seed)
        log = cp.simulate(chain, UP, cp.draw_accelerometer(load_sensor("qa700"), seed), motion, simulation)
        error, covariance, result = estimate(log, chain, 1024)
        squares.append(error @ np.linalg.solve(covariance, error) / error.size)
        assert result.cutoff > 7.0
    assert np.mean(squares) < 2.0


def test_exact_encoders_are_not_taken_for_coarse_ones_by_the_first_steps_of_a_motion():
    chain = chain_of(LINES)
    pieces = [cp.RaisedCosine(joint=joint, span=2.4, frequency=1.0, duration=8.0) for joint in range(3)]
    motion = cp.joint_trajectory(START, pieces, 100.0, 0.6)  # from rest in steps of 1, 3, 5 times 2.4 mrad
    sensor = cp.draw_accelerometer(load_sensor("qa700"), 1)
    log = cp.simulate(chain, UP, sensor, motion, cp.SimulationOptions(noise_std=0.001, seed=1))
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    options.reference_configuration = START
    result = cp.calibrate_whole_arm(log, cp.segment(log), options)
    assert result.cutoff == 12.0
    assert not [p.name for p in result.parameters if "gain" in p.name or "eccentricity" in p.name]
    for estimate, axis in zip(result.joints.joints, chain.axes, strict=True):
        error = cp.local_coordinates(estimate.axis.screw.line, axis.line)
        assert np.abs(error / np.sqrt(np.diag(estimate.axis.covariance))).max() < 4.0


def test_a_low_cutoff_and_a_resolution_that_is_no_number():
    motion = cp.joint_trajectory(
        START, [cp.MultiJointMotion(duration=40.0, amplitude=np.full(3, 1.2), seed=3)], 250.0, 0.6
    )
    simulation = cp.SimulationOptions(noise_std=0.005, encoder_counts_per_revolution=np.full(3, 4096.0), seed=1)
    log = cp.simulate(chain_of(LINES), UP, cp.AccelerometerModel(), motion, simulation)
    options = cp.WholeArmOptions()
    options.encoder_resolution = np.full(3, 2 * np.pi / 4096)
    options.cutoff = 1.0
    assert cp.calibrate_whole_arm(log, cp.segment(log), options).cutoff == 1.0
    options.encoder_resolution = np.array([1e-3, np.nan, 1e-3])
    with pytest.raises(cp.InvalidInput, match="encoder_resolution of joint 2 is nan"):
        cp.calibrate_whole_arm(log, cp.segment(log), options)
