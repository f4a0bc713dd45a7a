"""What the motion in a recording shows an estimate of the whole arm: any motion counts, not tests alone.

A line shows by how the readings change as its joint turns: gravity turns in the sensor's frame, which shows the line's
direction, and its acceleration shows the place. Nothing is estimated here, and no nominal arm is needed: the figures
are those of the joints' motion and of the readings themselves.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

import circlepoint

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.arm import Joint

    FloatArray = NDArray[np.float64]

JointStatus = Literal["good", "weak", "missing"]

MIN_TRAVEL = circlepoint.WholeArmOptions().min_travel
"""rad or m: joints that travel less have no line."""
SHORT_TRAVEL = {"revolute": 0.2, "prismatic": 0.05}
"""rad or m: the travel a joint should have."""
SLOW = {"revolute": 0.5, "prismatic": 0.2}
"""rad/s^2 or m/s^2: the acceleration it should reach, or the place of its line hardly shows."""
MIN_GRAVITY_TURN = math.radians(30)
"""By which gravity should turn in the sensor's frame: else a bias and a tilt look alike."""
MIN_SECOND_TURN = math.radians(20)
"""By which it should leave the plane it turns in."""

_BLOCK = 0.1  # s, over which motion and readings are averaged
_MOVING = 0.01  # rad/s or m/s
_ALIGNED = 0.995  # correlation of the speeds of two joints that move in step


@dataclass(frozen=True)
class JointMotion:
    """How a joint moved in a recording, alone or with others; rad or m.

    Attributes
    ----------
    travel : float
        Range of its positions.
    speed, acceleration : float
        Largest, over 0.1 s.
    time : float
        s, in motion.
    in_step : tuple of int
        Joints (0-based) it never moves apart from.
    static : bool
        Whether still poses are all that was recorded.
    """

    travel: float
    speed: float
    acceleration: float
    time: float
    in_step: tuple[int, ...]
    static: bool = False


@dataclass(frozen=True)
class GravityMotion:
    """How gravity turned in the sensor's frame, rad.

    Attributes
    ----------
    turn : float
        Largest angle between two directions.
    second : float
        How far its directions are from one plane: zero where the sensor turned about one line only.
    """

    turn: float
    second: float


def joint_motions(recording: circlepoint.Recording) -> tuple[JointMotion, ...]:
    """Return how each joint moved."""
    positions = [_blocks(recording, span, np.asarray(recording.joint_positions)) for span in recording.spans]
    speeds = np.concatenate([np.diff(block, axis=0) / _BLOCK for block in positions])
    changes = np.concatenate([np.diff(block, n=2, axis=0) / _BLOCK**2 for block in positions])
    everywhere = np.asarray(recording.joint_positions)
    joints = range(recording.joints)
    return tuple(
        JointMotion(
            travel=float(np.ptp(everywhere[:, joint])),
            speed=_largest(speeds[:, joint]),
            acceleration=_largest(changes[:, joint]),
            time=float(np.count_nonzero(np.abs(speeds[:, joint]) > _MOVING) * _BLOCK),
            in_step=tuple(other for other in joints if other != joint and _in_step(speeds[:, [joint, other]])),
            static=recording.is_static,
        )
        for joint in joints
    )


def gravity_motion(recording: circlepoint.Recording) -> GravityMotion | None:
    """Return how gravity turned, by the readings averaged over 0.1 s; None for a recording too short to say."""
    force = np.concatenate([_blocks(recording, span, np.asarray(recording.specific_force)) for span in recording.spans])
    if force.shape[0] < 2:
        return None
    directions = force / np.maximum(np.linalg.norm(force, axis=1), 1e-9)[:, None]
    spread = directions - directions.mean(axis=0)
    axes = np.linalg.svd(spread, full_matrices=False)[2]
    chord = min(float(np.ptp(spread @ axes[0])), 2.0)
    return GravityMotion(
        turn=float(2 * np.arcsin(chord / 2)),
        second=float(np.ptp(np.arcsin(np.clip(directions @ axes[2], -1.0, 1.0)))),
    )


def _blocks(recording: circlepoint.Recording, span: circlepoint.IndexRange, values: FloatArray) -> FloatArray:
    """Return means (K, channels) over 0.1 s of one span."""
    length = max(1, round(_BLOCK * recording.sample_rate))
    count = span.size // length
    rows = values[span.begin : span.begin + count * length]
    blocks: FloatArray = rows.reshape(count, length, values.shape[1]).mean(axis=1)
    return blocks


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max()) if values.size else 0.0


def _in_step(speeds: FloatArray) -> bool:
    """Whether two joints' speeds (K, 2) are proportional whenever one of them moves."""
    power = speeds.T @ speeds
    if min(power[0, 0], power[1, 1]) < _MOVING**2:
        return False
    return bool(abs(power[0, 1]) > _ALIGNED * np.sqrt(power[0, 0] * power[1, 1]))


def judge_motion(joint: Joint, motion: JointMotion, *, together: bool) -> tuple[JointStatus, str]:
    """Return whether the whole arm's estimate can find a joint's line, and what to record next.

    Parameters
    ----------
    joint : Joint
    motion : JointMotion
    together : bool
        Whether all it moves in step with are moved by the same encoder: a mimic joint cannot do otherwise.
    """
    degrees, metres = (60, 0) if joint.revolute else (0, 0.15)
    brisk = f"move it over {f'{degrees} deg' if joint.revolute else f'{1000 * metres:.0f} mm'} or more, 0.5 Hz or so"
    if motion.travel < MIN_TRAVEL:
        return "missing", f"it does not move: {brisk}, alone or with others"
    if motion.static:
        shown = "its direction and not its place" if joint.revolute else "nothing of a sliding joint"
        return "missing", f"still poses show {shown}: {brisk}, alone or with others"
    if motion.travel < SHORT_TRAVEL[joint.type]:
        return "weak", f"it moves little: {brisk}, alone or with others"
    if motion.acceleration < SLOW[joint.type]:
        return "weak", f"it moves slowly, so the place of its line hardly shows: {brisk}"
    if motion.in_step and not together:
        status: JointStatus = "weak" if len(motion.in_step) == 1 else "missing"
        return status, "they only move in step with one another: move each at times or at rates of its own"
    return "good", ""


def judge_gravity(gravity: GravityMotion | None) -> tuple[JointStatus, str]:
    """Return whether the sensor can be told from the arm by gravity, and what to record next."""
    more = "hold still at six or more orientations of the sensor well apart, 1 s each"
    if gravity is None or gravity.turn < MIN_GRAVITY_TURN:
        return "missing", f"gravity hardly turns in the sensor's frame, so a bias and a tilt look alike: {more}"
    if gravity.second < MIN_SECOND_TURN:
        return "weak", f"gravity turns about little more than one line of the sensor: {more}"
    return "good", ""
