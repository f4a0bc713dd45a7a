"""Plans and the motions they describe."""

import numpy as np
import pytest

import circlepoint as cp
from circlepoint.protocol import load_plan, paper_plan

NAMES = [f"joint{i}" for i in range(1, 8)]


def plan_file(tmp_path, text):
    path = tmp_path / "plan.yaml"
    path.write_text(text)
    return path


def test_the_papers_plan_moves_one_joint_at_a_time_within_its_size():
    plan = paper_plan(NAMES)
    trajectory = plan.trajectory()
    assert trajectory.sample_rate == 250.0
    assert trajectory.joints == 7
    assert 40_000 < trajectory.samples < 60_000
    assert (np.count_nonzero(trajectory.velocity, axis=1) <= 1).all()
    np.testing.assert_allclose(np.ptp(trajectory.position, axis=0), np.deg2rad(150), rtol=1e-6)
    np.testing.assert_allclose(trajectory.position[[0, -1]], np.deg2rad(-75), rtol=0, atol=1e-12)


def test_the_papers_plan_holds_sixteen_static_poses_and_equation_11_for_every_joint():
    plan = paper_plan(NAMES)
    trajectory = plan.trajectory()
    assert len(plan.pieces) == 14
    resting = ~trajectory.velocity.any(axis=1) & ~trajectory.acceleration.any(axis=1)
    for joint in range(7):
        held, count = np.unique(np.round(np.rad2deg(trajectory.position[resting, joint]), 6), return_counts=True)
        np.testing.assert_allclose(held, np.arange(-75, 76, 10), rtol=0, atol=1e-5)
        assert count.min() >= 0.8 * 250
    start = 0.5 + 16 * 0.8 + 15 * 0.6 + 2.0 + 0.5
    swing = (trajectory.time >= start) & (trajectory.time < start + 6.0)
    expected = np.deg2rad(-75) + np.deg2rad(150) * (1 - np.cos(np.pi * (trajectory.time[swing] - start))) / 2
    np.testing.assert_allclose(trajectory.position[swing, 0], expected, rtol=0, atol=1e-9)


def test_a_plan_says_units_by_the_kind_of_joint(tmp_path):
    path = plan_file(
        tmp_path,
        "rate_hz: 100\nrest: [0.5, 0.1]\npause: 0\ntests:\n"
        "  - {joint: all, dynamic: {frequency_hz: 1, span_deg: 90, span_m: 0.2, duration: 1}}\n"
        "  - free: {duration: 10, amplitude_deg: 30, amplitude_m: 0.05, frequency_max_hz: 0.3, seed: 4}\n",
    )
    plan = load_plan(path, ["turn", "slide"], ["revolute", "prismatic"])
    trajectory = plan.trajectory()
    np.testing.assert_allclose(trajectory.position[0], [0.5, 0.1])
    assert trajectory.position[50, 0] == pytest.approx(0.5 + np.pi / 2)
    assert trajectory.position[150, 1] == pytest.approx(0.3)
    assert np.abs(trajectory.position[200:, 1] - 0.1).max() <= 0.05
    assert trajectory.samples == 1201


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rest_deg: 0\ntests: []", "1: rate_hz: is missing; a finite number above 0 is needed"),
        ("rate_hz: 0\nrest_deg: 0\ntests: []", "1: rate_hz: is 0, must be a finite number above 0"),
        (
            "rate_hz: 100\nrest_deg: [1, 2]\ntests: []",
            "2: rest_deg: is a list of 2, must be one number, or a list of 7",
        ),
        ("rate_hz: 100\nrest_deg: 0\ntests: []", "3: tests: is a list of 0, must be a list of tests"),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: elbow, static: {}}]",
            r"3: tests\[0\].joint: is 'elbow'; .*joint1",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: joint1}]",
            r"3: tests\[0\].joint: is 'joint1', but .*; give static",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: all, static: {steps: 3, span_deg: 9, stop: 1}}]",
            r"3: tests\[0\].static.stop: unknown key; the keys known here are .*dwell",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: all, static: {steps: 2.5, span_deg: 9}}]",
            r"3: tests\[0\].static.steps: is 2.5, must be a whole number of at least 2",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: all, dynamic: {frequency_hz: 1, span_deg: 9, duration: 2.5}}]",
            r"motion 1 of 7 is not possible: .* 2.5\d* cycles",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\ntests: [{joint: joint2, dynamic: {frequency_hz: 1, span_m: 9, duration: 5}}]",
            r"3: tests\[0\].dynamic.span_m: no prismatic joint takes part; give span_deg only",
        ),
        (
            "rate_hz: 100\nrest_deg: 0\nspeed: 3\ntests: [{free: {duration: 9, amplitude_deg: 5}}]",
            "3: speed: unknown key; the keys known here are name, rate_hz",
        ),
        ("rate_hz: 100\nrest_deg: 0\nrest: 0\ntests: []", "3: rest: rest_deg is given too; keep one"),
        (
            "rate_hz: 100\nrest_deg: 0\ntests:\n- free: {duration: 9, amplitude_deg: 5}\n  joint: joint1",
            r"5: tests\[0\].joint: does not go with free",
        ),
        ("rate_hz: 100\nrate_hz: 200", "2: rate_hz: was given on line 1 already"),
    ],
)
def test_a_malformed_plan_names_file_line_field_value_and_remedy(tmp_path, text, message):
    with pytest.raises(cp.InvalidInput, match=f"plan.yaml(, line |: ){message}"):
        load_plan(plan_file(tmp_path, text), NAMES)


def test_eq_11_and_its_derivatives_agree_with_finite_differences():
    trajectory = cp.joint_trajectory(np.zeros(1), [cp.RaisedCosine(joint=0, span=2.0)], 1000.0)
    for value, derivative in (
        (trajectory.position, trajectory.velocity),
        (trajectory.velocity, trajectory.acceleration),
    ):
        difference = (value[2:-1] - value[:-3]) * 500.0
        np.testing.assert_allclose(difference, derivative[1:-2], rtol=0, atol=2e-4)
