"""The joint axes as things to draw: one scene, shown by the page's interactive view and by the printed figure.

All positions are in the sensor frame at the reference configuration, in mm. A joint's tube is where its line may lie:
at s from the nearest point its radius is k sqrt(point_std^2 + (s direction_std)^2), with one factor k for all joints,
a round number chosen so that the widest tube can be seen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint.report.inputs import Array, Document, is_estimated, number, vector
from circlepoint.report.style import shortened

if TYPE_CHECKING:
    from collections.abc import Mapping

_parallel_sine = 0.05
_widest_tube = 0.025  # of the scene's size, as the next ones
_triad_size = 0.11
_gravity_size = 0.17
_overhang = 0.13


@dataclass(frozen=True)
class AxisSegment:
    """The drawn piece of one joint's axis, mm."""

    index: int
    name: str
    nearest: Array
    direction: Array
    begin: float  # along the direction, from the nearest point
    end: float
    direction_std: float | None
    point_std: float | None
    truth: tuple[Array, Array] | None

    def at(self, s: float) -> Array:
        """Return the point at s along the axis."""
        return np.asarray(self.nearest + s * self.direction)


@dataclass(frozen=True)
class Scene:
    """What is drawn; `links` are the common normals from joint to joint and to the sensor."""

    axes: list[AxisSegment]
    links: list[tuple[Array, Array]]
    up: Array
    size: float
    corners: Array  # what must stay in the picture
    center: Array
    tube_factor: float
    view: Array  # rows: right, up, towards the reader


def build_scene(document: Document, truth: Mapping[str, Any] | None = None) -> Scene | None:
    """Lay out what is known of the arm, or None where no joint's axis is."""
    lines: list[tuple[int, Document, Array, Array]] = []
    for index, joint in enumerate(document["joints"]):
        direction = vector(joint.get("direction_sensor"))
        if not is_estimated(joint) or direction is None:
            continue
        point = vector(joint.get("point_sensor")) or [0.0, 0.0, 0.0]
        lines.append((index, joint, np.asarray(direction), 1e3 * np.asarray(point)))
    if not lines:
        return None
    feet, links = _skeleton([(direction, point) for _, _, direction, point in lines])
    points = np.vstack([*(np.vstack(pair) for pair in links), np.zeros((1, 3))])
    size = max(float(np.ptp(points, axis=0).max()), 1.0)
    segments = [
        _segment(index, joint, (direction, point), feet=pair, size=size, truth=truth)
        for (index, joint, direction, point), pair in zip(lines, feet, strict=True)
    ]
    gravity = vector(document.get("gravity_sensor"))
    up = np.array([0.0, 0.0, 1.0]) if gravity is None else np.asarray(gravity) / np.linalg.norm(gravity)
    arm = _triad_size * size
    corners = np.vstack(
        [points, arm * np.eye(3), -_gravity_size * size * up]
        + [np.vstack([axis.at(axis.begin), axis.at(axis.end)]) for axis in segments]
    )
    view = _best_view(corners, up, np.vstack([axis.direction for axis in segments]))
    seen = corners @ view.T
    return Scene(
        axes=segments,
        links=links,
        up=up,
        size=size,
        corners=corners,
        center=np.asarray(view.T @ (0.5 * (seen.min(axis=0) + seen.max(axis=0)))),
        tube_factor=_tube_factor(segments, size),
        view=view,
    )


def triad_and_gravity(scene: Scene) -> tuple[Array, Array]:
    """Return the tips of the sensor's axes (rows) and of the gravity arrow, mm; all start at the sensor."""
    return _triad_size * scene.size * np.eye(3), np.asarray(-_gravity_size * scene.size * scene.up)


def tube_radius(axis: AxisSegment, s: float, factor: float) -> float:
    """Return the tube's radius in mm at s along the axis."""
    return factor * math.hypot(1e3 * (axis.point_std or 0.0), s * (axis.direction_std or 0.0))


def as_json(scene: Scene) -> dict[str, Any]:
    """Return the scene as the page's script reads it, rounded to what can be seen."""

    def triple(values: Array, digits: int = 2) -> list[float]:
        return [round(float(value), digits) for value in values]

    triad, gravity = triad_and_gravity(scene)
    return {
        "axes": [
            {
                "index": axis.index,
                "name": shortened(axis.name),
                "nearest": triple(axis.nearest, 3),
                "direction": triple(axis.direction, 6),
                "begin": round(axis.begin, 1),
                "end": round(axis.end, 1),
                "point_std": 1e3 * (axis.point_std or 0.0),
                "direction_std": axis.direction_std or 0.0,
                "truth": None if axis.truth is None else [triple(axis.truth[0], 3), triple(axis.truth[1], 6)],
            }
            for axis in scene.axes
        ],
        "links": [[triple(begin), triple(end)] for begin, end in scene.links],
        "up": triple(scene.up, 5),
        "corners": [triple(corner, 1) for corner in scene.corners],
        "triad": [triple(tip) for tip in triad],
        "gravity": triple(gravity),
        "center": triple(scene.center),
        "factor": scene.tube_factor,
        "view": [triple(row, 6) for row in scene.view],
    }


def _skeleton(lines: list[tuple[Array, Array]]) -> tuple[list[list[float]], list[tuple[Array, Array]]]:
    """Return for each line the places of its links along it, and the links: common normals, last the sensor's."""
    feet: list[list[float]] = [[] for _ in lines]
    links = []
    for i in range(len(lines) - 1):
        (z1, c1), (z2, c2) = lines[i], lines[i + 1]
        cosine = float(z1 @ z2)
        between = c2 - c1
        if 1.0 - cosine**2 > _parallel_sine**2:
            s1 = float(between @ (z1 - cosine * z2)) / (1.0 - cosine**2)
        else:
            s1 = feet[i][-1] if feet[i] else 0.0
        s2 = float(z2 @ (c1 + s1 * z1 - c2))
        feet[i].append(s1)
        feet[i + 1].append(s2)
        links.append((np.asarray(c1 + s1 * z1), np.asarray(c2 + s2 * z2)))
    feet[-1].append(0.0)
    links.append((np.asarray(lines[-1][1]), np.zeros(3)))
    return feet, links


def _segment(
    index: int,
    joint: Document,
    line: tuple[Array, Array],
    *,
    feet: list[float],
    size: float,
    truth: Mapping[str, Any] | None,
) -> AxisSegment:
    overhang = _overhang * size
    known = (truth or {}).get("joints") or []
    true_line = None
    if index < len(known):
        true_direction = vector(known[index].get("direction_sensor"))
        true_point = vector(known[index].get("point_sensor"))
        if true_direction is not None and true_point is not None:
            true_line = (1e3 * np.asarray(true_point), np.asarray(true_direction))
    return AxisSegment(
        index=index,
        name=joint["name"],
        nearest=line[1],
        direction=line[0],
        begin=min(feet) - overhang,
        end=max(feet) + overhang,
        direction_std=number(joint.get("direction_std")),
        point_std=number(joint.get("point_std")),
        truth=true_line,
    )


def _tube_factor(axes: list[AxisSegment], size: float) -> float:
    widest = max(max(tube_radius(axis, axis.begin, 1.0), tube_radius(axis, axis.end, 1.0)) for axis in axes)
    if widest <= 0.0:
        return 1.0
    wanted = _widest_tube * size / widest
    if wanted <= 1.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(wanted))
    return power * max(step for step in (1.0, 2.0, 5.0) if step * power <= wanted)


def _best_view(points: Array, up: Array, directions: Array) -> Array:
    """Stand with gravity downwards, above, where the arm looks wide and no axis points at the reader."""
    start = np.eye(3)[int(np.argmin(np.abs(up)))]
    right = np.cross(up, start)
    right /= np.linalg.norm(right)
    size = float(np.ptp(points, axis=0).max())
    best_score, best = -1.0, np.eye(3)
    for elevation in np.deg2rad([15.0, 25.0, 35.0]):
        for azimuth in np.deg2rad(np.arange(0.0, 360.0, 15.0)):
            turned = right * math.cos(azimuth) + np.cross(up, right) * math.sin(azimuth)
            view = view_from(up, turned, float(elevation))
            spread = float(np.ptp(points @ view[0])) + 0.4 * float(np.ptp(points @ view[1]))
            shortest = float(np.linalg.norm(directions @ view[:2].T, axis=1).min())
            score = spread + 0.7 * size * min(shortest, 0.7)
            if score > best_score * (1.0 + 1e-9):
                best_score, best = score, view
    return best


def view_from(up: Array, right: Array, elevation: float) -> Array:
    """Return the view's rows for a reader looking down by the elevation (rad), with `right` to the right."""
    towards_level = np.cross(right, up)
    towards = towards_level * math.cos(elevation) + up * math.sin(elevation)
    return np.vstack([right, np.cross(towards, right), towards])
