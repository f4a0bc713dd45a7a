"""The scene of joint axes as a still picture, for print and for other documents."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from circlepoint.report.scene import AxisSegment, Scene, triad_and_gravity, tube_radius
from circlepoint.report.style import axis_colours, figure_style, joint_colours, palette, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from circlepoint.report.inputs import Array

_width, _height = 9.6, 5.6


def draw_axes(scene: Scene) -> Figure:
    """Draw the axes, their tubes, the sensor's frame and gravity, seen as the interactive view starts."""
    seen = (scene.corners - scene.center) @ scene.view[:2].T
    reach = np.abs(seen).max(axis=0)
    half = max(float(reach[1]) / 0.82, float(reach[0]) / (0.84 * _width / _height))
    with figure_style():
        figure = Figure(figsize=(_width, _height))
        panel = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        panel.set_axis_off()
        panel.set_xlim(-half * _width / _height, half * _width / _height)
        panel.set_ylim(-half, half)
        labels = _Labels(half)
        for begin, end in scene.links:
            a, b = _project(scene, begin), _project(scene, end)
            panel.plot([a[0], b[0]], [a[1], b[1]], color=palette["soft"][0], linewidth=3.0, alpha=0.4, zorder=1)
        for axis in sorted(scene.axes, key=lambda axis: _depth(scene, axis)):
            _draw_axis(panel, scene, axis, labels)
        _draw_sensor(panel, scene, labels)
        labels.write(panel)
        _draw_scale(panel, half)
    return figure


class _Labels:
    """Names at the tips of arrows, each at the place around its tip where it covers least."""

    def __init__(self, half: float) -> None:
        self.half = half
        self.entries: list[tuple[Array, Array, str, str]] = []

    def add(self, at: Array, away: Array, text: str, colour: str) -> None:
        self.entries.append((at, away, text, colour))

    def write(self, panel: Axes) -> None:
        halo = [withStroke(linewidth=3.0, foreground=palette["paper"][0])]
        placed: list[tuple[float, float, float]] = []
        for at, away, text, colour in self.entries:
            width = 0.04 * self.half * len(text)
            x, y = min(self._places(at, away, width), key=lambda place: self._cost(place, width, placed))[:2]
            placed.append((x, y, width))
            panel.text(
                x,
                y,
                text,
                color=colour,
                ha="center",
                va="center",
                fontsize=11,
                fontweight="bold",
                zorder=9,
                path_effects=halo,
            )

    def _places(self, at: Array, away: Array, width: float) -> list[tuple[float, float, float]]:
        heading = math.atan2(float(at[1] - away[1]), float(at[0] - away[0]))
        places = []
        for reach in (1.0, 1.9):
            for turned in np.deg2rad([0, 30, -30, 60, -60, 90, -90, 130, -130, 180]):
                x = float(at[0]) + math.cos(heading + turned) * (0.035 * reach * self.half + 0.5 * width)
                y = float(at[1]) + math.sin(heading + turned) * 0.065 * reach * self.half
                places.append((x, y, 0.3 * abs(float(turned)) + reach - 1.0))
        return places

    def _cost(self, place: tuple[float, float, float], width: float, placed: list[tuple[float, float, float]]) -> float:
        x, y, cost = place
        height = 0.075 * self.half
        for other_x, other_y, other_width in placed:
            if abs(x - other_x) < 0.5 * (width + other_width) and abs(y - other_y) < height:
                cost += 10.0
        for tip, tail, *_ in self.entries:
            line = tail + np.linspace(0.0, 1.0, 25)[:, None] * (tip - tail)
            if np.any((np.abs(line[:, 0] - x) < 0.5 * width) & (np.abs(line[:, 1] - y) < 0.55 * height)):
                cost += 2.0
        return cost


def _project(scene: Scene, point: Array) -> Array:
    return np.asarray(scene.view[:2] @ (point - scene.center))


def _depth(scene: Scene, axis: AxisSegment) -> float:
    return float(scene.view[2] @ (axis.at(0.5 * (axis.begin + axis.end)) - scene.center))


def _draw_axis(panel: Axes, scene: Scene, axis: AxisSegment, labels: _Labels) -> None:
    colour = joint_colours[axis.index % len(joint_colours)]
    a, b = _project(scene, axis.at(axis.begin)), _project(scene, axis.at(axis.end))
    normal = np.array([-(b - a)[1], (b - a)[0]])
    normal = normal / (float(np.linalg.norm(normal)) or 1.0)
    places = np.linspace(axis.begin, axis.end, 17)
    middle = np.vstack([_project(scene, axis.at(s)) for s in places])
    radius = np.array([tube_radius(axis, float(s), scene.tube_factor) for s in places])[:, None]
    outline = np.vstack([middle + radius * normal, (middle - radius * normal)[::-1]])
    panel.fill(outline[:, 0], outline[:, 1], color=colour, alpha=0.2, linewidth=0, zorder=2)
    if axis.truth is not None:
        more = 0.2 * (axis.end - axis.begin)
        ends = [_project(scene, axis.truth[0] + s * axis.truth[1]) for s in (axis.begin - more, axis.end + more)]
        panel.plot(*np.transpose(ends), color=palette["ink"][0], linewidth=0.9, linestyle=(0, (5, 4)), zorder=2)
    _arrow(panel, a, b, colour, 2.4)
    labels.add(b, a, plain(axis.name), colour)


def _draw_sensor(panel: Axes, scene: Scene, labels: _Labels) -> None:
    origin = _project(scene, np.zeros(3))
    triad, gravity = triad_and_gravity(scene)
    for name, colour, corner in (
        *zip("xyz", axis_colours, triad, strict=True),
        ("gravity", palette["ink"][0], gravity),
    ):
        tip = _project(scene, corner)
        _arrow(panel, origin, tip, colour, 1.6)
        labels.add(tip, origin, name, colour)
    panel.plot(*origin, "o", color=palette["ink"][0], markersize=6, zorder=6)


def _arrow(panel: Axes, begin: Array, end: Array, colour: str, width: float) -> None:
    style = {"arrowstyle": "-|>,head_length=0.7,head_width=0.3", "color": colour, "linewidth": width}
    panel.annotate("", xy=tuple(end), xytext=tuple(begin), arrowprops={**style, "shrinkA": 0, "shrinkB": 0}, zorder=5)


def _draw_scale(panel: Axes, half: float) -> None:
    wanted = 0.5 * half
    power = 10.0 ** math.floor(math.log10(wanted))
    length = power * max(step for step in (1.0, 2.0, 5.0) if step * power <= wanted)
    x, y = -half * _width / _height + 0.06 * half, -0.94 * half
    panel.plot([x, x + length], [y, y], color=palette["soft"][0], linewidth=1.6)
    panel.text(x + length + 0.03 * half, y, f"{length:g} mm", color=palette["soft"][0], va="center", fontsize=9.5)
