"""The paper's Figures 6 to 10 with our signals, and the study's own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter

from circlepoint.report.style import axis_colours, figure_style, palette

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from matplotlib.axes import Axes

    from circlepoint.reproduce.one_joint import Array

_width = 9.6  # in
_ink, _soft, _accent, _warn = (palette[role][0] for role in ("ink", "soft", "accent", "warn"))
_methods: dict[str, tuple[str, str, Any]] = {
    "two_corrections": ("position, two corrections", _warn, "--"),
    "position": ("position", _warn, "-"),
    "velocity_means": ("velocity, as printed", palette["z"][0], "--"),
    "velocity": ("velocity, least squares", palette["z"][0], "-"),
    "regression": ("regression", _accent, "-"),
}
_ticks = {
    "rate": (50, 100, 200, 500, 1000, 2000),
    "cable": (0, 30, 100, 300, 1000),
    "cutoff": (2, 5, 10, 20, 50),
    "vibration": (0.5, 1, 2, 5, 10, 20, 50),
}
_names = ("x", "y", "z")


def draw_figure6(signals: Mapping[str, Any]) -> Figure:
    """Draw the accelerometer's output over the joint's angle during the static test."""
    data = signals["figure6"]
    with figure_style():
        figure, panel = _panel(3.6)
        for k, colour in enumerate(axis_colours):
            panel.plot(np.degrees(data["angle"]), data["force"][:, k], ".", markersize=4, color=colour)
        _name_ends(panel, np.degrees(data["angle"][-1]), data["force"][-1])
        panel.set_xlabel("joint angle, degrees")
        panel.set_title("specific force at rest, m/s², one point a pose")
        panel.set_xlim(0.0, 157.0)
    return figure


def draw_figure7(signals: Mapping[str, Any]) -> Figure:
    """Draw the power spectrum of one channel during the dynamic test, and where the motion drops below the rest."""
    data = signals["figure7"]
    with figure_style():
        figure, panel = _panel(4.2)
        used = slice(1, None)
        channel = int(np.argmax(data["signal"].sum(axis=0)))
        power, floor, signal = (data[key][:, channel] for key in ("power", "floor", "signal"))
        panel.loglog(data["frequency"][used], floor[used], color=palette["y"][0], linewidth=2.2, alpha=0.4)
        panel.loglog(data["frequency"][used], power[used], color=_ink, linewidth=0.6)
        shown = signal > 1e-9
        panel.loglog(data["lines"][shown], signal[shown], "o", color=_accent, markersize=4)
        low, high = 1e-9, float(power.max()) * 4.0
        panel.set_ylim(low, high)
        panel.set_xlim(0.1, 250.0)
        for place, text, colour, align in (
            (data["last"], f"last harmonic above \nthe rest: {data['last']:g} Hz ", _accent, "right"),
            (10.0, " the paper's filter:\n 10 Hz", _ink, "left"),
        ):
            panel.axvline(place, color=colour, linewidth=1.0, linestyle=(0, (4, 3)))
            panel.text(place, high / 4.0, text, color=colour, ha=align, va="top", fontsize=9.5)
        panel.set_xlabel("frequency, Hz")
        panel.set_title("power spectral density of one channel, (m/s²)²/Hz")
        handles = [
            Line2D([], [], color=_ink, label="measured"),
            Line2D([], [], color=palette["y"][0], linewidth=2.2, alpha=0.4, label="noise and vibration"),
            Line2D([], [], color=_accent, marker="o", markersize=4, linestyle="", label="harmonics of the motion"),
        ]
        panel.legend(handles=handles, loc="upper right")
    return figure


def draw_figure8(signals: Mapping[str, Any]) -> Figure:
    """Draw the three channels during the dynamic test, low-passed at 20 Hz, and what the filter takes out."""
    data = signals["figure8"]
    with figure_style():
        figure = Figure(figsize=(_width, 4.8))
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1.0))
        figure.subplots_adjust(left=0.075, right=0.985, top=0.93, bottom=0.11, hspace=0.3)
        for k, colour in enumerate(axis_colours):
            upper.plot(data["time"], data["filtered"][:, k], color=colour, linewidth=1.3)
            removed = data["raw"][:, k] - data["filtered"][:, k]
            lower.plot(data["time"], removed, color=colour, linewidth=0.6, alpha=0.8)
        _name_ends(upper, data["time"][-1], data["filtered"][-1])
        upper.set_title("specific force, m/s², low-passed at 20 Hz without phase shift")
        lower.set_title("what the filter takes out, m/s²")
        lower.set_xlabel("time, s")
        lower.set_xlim(0.0, 1.03 * data["time"][-1])
    return figure


def draw_figure9(signals: Mapping[str, Any]) -> Figure:
    """Draw the reconstructed path in O_w against the true one, and how far they are apart over time."""
    data, tracking = signals["figure9"], signals["tracking"]
    with figure_style():
        figure = Figure(figsize=(_width, 4.4))
        left, right = figure.subplots(1, 2, width_ratios=(1.0, 1.15))
        figure.subplots_adjust(left=0.07, right=0.98, top=0.9, bottom=0.12, wspace=0.2)
        path, true, lever = (1e3 * np.asarray(data[key]) for key in ("path", "true", "lever"))
        left.plot(true[:, 0], true[:, 1], color=_soft, linewidth=4.0, alpha=0.45)
        left.plot(path[:, 0], path[:, 1], color=_accent, linewidth=1.2)
        left.plot([-lever[0]], [-lever[1]], "+", color=_ink, markersize=10)
        left.plot([0.0], [0.0], "o", color=_ink, markersize=4)
        left.annotate("centre of rotation", (-lever[0], -lever[1]), (6, 6), textcoords="offset points", fontsize=9.5)
        left.annotate("start", (0.0, 0.0), (6, -12), textcoords="offset points", fontsize=9.5)
        left.set_aspect("equal", adjustable="datalim")
        left.set_xlabel("x$_w$, mm")
        left.set_title("path over y$_w$, mm, on the true one (grey)")
        low, middle, high = 1e3 * tracking["quantiles"]
        right.fill_between(tracking["time"], low, high, color=_accent, alpha=0.16, linewidth=0)
        right.plot(tracking["time"], middle, color=_accent, linewidth=1.6)
        right.plot(tracking["time"], 1e3 * tracking["known"], color=_soft, linewidth=1.2, linestyle="--")
        right.set_xlim(0.0, _period(tracking["time"]))
        right.set_ylim(0.0, None)
        right.set_xlabel("time, s")
        right.set_title("distance from the true position, mm")
        right.legend(
            handles=[
                Line2D([], [], color=_accent, linewidth=1.6, label="QA700: median, and 90 % of trials"),
                Line2D([], [], color=_soft, linestyle="--", label="only noise and bias: median"),
            ],
            loc="upper left",
        )
    return figure


def draw_figure10(signals: Mapping[str, Any]) -> Figure:
    """Draw the joint's rate from the filtered encoder against the true one."""
    data = signals["figure10"]
    with figure_style():
        figure = Figure(figsize=(_width, 4.2))
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1.0))
        figure.subplots_adjust(left=0.075, right=0.985, top=0.92, bottom=0.12, hspace=0.34)
        upper.plot(data["time"], data["true"], color=_soft, linewidth=4.0, alpha=0.45)
        upper.plot(data["time"], data["rate"], color=_accent, linewidth=1.2)
        upper.set_title("angular velocity, rad/s: from the encoder, low-passed at 20 Hz, on the true one (wide, grey)")
        inner = slice(15, -15)
        difference = 1e3 * (data["rate"] - data["true"])
        lower.plot(data["time"][inner], difference[inner], color=_accent, linewidth=0.8)
        lower.set_title("difference, mrad/s")
        lower.set_xlabel("time, s")
        lower.set_xlim(0.0, _period(data["time"]))
    return figure


def draw_sweeps(signals: Mapping[str, Any]) -> Figure:
    """Draw the centre's error over each condition, by method."""
    sweeps = signals["sweeps"]
    panels: tuple[tuple[str, str, float], ...] = (
        ("rate", "sampling rate, Hz", 1.0),
        ("cable", "cable noise, mm/s²", 1e3),
        ("distance", "distance from the axis, m", 1.0),
        ("cutoff", "cut-off of the filter, Hz", 1.0),
        ("vibration", "vibration at one frequency, Hz", 1.0),
    )
    with figure_style():
        figure = Figure(figsize=(_width, 6.6))
        grid = figure.subplots(2, 3, sharey=True).ravel()
        figure.subplots_adjust(left=0.065, right=0.985, top=0.94, bottom=0.085, wspace=0.1, hspace=0.36)
        for panel, (key, label, factor) in zip(grid, panels, strict=False):
            places, curves = sweeps[key]
            _curves(panel, factor * np.asarray(places), curves)
            if key == "rate":
                exact = 1e3 * np.asarray(sweeps["rate_exact"][1]["position"])
                panel.plot(places, exact, color=_warn, linewidth=1.0, linestyle=":")
            panel.axhline(15.0, color=_soft, linewidth=0.8, linestyle=(0, (1, 2)))
            panel.set_xlabel(label)
            if key == "cable":
                panel.set_xscale("symlog", linthresh=30.0)
                panel.set_xlim(0.0, factor * places[-1])
            elif key != "distance":
                panel.set_xscale("log")
            if key in _ticks:
                panel.set_xticks(_ticks[key], [f"{tick:g}" for tick in _ticks[key]])
            panel.xaxis.set_minor_formatter(NullFormatter())
            panel.set_yscale("log")
            panel.set_ylim(0.03, 300.0)
        grid[0].set_title("centre error, mm, rms of ten")
        legend = grid[5]
        legend.set_axis_off()
        handles = [
            Line2D([], [], color=colour, linestyle=line, linewidth=1.6, label=label)
            for label, colour, line in _methods.values()
        ]
        handles += [
            Line2D([], [], color=_warn, linestyle=":", label="position, no noise at all"),
            Line2D([], [], color=_soft, linestyle=(0, (1, 2)), label="15 mm, measured"),
        ]
        legend.legend(handles=handles, loc="center left", handlelength=2.6)
    return figure


def draw_bound(signals: Mapping[str, Any]) -> Figure:
    """Draw how often which axis error occurs, and the bound."""
    data = signals["bound"]
    with figure_style():
        figure, panel = _panel(3.0)
        errors, limit = 1e3 * np.asarray(data["errors"]), 1e3 * data["limit"]
        top = max(1.12 * limit, float(errors.max()) * 1.02)
        panel.hist(errors, bins=np.linspace(0.0, top, 70).tolist(), color=_accent, alpha=0.75)
        panel.axvline(limit, color=palette["bad"][0], linewidth=1.2)
        height = panel.get_ylim()[1]
        text = f"bound, {limit:.2f} mrad "
        panel.text(limit, 0.95 * height, text, ha="right", va="top", color=palette["bad"][0], fontsize=9.5)
        panel.set_xlim(0.0, top)
        panel.set_xlabel("axis error, mrad")
        panel.set_title(f"trials out of {len(errors)}")
    return figure


DRAWINGS: dict[str, Callable[[Mapping[str, Any]], Figure]] = {
    "figure6": draw_figure6,
    "figure7": draw_figure7,
    "figure8": draw_figure8,
    "figure9": draw_figure9,
    "figure10": draw_figure10,
    "sweeps": draw_sweeps,
    "bound": draw_bound,
}


def _panel(height: float) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(_width, height))
    panel = figure.subplots()
    figure.subplots_adjust(left=0.075, right=0.985, top=1.0 - 0.34 / height, bottom=0.5 / height)
    return figure, panel


def _name_ends(panel: Axes, x: float, ends: Array) -> None:
    """Write each channel's name behind its curve's last point, apart from one another."""
    low, high = panel.get_ylim()
    place = -np.inf
    for k in np.argsort(ends):
        place = max(float(ends[k]), place + 0.07 * (high - low))
        panel.annotate(
            _names[k],
            (x, place),
            (7, 0),
            textcoords="offset points",
            color=axis_colours[k],
            va="center",
            fontweight="bold",
        )


def _period(time: Array) -> float:
    """Return the end of the last sample's interval, so that the axis ends on a tick."""
    return float(time[-1] + time[1] - time[0])


def _curves(panel: Axes, places: Array, curves: Mapping[str, Sequence[float]]) -> None:
    for key, (_, colour, line) in _methods.items():
        if key in curves:
            panel.plot(places, 1e3 * np.asarray(curves[key]), color=colour, linestyle=line, linewidth=1.5)
