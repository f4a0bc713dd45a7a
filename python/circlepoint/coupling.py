"""Joints that one encoder moves together: a joint of a URDF that mimics another.

Each has a line of its own. Both are estimated from any motion: turns about two lines by q and m q make harmonics
that one turn does not, and circles of their own where the lines are parallel. One case does not show: where the lines
are parallel and the turns cancel (m = -1, a parallelogram), what is carried moves along a circle without turning: only
the crank from the one line to the other is seen, and not where the pair stands.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint

if TYPE_CHECKING:
    from circlepoint.arm import Arm

_NUMBERED = re.compile(r"\bjoint(\d+)\b")


def mimic_entries(arm: Arm) -> list[dict[str, Any]]:
    """Return which joints follow which others: `joint` is at multiplier * position of `mimics` + offset."""
    return [
        {
            "joint": joint.name,
            "mimics": joint.mimic.joint,
            "multiplier": joint.mimic.multiplier,
            "offset": joint.mimic.offset,
        }
        for joint in arm.joints
        if joint.mimic is not None
    ]


def said_of(arm: Arm, text: str, joint: int | None = None) -> str:
    """Return what the estimate says of joints by number, under the arm's names, with advice that can be followed.

    Parameters
    ----------
    arm : Arm
    text : str
        Joints in it are called ``joint1`` and so on, base to tip.
    joint : int, optional
        The joint (0-based) it is about; default: those in the text.
    """
    numbers = [int(number) - 1 for number in _NUMBERED.findall(text)] if joint is None else [joint]
    named = _NUMBERED.sub(lambda match: arm.joints[int(match.group(1)) - 1].name, text)
    coupled = next((index for index in numbers if arm.coupled(index)), None)
    if coupled is None:
        return named
    return (
        f"{re.split('; move |: move ', named)[0]}; {arm.joints[coupled].name} moves together with "
        f"{', '.join(arm.coupled(coupled))} (mimic), never alone: move it with the others (calibrate --method "
        f"whole-arm); where their axes are parallel and their turns cancel, as in a parallelogram, the place of the "
        f"pair does not show, nor does it change where the tip goes"
    )


def following(arm: Arm, trajectory: circlepoint.JointTrajectory) -> circlepoint.JointTrajectory:
    """Return the motion of all joints where those that are driven make this one."""
    if arm.driven is arm:
        return trajectory
    still = arm.follow(np.zeros_like(trajectory.velocity))
    return circlepoint.JointTrajectory(
        trajectory.time,
        np.ascontiguousarray(arm.follow(trajectory.position)),
        np.ascontiguousarray(arm.follow(trajectory.velocity) - still),
        np.ascontiguousarray(arm.follow(trajectory.acceleration) - still),
        trajectory.sample_rate,
    )


def leading(arm: Arm, recording: circlepoint.Recording) -> circlepoint.Recording:
    """Return a recording of all joints with the columns of those that are driven, as a log has them."""
    if arm.driven is arm:
        return recording
    return circlepoint.make_recording(
        recording.time,
        np.ascontiguousarray(arm.lead(np.asarray(recording.joint_positions))),
        recording.specific_force,
        angular_velocity=recording.angular_velocity,
        temperature=recording.temperature,
    )
