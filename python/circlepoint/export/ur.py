"""The kinematics calibration of Universal Robots' descriptions (``default_kinematics.yaml`` of ur_description).

Six placements, x y z roll pitch yaw, each joint turning about its own z: the frames of the nominal Denavit-Hartenberg
rows (`circlepoint.export.nominal_frames`), moved onto the calibrated axes. ``hash`` tells the driver which robot the
numbers belong to; the controller's own is unknown here.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

import circlepoint
from circlepoint._core import InvalidInput
from circlepoint.dh_rows import neighbour_angles
from circlepoint.document import plain
from circlepoint.export.form import Export, header, yaml_text
from circlepoint.transforms import rpy_of_rotation

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from circlepoint.export.placement import PlacedArm

LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
_PARALLEL = (1, 2)
"""Pairs (joint, next) of a Universal Robots arm whose axes are parallel; from 0."""


def export_ur(placed: PlacedArm, checksum: str | None = None) -> Export:
    """Return the kinematics block.

    Parameters
    ----------
    placed : PlacedArm
        With a nominal arm.
    checksum : str, optional
        The controller's ``calib_...``. Default: one of these numbers, which no controller has.

    Raises
    ------
    InvalidInput
        The arm is not of this kind, or there is no nominal arm whose frames could be kept.
    """
    nominal = _require_ur(placed)
    kinematics: dict[str, dict[str, float] | str] = {}
    for link, placement, drawn in zip(LINKS, placed.placements, nominal, strict=True):
        angles = rpy_of_rotation(placement[:3, :3], rpy_of_rotation(drawn[:3, :3]))
        values = [*plain(placement[:3, 3]), *angles]
        kinematics[link] = dict(zip(("x", "y", "z", "roll", "pitch", "yaw"), map(float, values), strict=True))
    notes: tuple[str, ...] = ()
    if checksum is None:
        digest = hashlib.sha256(repr(kinematics).encode()).hexdigest()[:16]
        checksum = f"circlepoint_{digest}"
        note = (
            "hash is not the controller's: the driver warns that robot and description differ; give the controller's "
            "with --hash to state that they belong together"
        )
        notes = (note,)
    kinematics["hash"] = checksum
    notes += (f"the sensor is at T_tip_sensor in {placed.tip_name}, which keeps its nominal place on {LINKS[-1]}",)
    document = header(placed, "ur", notes) | {"T_tip_sensor": plain(placed.T_tip_sensor), "kinematics": kinematics}
    comment = "".join(f"# kept nominal: {entry['quantity']}\n" for entry in document["kept_nominal"])
    text = f"# {placed.arm.name}, calibrated by circlepoint {circlepoint.__version__}; m and rad\n{comment}"
    text += yaml_text({"kinematics": kinematics})
    return Export("ur", document, {".yaml": text}, notes)


def _require_ur(placed: PlacedArm) -> tuple[NDArray[np.float64], ...]:
    nominal, arm = placed.nominal, placed.arm
    if nominal is None:
        raise InvalidInput(
            f"arm {arm.name!r}: the form ur keeps the frames of the nominal arm, and none was given; give its arm.yaml "
            "with `dh`, or its URDF, with --arm"
        )
    revolute = all(kind == circlepoint.JointType.revolute for kind in arm.joint_types)
    angles = neighbour_angles(nominal.chain(arm.reference).axes)
    if (
        len(arm.joint_types) != len(LINKS)
        or not revolute
        or any((angle < 0.1) != (index in _PARALLEL) for index, angle in enumerate(angles))
    ):
        raise InvalidInput(
            f"arm {arm.name!r}: is not of Universal Robots' kind (six revolute joints, axes 2, 3 and 4 parallel, the "
            "others not); the form ur is for these alone, use urdf or dh"
        )
    if any(float(axis[2]) < 1.0 - 1e-9 for axis in nominal.axes):
        raise InvalidInput(
            f"{nominal.source}: its joints do not turn about their z axes as in today's ur_description; give an "
            "arm.yaml with the maker's `dh` with --arm"
        )
    return nominal.placements
