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
    return cp.make_recording(recording.time, read, recording.specific_force)


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


def test_several_encoders_each_with_its_own_errors_are_found():
    wrong = misread(recorded(sweeps_of()), gain=(0.02, -0.01, 0.005), cosine=(0.003, 0, 0), sine=(0, 0.003, 0))
    result = estimate(wrong)
    assert result.converged
    assert {"joint1.gain", "joint2.gain", "joint3.gain", "joint1.eccentricity_cos"} <= set(encoder_parameters(result))
    np.testing.assert_allclose(result.encoder_gain, [0.02, -0.01, 0.005], atol=3e-4)
    np.testing.assert_allclose(result.eccentricity, [[3e-3, 0], [0, 3e-3], [0, 0]], atol=3e-4)
    assert_found(result, chain_of(LINES), 3e-4)


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
    assert "% more than its encoder" in told["encoder_gain"]["message"]
    assert told["eccentricity"]["joint"] == "wrist"
    assert "by 2 mrad" in told["eccentricity"]["message"]
