"""Segments as KDL has them: a joint about or along any axis, then the segment's frame."""

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


def export_kdl(placed: PlacedArm) -> Export:
    """Return the arguments of ``KDL::Segment(name, KDL::Joint(name, origin, axis, type), frame)``, base to sensor.

    The frame is the segment's tip at q = 0, as kdl_parser makes it of a URDF; a fixed segment for the tip and one for
    the sensor end the chain.
    """
    names = placed.arm.joint_names
    segments = [
        _moving(name, kind, placement, axis)
        for name, kind, placement, axis in zip(
            names, placed.arm.joint_types, placed.placements, placed.axes, strict=True
        )
    ]
    segments += [_fixed(placed.tip_name, placed.tip_placement), _fixed("sensor", placed.T_tip_sensor)]
    document = header(placed, "kdl") | {
        "formula": "T_base_sensor(q) = product over the segments of joint.pose(q) * frame",
        "segments": segments,
    }
    return Export("kdl", document)


def _moving(
    name: str, kind: circlepoint.JointType, placement: NDArray[np.float64], axis: NDArray[np.float64]
) -> dict[str, Any]:
    return {
        "name": f"{name}_link",
        "joint": {
            "name": name,
            "type": "RotAxis" if kind == circlepoint.JointType.revolute else "TransAxis",
            "origin": plain(placement[:3, 3]),
            "axis": plain(placement[:3, :3] @ axis),
        },
        "frame": _frame(placement),
    }


def _fixed(name: str, placement: NDArray[np.float64]) -> dict[str, Any]:
    return {"name": name, "joint": {"name": f"{name}_fixed", "type": "Fixed"}, "frame": _frame(placement)}


def _frame(pose: NDArray[np.float64]) -> dict[str, Any]:
    rotation = pose[:3, :3]
    return {"position": plain(pose[:3, 3]), "rotation": plain(rotation), "quaternion_xyzw": quaternion_xyzw(rotation)}
