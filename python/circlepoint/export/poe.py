"""Product of exponentials: the axes as they are, at the reference configuration and at zero."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint.document import plain
from circlepoint.export.form import Export, header
from circlepoint.transforms import inverse

if TYPE_CHECKING:
    from circlepoint.export.placement import PlacedArm


def export_poe(placed: PlacedArm) -> Export:
    """Return ``T_base_sensor(q) = exp(S_1 (q_1 - r_1)) ... exp(S_n (q_n - r_n)) home``, screws in the base frame.

    Also with all r at zero (``at_zero``), the form of textbooks. A screw is (angular, linear), its line's direction and
    the point nearest the base frame's origin beside it.
    """
    zero = np.zeros(len(placed.arm.joint_names))
    pose = circlepoint.forward_kinematics(placed.chain, zero)
    at_zero = circlepoint.rebase(placed.chain, zero)  # in the sensor frame at zero
    axes = [circlepoint.transform(pose, axis) for axis in at_zero.axes]
    document = header(placed, "poe") | {
        "formula": "T_base_sensor(q) = exp(S_1 (q_1 - r_1)) ... exp(S_n (q_n - r_n)) home, r: reference_configuration",
        "screws": [_screw(axis) for axis in placed.chain.axes],
        "home": plain(np.asarray(placed.chain.home)),
        "at_zero": {"screws": [_screw(axis) for axis in axes], "home": plain(pose)},
        "T_tip_sensor": plain(placed.T_tip_sensor),
        "T_sensor_tip": plain(inverse(placed.T_tip_sensor)),
        "tip_frame": placed.tip_name,
    }
    return Export("poe", document)


def _screw(axis: circlepoint.ScrewAxis) -> dict[str, Any]:
    line = axis.line
    return {
        "type": axis.type.name,
        "direction": plain(line.direction),
        "point": plain(line.point) if axis.type == circlepoint.JointType.revolute else None,
        "screw": plain(np.ravel(axis.twist())),
    }
