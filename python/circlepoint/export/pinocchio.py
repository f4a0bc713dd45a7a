"""Joint placements as Pinocchio has them: ``Model.addJoint(parent, joint, SE3(rotation, translation), name)``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import circlepoint
from circlepoint.document import plain
from circlepoint.export.form import Export, header
from circlepoint.transforms import quaternion_xyzw

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from circlepoint.export.placement import PlacedArm


def export_pinocchio(placed: PlacedArm) -> Export:
    """Return each joint's model, axis and placement in its parent joint, and the tip's and the sensor's frames."""
    names = placed.arm.joint_names
    parents = ["universe", *names[:-1]]
    joints = [
        {"name": name, "parent": parent, "model": _model(kind), "axis": plain(axis), "placement": _placement(pose)}
        for name, parent, kind, axis, pose in zip(
            names, parents, placed.arm.joint_types, placed.axes, placed.placements, strict=True
        )
    ]
    frames = [
        {"name": placed.tip_name, "parent": names[-1], "placement": _placement(placed.tip_placement)},
        {"name": "sensor", "parent": names[-1], "placement": _placement(placed.tip_placement @ placed.T_tip_sensor)},
    ]
    document = header(placed, "pinocchio") | {
        "formula": "oMi[i] = oMi[parent] * placement * motion(axis, q_i); T_base_sensor = oMi[n] * placement of sensor",
        "serial_joints": joints,
        "frames": frames,
    }
    return Export("pinocchio", document)


def _model(kind: circlepoint.JointType) -> str:
    return "JointModelRevoluteUnaligned" if kind == circlepoint.JointType.revolute else "JointModelPrismaticUnaligned"


def _placement(pose: NDArray[np.float64]) -> dict[str, Any]:
    rotation = pose[:3, :3]
    return {
        "translation": plain(pose[:3, 3]),
        "rotation": plain(rotation),
        "quaternion_xyzw": quaternion_xyzw(rotation),
    }
