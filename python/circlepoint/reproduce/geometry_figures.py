"""The paper's Figures 1 and 2, drawn from the model: frames of a turning joint, and the angles of method 2."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc

import circlepoint
from circlepoint.report.style import axis_colours, figure_style, palette

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from circlepoint.reproduce.one_joint import Array

_width = 9.6  # in
_ink, _soft, _accent = (palette[role][0] for role in ("ink", "soft", "accent"))
_view = np.array([[-0.62, 0.785, 0.0], [-0.33, -0.26, 0.907]])  # rows: right and up of the drawing, in O_w
_upward = 2  # channel z
_turn = math.radians(70.0)
_lever = np.array([0.9, 0.0, 0.35])  # of the drawing, in O_w


def draw_figure1(_: Mapping[str, Any]) -> Figure:
    """Draw O_w on the joint's axis, O_a with the joint at its stop, and O_m after it has turned by theta."""
    with figure_style():
        figure = Figure(figsize=(_width, 4.6))
        panel = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        _blank(panel)
        axis = np.array([0.0, 0.0, 1.0])
        _line(panel, -0.3 * axis, 0.95 * axis, _soft, "-.")
        _frame(panel, np.zeros(3), np.eye(3), "w", 0.42)
        tilt = circlepoint.rotation_exp(np.array([0.25, 0.35, 0.5]))
        angles = np.linspace(0.0, _turn, 60)
        circle = np.array([circlepoint.rotation_exp(angle * axis) @ _lever for angle in angles])
        panel.plot(*_seen(circle).T, color=_soft, linewidth=1.0)
        height = np.array([0.0, 0.0, _lever[2]])
        for angle, name in ((0.0, "a"), (_turn, "m")):
            turned = circlepoint.rotation_exp(angle * axis)
            origin = turned @ _lever
            _line(panel, height, origin, _ink, "-")
            _frame(panel, origin, turned @ tilt, name, 0.26)
        arm = _lever - height
        arc = np.array([circlepoint.rotation_exp(angle * axis) @ (0.3 * arm) + height for angle in angles])
        panel.plot(*_seen(arc).T, color=_accent, linewidth=1.2)
        _text(panel, circlepoint.rotation_exp(0.7 * _turn * axis) @ (0.38 * arm) + height, "θ", _accent)
        _text(panel, 0.55 * arm + height + 0.06 * axis, "b", _ink)
        _text(panel, 1.01 * axis, "joint axis", _soft)
        panel.set_xlim(-1.25, 1.25)
        panel.set_ylim(-0.36, 0.98)
        panel.set_aspect("equal")
    return figure


def draw_figure2(_: Mapping[str, Any]) -> Figure:
    """Draw the plane of rotation: lever b at angle theta, velocity v a quarter turn ahead, its direction phi."""
    with figure_style():
        figure = Figure(figsize=(_width, 4.2))
        panel = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        _blank(panel)
        start, theta = math.radians(20.0), math.radians(50.0)
        now = start + theta
        here = np.array([math.cos(now), math.sin(now)])
        ahead = np.array([-here[1], here[0]])
        first = np.array([math.cos(start), math.sin(start)])
        sweep = np.linspace(start - 0.25, now + 0.7, 100)
        panel.plot(np.cos(sweep), np.sin(sweep), color=_soft, linewidth=1.0)
        ends = ((np.array([1.25, 0.0]), "x$_w$"), (np.array([0.0, 0.7]), "y$_w$"))
        for (end, name), colour in zip(ends, axis_colours, strict=False):
            _arrow(panel, np.zeros(2), end, colour)
            _put(panel, 1.06 * end, name, colour)
        panel.plot([0.0, first[0]], [0.0, first[1]], color=_ink, linewidth=1.2, linestyle="--")
        _arrow(panel, np.zeros(2), here, _ink)
        _arrow(panel, here, here + 0.55 * ahead, _accent)
        panel.plot([here[0], here[0] + 0.45], [here[1], here[1]], color=_soft, linewidth=0.8)
        panel.add_patch(Arc((0.0, 0.0), 0.7, 0.7, theta1=math.degrees(start), theta2=math.degrees(now), color=_ink))
        panel.add_patch(Arc((here[0], here[1]), 0.44, 0.44, theta1=0.0, theta2=math.degrees(now) + 90.0, color=_accent))
        middle = start + 0.45 * theta
        _put(panel, 0.42 * np.array([math.cos(middle), math.sin(middle)]), "θ", _ink)
        _put(panel, here + np.array([0.13, 0.25]), "φ", _accent)
        _put(panel, 0.55 * here + [-0.07, 0.03], "r", _ink)
        _put(panel, here + 0.6 * ahead + [-0.12, 0.0], "v = r w", _accent)
        _put(panel, 0.66 * first + [0.05, -0.08], "b at θ = 0", _ink)
        words = (
            "v is a quarter turn ahead of the lever,",
            "so at θ = 0 the lever b stands at",
            "    φ - θ - 90°",
            "from x$_w$. The paper prints 90° + θ - φ:",
            "the same angle, counted the other way.",
        )
        panel.text(1.3, 1.15, "\n".join(words), fontsize=11, color=_soft, va="top", linespacing=1.5)
        panel.set_xlim(-1.05, 2.5)
        panel.set_ylim(-0.14, 1.41)
        panel.set_aspect("equal")
    return figure


def _seen(points: Array) -> Array:
    return np.asarray(np.asarray(points) @ _view.T)


def _blank(panel: Axes) -> None:
    panel.set_axis_off()
    panel.grid(visible=False)


def _line(panel: Axes, begin: Array, end: Array, colour: str, style: str) -> None:
    panel.plot(*_seen(np.array([begin, end])).T, color=colour, linewidth=1.4, linestyle=style)


def _text(panel: Axes, place: Array, text: str, colour: str) -> None:
    _put(panel, _seen(place), text, colour)


def _put(panel: Axes, place: Array, text: str, colour: str) -> None:
    panel.text(float(place[0]), float(place[1]), text, color=colour, fontsize=12, ha="center", va="center")


def _arrow(panel: Axes, begin: Array, end: Array, colour: str) -> None:
    panel.annotate(
        "",
        xy=(end[0], end[1]),
        xytext=(begin[0], begin[1]),
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.5, "shrinkA": 0, "shrinkB": 0},
    )


def _frame(panel: Axes, origin: Array, rotation: Array, name: str, length: float) -> None:
    for k, colour in enumerate(axis_colours):
        end = origin + length * rotation[:, k]
        _arrow(panel, _seen(origin), _seen(end), colour)
        place = _seen(origin + 1.22 * length * rotation[:, k])
        if name == "w" and k == _upward:
            place += [0.07, -0.1]  # off the joint's axis
        _put(panel, place, f"{'xyz'[k]}$_{name}$", colour)
    panel.plot(*_seen(origin), "o", color=_ink, markersize=5)
