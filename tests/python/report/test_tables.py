"""The printed tables, character for character, and how numbers are rounded."""

from __future__ import annotations

from pathlib import Path

import pytest

from circlepoint.report import format_dh_table, format_joint_table
from circlepoint.report.rounding import ABSENT, align_decimals, format_uncertain

GOLDEN = Path(__file__).parent / "golden"


def golden(name):
    return (GOLDEN / name).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("value", "std", "expected"),
    [  # the Particle Data Group's own examples (0.827 +- 0.119 and 0.827 +- 0.367), then the edges of the rule
        (0.827, 0.119, ("0.83", "0.12")),
        (0.827, 0.367, ("0.8", "0.4")),
        (0.827, 0.354, ("0.83", "0.35")),
        (0.827, 0.355, ("0.8", "0.4")),
        (0.827, 0.0949, ("0.83", "0.09")),
        (0.827, 0.0951, ("0.83", "0.10")),
        (14.674, 0.964, ("14.7", "1.0")),
        (12345.6, 123.0, ("12346", "123")),
        (-0.0004, 0.02, ("0.000", "0.020")),
        (1.5, None, ("1.500", "")),
        (None, None, (ABSENT, "")),
    ],
)
def test_value_ends_at_the_last_digit_of_its_uncertainty(value, std, expected):
    assert format_uncertain(value, std) == expected


def test_aligned_numbers_have_their_points_at_one_distance_from_the_right():
    aligned = align_decimals(["1.25", "-10.5", "7", ABSENT])
    assert aligned == ["1.25", "-10.5 ", "7   ", ABSENT]


def test_joint_table_is_as_printed_before(calibration):
    assert format_joint_table(calibration.document) == golden("joint_table.txt")


def test_joint_table_with_truth_is_as_printed_before(calibration, truth):
    assert format_joint_table(calibration.document, truth) == golden("joint_table_truth.txt")


def test_joint_table_without_a_line_is_as_printed_before(incomplete_calibration):
    assert format_joint_table(incomplete_calibration.document) == golden("joint_table_incomplete.txt")


def test_dh_table_is_as_printed_before(calibration):
    assert format_dh_table(calibration.document) == golden("dh_table.txt")


def test_dh_table_without_parameters_says_what_they_need(incomplete_calibration):
    assert "every joint's axis" in format_dh_table(incomplete_calibration.document)


def test_joint_table_shows_the_true_error_and_not_the_deviation(calibration, truth):
    truth["joints"][2]["point_sensor"] = [
        c + 0.0123 * d for c, d in zip(calibration.document["joints"][2]["point_sensor"], (0.6, 0.0, 0.8), strict=True)
    ]
    row = format_joint_table(calibration.document, truth).splitlines()[5]
    assert row.startswith("joint3")
    assert row.split()[-1] == "12"


def test_a_prismatic_joint_has_a_direction_and_no_point(calibration):
    joint = calibration.document["joints"][1]
    joint.update(type="prismatic", point_sensor=None, point_std=None)
    row = format_joint_table(calibration.document).splitlines()[4].split()
    assert row[0] == "joint2"
    assert row[1:4] == ["-0.705151", "-0.578881", "0.409462"]
    assert row[4:7] == [ABSENT] * 3
    assert "not estimated" not in format_joint_table(calibration.document)


def test_joints_that_fail_for_one_reason_are_named_together_and_an_empty_table_is_left_out():
    missing = {"direction_sensor": None, "point_sensor": None, "direction_std": None, "point_std": None}
    joints = [{"name": f"j{k}", "type": "revolute", "reason": "gravity hardly turns", **missing} for k in (1, 2)]
    joints.append({"name": "j3", "type": "revolute", "reason": "it never moves", **missing})
    assert format_joint_table({"joints": joints}).splitlines() == [
        "j1, j2: not estimated. gravity hardly turns",
        "j3: not estimated. it never moves",
    ]
