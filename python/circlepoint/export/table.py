"""Before and after: each parameter nominal and calibrated, in degrees and millimetres, with its 95 % interval."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.dh_rows import HAYATI_PARAMETERS
from circlepoint.export.form import Export, header
from circlepoint.export.hayati import absent_parameter, hayati_parameters, row_values

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.export.placement import PlacedArm

INTERVAL = 1.959963984540054
"""Half-width of the 95 % interval in standard deviations."""
_LENGTHS = ("a", "d")
_MM, _DEG = 1e3, math.degrees(1.0)


@dataclass(frozen=True)
class Line:
    """One number before and after, in the unit it is shown in; None where there is none."""

    joint: str
    parameter: str
    unit: str
    nominal: float | None
    calibrated: float
    interval: float | None
    """Half-width of the 95 % interval; None for a choice."""

    @property
    def change(self) -> float | None:
        """Calibrated less nominal."""
        return None if self.nominal is None else self.calibrated - self.nominal


def export_table(placed: PlacedArm) -> Export:
    """Return the table as Markdown and CSV, and the same numbers as a document."""
    parameters, axes = parameter_lines(placed), axis_lines(placed)
    document = header(placed, "table") | {
        "interval": "95 %, half-width",
        "rows": [_entry(line) for line in parameters],
        "axes": [_entry(line) for line in axes],
    }
    texts = {".md": _markdown(placed, parameters, axes), ".csv": _csv([*parameters, *axes])}
    return Export("table", document, texts)


def parameter_lines(placed: PlacedArm) -> list[Line]:
    """Return the parameters of every row: standard Denavit-Hartenberg, Hayati between nearly parallel axes."""
    found = hayati_parameters(placed)
    lines = []
    for index, (name, row) in enumerate(zip(placed.arm.joint_names, found.chain.rows, strict=True)):
        expected = None if found.nominal is None else row_values(found.nominal.rows[index])
        for column, key in enumerate(HAYATI_PARAMETERS):
            if key == absent_parameter(row):
                continue
            unit, scale = ("mm", _MM) if key in _LENGTHS else ("deg", _DEG)
            free = bool(found.free[index, column])
            lines.append(
                Line(
                    name,
                    key,
                    unit,
                    None if expected is None else scale * expected[column],
                    scale * row_values(row)[column],
                    None if free else scale * INTERVAL * float(found.std[index, column]),
                )
            )
    return lines


def axis_lines(placed: PlacedArm) -> list[Line]:
    """Return how far each axis is off its nominal place once the nominal arm is laid on all of them; none without one.

    The interval is that of the larger principal direction. Joint offsets are the fit's; they have none of their own.
    """
    if placed.nominal is None or placed.alignment is None:
        return []
    offsets = np.asarray(placed.alignment.joint_offsets)
    nominal = placed.nominal.chain(placed.arm.reference + offsets)
    lines = []
    for index, (name, axis, drawn) in enumerate(
        zip(placed.arm.joint_names, placed.chain.axes, nominal.axes, strict=True)
    ):
        local = circlepoint.local_coordinates(drawn.line, axis.line)
        block = placed.arm.covariance[4 * index : 4 * index + 4, 4 * index : 4 * index + 4]
        angle = float(np.hypot(*local[:2]))
        lines.append(Line(name, "axis direction off nominal", "deg", 0.0, _DEG * angle, _DEG * _largest(block[:2, :2])))
        if axis.type == circlepoint.JointType.revolute:
            distance = float(np.hypot(*local[2:]))
            lines.append(Line(name, "axis place off nominal", "mm", 0.0, _MM * distance, _MM * _largest(block[2:, 2:])))
            lines.append(Line(name, "joint zero off nominal", "deg", 0.0, _DEG * float(offsets[index]), None))
        else:
            lines.append(Line(name, "joint zero off nominal", "mm", 0.0, _MM * float(offsets[index]), None))
    return lines


def _largest(block: NDArray[np.float64]) -> float:
    return INTERVAL * float(np.sqrt(max(float(np.linalg.eigvalsh(block)[-1]), 0.0)))


def _entry(line: Line) -> dict[str, object]:
    return {
        "joint": line.joint,
        "parameter": line.parameter,
        "unit": line.unit,
        "nominal": line.nominal,
        "calibrated": line.calibrated,
        "change": line.change,
        "interval": line.interval,
    }


def _decimals(line: Line) -> int:
    """Two significant digits of the interval, at most nine decimals; four for a choice."""
    if line.interval is None or line.interval <= 0.0:
        return 4
    return int(min(max(1 - math.floor(math.log10(line.interval)), 0), 9))


def _cells(line: Line) -> list[str]:
    decimals = _decimals(line)
    numbers = (line.nominal, line.calibrated, line.change)
    shown = ["-" if number is None else f"{round(number, decimals) + 0.0:.{decimals}f}" for number in numbers]
    interval = "kept" if line.interval is None else f"± {line.interval:.{decimals}f}"
    return [line.joint, line.parameter, line.unit, *shown, interval]


def _markdown(placed: PlacedArm, parameters: list[Line], axes: list[Line]) -> str:
    titles = ["joint", "parameter", "unit", "nominal", "calibrated", "change", "95 %"]
    text = [
        f"# {placed.arm.name}: before and after",
        "",
        "Standard Denavit-Hartenberg parameters (Hayati's beta instead of d between nearly parallel axes).",
        "`kept`: what the calibration cannot see, left at its nominal value.",
        "",
        *_rows(titles, [_cells(line) for line in parameters]),
    ]
    if axes:
        text += ["", "The axes themselves, the nominal arm laid on all of them (least squares):", ""]
        text += _rows(titles, [["fit" if cell == "kept" else cell for cell in _cells(line)] for line in axes])
    return "\n".join([*text, ""])


def _rows(titles: list[str], rows: list[list[str]]) -> list[str]:
    widths = [max(len(row[k]) for row in [titles, *rows]) for k in range(len(titles))]
    left = 3
    lines = []
    for row in [titles, *rows]:
        cells = [
            cell.ljust(width) if k < left else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append(f"| {' | '.join(cells)} |")
    rule = ["-" * width if k < left else "-" * (width - 1) + ":" for k, width in enumerate(widths)]
    return [lines[0], f"| {' | '.join(rule)} |", *lines[1:]]


def _csv(lines: list[Line]) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["joint", "parameter", "unit", "nominal", "calibrated", "change", "interval_95"])
    for line in lines:
        numbers = (line.nominal, line.calibrated, line.change, line.interval)
        writer.writerow(
            [line.joint, line.parameter, line.unit, *("" if x is None else repr(float(x)) for x in numbers)]
        )
    return stream.getvalue()
