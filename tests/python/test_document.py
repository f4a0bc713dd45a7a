"""The result document: the schema describes all of it, and a file is whole or not there."""

import json

import jsonschema
import numpy as np
import pytest

from circlepoint.document import (
    SCHEMA_NAME,
    dh_row_entry,
    estimate_entry,
    finding_entries,
    generator_entry,
    joint_entry,
    load_schema,
    missing_joint_entry,
    write_document,
)
from circlepoint.findings import Finding


def a_document(*, complete=True):
    line = {
        "direction": np.array([0.0, 0.0, 1.0]),
        "point": np.array([0.1, 0.2, 0.0]),
        "direction_std": np.float64(1e-5),
        "point_std": 1e-4,
        "covariance": np.eye(4) * 1e-10,
        "basis": np.eye(3)[:2],
        "tests": [{"dwells": np.int64(16), "dwell_span": 2.6, "motions": 3, "motion_span": 2.6}],
    }
    joints = [joint_entry("pan", "revolute", **line), joint_entry("slide", "prismatic", **line)]
    if not complete:
        joints[1] = missing_joint_entry("slide", "prismatic", "no motion of this joint; move it alone")
    stds = [1e-4, 1e-5, 1e-4, None]
    dh = {
        "convention": "standard",
        "rows": [
            dh_row_entry({"a": 0.1, "alpha": 0.0, "d": 0.0, "theta": 1.0}, stds, [False, False, k == 0, k == 0])
            for k in range(2)
        ],
        "base": np.eye(4),
        "tool": np.eye(4),
        "near_parallel": [["pan", "slide"]],
    }
    return {
        "schema": SCHEMA_NAME,
        "generator": generator_entry(),
        "arm": "two",
        "method": "joint",
        "complete": complete,
        "reference_configuration": np.zeros(2),
        "joints": joints,
        "gravity_magnitude": 9.80665,
        "gravity_sensor": np.array([0.0, 0.0, 9.80665]),
        "sensor": {
            "bias": estimate_entry(np.zeros(3), np.ones(3)),
            "scale": None,
            "misalignment": None,
            "percussion_distance": estimate_entry(0.0182, 1e-4),
            "clock_offset": estimate_entry(0.07, 1e-4),
            "clock_rate": estimate_entry(1.0033, 1e-6),
        },
        "dh": dh if complete else None,
        "covariance": {"parameters": ["pan.d1", "pan.d2"], "matrix": np.eye(2)},
        "identifiability": {"rank": 6, "condition_number": 30.0, "unseen": []},
        "fit": {
            "samples": 1000,
            "noise_std": 1e-3,
            "normalised_residual_rms": 1.0,
            "iterations": 4,
            "converged": True,
        },
        "end_point": {"rms": 1e-4, "max": 2e-4} if complete else None,
        "findings": finding_entries([Finding("gap", "log.csv: a gap of 0.1 s at 3 s")]),
    }


@pytest.mark.parametrize("complete", [True, False])
def test_what_is_written_satisfies_the_schema(tmp_path, complete):
    path = tmp_path / "calibration.json"
    write_document(path, a_document(complete=complete))
    document = json.loads(path.read_text())
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    assert document["schema"] == "circlepoint/calibration/1"
    assert [joint["direction_sensor"] is None for joint in document["joints"]] == [False, not complete]
    assert document["joints"][0]["point_sensor"] == [0.1, 0.2, 0.0]
    assert [entry.name for entry in tmp_path.iterdir()] == ["calibration.json"]


def test_the_schema_is_valid_and_describes_every_field_of_the_top_level():
    schema = load_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    assert not schema["additionalProperties"]
    for name, field in schema["properties"].items():
        assert field.get("description"), name


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("gravity_magnitude", float("nan")),
        ("gravity_sensor", [0.0, float("inf"), 0.0]),
        ("complete", False),
        ("reference_configuration", [0.0]),
        ("schema", "circlepoint/calibration/0"),
        ("covariance", {"parameters": ["a"], "matrix": [[1.0, 2.0]]}),
        ("surprise", 1),
        ("joints", [missing_joint_entry("a", "revolute", ""), missing_joint_entry("b", "revolute", "why")]),
    ],
)
def test_an_inconsistent_document_is_not_written_and_the_earlier_one_stays(tmp_path, field, value):
    path = tmp_path / "calibration.json"
    path.write_text("earlier")
    with pytest.raises(ValueError, match="calibration document"):
        write_document(path, {**a_document(), field: value})
    assert path.read_text() == "earlier"
    assert [entry.name for entry in tmp_path.iterdir()] == ["calibration.json"]


def test_a_failure_while_writing_leaves_nothing_behind(tmp_path, monkeypatch):
    path = tmp_path / "calibration.json"

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pathlib.Path.replace", fail)
    with pytest.raises(KeyboardInterrupt):
        write_document(path, a_document())
    assert not list(tmp_path.iterdir())
