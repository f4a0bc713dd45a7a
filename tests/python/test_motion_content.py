"""What motion shows the whole arm's estimate, on motions made to show it or not."""

import math

import numpy as np
import pytest

import circlepoint
from circlepoint.arm import Joint
from circlepoint.motion_content import gravity_motion, joint_motions, judge_gravity, judge_motion

RATE = 100.0
PAN, SLIDE = Joint("pan", "revolute"), Joint("slide", "prismatic")


def recording(q, force=None):
    t = np.arange(len(q)) / RATE
    force = np.tile([0.0, 0.0, 9.8], (t.size, 1)) if force is None else force
    return circlepoint.make_recording(t, np.ascontiguousarray(q), np.ascontiguousarray(force))


def turning(*angles):
    """Gravity in the frame of a sensor that turns about its x, then about its y."""
    about_x, about_y = angles
    return 9.8 * np.column_stack(
        [np.sin(about_y) * np.cos(about_x), np.sin(about_x), np.cos(about_y) * np.cos(about_x)]
    )


def verdict(joint, q, together=False):
    return judge_motion(joint, joint_motions(recording(q))[0], together=together)[0]


def test_travel_speed_and_acceleration_are_those_of_the_motion():
    t = np.arange(3000) / RATE
    motion, still = joint_motions(recording(np.column_stack([0.5 * np.sin(2 * t), 0 * t + 0.3])))
    assert motion.travel == pytest.approx(1.0, rel=1e-3)
    assert motion.speed == pytest.approx(1.0, rel=0.01)
    assert motion.acceleration == pytest.approx(2.0, rel=0.01)
    assert motion.time == pytest.approx(30.0, rel=0.02)
    assert (still.travel, still.speed, still.time) == (0.0, pytest.approx(0.0, abs=1e-9), 0.0)


def test_joints_that_move_by_one_law_are_in_step_and_others_are_not():
    t = np.arange(3000) / RATE
    q = np.column_stack([np.sin(t), 0.3 - 0.4 * np.sin(t), np.sin(1.3 * t), 0 * t])
    assert [motion.in_step for motion in joint_motions(recording(q))] == [(1,), (0,), (), ()]


def test_verdicts_follow_the_motion():
    t = np.arange(3000) / RATE
    wave = np.sin(np.pi * t)
    assert verdict(PAN, np.column_stack([0.5 * wave, 0 * t])) == "good"
    assert verdict(PAN, np.column_stack([0.05 * wave, 0 * t])) == "weak"
    assert verdict(PAN, np.column_stack([0.005 * wave, wave])) == "missing"
    assert verdict(PAN, np.column_stack([0.5 * np.sin(0.3 * t), 0 * t])) == "weak"
    assert verdict(SLIDE, np.column_stack([0.1 * wave, 0 * t])) == "good"
    assert verdict(PAN, np.column_stack([0.5 * wave, 0.3 * wave])) == "weak"
    assert verdict(PAN, np.column_stack([0.5 * wave, 0.3 * wave]), together=True) == "good"
    assert verdict(PAN, np.column_stack([0.5 * wave, 0.3 * wave, 0.7 * wave])) == "missing"


@pytest.mark.parametrize(
    ("first", "second", "expected"), [(0.0, 0.0, "missing"), (1.0, 0.0, "weak"), (1.0, 0.6, "good")]
)
def test_gravity_is_judged_by_how_it_turns_in_the_sensor(first, second, expected):
    t = np.arange(3000) / RATE
    force = turning(first * np.sin(0.4 * t), second * np.sin(0.7 * t))
    turned = gravity_motion(recording(np.column_stack([t, t]), force))
    assert judge_gravity(turned)[0] == expected
    if expected == "weak":
        assert turned.turn == pytest.approx(2 * first, rel=0.02)
        assert turned.second < math.radians(1)


def test_a_cone_about_one_line_is_one_turn_however_wide():
    t = np.arange(3000) / RATE
    force = 9.8 * np.column_stack([0.6 * np.cos(t), 0.6 * np.sin(t), 0 * t + 0.8])
    turned = gravity_motion(recording(np.column_stack([t, t]), force))
    assert turned.turn == pytest.approx(2 * math.asin(0.6), rel=0.01)
    assert judge_gravity(turned)[0] == "weak"
