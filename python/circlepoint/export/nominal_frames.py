"""The nominal arm as frames on its joints: what an export starts from and changes as little as it can."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.nominal import DhChain, joint_types, nominal_dh_chain
from circlepoint.transforms import joint_motion

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from circlepoint.arm import Arm
    from circlepoint.urdf_xml import UrdfJoint


@dataclass(frozen=True)
class NominalFrames:
    """A serial chain: each joint's frame in the one before, and its axis in its own frame.

    ``T_base_tip(q) = P_1 M_1(q_1) ... P_n M_n(q_n) tip`` with M_i the motion about or along axis i.

    Attributes
    ----------
    source : str
        Where it was described.
    base, tip : str
        Names of the first frame and the last.
    placements : tuple of (4, 4) ndarray
        P_i, at q = 0.
    axes : tuple of (3,) ndarray
        Unit, each in its own frame.
    types : tuple of JointType
    tip_placement : (4, 4) ndarray
        The tip in the last joint's frame.
    dh : StandardDhChain, ModifiedDhChain or None
        The rows it was described by.
    """

    source: str
    base: str
    tip: str
    placements: tuple[NDArray[np.float64], ...]
    axes: tuple[NDArray[np.float64], ...]
    types: tuple[circlepoint.JointType, ...]
    tip_placement: NDArray[np.float64]
    dh: DhChain | None = None

    def frames(self, q: ArrayLike) -> list[NDArray[np.float64]]:
        """Return each joint's frame (4, 4), moved by its own joint, in the base frame."""
        pose = np.eye(4)
        frames = []
        positions = np.asarray(q, dtype=float)
        for placement, axis, kind, position in zip(self.placements, self.axes, self.types, positions, strict=True):
            pose = pose @ placement @ joint_motion(kind, axis, float(position))
            frames.append(pose)
        return frames

    def chain(self, q: ArrayLike) -> circlepoint.ScrewChain:
        """Return the axes in the base frame at a configuration, home being the tip's pose."""
        frames = self.frames(q)
        axes = [
            circlepoint.ScrewAxis(kind, circlepoint.make_line(frame[:3, :3] @ axis, frame[:3, 3]))
            for frame, axis, kind in zip(frames, self.axes, self.types, strict=True)
        ]
        return circlepoint.ScrewChain(axes, np.ascontiguousarray(q, dtype=float), frames[-1] @ self.tip_placement)


def frames_of_arm(arm: Arm, source: str) -> NominalFrames | None:
    """Return the frames of an arm's nominal Denavit-Hartenberg rows; None without rows.

    A joint's frame has its z along the axis: in the modified convention the row's own frame, in the standard one the
    frame between the row's screw about z and its screw about x (the frames of Universal Robots' descriptions).
    """
    chain = nominal_dh_chain(arm)
    if chain is None:
        return None
    types = joint_types(arm)
    placements: list[NDArray[np.float64]] = []
    tip = np.eye(4)
    for row, kind in zip(chain.rows, types, strict=True):
        if isinstance(chain, circlepoint.ModifiedDhChain):
            placements.append(circlepoint.modified_dh_transform(row, kind, 0.0))
            continue
        about_z = circlepoint.DhRow(0.0, 0.0, row.d, row.theta)
        about_x = circlepoint.DhRow(row.a, row.alpha, 0.0, 0.0)
        placements.append(tip @ circlepoint.standard_dh_transform(about_z, kind, 0.0))
        tip = circlepoint.standard_dh_transform(about_x, kind, 0.0)
    return NominalFrames(
        source=source,
        base="base",
        tip="flange",
        placements=tuple(placements),
        axes=_z_axes(len(types)),
        types=tuple(types),
        tip_placement=tip,
        dh=chain,
    )


def frames_of_urdf(chain: Sequence[UrdfJoint], source: str) -> NominalFrames:
    """Return the frames of the child links of a URDF's chain; fixed joints are folded into them."""
    placements: list[NDArray[np.float64]] = []
    moving: list[UrdfJoint] = []
    pose = np.eye(4)
    for joint in chain:
        pose = pose @ joint.origin
        if not joint.fixed:
            placements.append(pose)
            moving.append(joint)
            pose = np.eye(4)
    return NominalFrames(
        source=source,
        base=chain[0].parent,
        tip=chain[-1].child,
        placements=tuple(placements),
        axes=tuple(joint.axis for joint in moving),
        types=tuple(joint.joint_type for joint in moving),
        tip_placement=pose,
    )


def _z_axes(n: int) -> tuple[NDArray[np.float64], ...]:
    return tuple(np.array([0.0, 0.0, 1.0]) for _ in range(n))
