"""Calibration of recordings nobody here made: arms of a physics engine against truth, real arms against nominal."""

import json

import numpy as np
import pytest

import circlepoint
from circlepoint.arm import Arm, Joint, load_arm
from circlepoint.calibration import calibrate, whole_arm_options
from circlepoint.cli import main
from circlepoint.nominal import nominal_chain, nominal_dh_chain
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor

DEGREE = np.pi / 180


def calibrated(folder, method, sensor=None):
    arm = load_arm(folder / "arm.yaml")
    specification = None if sensor is None else load_sensor(sensor)
    return calibrate(read_recording([folder / "log.csv"], arm).recording, arm, method=method, sensor=specification)


def true_chain(folder, reference_configuration):
    """The engine's lines, in the sensor frame at the given configuration."""
    truth = json.loads((folder / "truth.json").read_text())
    axes = [
        circlepoint.ScrewAxis(
            type=circlepoint.JointType.revolute,
            line=circlepoint.make_line(np.array(joint["direction_sensor"]), np.array(joint["point_sensor"])),
        )
        for joint in truth["joints"]
    ]
    chain = circlepoint.ScrewChain(axes, np.array(truth["reference_configuration"]))
    return circlepoint.rebase(chain, np.array(reference_configuration))


def line_errors(result, truth):
    """(n, 4) local coordinates of the true lines at the estimated ones."""
    return np.array(
        [
            circlepoint.local_coordinates(estimate.axis.screw.line, axis.line)
            for estimate, axis in zip(result.joints.joints, truth.axes, strict=True)
        ]
    )


# Reached, joint: 0.013 mrad and 0.011 mm, 0.31 and 0.19, 0.49 and 0.58; required for a QA700: 3 mrad and 6 mm.
# Reached, whole-arm: 0.006 and 0.005, 0.11 and 0.08; required: 0.04 mrad and 0.12 mm.
@pytest.mark.parametrize(
    ("name", "method", "axis_bound", "line_bound"),
    [
        ("physics-arm7-sweeps-qa700", "joint", 0.1e-3, 0.1e-3),
        ("physics-arm6-sweeps-mems", "joint", 1e-3, 1e-3),
        ("physics-arm7-sweeps-coarse", "joint", 2e-3, 2e-3),
        ("physics-arm7-sweeps-qa700", "whole-arm", 0.04e-3, 0.03e-3),
        ("physics-arm6-sweeps-mems", "whole-arm", 0.3e-3, 0.2e-3),
        ("physics-arm7-free-ideal", "whole-arm", 0.04e-3, 0.03e-3),
        ("physics-arm6-free-qa700", "whole-arm", 0.04e-3, 0.03e-3),
    ],
)
def test_lines_of_an_arm_of_a_physics_engine_are_within_their_uncertainty(
    shared_data, name, method, axis_bound, line_bound
):
    result = calibrated(shared_data / name, method)
    assert result.document["complete"]
    errors = line_errors(result, true_chain(shared_data / name, result.joints.reference_configuration))
    std = np.array([np.sqrt(np.diag(estimate.axis.covariance)) for estimate in result.joints.joints])
    assert np.abs(errors / std).max() < 4.5
    assert np.linalg.norm(errors[:, :2], axis=1).max() < axis_bound
    assert np.linalg.norm(errors[:, 2:], axis=1).max() < line_bound


# Required: 0.15, 0.4 and 0.05 mm; reached 0.010, 0.17, 0.003 and 0.008.
@pytest.mark.parametrize(
    ("name", "method", "sensor", "bound"),
    [
        ("physics-arm7-sweeps-qa700", "joint", None, 0.2e-3),
        ("physics-arm7-sweeps-qa700", "whole-arm", None, 0.05e-3),
        ("physics-arm6-sweeps-mems", "whole-arm", "mems", 0.4e-3),
        ("physics-arm7-free-ideal", "whole-arm", "ideal", 0.02e-3),
        ("physics-arm6-free-qa700", "whole-arm", "qa700", 0.04e-3),
    ],
)
def test_end_points_of_an_arm_of_a_physics_engine_are_within_the_predicted_spread(
    shared_data, name, method, sensor, bound
):
    folder = shared_data / name
    result = calibrated(folder, method, sensor)
    reference = result.joints.reference_configuration
    truth = true_chain(folder, reference)
    poses = reference + np.random.default_rng(1).uniform(-np.pi, np.pi, (200, len(reference)))
    errors = (
        circlepoint.forward_kinematics(result.chain, poses)[:, :3, 3]
        - circlepoint.forward_kinematics(truth, poses)[:, :3, 3]
    )
    rms = np.sqrt(np.mean(np.sum(errors**2, axis=1)))
    assert rms < 3.0 * result.document["end_point"]["rms"]
    assert rms < bound


@pytest.mark.parametrize("name", ["physics-arm6-free-qa700", "physics-arm7-free-ideal"])
def test_joint_by_joint_no_line_is_invented_where_all_joints_move_at_once(shared_data, name):
    result = calibrated(shared_data / name, "joint")
    assert not result.document["complete"]
    assert result.document["covariance"] is None
    for joint in result.document["joints"]:
        assert joint["direction_sensor"] is None
        assert joint["point_sensor"] is None
        assert "never moves alone" in joint["reason"]


def run_two_clocks(folder, out, method):
    arguments = [str(folder / "joints.csv"), str(folder / "sensor.csv"), "--arm", str(folder / "arm.yaml")]
    status = main(["calibrate", *arguments, "--method", method, "--out", str(out)])
    return status, json.loads((out / "calibration.json").read_text())


@pytest.fixture(scope="module")
def real_arm(shared_data, tmp_path_factory):
    """Exit status and document of the real arm that moved two of its joints alone, joint by joint."""
    return run_two_clocks(shared_data / "real-ur5-imu-6", tmp_path_factory.mktemp("ur5") / "result", "joint")


@pytest.fixture(scope="module")
def whole_real_arm(shared_data, tmp_path_factory):
    """Exit status and document of the same by the whole-arm estimate."""
    return run_two_clocks(shared_data / "real-ur5-imu-6", tmp_path_factory.mktemp("ur5") / "result", "whole-arm")


def test_every_axis_of_the_real_arm_lies_where_the_maker_says(whole_real_arm):
    # The sensor's mounting is not the maker's: up to half a degree of every difference is its own.
    status, document = whole_real_arm
    assert status == 0
    assert document["complete"]
    for joint in document["joints"]:
        assert joint["direction_std"] < 3e-3
        assert joint["point_std"] < 5e-3
        assert joint["nominal"]["direction_difference"] < 1.0 * DEGREE
        assert joint["nominal"]["point_difference"] < 0.012


def test_the_real_arms_last_joint_is_found_to_be_off_once_a_turn_and_no_other(whole_real_arm):
    (off,) = whole_real_arm[1]["encoders"]
    assert off["joint"] == "wrist_3_joint"
    assert off["gain"] is None
    assert np.hypot(off["eccentricity_cos"]["estimate"], off["eccentricity_sin"]["estimate"]) == pytest.approx(
        4.3e-3, abs=0.5e-3
    )


@pytest.mark.parametrize("gyroscope", [False, True])
def test_lengths_of_the_real_arm_are_the_makers_within_millimetres(shared_data, gyroscope):
    folder = shared_data / "real-ur5-imu-6"
    arm = load_arm(folder / "arm.yaml")
    log = read_recording([folder / "joints.csv", folder / "sensor.csv"], arm)
    options = whole_arm_options(arm, None, circlepoint.STANDARD_GRAVITY, None, two_clocks=True)
    options.use_gyroscope = gyroscope
    result = circlepoint.calibrate_whole_arm(log.recording, circlepoint.segment(log.recording), options)
    joints = result.joints
    conversion = circlepoint.to_hayati(joints.chain(), nominal_dh_chain(arm), 0.05)
    jacobian = circlepoint.hayati_parameter_jacobian(joints.chain(), conversion)
    std = np.sqrt(np.einsum("ij,jk,ik->i", jacobian, joints.covariance, jacobian)).reshape(-1, 5)
    rows = conversion.chain.rows
    lengths = np.array([rows[1].a, rows[2].a, rows[3].d, rows[4].d])
    spread = np.array([std[1, 0], std[2, 0], std[3, 2], std[4, 2]])
    error = np.abs(lengths - [-0.425, -0.39225, 0.10915, 0.09465])
    assert error.max() < (3e-3 if gyroscope else 4e-3)
    assert spread.max() < 4e-3
    assert (error / spread).max() < 2.0
    # The gyroscope is ahead of the accelerometer, by more than two standard deviations.
    assert result.gyroscope_delay == (pytest.approx(-0.39e-3, abs=0.15e-3) if gyroscope else 0.0)


def test_whole_arm_clocks_agree_with_their_alignment_by_activity(real_arm, whole_real_arm):
    for name in ("clock_offset", "clock_rate"):
        coarse, fine = real_arm[1]["sensor"][name], whole_real_arm[1]["sensor"][name]
        assert fine["std"] < coarse["std"]
        assert abs(fine["estimate"] - coarse["estimate"]) < 4 * np.hypot(fine["std"], coarse["std"])


def test_real_arm_gives_the_joints_it_moved_alone_and_reasons_for_the_others(real_arm):
    status, document = real_arm
    assert status == 1
    assert not document["complete"]
    assert [joint["direction_sensor"] is not None for joint in document["joints"]] == [True] + [False] * 4 + [True]
    assert all("never moves alone" in joint["reason"] for joint in document["joints"][1:5])
    names = [joint["name"] for joint in document["joints"]]
    assert document["covariance"]["parameters"] == [
        f"{names[joint]}.{coordinate}" for joint in (0, 5) for coordinate in ("d1", "d2", "p1", "p2")
    ]


def test_real_arms_two_clocks_are_brought_together(real_arm):
    sensor = real_arm[1]["sensor"]
    assert sensor["clock_offset"]["estimate"] == pytest.approx(0.07, abs=0.01)
    assert sensor["clock_rate"]["estimate"] == pytest.approx(1.0033, abs=3e-4)
    assert 0.0 < sensor["clock_offset"]["std"] < 0.01
    assert 0.0 < sensor["clock_rate"]["std"] < 3e-4


def test_real_arms_sensor_sits_beside_its_last_axis_where_it_was_mounted(real_arm):
    last = real_arm[1]["joints"][5]
    assert abs(last["direction_sensor"][2]) > np.cos(2 * DEGREE)
    lever = -np.array(last["point_sensor"])
    assert np.linalg.norm(lever[:2] - [0.013, 0.0045]) < 3e-3


def test_real_arms_first_and_last_axis_lie_to_each_other_as_the_maker_says(shared_data, real_arm):
    document = real_arm[1]
    arm = load_arm(shared_data / "real-ur5-imu-6" / "arm.yaml")
    nominal = nominal_chain(arm, document["reference_configuration"])
    measured = [
        circlepoint.make_line(np.array(joint["direction_sensor"]), np.array(joint["point_sensor"]))
        for joint in (document["joints"][0], document["joints"][5])
    ]
    covariance = np.array(document["covariance"]["matrix"])

    def relation(lines):
        normal = circlepoint.common_normal(lines[0], lines[1], np.zeros(3))
        return np.array([abs(normal.angle), normal.distance])

    expected = relation([nominal.axes[0].line, nominal.axes[5].line])
    step = 1e-6
    jacobian = np.empty((2, 8))
    for k in range(8):
        nudge = np.zeros((2, 4))
        nudge.flat[k] = step
        plus = [circlepoint.retract(line, local) for line, local in zip(measured, nudge, strict=True)]
        minus = [circlepoint.retract(line, -local) for line, local in zip(measured, nudge, strict=True)]
        jacobian[:, k] = (relation(plus) - relation(minus)) / (2 * step)
    std = np.sqrt(np.diag(jacobian @ covariance @ jacobian.T))
    angle, distance = np.abs(relation(measured) - expected)
    assert angle < 4 * std[0]
    assert angle < 1.5 * DEGREE
    assert distance < 4 * std[1]
    assert distance < 0.015


@pytest.mark.parametrize(("method", "reason"), [("joint", "never moves"), ("whole-arm", "gravity hardly turns")])
def test_nothing_is_invented_of_a_real_arm_in_whose_hand_gravity_hardly_turns(shared_data, tmp_path, method, reason):
    status, document = run_two_clocks(shared_data / "real-ur5-imu-8", tmp_path / "result", method)
    assert status == 1
    assert not document["complete"]
    assert document["dh"] is None
    assert document["end_point"] is None
    for joint in document["joints"]:
        assert joint["direction_sensor"] is None
        assert reason in joint["reason"]


def test_the_estimate_of_a_real_arm_that_shakes_settles(shared_data):
    arm = Arm("four modules", tuple(Joint(f"module{number}", "revolute") for number in range(1, 5)))
    loaded = read_recording([shared_data / "real-hebi-5module" / "log.csv.gz"], arm)
    calibration = calibrate(loaded.recording, arm)
    assert calibration.whole_arm.converged
    assert not calibration.joints.complete()  # a metre a second squared beside the model
