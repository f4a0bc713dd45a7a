"""URDF: the arm's own, its joint origins moved onto the calibrated axes; or a minimal one where there was none.

Link frames move with their joints, by the millimetres and milliradians the arm is off its drawing, and what is attached
to a link - visuals, collisions, inertials, fixed joints - stays as it is in the link's frame: the metal belongs to the
axis it turns about. Compensating their origins would hold them where the drawing had them, which no measurement
supports. Joint limits stay too; they are limits of the raw encoder values.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint.document import plain
from circlepoint.export.form import Export, header
from circlepoint.export.nominal_frames import frames_of_urdf
from circlepoint.export.placement import PlacedArm, place
from circlepoint.export.result import calibrated_arm
from circlepoint.export.urdf_text import attribute, with_placements
from circlepoint.transforms import inverse, rpy_of_rotation
from circlepoint.urdf_xml import parse_urdf

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from circlepoint.arm import Arm, Joint
    from circlepoint.export.result import CalibratedArm

SENSOR_LINK = "sensor"
UNKNOWN_TRAVEL = 10.0
"""m, written as the limit of a prismatic joint whose limits nobody gave."""


def write_calibrated_urdf(
    urdf_text: str, calibration_document: Mapping[str, Any], base: str | None = None, tip: str | None = None
) -> str:
    """Return a URDF with the joint origins of the calibrated chain moved onto the calibrated axes.

    Parameters
    ----------
    urdf_text : str
        The nominal URDF; everything but those origins stays byte for byte.
    calibration_document : mapping
        The content of ``calibration.json``, every joint estimated, joints named as in the URDF.
    base, tip : str, optional
        Links; by default the parent of the first calibrated joint and the child of the last.

    Raises
    ------
    InvalidInput
        The text is no URDF, refers to something outside itself, or does not describe the calibrated arm.
    NotIdentifiable
        A joint's axis is missing.
    """
    return export_urdf(calibrated_arm(calibration_document), urdf_text, base=base, tip=tip).texts[".urdf"]


def export_urdf(
    arm: CalibratedArm, urdf_text: str, where: str = "URDF", *, base: str | None = None, tip: str | None = None
) -> Export:
    """Return the edited URDF and its notes; parameters and errors as `write_calibrated_urdf`, `where` names it."""
    urdf = parse_urdf(urdf_text, where)
    chain = urdf.chain_of(arm.joint_names, base, tip)
    nominal = frames_of_urdf(chain, where)
    placed = place(arm, nominal)
    text, changed = with_placements(urdf_text, chain, placed.placements)
    notes = (
        f"{len(changed)} joint origins changed, nothing else: {', '.join(changed) or 'none'}",
        "visuals, collisions and inertials stay in their links' frames, which moved with the joints",
        f"the sensor is at T_tip_sensor in {placed.tip_name}; the URDF has no link for it",
    )
    moved = {
        name: _moved(old, new)
        for name, old, new in zip(arm.joint_names, nominal.placements, placed.placements, strict=True)
    }
    document = header(placed, "urdf", notes) | {"robot": urdf.robot, **_tip_entries(placed), "joints_moved": moved}
    return Export("urdf", document, {".urdf": text}, notes)


def minimal_urdf(placed: PlacedArm, description: Arm | None = None) -> Export:
    """Return a URDF made from the calibrated axes alone: links without bodies, joints, tip and sensor.

    Parameters
    ----------
    placed : PlacedArm
    description : Arm, optional
        Gives the joints' limits.
    """
    names = placed.arm.joint_names
    described = {joint.name: joint for joint in description.joints} if description else {}
    unlimited = [name for name in names if name not in described or described[name].limits is None]
    notes = (
        "no URDF was given: this one has links without bodies",
        "effort limits are unknown and written as 0" + (f"; no limits of {', '.join(unlimited)}" if unlimited else ""),
        f"link {SENSOR_LINK!r} is the accelerometer's frame",
    )
    links = [placed.base_name, *(f"{name}_link" for name in names), placed.tip_name, SENSOR_LINK]
    lines = ['<?xml version="1.0"?>', f"<!-- {_comment(placed)} -->", f"<robot name={attribute(placed.arm.name)}>"]
    lines += [f"  <link name={attribute(link)}/>" for link in links]
    rows = zip(names, placed.arm.joint_types, links[:-3], links[1:-2], placed.placements, placed.axes, strict=True)
    for name, kind, parent, child, placement, axis in rows:
        lines += _joint(name, kind, (parent, child), (placement, axis), described.get(name))
    lines += _fixed("tip_fixed", links[-3:-1], placed.tip_placement)
    lines += _fixed("sensor_fixed", links[-2:], placed.T_tip_sensor)
    lines += ["</robot>", ""]
    document = header(placed, "urdf", notes) | {"robot": placed.arm.name, **_tip_entries(placed)}
    return Export("urdf", document, {".urdf": "\n".join(lines)}, notes)


def _tip_entries(placed: PlacedArm) -> dict[str, Any]:
    return {
        "tip_frame": placed.tip_name,
        "T_tip_sensor": plain(placed.T_tip_sensor),
        "T_sensor_tip": plain(inverse(placed.T_tip_sensor)),
    }


def _moved(old: NDArray[np.float64], new: NDArray[np.float64]) -> dict[str, float]:
    turn = circlepoint.rotation_log(old[:3, :3].T @ new[:3, :3])
    return {
        "distance": float(np.linalg.norm(new[:3, 3] - old[:3, 3])),
        "angle": float(np.linalg.norm(turn)),
    }


def _comment(placed: PlacedArm) -> str:
    name = placed.arm.name.replace("--", "- -")
    return f"{name}, calibrated by circlepoint {circlepoint.__version__}; base frame: {placed.base_name}"


def _joint(
    name: str,
    kind: circlepoint.JointType,
    links: tuple[str, str],
    pose: tuple[NDArray[np.float64], NDArray[np.float64]],
    described: Joint | None,
) -> list[str]:
    placement, axis = pose
    limits = described.limits if described else None
    revolute = kind == circlepoint.JointType.revolute
    urdf_type = "prismatic" if not revolute else "continuous" if limits is None else "revolute"
    lines = [f"  <joint name={attribute(name)} type={attribute(urdf_type)}>", *_frame(links, placement)]
    lines.append(f'    <axis xyz="{_triple(axis)}"/>')
    if urdf_type != "continuous":
        low, high = limits or (-UNKNOWN_TRAVEL, UNKNOWN_TRAVEL)
        velocity = described.velocity if described and described.velocity else 0.0
        lines.append(f'    <limit lower="{low!r}" upper="{high!r}" velocity="{velocity!r}" effort="0.0"/>')
    return [*lines, "  </joint>"]


def _fixed(name: str, links: Sequence[str], placement: NDArray[np.float64]) -> list[str]:
    opening = f'  <joint name={attribute(name)} type="fixed">'
    return [opening, *_frame((links[0], links[1]), placement), "  </joint>"]


def _frame(links: tuple[str, str], placement: NDArray[np.float64]) -> list[str]:
    rpy = rpy_of_rotation(placement[:3, :3])
    return [
        f"    <parent link={attribute(links[0])}/>",
        f"    <child link={attribute(links[1])}/>",
        f'    <origin xyz="{_triple(placement[:3, 3])}" rpy="{_triple(rpy)}"/>',
    ]


def _triple(values: Sequence[float] | NDArray[np.float64]) -> str:
    return " ".join(repr(float(value) + 0.0) for value in values)
