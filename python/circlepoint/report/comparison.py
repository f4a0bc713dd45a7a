"""How far an estimate is from a known truth, for demonstrations and simulated recordings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from circlepoint.report.inputs import Document, is_estimated, number, vector

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class LineError(NamedTuple):
    """Distance of a line from the true one: angle between directions (rad), between nearest points (m)."""

    direction: float | None
    point: float | None


def line_errors(document: Document, truth: Mapping[str, Any] | None) -> list[LineError]:
    """Return each joint's error; None where either side has no line."""
    true_joints: Sequence[Mapping[str, Any]] = (truth or {}).get("joints") or []
    errors = []
    for index, joint in enumerate(document["joints"]):
        known = true_joints[index] if index < len(true_joints) else None
        if known is None or not is_estimated(joint):
            errors.append(LineError(None, None))
            continue
        direction, true_direction = vector(joint["direction_sensor"]), vector(known.get("direction_sensor"))
        point, true_point = vector(joint.get("point_sensor")), vector(known.get("point_sensor"))
        angle = None
        if direction is not None and true_direction is not None:
            sine = float(np.linalg.norm(np.cross(direction, true_direction)))
            angle = float(np.arctan2(sine, np.dot(direction, true_direction)))
        distance = None
        if joint.get("type") != "prismatic" and point is not None and true_point is not None:
            distance = float(np.linalg.norm(np.subtract(point, true_point)))
        errors.append(LineError(angle, distance))
    return errors


def nominal_differences(document: Document) -> list[LineError] | None:
    """Return how far each estimated axis lies from where the arm's description puts it; None without any."""
    entries = [joint.get("nominal") or {} for joint in document["joints"]]
    if not any(entries):
        return None
    return [
        LineError(number(entry.get("direction_difference")), number(entry.get("point_difference"))) for entry in entries
    ]


def largest(values: Sequence[float | None]) -> tuple[float, int] | None:
    """Return the largest known value and where it is."""
    known = [(value, index) for index, value in enumerate(values) if value is not None]
    return max(known, key=lambda entry: entry[0]) if known else None
