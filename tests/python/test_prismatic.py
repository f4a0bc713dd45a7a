"""Sliding joints: found in a log, calibrated from their acceleration, carried into every form of the result."""

import jsonschema
import numpy as np
import pytest

import circlepoint as cp
from circlepoint.arm import Arm, DhRow, Joint, NominalDh, load_arm
from circlepoint.calibration import calibrate
from circlepoint.check import check_recording
from circlepoint.document import load_schema
from circlepoint.protocol import paper_plan
from circlepoint.recording_files import write_recording
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor

UP = cp.STANDARD_GRAVITY * np.array([0.48, -0.6, 0.64])
LINES = [  # no two parallel, none near the vertical, up to 0.7 m from the sensor
    ([0.9, 0.1, 0.3], [0.1, 0.6, -0.3]),
    ([0.0, 0.2, 1.0], [-0.5, 0.1, 0.1]),
    ([0.2, 1.0, 0.3], [0.2, 0.0, 0.3]),
    ([1.0, -0.3, 0.1], [0.0, 0.12, 0.05]),
    ([0.1, 0.8, -0.7], [0.1, 0.05, 0.1]),
    ([0.7, 0.2, 0.8], [0.05, 0.1, 0.0]),
]
STANFORD = "RRPRRR"
ON_A_RAIL = "PRRR"
NAMES = "abcdef"
TURNING_COUNTS, SLIDING_COUNTS = 400_000.0, 1e6
RATE = 200.0


def types_of(arm):
    return [cp.JointType.revolute if kind == "R" else cp.JointType.prismatic for kind in arm]


def chain_of(arm):
    axes = [
        cp.ScrewAxis(kind, cp.make_line(np.array(direction), np.array(point)))
        for kind, (direction, point) in zip(types_of(arm), LINES, strict=False)
    ]
    return cp.ScrewChain(axes, np.zeros(len(arm)))


def description(arm, dh=None):
    kinds = {"R": "revolute", "P": "prismatic"}
    joints = tuple(Joint(name, kinds[kind]) for name, kind in zip(NAMES, arm, strict=False))
    counts = tuple(TURNING_COUNTS if kind == "R" else SLIDING_COUNTS for kind in arm)
    return Arm("sliding", joints, dh, counts)


def motions_of(arm, joints, span, frequency):
    pieces = []
    for joint in joints:
        if arm[joint] == "P":
            pieces.append(cp.RaisedCosine(joint=joint, span=span, frequency=frequency, duration=3 / frequency))
            continue
        pieces.append(cp.SteppedSweep(joint=joint, steps=12, span=2.4, dwell=0.6, move=0.5, return_duration=1.5))
        pieces.append(cp.RaisedCosine(joint=joint, span=2.4, frequency=0.5, duration=4.0))
    return pieces


def recorded(arm, seed=1, *, joints=None, span=0.3, frequency=0.5, exact=False, noise=None, compliance=(), counts=True):
    """Eq. (11) of every joint, and a stepped sweep of those that turn, by an individual QA700."""
    specification = load_sensor("qa700")
    start = np.where(np.array(list(arm)) == "R", -1.2, 0.1)
    pieces = motions_of(arm, range(len(arm)) if joints is None else joints, span, frequency)
    options = cp.SimulationOptions(
        noise_std=noise or (0.0 if exact else specification.noise_std),
        encoder_counts_per_revolution=np.array(description(arm).encoder_counts if counts and not exact else ()),
        compliance=np.array(compliance),
        seed=seed,
    )
    sensor = cp.AccelerometerModel() if exact else cp.draw_accelerometer(specification, seed)
    return cp.simulate(chain_of(arm), UP, sensor, cp.joint_trajectory(start, pieces, RATE, 0.6), options)


def true_axes(arm, result):
    return cp.rebase(chain_of(arm), result.joints.reference_configuration).axes


def direction_error(estimate, truth):
    """(2,) rad in the tangent basis of the estimate."""
    line = estimate.axis.screw.line
    return cp.local_coordinates(line, cp.make_line(truth.line.direction, line.point))[:2]


@pytest.fixture(
    scope="module", params=[(arm, method) for arm in (STANFORD, ON_A_RAIL) for method in ("joint", "whole-arm")]
)
def calibrated(request):
    arm, method = request.param
    return arm, calibrate(recorded(arm), description(arm), method=method, sensor=load_sensor("qa700"))


def test_every_axis_is_found_within_its_uncertainty(calibrated):
    arm, result = calibrated
    assert result.joints.complete(), [joint.reason for joint in result.joints.joints]
    for kind, estimate, truth in zip(arm, result.joints.joints, true_axes(arm, result), strict=True):
        std = np.sqrt(np.diag(estimate.axis.covariance))
        error = direction_error(estimate, truth)
        if kind == "R":
            error = cp.local_coordinates(estimate.axis.screw.line, truth.line)
        assert np.abs(error / std[: error.size]).max() < 4.5
        assert np.linalg.norm(error[:2]) < 5e-4


def test_a_sliding_joint_has_no_point_and_no_variance_of_one(calibrated):
    arm, result = calibrated
    index = arm.index("P")
    axis = result.joints.joints[index].axis
    assert axis.screw.type == cp.JointType.prismatic
    assert not axis.screw.line.point.any()
    assert not axis.covariance[2:].any()
    assert not axis.covariance[:, 2:].any()
    covariance = result.joints.covariance
    assert not covariance[4 * index + 2 : 4 * index + 4].any()
    assert 0 < axis.direction_std() < 1e-3
    entry = result.document["joints"][index]
    assert (entry["point_sensor"], entry["point_std"]) == (None, None)


def test_the_document_fits_the_schema_and_reports_the_scale_of_the_acceleration(calibrated):
    arm, result = calibrated
    jsonschema.Draft202012Validator(load_schema()).validate(result.document)
    assert result.document["complete"]
    used = [test for test in result.document["joints"][arm.index("P")]["tests"] if test["used"]]
    if result.document["method"] == "joint":
        assert used[0]["acceleration_scale"] == pytest.approx(1.0, abs=5e-3)
    assert result.document["findings"] == []
    assert 0 < result.document["end_point"]["rms"] < 2e-3


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_dh_parameters_and_the_product_of_exponentials_move_the_end_point_alike(calibrated, convention):
    arm, result = calibrated
    convert = cp.to_standard_dh if convention == "standard" else cp.to_modified_dh
    dh = convert(result.chain)
    index = arm.index("P")
    assert list(dh.chain.types) == types_of(arm)
    random = np.random.default_rng(3)
    poses = random.uniform(-np.pi, np.pi, (1000, len(arm)))
    poses[:, index] /= np.pi
    np.testing.assert_allclose(
        cp.forward_kinematics(dh.chain, poses), cp.forward_kinematics(result.chain, poses), rtol=0, atol=1e-9
    )


@pytest.mark.parametrize("method", ["position", "velocity"])
def test_the_papers_methods_fit_a_straight_line(method):
    recording = recorded(ON_A_RAIL)
    result = calibrate(recording, description(ON_A_RAIL), method=method, sensor=load_sensor("qa700"))
    estimate = result.joints.joints[0]
    error = direction_error(estimate, true_axes(ON_A_RAIL, result)[0])
    assert np.abs(error / np.sqrt(np.diag(estimate.axis.covariance)[:2])).max() < 4.5
    assert np.linalg.norm(error) < 5e-3
    assert result.joints.fits[0].acceleration_scale == pytest.approx(1.0, abs=0.02)


def test_a_sliding_joint_needs_no_rests_and_runs_the_way_its_encoder_counts():
    result = calibrate(recorded(ON_A_RAIL, exact=True), description(ON_A_RAIL), method="joint")
    truth = true_axes(ON_A_RAIL, result)[0]
    np.testing.assert_allclose(result.joints.joints[0].axis.screw.line.direction, truth.line.direction, atol=2e-5)


def test_joints_that_yield_under_a_sliding_one_are_corrected_by_their_encoders():
    arm = "RPRR"
    compliance = [2e-4, 1e-5, 2e-4, 2e-4]
    recording = recorded(arm, exact=True, compliance=compliance)
    result = calibrate(recording, description(arm), method="joint")
    error = direction_error(result.joints.joints[1], true_axes(arm, result)[1])
    assert np.linalg.norm(error) < 1e-4


def test_the_stated_covariance_of_a_sliding_direction_is_honest():
    # Two degrees of freedom: the normalised squares over 24 seeds average 2 +- 0.41.
    squares = []
    for seed in range(24):
        recording = recorded("PR", seed, counts=False)
        result = calibrate(recording, description("PR"), method="joint", sensor=load_sensor("qa700"))
        estimate = result.joints.joints[0]
        error = direction_error(estimate, true_axes("PR", result)[0])
        squares.append(error @ np.linalg.solve(estimate.axis.covariance[:2, :2], error))
    assert 0.7 < np.mean(squares) < 3.6


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"joints": [1, 2, 3]}, "never moves"),
        ({"span": 0.05, "frequency": 0.02, "noise": 0.1}, "too little acceleration"),
    ],
)
def test_what_a_sliding_joint_lacks_is_said(change, reason):
    result = calibrate(
        recorded(ON_A_RAIL, **change), description(ON_A_RAIL), method="joint", sensor=load_sensor("qa700")
    )
    assert reason in result.joints.joints[0].reason
    assert "0.3 m" in result.joints.joints[0].reason
    assert all(joint.axis is not None for joint in result.joints.joints[1:])


def test_a_direction_that_a_slow_motion_hardly_shows_is_named():
    result = calibrate(
        recorded("PR", span=0.05, frequency=0.02), description("PR"), method="joint", sensor=load_sensor("qa700")
    )
    assert result.joints.complete()
    unseen = result.document["identifiability"]["unseen"]
    assert any("joint 1 direction: it accelerated by 0.3 mm/s^2" in entry and "faster" in entry for entry in unseen)


def test_a_wrong_scale_of_a_sliding_encoder_is_found_and_leaves_the_direction_alone():
    recording = recorded(ON_A_RAIL, exact=True)
    positions = recording.joint_positions.copy()
    positions[:, 0] *= 1.1
    wrong = cp.make_recording(recording.time, positions, recording.specific_force)
    result = calibrate(wrong, description(ON_A_RAIL), method="joint")
    assert [finding["joint"] for finding in result.document["findings"]] == ["a"]
    assert "-9.1 %" in result.document["findings"][0]["message"]
    truth = true_axes(ON_A_RAIL, result)[0]
    np.testing.assert_allclose(result.joints.joints[0].axis.screw.line.direction, truth.line.direction, atol=1e-4)


def test_lengths_are_judged_in_metres_where_a_joint_slides():
    recording = recorded("PR", exact=True, span=0.02, joints=[0])
    assert not cp.segment(recording).motions
    found = cp.segment(recording, cp.SegmentationOptions(joint_types=types_of("PR")))
    assert [motion.joint for motion in found.motions] == [0]
    assert found.motions[0].travel == pytest.approx(0.02, rel=1e-3)
    assert found.tests[0].motion_span == pytest.approx(0.02, rel=1e-3)
    with pytest.raises(cp.InvalidInput, match="joint_types has 3 entries for 2 joints"):
        cp.segment(recording, cp.SegmentationOptions(joint_types=types_of("PRR")))


def test_positions_of_a_sliding_joint_two_centimetres_apart_are_two_configurations():
    pieces = [
        cp.RaisedCosine(joint=1, span=1.0),
        cp.PointToPointMove(np.array([0.13, 0.0]), 1.0),
        cp.RaisedCosine(joint=1, span=1.0),
    ]
    trajectory = cp.joint_trajectory(np.array([0.1, 0.0]), pieces, RATE, 0.6)
    recording = cp.simulate(chain_of("PR"), UP, cp.AccelerometerModel(), trajectory)
    found = cp.segment(recording, cp.SegmentationOptions(joint_types=types_of("PR")))
    assert len([test for test in found.tests if test.joint == 1]) == 2


def test_encoders_of_sliding_joints_count_per_metre(tmp_path):
    recording = recorded("PR")
    counts = recording.joint_positions[:, 0] * SLIDING_COUNTS
    np.testing.assert_allclose(counts, np.round(counts), rtol=0, atol=1e-6)
    path = tmp_path / "arm.yaml"
    joints = "name: x\njoints: [{name: a, type: prismatic}, {name: b, type: revolute}]\n"
    path.write_text(joints + "encoder: {counts_per_revolution: 4096, counts_per_metre: 1000000}\n")
    assert load_arm(path).encoder_counts == (1e6, 4096)
    path.write_text(joints + "encoder: {counts_per_metre: [1000000, null]}\n")
    assert load_arm(path).encoder_counts == (1e6, None)
    path.write_text(joints.replace("prismatic", "revolute") + "encoder: {counts_per_metre: 1000}\n")
    with pytest.raises(cp.InvalidInput, match="no joint is prismatic"):
        load_arm(path)


@pytest.mark.parametrize(
    ("change", "status", "advice"),
    [
        ({}, "good", ""),
        ({"span": 0.04}, "weak", "short (40 mm)"),
        ({"span": 0.2, "frequency": 0.1}, "weak", "slow"),
        ({"joints": [1]}, "missing", "move it alone"),
    ],
)
def test_check_judges_a_sliding_joint_by_its_motion(tmp_path, change, status, advice):
    write_recording(tmp_path / "log.csv", recorded("PR", **change))
    arm = description("PR")
    joint = check_recording(read_recording(tmp_path / "log.csv", arm), arm).joints[0]
    assert joint.status == status
    assert advice in joint.advice
    assert "deg" not in joint.advice


def test_the_papers_plan_runs_on_an_arm_with_a_sliding_joint():
    plan = paper_plan(NAMES[:4], ["prismatic", "revolute", "revolute", "revolute"])
    assert plan.rest[0] == 0.0
    assert plan.rest[1] == pytest.approx(np.radians(-75))
    assert sum(isinstance(piece, cp.SteppedSweep) for piece in plan.pieces) == 3
    assert plan.pieces[0].span == pytest.approx(0.3)
    assert np.ptp(plan.trajectory().position[:, 0]) == pytest.approx(0.3)


def test_a_sliding_joints_place_in_the_description_does_not_matter():
    rows = (DhRow(0.1, 1.5, 0.2, 0.3), DhRow(0.0, -1.2, 0.1, 0.4), DhRow(0.3, 0.7, 0.2, -0.2))
    arm = description("RPR", NominalDh("standard", rows))
    result = calibrate(recorded("RPR"), arm, method="joint", sensor=load_sensor("qa700"))
    nominal = result.document["joints"][1]["nominal"]
    assert nominal["point_sensor"] is None
    assert nominal["point_difference"] is None
    jsonschema.Draft202012Validator(load_schema()).validate(result.document)
