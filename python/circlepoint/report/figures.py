"""The report's drawings: the log, and each test measured against modelled."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from circlepoint.report.series import broken_line
from circlepoint.report.style import axis_colours, figure_style, palette, plain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from circlepoint.report.inputs import Array, CalibrationResult, Document, TestFit

_width = 9.6  # in
_label_inset = 0.58  # in, from a panel to its label
_overview_buckets = 450
_test_buckets = 260
_least_range = 1.0  # deg or mm, of the axis of positions: rests that differ by less are one place


def draw_overview(calibration: CalibrationResult) -> Figure:
    """Draw the whole log: each joint with its tests' dwells and motions shaded, and the specific force."""
    log, segments = calibration.recording, calibration.segmentation
    joints: Sequence[Document] = calibration.document["joints"]
    rows = len(joints) + 1
    dots: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 3.0} if log.is_static else {}
    with figure_style():
        height = 0.86 * len(joints) + 2.6
        figure = Figure(figsize=(_width, height))
        frame = {"left": 0.075, "right": 0.99, "top": 1.0 - 0.62 / height, "bottom": 0.52 / height, "hspace": 0.58}
        ratios = [1.0] * len(joints) + [1.9]
        panels = figure.subplots(rows, 1, sharex=True, squeeze=False, height_ratios=ratios, gridspec_kw=frame)[:, 0]
        for index, (panel, joint) in enumerate(zip(panels[:-1], joints, strict=True)):
            scale, unit = position_unit(joint)
            if not log.is_static:
                _shade(panel, calibration, index)
            time, values = broken_line(
                log.time, scale * log.joint_positions[:, index], log.sample_rate, _overview_buckets
            )
            panel.plot(time, values, color=palette["ink"][0], linewidth=0.9, **dots)
            panel.set_title(f"{plain(joint['name'])}, {unit}", pad=2.0)
            panel.yaxis.set_major_locator(MaxNLocator(3))
            panel.tick_params(bottom=False)
        for k, colour in enumerate(axis_colours):
            time, values = broken_line(log.time, log.specific_force[:, k], log.sample_rate, _overview_buckets)
            panels[-1].plot(time, values, color=colour, linewidth=0.7, **dots)
        panels[-1].set_title("specific force, m/s²", pad=2.0)
        panels[-1].set_xlabel("still pose, from 0" if log.is_static else "time, s")
        if len(log.time):
            margin = 0.5 if log.is_static else 0.0
            panels[-1].set_xlim(float(log.time[0]) - margin, float(log.time[-1]) + margin)
        handles: list[Any] = [Line2D([], [], color=palette["ink"][0], label="joint position", **dots)]
        if segments.tests and not log.is_static:
            handles += [
                Patch(color=palette["dwell"][0], label="dwells of its test"),
                Patch(color=palette["motion"][0], label="single-joint motion"),
            ]
        handles += [
            Line2D([], [], color=colour, label=f"sensor {name}", **dots)
            for name, colour in zip("xyz", axis_colours, strict=True)
        ]
        _legend(figure, handles)
    return figure


def draw_test(fit: TestFit, joint: Document) -> Figure:
    """Draw one test: the motion over time on the left, the dwells over the joint's position on the right."""
    dynamic, static = len(fit.time) > 0, len(fit.dwell_positions) > 0
    with figure_style():
        figure = Figure(figsize=(_width, 4.7))
        columns = max(int(dynamic) + int(static), 1)
        grid = figure.add_gridspec(
            4,
            columns,
            height_ratios=[2.7, 0.7, 0.7, 0.7],
            width_ratios=[1.7, 1.0] if columns == 2 else None,
            left=0.085,
            right=0.99,
            top=0.86,
            bottom=0.115,
            hspace=0.28,
            wspace=0.24,
        )
        if dynamic:
            upper = figure.add_subplot(grid[0, 0])
            lower = [figure.add_subplot(grid[row, 0], sharex=upper) for row in (1, 2, 3)]
            _draw_motion(upper, lower, fit)
        if static:
            upper = figure.add_subplot(grid[0, -1])
            _draw_dwells(upper, figure.add_subplot(grid[1:, -1], sharex=upper), fit, joint)
        handles: list[Any] = [
            Line2D([], [], color=colour, linewidth=2.0, label=name)
            for name, colour in zip("xyz", axis_colours, strict=True)
        ]
        handles.append(Line2D([], [], color=palette["soft"][0], linewidth=3.2, alpha=0.4, label="measured"))
        if static:
            handles.append(
                Line2D(
                    [], [], color=palette["soft"][0], marker="o", markersize=4.5, linestyle="", label="dwell, measured"
                )
            )
        handles.append(Line2D([], [], color=palette["ink"][0], linewidth=0.8, label="modelled"))
        _legend(figure, handles)
    return figure


def _legend(figure: Figure, handles: list[Any]) -> None:
    figure.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(0.005, 1.0),
        ncols=len(handles),
        columnspacing=1.4,
        handlelength=1.3,
        handletextpad=0.5,
    )


def position_unit(joint: Document) -> tuple[float, str]:
    """Return the factor and unit a joint's position is shown in."""
    return (1e3, "mm") if joint.get("type") == "prismatic" else (math.degrees(1.0), "deg")


def _shade(panel: Axes, calibration: CalibrationResult, joint: int) -> None:
    time, segments = calibration.recording.time, calibration.segmentation
    for test in segments.tests:
        if test.joint != joint:
            continue
        spans = [(segments.dwells[i].samples, "dwell") for i in test.dwells]
        spans += [(segments.motions[i].samples, "motion") for i in test.motions]
        for samples, role in spans:
            panel.axvspan(
                float(time[samples.begin]), float(time[samples.end - 1]), color=palette[role][0], linewidth=0, zorder=0
            )


def _draw_motion(upper: Axes, lower: Sequence[Axes], fit: TestFit) -> None:
    time = fit.time - fit.time[0]
    rate = 1.0 / float(np.median(np.diff(time))) if len(time) > 1 else 1.0
    residual, unit = _residual_scale(fit.measured - fit.modelled)
    for k, colour in enumerate(axis_colours):
        t, values = broken_line(time, fit.measured[:, k], rate, _test_buckets)
        upper.plot(t, values, color=colour, linewidth=3.2, alpha=0.4)
    for k, (panel, colour) in enumerate(zip(lower, axis_colours, strict=True)):
        t, values = broken_line(time, fit.modelled[:, k], rate, _test_buckets)
        upper.plot(t, values, color=palette["ink"][0], linewidth=0.8)
        t, values = broken_line(time, residual[:, k], rate, _test_buckets)
        panel.plot(t, values, color=colour, linewidth=0.7)
        panel.tick_params(labelbottom=panel is lower[-1], bottom=panel is lower[-1])
        panel.spines["bottom"].set_visible(panel is lower[-1])
        _centre(panel, _without_knocks(residual), 2)
    upper.tick_params(labelbottom=False)
    upper.set_title("motion")
    upper.set_ylabel("specific force, m/s²")
    lower[1].set_ylabel(f"residual, {unit}")
    lower[-1].set_xlabel("time from the start of the motion, s")
    upper.set_xlim(0.0, float(time[-1]) or 1.0)
    _align_labels([upper, lower[1]])


def _draw_dwells(upper: Axes, lower: Axes, fit: TestFit, joint: Document) -> None:
    scale, unit = position_unit(joint)
    order = np.argsort(fit.dwell_positions, kind="stable")
    position = scale * fit.dwell_positions[order]
    residual, residual_unit = _residual_scale((fit.dwell_measured - fit.dwell_modelled)[order])
    shift = 0.008 * max(float(np.ptp(position)), _least_range)
    for k, colour in enumerate(axis_colours):
        upper.plot(position, fit.dwell_modelled[order, k], color=palette["ink"][0], linewidth=0.8)
        upper.plot(position, fit.dwell_measured[order, k], "o", color=colour, markersize=4.5, alpha=0.85, mew=0)
        lower.vlines(position + (k - 1) * shift, 0.0, residual[:, k], color=colour, linewidth=0.8)
        lower.plot(position + (k - 1) * shift, residual[:, k], "o", color=colour, markersize=3.2, mew=0)
    upper.set_title("dwells")
    upper.set_ylabel("specific force, m/s²")
    lower.set_ylabel(f"residual, {residual_unit}")
    lower.set_xlabel(f"joint position, {unit}")
    upper.tick_params(labelbottom=False)
    if float(np.ptp(position)) < _least_range:
        middle = 0.5 * float(position.min() + position.max())
        upper.set_xlim(middle - 0.5 * _least_range, middle + 0.5 * _least_range)
    _centre(lower, residual, 4)
    _align_labels([upper, lower])


def _align_labels(panels: Sequence[Axes]) -> None:
    for panel in panels:
        panel.yaxis.set_label_coords(-_label_inset / (_width * panel.get_position().width), 0.5)


def _residual_scale(residual: Array) -> tuple[Array, str]:
    largest = float(np.abs(residual).max(initial=0.0))
    return (residual, "m/s²") if largest >= 1.0 else (1e3 * residual, "mm/s²")


def _without_knocks(residual: Array) -> Array:
    """Return the residuals within the range that shows their noise: a knock may leave the panel."""
    usual = float(np.quantile(np.abs(residual), 0.98)) if residual.size else 0.0
    return np.clip(residual, -3.0 * usual, 3.0 * usual)


def _centre(panel: Axes, residual: Array, ticks: int) -> None:
    limit = 1.12 * float(np.abs(residual).max(initial=0.0)) or 1.0
    panel.set_ylim(-limit, limit)
    panel.axhline(0.0, color=palette["soft"][0], linewidth=0.6)
    panel.yaxis.set_major_locator(MaxNLocator(ticks, symmetric=True))
