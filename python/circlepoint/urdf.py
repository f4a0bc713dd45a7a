"""URDF in: a serial arm from a base link to a tip link, with its nominal axes as lines.

Fixed joints are folded into the frames between; links, meshes, inertias are not looked at. A joint that mimics another
keeps its own line and follows the other's encoder: its position is ``multiplier * position + offset``. The other may be
beside the arm; then its column must be in the log too.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from circlepoint._core import InvalidInput, JointType
from circlepoint.arm import Arm, Joint, Mimic, NominalLine, NominalLines
from circlepoint.urdf_xml import parse_urdf, read_urdf_file

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.urdf_xml import Urdf, UrdfJoint


def read_urdf(path: str | Path, base: str | None = None, tip: str | None = None) -> Arm:
    """Read an arm from a URDF.

    Parameters
    ----------
    path : str or Path
        The file, xacro already expanded.
    base : str, optional
        Link the arm begins at; default: the root of the tree.
    tip : str, optional
        Link that carries the sensor; default: the only leaf above the base.

    Returns
    -------
    Arm
        Joints base to tip with names, types and limits, and the nominal lines at zero joint positions.

    Raises
    ------
    InvalidInput
        When the file cannot be read or is no serial arm from base to tip; the message names file, line, element,
        value and remedy.
    """
    path = Path(path)
    urdf = parse_urdf(read_urdf_file(path), str(path))
    chain = urdf.chain(base, tip)
    moving = [joint for joint in chain if not joint.fixed]
    if not moving:
        ends = f"{base or (chain[0].parent if chain else tip)} and {tip or (chain[-1].child if chain else base)}"
        raise InvalidInput(f"{path}: no joint moves between {ends}; choose --base and --tip further apart")
    joints = tuple(_moving_joint(urdf, joint) for joint in moving)
    names = {joint.name for joint in joints}
    beside = {joint.mimic.joint for joint in joints if joint.mimic and joint.mimic.joint not in names}
    return Arm(
        name=urdf.robot or path.stem,
        joints=joints,
        lines=_lines(chain),
        beside=tuple(_moving_joint(urdf, joint) for joint in urdf.joints if joint.name in beside),
    )


def _lines(chain: list[UrdfJoint]) -> NominalLines:
    lines: list[NominalLine] = []
    pose = np.eye(4)
    for joint in chain:
        pose = pose @ joint.origin
        if not joint.fixed:
            lines.append(NominalLine(_triple(pose[:3, :3] @ joint.axis), _triple(pose[:3, 3])))
    tip = tuple(tuple(float(x) for x in row) for row in pose)
    return NominalLines((0.0,) * len(lines), tuple(lines), tip)


def _moving_joint(urdf: Urdf, joint: UrdfJoint) -> Joint:
    return Joint(
        name=joint.name,
        type="revolute" if joint.joint_type == JointType.revolute else "prismatic",
        limits=joint.limits,
        velocity=joint.velocity,
        mimic=_mimic(urdf, joint),
    )


def _mimic(urdf: Urdf, joint: UrdfJoint) -> Mimic | None:
    """Return what a joint follows, through joints that follow others themselves."""
    if joint.mimic is None:
        return None
    multiplier, offset = 1.0, 0.0
    followed, seen = joint, [joint.name]
    while followed.mimic is not None:
        name, times, plus = followed.mimic
        multiplier, offset = multiplier * times, offset + multiplier * plus
        source = urdf.joint(name)
        if source is None or source.fixed:
            moving = ", ".join(other.name for other in urdf.joints if not other.fixed)
            raise followed.error(f"mimics {name!r}, which is not a joint that moves; those are {moving}")
        if name in seen:
            raise joint.error(f"mimics itself ({' -> '.join([*seen, name])}); let one of them move by itself")
        seen.append(name)
        followed = source
    return Mimic(followed.name, multiplier, offset)


def _triple(vector: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return x, y, z
