"""From a simulated recording to the result document, end to end."""

import jsonschema
import numpy as np
import pytest

import circlepoint
from circlepoint.arm import Arm, DhRow, Joint, NominalDh
from circlepoint.calibration import calibrate, whole_arm_options
from circlepoint.document import load_schema
from circlepoint.report import format_joint_table
from circlepoint.report.tables import joint_table, sensor_table
from circlepoint.sensor_presets import load_sensor
from circlepoint.whole_arm_document import with_whole_arm

UP = circlepoint.STANDARD_GRAVITY * np.array([0.48, -0.6, 0.64])
LINES = [
    ([0.9, 0.1, 0.3], [0.1, 0.6, -0.3]),
    ([0.0, 0.2, 1.0], [-0.5, 0.1, 0.1]),
    ([0.2, 1.0, 0.3], [0.2, 0.0, 0.3]),
    ([1.0, -0.3, 0.1], [0.0, 0.12, 0.05]),
]
NAMES = ("base", "shoulder", "elbow", "wrist")
START = np.full(4, -1.2)
COUNTS = 400_000.0
METHODS = ("whole-arm", "joint", "position", "velocity")


def four_joints():
    """No two axes parallel, none near the vertical, up to 0.7 m from the sensor."""
    axes = [
        circlepoint.ScrewAxis(
            type=circlepoint.JointType.revolute, line=circlepoint.make_line(np.array(direction), np.array(point))
        )
        for direction, point in LINES
    ]
    return circlepoint.ScrewChain(axes, np.zeros(4))


def an_arm(dh=None):
    return Arm("four", tuple(Joint(name, "revolute") for name in NAMES), dh, (COUNTS,) * 4)


def recorded(seed, joints=range(4), vibration=0.0):
    """A stepped sweep and eq. (11) of each of these joints, by an individual QA700."""
    specification = load_sensor("qa700")
    pieces = []
    for joint in joints:
        pieces.append(
            circlepoint.SteppedSweep(joint=joint, steps=12, span=2.4, dwell=0.6, move=0.5, return_duration=1.5)
        )
        pieces.append(circlepoint.RaisedCosine(joint=joint, span=2.4, frequency=0.5, duration=4.0))
    options = circlepoint.SimulationOptions(
        noise_std=specification.noise_std,
        encoder_counts_per_revolution=np.full(4, COUNTS),
        vibration=circlepoint.VibrationOptions(
            tangential_amplitude=vibration, orthogonal_amplitude=0.1 * vibration, frequency_max=60.0
        ),
        seed=seed,
    )
    sensor = circlepoint.draw_accelerometer(specification, seed)
    # Where within its count a joint stands at the start is another thing in every recording.
    start = START + np.random.default_rng(seed).uniform(0.0, 1e-4, 4)
    trajectory = circlepoint.joint_trajectory(start, pieces, 200.0, 0.6)
    return circlepoint.simulate(four_joints(), UP, sensor, trajectory, options)


@pytest.fixture(scope="module")
def recording():
    return recorded(seed=1)


def line_errors(calibration):
    """(n, 4) local coordinates of the true lines at the estimated ones."""
    truth = circlepoint.rebase(four_joints(), calibration.joints.reference_configuration)
    return np.array(
        [
            circlepoint.local_coordinates(estimate.axis.screw.line, axis.line)
            for estimate, axis in zip(calibration.joints.joints, truth.axes, strict=True)
        ]
    )


def line_std(calibration):
    return np.array([np.sqrt(np.diag(estimate.axis.covariance)) for estimate in calibration.joints.joints])


@pytest.mark.parametrize("method", METHODS)
def test_every_method_finds_every_line_within_its_uncertainty(recording, method):
    result = calibrate(recording, an_arm(), method=method, sensor=load_sensor("qa700"))
    errors = line_errors(result)
    assert np.abs(errors / line_std(result)).max() < 4.5
    assert np.linalg.norm(errors[:, :2], axis=1).max() < {"whole-arm": 0.05e-3, "joint": 0.1e-3}.get(method, 0.5e-3)
    bounds = {"whole-arm": 0.05e-3, "joint": 0.1e-3, "velocity": 15e-3, "position": 50e-3}  # others yield: t^2
    assert np.linalg.norm(errors[:, 2:], axis=1).max() < bounds[method]


@pytest.mark.parametrize("method", METHODS)
def test_the_document_of_every_method_fits_the_schema(recording, method):
    document = calibrate(recording, an_arm(), method=method).document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    assert document["complete"]
    assert document["method"] == method
    assert (document["sensor"]["bias"] is not None) == (method in ("whole-arm", "joint"))


@pytest.mark.parametrize("estimated", [True, False])
def test_the_document_with_a_gyroscope_fits_the_schema_and_tells_its_delay(estimated, monkeypatch):
    motion = circlepoint.MultiJointMotion(duration=15.0, amplitude=np.full(4, 1.0), seed=2)
    recording = circlepoint.simulate(
        four_joints(),
        UP,
        circlepoint.AccelerometerModel(),
        circlepoint.joint_trajectory(START, [motion], 200.0, 0.6),
        circlepoint.SimulationOptions(noise_std=0.01, angular_velocity_noise_std=0.002, seed=1),
    )

    def chosen(*arguments, **named):
        made = whole_arm_options(*arguments, **named)
        made.gyroscope_delay = circlepoint.ParameterTreatment(estimated, 0.002)
        return made

    monkeypatch.setattr("circlepoint.calibration.whole_arm_options", chosen)
    document = calibrate(recording, an_arm(), sensor=load_sensor("qa700")).document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    delay = document["sensor"]["gyroscope"]["delay"]
    if estimated:
        assert abs(delay["estimate"]) < 4.5 * delay["std"] < 1e-3
    else:
        assert delay is None
    page = sensor_table(document, None)
    assert "Accelerometer and gyroscope" in page
    assert ("not estimated" in page.partition("delay")[2]) is not estimated


def test_the_document_of_an_incomplete_calibration_fits_the_schema_and_says_what_to_record():
    result = calibrate(recorded(seed=2, joints=(0, 3)), an_arm())
    document = result.document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    assert result.chain is None
    assert result.dh is None
    assert not document["complete"]
    assert document["end_point"] is None
    assert [joint["direction_sensor"] is not None for joint in document["joints"]] == [True, False, False, True]
    for joint in document["joints"][1:3]:
        assert "turn it" in joint["reason"]
        assert any(joint["name"] in unseen for unseen in document["identifiability"]["unseen"])


@pytest.mark.parametrize("method", ["whole-arm", "joint"])
def test_the_covariance_is_labelled_by_joint_and_coordinate_and_holds_each_joints_own(recording, method):
    document = calibrate(recording, an_arm(), method=method).document
    labels = document["covariance"]["parameters"]
    matrix = np.array(document["covariance"]["matrix"])
    lines = [f"{name}.{coordinate}" for name in NAMES for coordinate in ("d1", "d2", "p1", "p2")]
    assert labels[: len(lines)] == lines
    assert (len(labels) > len(lines)) == (method == "whole-arm")  # gravity, the sensor and the delay as well
    np.testing.assert_allclose(matrix, matrix.T, rtol=0, atol=1e-9 * matrix.max())
    assert np.linalg.eigvalsh(matrix / np.sqrt(np.outer(np.diag(matrix), np.diag(matrix)))).min() > 0
    for index, joint in enumerate(document["joints"]):
        own = matrix[4 * index : 4 * index + 4, 4 * index : 4 * index + 4]
        np.testing.assert_array_equal(own, joint["covariance"])
        assert joint["direction_std"] == pytest.approx(np.sqrt(np.linalg.eigvalsh(own[:2, :2])[-1]))
        assert joint["point_std"] == pytest.approx(np.sqrt(np.linalg.eigvalsh(own[2:, 2:])[-1]))
        assert np.dot(joint["direction_sensor"], joint["point_sensor"]) == pytest.approx(0.0, abs=1e-12)


NOMINAL_ROWS = tuple(DhRow(0.1 * k, 1.5 - k, 0.2, 0.3 * k) for k in range(4))


@pytest.mark.parametrize("convention", [None, "standard", "modified"])
def test_the_exported_dh_parameters_move_the_end_point_as_the_chain_does(recording, convention):
    dh = None if convention is None else NominalDh(convention, NOMINAL_ROWS)
    result = calibrate(recording, an_arm(dh))
    exported = result.document["dh"]
    assert exported["convention"] == (convention or "standard")
    rows = [circlepoint.DhRow(*(row[name] for name in ("a", "alpha", "d", "theta"))) for row in exported["rows"]]
    kind = circlepoint.ModifiedDhChain if convention == "modified" else circlepoint.StandardDhChain
    chain = kind(
        rows, [circlepoint.JointType.revolute] * 4, base=np.array(exported["base"]), tool=np.array(exported["tool"])
    )
    poses = np.random.default_rng(3).uniform(-np.pi, np.pi, (1000, 4))
    np.testing.assert_allclose(
        circlepoint.forward_kinematics(chain, poses),
        circlepoint.forward_kinematics(result.chain, poses),
        rtol=0,
        atol=1e-9,
    )


def test_lines_are_given_at_the_reference_configuration_asked_for():
    recording = recorded(seed=5)  # in which no row lies at the limit of a knock, cut in one and not in the other
    reference = [0.3, -0.8, 1.4, 0.2]
    chosen = calibrate(recording, an_arm())
    asked = calibrate(recording, an_arm(), reference_configuration=reference)
    assert asked.document["reference_configuration"] == reference
    carried = circlepoint.rebase(chosen.chain, np.array(reference))
    for joint, theirs in zip(asked.joints.joints, carried.axes, strict=True):
        std = np.sqrt(np.diag(joint.axis.covariance))
        difference = circlepoint.local_coordinates(joint.axis.screw.line, theirs.line)
        assert np.all(np.abs(difference) < 0.05 * std)


@pytest.mark.parametrize(
    ("specified", "vibration"), [(True, 0.0), (True, 0.1), (False, 0.0)], ids=["qa700", "vibrating", "unspecified"]
)
@pytest.mark.parametrize("method", ["whole-arm", "joint"])
def test_intervals_are_honest_over_repeated_calibrations(method, specified, vibration):
    sensor = load_sensor("qa700") if specified else None
    seeds = range(10, 20)
    squares = np.zeros(4)
    for seed in seeds:
        result = calibrate(recorded(seed, vibration=vibration), an_arm(), method=method, sensor=sensor)
        squares += np.mean((line_errors(result) / line_std(result)) ** 2, axis=0) / len(seeds)
    # 40 squares a coordinate, those of a recording correlated by its sensor. A data sheet's limits and the encoders'
    # half counts are taken in full: rather too wide than too narrow.
    assert squares.max() < 2.0, squares
    assert squares.min() > 0.05, squares


def test_nearly_parallel_axes_get_hayati_rows_whose_lengths_stay_short():
    lines = [([0.9, 0.1, 0.3], [0.1, 0.6, -0.3]), ([0.9, 0.102, 0.3], [0.1, 0.2, -0.1]), LINES[2], LINES[3]]
    axes = [
        circlepoint.ScrewAxis(
            type=circlepoint.JointType.revolute, line=circlepoint.make_line(np.array(direction), np.array(point))
        )
        for direction, point in lines
    ]
    chain = circlepoint.ScrewChain(axes, np.zeros(4))
    pieces = [circlepoint.MultiJointMotion(duration=30.0, amplitude=np.full(4, 1.2), seed=2)]
    trajectory = circlepoint.joint_trajectory(START, pieces, 200.0, 0.6)
    recording = circlepoint.simulate(
        chain, UP, circlepoint.AccelerometerModel(), trajectory, circlepoint.SimulationOptions(noise_std=0.005)
    )
    result = calibrate(recording, an_arm(), sensor=load_sensor("ideal"))
    document = result.document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    dh = document["dh"]
    assert dh["convention"] == "hayati"
    assert dh["near_parallel"] == [["base", "shoulder"]]
    assert [row["form"] for row in dh["rows"]] == ["hayati", "dh", "dh", "dh"]
    assert all(abs(row[name]) < 2.0 for row in dh["rows"] for name in ("a", "d"))
    assert all(std == "free" or std < 1e-3 for row in dh["rows"] for std in row["std"].values())
    rows = [
        circlepoint.HayatiRow(
            **{name: row[name] for name in ("a", "alpha", "d", "theta", "beta")},
            form=circlepoint.RowForm[row["form"]],
        )
        for row in dh["rows"]
    ]
    read_back = circlepoint.HayatiChain(
        rows, [circlepoint.JointType.revolute] * 4, base=np.array(dh["base"]), tool=np.array(dh["tool"])
    )
    poses = np.random.default_rng(3).uniform(-np.pi, np.pi, (1000, 4))
    np.testing.assert_allclose(
        circlepoint.forward_kinematics(read_back, poses),
        circlepoint.forward_kinematics(result.chain, poses),
        rtol=0,
        atol=1e-9,
    )


def test_of_lines_too_vague_to_be_given_the_directions_are_told():
    pieces = []
    for joint in range(4):
        pieces.append(
            circlepoint.SteppedSweep(joint=joint, steps=8, span=2.0, dwell=1.0, move=4.0, return_duration=8.0)
        )
        pieces.append(circlepoint.RaisedCosine(joint=joint, span=2.0, frequency=0.05, duration=20.0))
    slow = circlepoint.joint_trajectory(START, pieces, 100.0, 0.6)
    noisy = circlepoint.SimulationOptions(noise_std=0.3, seed=1)
    recording = circlepoint.simulate(four_joints(), UP, circlepoint.AccelerometerModel(), slow, noisy)
    calibration = calibrate(recording, an_arm(), sensor=load_sensor("qa700"))
    jsonschema.Draft202012Validator(load_schema()).validate(calibration.document)
    truth = circlepoint.rebase(four_joints(), calibration.joints.reference_configuration)
    for joint, estimate, true in zip(
        calibration.document["joints"], calibration.joints.joints, truth.axes, strict=True
    ):
        assert joint["direction_sensor"] is None
        assert "mm only; move it alone, farther and faster" in joint["reason"]
        vague = joint["vague"]
        assert vague["direction_std"] < 3e-3
        assert vague["point_std"] > 2e-2
        np.testing.assert_array_equal(vague["direction_sensor"], estimate.vague.screw.line.direction)
        error = circlepoint.local_coordinates(estimate.vague.screw.line, true.line)
        assert np.all(np.abs(error) < 4.5 * np.sqrt(np.diag(estimate.vague.covariance)))
    assert "wrist, as far as it is seen: direction (" in format_joint_table(calibration.document)
    assert "6 s; as far as it is seen: direction (" in joint_table(calibration.document, None)


def test_of_joints_that_are_seen_well_or_not_at_all_nothing_vague_is_told(recording):
    assert all(joint.vague is None for joint in calibrate(recording, an_arm()).joints.joints)
    missing = calibrate(recorded(3, joints=range(3)), an_arm()).document["joints"][3]
    assert missing["reason"]
    assert "vague" not in missing


def test_an_estimate_that_has_not_settled_says_so(recording):
    settled = calibrate(recording, an_arm())
    assert settled.whole_arm.unsettled < 0.05
    assert not any(finding["code"] == "not-converged" for finding in settled.document["findings"])
    options = whole_arm_options(an_arm(), None, circlepoint.STANDARD_GRAVITY, None)
    options.max_passes = 2
    cut_short = circlepoint.calibrate_whole_arm(recording, settled.segmentation, options)
    document = with_whole_arm(settled.document, an_arm(), cut_short)
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    (found,) = (finding for finding in document["findings"] if finding["code"] == "not-converged")
    assert f"by {cut_short.unsettled:.1g} standard deviations" in found["message"]
    assert document["fit"]["unsettled"] == cut_short.unsettled > 0.05
