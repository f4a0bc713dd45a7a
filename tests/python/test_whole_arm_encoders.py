"""Encoders that are off: found where the data show it, left alone where they do not."""

import jsonschema
import numpy as np
import pytest
from whole_arm_support import (
    LINES,
    START,
    assert_found,
    chain_of,
    errors_and_std,
    estimate,
    free,
    recorded,
    sweeps_of,
    value,
)

import circlepoint as cp
from circlepoint.arm import Arm, Joint
from circlepoint.calibration import calibrate
from circlepoint.document import load_schema
from circlepoint.sensor_presets import load_sensor

FIXED = cp.ParameterTreatment(estimated=False)
PIECES = pytest.mark.parametrize("pieces", [sweeps_of(), free()], ids=["tests", "all joints at once"])


def misread(recording, *, gain=(0, 0, 0), cosine=(0, 0, 0), sine=(0, 0, 0)):
    """Return the recording as encoders with these errors read it: true = read + error(read)."""
    gain, cosine, sine = np.array(gain), np.array(cosine), np.array(sine)
    true = np.array(recording.joint_positions)
    read = true
    for _ in range(50):
        read = (
            true
            - gain * (read - START)
            - cosine * (np.cos(read) - np.cos(START))
            - sine * (np.sin(read) - np.sin(START))
        )
    return cp.make_recording(
        recording.time, read, recording.specific_force, angular_velocity=recording.angular_velocity
    )


def encoder_parameters(result):
    return [p.name for p in result.parameters if "gain" in p.name or "eccentricity" in p.name]


@PIECES
def test_nothing_is_estimated_of_encoders_that_are_right(pieces):
    result = estimate(recorded(pieces))
    assert result.converged
    assert encoder_parameters(result) == []


@PIECES
def test_an_eccentric_encoder_is_found(pieces):
    result = estimate(misread(recorded(pieces), cosine=(0, 2e-3, 0), sine=(0, 1e-3, 0)))
    assert result.converged
    assert encoder_parameters(result) == ["joint2.eccentricity_cos", "joint2.eccentricity_sin"]
    for name, true in (("joint2.eccentricity_cos", 2e-3), ("joint2.eccentricity_sin", 1e-3)):
        found = value(result, name)
        assert abs(found.value - true) < 4.5 * found.std < 4e-4
    np.testing.assert_array_equal(result.eccentricity[[0, 2]], 0.0)
    assert_found(result, chain_of(LINES), 2e-4)


@PIECES
def test_a_gain_so_wrong_that_the_motions_disagree_is_found(pieces):
    result = estimate(misread(recorded(pieces), gain=(0, 0.01, 0)))
    assert result.converged
    assert encoder_parameters(result) == ["joint2.gain"]
    assert result.encoder_gain[1] == pytest.approx(0.01, abs=1.5e-4)
    assert_found(result, chain_of(LINES), 2e-4)


@pytest.mark.parametrize(
    ("pieces", "limit"), [(sweeps_of(), 3e-4), (free(), 6e-4)], ids=["tests", "all joints at once"]
)
def test_several_encoders_each_with_its_own_errors_are_found(pieces, limit):
    wrong = misread(recorded(pieces), gain=(0.02, -0.01, 0.005), cosine=(0.003, 0, 0), sine=(0, 0.003, 0))
    result = estimate(wrong)
    assert result.converged
    assert sorted(encoder_parameters(result)) == [
        *(f"joint1.{error}" for error in ("eccentricity_cos", "eccentricity_sin", "gain")),
        *(f"joint2.{error}" for error in ("eccentricity_cos", "eccentricity_sin", "gain")),
        "joint3.gain",
    ]
    np.testing.assert_allclose(result.encoder_gain, [0.02, -0.01, 0.005], atol=limit)
    np.testing.assert_allclose(result.eccentricity, [[3e-3, 0], [0, 3e-3], [0, 0]], atol=limit)
    assert result.noise_inflation < 1.2
    assert_found(result, chain_of(LINES), 3e-4)


def test_a_coarse_encoder_that_is_off_costs_no_more_than_one_known_to_be():
    count = 2.0 * np.pi / 4096.0
    wrong = misread(recorded(free()), gain=(0, 0, 0.02))
    positions = np.round(np.array(wrong.joint_positions) / count) * count
    counted = cp.make_recording(wrong.time, positions, wrong.specific_force)
    resolution = np.full(3, count)
    found = estimate(counted, encoder_resolution=resolution)
    forced = estimate(counted, encoder_resolution=resolution, encoder_gain=cp.ParameterTreatment(std=0.05))
    assert "joint3.gain" in encoder_parameters(found)
    gain = value(found, "joint3.gain")
    assert abs(gain.value - 0.02) < 4.5 * gain.std
    assert gain.std < 3.0 * value(forced, "joint3.gain").std
    assert found.noise_inflation < 3.0


def test_knocks_are_found_beside_an_encoder_that_is_off():
    wrong = misread(recorded(free()), gain=(0, 0.03, 0), cosine=(0, 0, 0.01))
    force = np.array(wrong.specific_force)
    random = np.random.default_rng(4)
    force[random.choice(len(force), 25, replace=False), random.integers(3, size=25)] += 8.0
    result = estimate(cp.make_recording(wrong.time, wrong.joint_positions, force))
    assert result.outliers > 150
    assert result.encoder_gain[1] == pytest.approx(0.03, abs=5e-4)
    assert_found(result, chain_of(LINES), 3e-4)


def test_a_gyroscope_helps_to_find_an_encoder_that_is_off():
    wrong = misread(recorded(free(20.0), angular_velocity_noise_std=0.002), gain=(0, 0, 0.002))
    result = estimate(wrong)
    assert result.gyroscope_used
    assert encoder_parameters(result) == ["joint3.gain"]
    assert value(result, "joint3.gain").std < value(estimate(wrong, use_gyroscope=False), "joint3.gain").std
    assert_found(result, chain_of(LINES), 3e-4)


@pytest.mark.parametrize("gain", [0.02, 0.005])
def test_a_sliding_joints_gain_is_found_and_told_as_such(gain):
    lines = [*LINES[:2], ([0.2, 1.0, 0.3], [0.0, 0.0, 0.0])]
    chain = chain_of(lines, [cp.JointType.revolute, cp.JointType.revolute, cp.JointType.prismatic])
    pieces = [
        *sweeps_of(range(2)),
        cp.SteppedSweep(joint=2, steps=6, span=0.3, dwell=0.6, move=0.5, return_duration=1.5),
        cp.RaisedCosine(joint=2, span=0.3, frequency=0.5, duration=6.0),
    ]
    wrong = misread(recorded(pieces, chain=chain), gain=(0, 0, gain))
    arm = Arm("slide", (Joint("shoulder", "revolute"), Joint("elbow", "revolute"), Joint("slide", "prismatic")))
    (entry,) = (document := calibrate(wrong, arm, sensor=load_sensor("qa700")).document)["encoders"]
    assert entry["joint"] == "slide"
    assert entry["gain"]["estimate"] == pytest.approx(gain, abs=6e-4)
    assert entry["eccentricity_cos"] is None
    assert any("slide: slides" in finding["message"] for finding in document["findings"])


def test_where_a_joint_never_moves_the_findings_speak_of_no_export():
    wrong = misread(recorded(sweeps_of((0, 2))), gain=(0, 0, 0.01))
    arm = Arm("three joints", tuple(Joint(name, "revolute") for name in ("shoulder", "elbow", "wrist")))
    document = calibrate(wrong, arm, sensor=load_sensor("qa700")).document
    assert not document["complete"]
    (told,) = (finding["message"] for finding in document["findings"] if finding["code"] == "encoder-gain")
    assert "wrist: turns" in told
    assert "URDF" not in told


def test_only_encoders_can_be_estimated_where_evident():
    with pytest.raises(cp.InvalidInput, match="encoder_gain and eccentricity only"):
        estimate(recorded(free(10.0)), scale=cp.ParameterTreatment(where_evident=True))


def test_encoders_said_to_be_right_are_believed():
    wrong = misread(recorded(sweeps_of()), cosine=(0, 2e-3, 0))
    believed = estimate(wrong, encoder_gain=FIXED, eccentricity=FIXED)
    assert encoder_parameters(believed) == []
    errors, _ = errors_and_std(believed, chain_of(LINES))
    assert np.abs(errors).max() > 3e-4


def test_every_encoders_gain_is_estimated_on_request():
    wrong = misread(recorded(sweeps_of(), noise=0.002), gain=(0, 0.002, 0))
    result = estimate(wrong, encoder_gain=cp.ParameterTreatment(std=0.01), eccentricity=FIXED)
    assert encoder_parameters(result) == ["joint1.gain", "joint2.gain", "joint3.gain"]
    np.testing.assert_allclose(result.encoder_gain, [0, 0.002, 0], atol=1e-4)


def test_the_document_names_the_encoders_that_are_off():
    wrong = misread(recorded(sweeps_of()), gain=(0.01, 0, 0), sine=(0, 0, 2e-3))
    arm = Arm("three joints", tuple(Joint(name, "revolute") for name in ("shoulder", "elbow", "wrist")))
    document = calibrate(wrong, arm, sensor=load_sensor("qa700")).document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    shoulder, wrist = document["encoders"]
    assert (shoulder["joint"], wrist["joint"]) == ("shoulder", "wrist")
    assert shoulder["gain"]["estimate"] == pytest.approx(0.01, abs=2e-4)
    assert wrist["eccentricity_sin"]["estimate"] == pytest.approx(2e-3, abs=3e-4)
    assert wrist["gain"] is None
    told = {finding["code"]: finding for finding in document["findings"]}
    assert "% more than its encoder" in told["encoder-gain"]["message"]
    assert told["eccentricity"]["joint"] == "wrist"
    assert "by 2 mrad" in told["eccentricity"]["message"]
