"""Rigid transforms (4, 4) in the notations other programs take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

import circlepoint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray


def rigid(rotation: ArrayLike | None = None, translation: ArrayLike = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """Return the transform of a rotation matrix and a translation in m."""
    pose = np.eye(4)
    if rotation is not None:
        pose[:3, :3] = rotation
    pose[:3, 3] = translation
    return pose


def inverse(pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the inverse of a rigid transform."""
    rotation = pose[:3, :3].T
    return rigid(rotation, -rotation @ pose[:3, 3])


def joint_motion(joint_type: circlepoint.JointType, axis: ArrayLike, q: float) -> NDArray[np.float64]:
    """Return the motion of a joint about or along an axis (unit) through the origin by q, rad or m."""
    along = q * np.asarray(axis, dtype=float)
    if joint_type == circlepoint.JointType.revolute:
        return rigid(circlepoint.rotation_exp(along))
    return rigid(translation=along)


def rotation_from_rpy(rpy: Sequence[float]) -> NDArray[np.float64]:
    """Return Rot_z(yaw) Rot_y(pitch) Rot_x(roll), the rotation of URDF's ``rpy``."""
    roll, pitch, yaw = rpy
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def rpy_of_rotation(
    rotation: NDArray[np.float64], nearest: Sequence[float] = (0.0, 0.0, 0.0)
) -> tuple[float, float, float]:
    """Return roll, pitch, yaw of a rotation matrix, exact also where pitch is a right angle.

    Parameters
    ----------
    rotation : (3, 3) ndarray
    nearest : sequence of float
        Angles, rad; of the two solutions and their turns the one nearest to these.
    """
    candidates = []
    yaw = math.atan2(rotation[1, 0], rotation[0, 0])
    if math.hypot(rotation[1, 0], rotation[0, 0]) < 1e-12:
        yaw = nearest[2]
    for turned in (yaw, yaw + math.pi):
        cy, sy = math.cos(turned), math.sin(turned)
        # What is left without the yaw is Rot_y(pitch) Rot_x(roll): its second row is (0, cos roll, -sin roll).
        rest = np.array([[cy, sy, 0.0], [-sy, cy, 0.0], [0.0, 0.0, 1.0]]) @ rotation
        angles = (math.atan2(-rest[1, 2], rest[1, 1]), math.atan2(-rest[2, 0], rest[0, 0]), turned)
        near = [_nearest_turn(angle, wanted) for angle, wanted in zip(angles, nearest, strict=True)]
        candidates.append((near[0], near[1], near[2]))
    return min(candidates, key=lambda found: math.dist(found, nearest))


def quaternion_xyzw(rotation: NDArray[np.float64]) -> list[float]:
    """Return the unit quaternion (x, y, z, w) of a rotation matrix, w not negative."""
    # The largest eigenvector of Bar-Itzhack's matrix: no case distinction, no loss near half-turns.
    r = rotation
    k = np.array(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], 0.0, 0.0, 0.0],
            [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], 0.0, 0.0],
            [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], 0.0],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
        ]
    )
    quaternion = np.linalg.eigh(k)[1][:, -1]
    return [float(x) for x in (quaternion if quaternion[3] >= 0.0 else -quaternion)]


def nearest_frame(
    frame: NDArray[np.float64], axis: ArrayLike, line: circlepoint.Line, *, keep_origin: bool = False
) -> NDArray[np.float64]:
    """Return the frame nearest to another one whose axis lies on a line.

    Parameters
    ----------
    frame : (4, 4) ndarray
    axis : array_like, shape (3,)
        Unit, in the frame: what must come to lie along the line's direction. The rotation is the smallest that does it.
    line : Line
        Its point nearest the frame's origin becomes the origin.
    keep_origin : bool
        The line has a direction only; leave the origin where it is.
    """
    rotation, origin = frame[:3, :3], frame[:3, 3]
    wanted = np.asarray(line.direction)
    now = rotation @ np.asarray(axis, dtype=float)
    across = np.cross(now, wanted)
    sine, cosine = float(np.linalg.norm(across)), float(now @ wanted)
    if sine > 0.0:
        turn = circlepoint.rotation_exp(math.atan2(sine, cosine) / sine * across)
    else:
        turn = np.eye(3)
        if cosine < 0.0:
            turn = circlepoint.rotation_exp(math.pi * circlepoint.tangent_basis(wanted)[:, 0])
    if not keep_origin:
        point = np.asarray(line.point)
        origin = point + wanted * float(wanted @ (origin - point))
    return rigid(turn @ rotation, origin)


def _nearest_turn(angle: float, wanted: float) -> float:
    return wanted + math.remainder(angle - wanted, 2.0 * math.pi)
