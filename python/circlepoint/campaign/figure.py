"""The figure of a campaign: errors against prediction, coverage and consistency, a row a cell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from circlepoint.campaign.presentation import QUANTITIES, cell_label, swept
from circlepoint.report.style import figure_style, palette, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from circlepoint.document import Document

_width = 12.5  # in
_row = 0.34  # in
_frame = 1.35  # in, title, legend and labels
_tallest = 60.0  # in
_longest_label = 110
_label_width = 3.3  # in, what a label may take of the width; a longer one makes the figure wider
_linear_ratio = 8.0
_most_ticks = 5
_shortest_plain, _longest_plain = 1e-3, 1e4
_log_steps = ((1.5, (1.0, 2.0, 5.0)), (2.5, (1.0, 3.0)))  # widest axis in decades, figures that are written
_colours = {"direction": "z", "point": "y"}  # neither is near the colour of all


def draw_summary(summary: Document) -> Figure:
    """Draw each cell's errors and what was predicted, coverage with the nominal shares, and NEES."""
    cells = summary["cells"]
    names = swept(summary)
    titles = [plain(cell_label(cell, names), _longest_label) for cell in cells]
    height = min(_frame + _row * len(cells), _tallest)
    margin = 0.1 + 0.072 * max(len(title) for title in titles)
    width = _width + max(margin - _label_width, 0.0)
    with figure_style():
        figure = Figure(figsize=(width, height))
        panels = figure.subplots(
            1,
            len(QUANTITIES) + 2,
            sharey=True,
            gridspec_kw={
                "left": margin / width,
                "right": 0.985,
                "top": 1.0 - 0.72 / height,
                "bottom": 0.45 / height,
                "wspace": 0.16,
            },
        )
        for panel, (title, place, factor, _) in zip(panels, QUANTITIES, strict=False):
            for row, cell in enumerate(cells):
                entry = cell
                for key in place:
                    entry = entry.get(key, {})
                _interval(panel, row, entry.get("rmse"), factor, "accent")
                if entry.get("predicted") is not None:
                    panel.plot(factor * entry["predicted"], row, "|", color=palette["ink"][0], markersize=13)
            panel.set_title(title)
            _scale(panel, from_zero=True)
        _coverage(panels[-2], cells)
        for row, cell in enumerate(cells):
            _interval(panels[-1], row, cell["lines"]["nees"], 1.0, "accent")
        panels[-1].axvline(1.0, color=palette["soft"][0], linewidth=0.9)
        panels[-1].set_title("NEES of the lines")
        _scale(panels[-1], from_zero=False)
        panels[0].set_yticks(range(len(cells)), titles)
        panels[0].set_ylim(len(cells) - 0.5, -0.5)
        for panel in panels:
            panel.tick_params(left=False)
            panel.grid(axis="y", visible=False)
        _legend(figure)
    return figure


def _scale(panel: Axes, *, from_zero: bool) -> None:
    """Give figures of different orders of magnitude a logarithmic axis, any others a linear one."""
    ends = [x for line in panel.lines for x in _positive(line)]
    marked = [x for line in panel.lines if line.get_marker() != "None" for x in _positive(line)]
    if not marked or max(marked) < _linear_ratio * min(marked):
        if from_zero:
            panel.set_xlim(left=0.0)
        return
    low, high = 0.6 * min(marked), 1.5 * max(ends)
    decades = math.log10(high / low)
    panel.set_xscale("log")
    panel.set_xlim(low, high)
    steps = next((steps for widest, steps in _log_steps if decades < widest), (1.0,))
    panel.xaxis.set_major_locator(LogLocator(subs=steps, numticks=_most_ticks))
    panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: _short(value)))
    panel.xaxis.set_minor_formatter(NullFormatter())


def _positive(line: Line2D) -> list[float]:
    return [float(x) for x in np.asarray(line.get_xdata(), dtype=float) if x > 0.0]


def _short(value: float) -> str:
    """Return a power of ten, or a small multiple, as briefly as can be: 0.03, 100, 1e4."""
    if _shortest_plain < value < _longest_plain:
        return f"{value:g}"
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def _coverage(panel: Axes, cells: list[Document]) -> None:
    for key, nominal in (("coverage_68", 68.0), ("coverage_95", 95.0)):
        panel.axvline(nominal, color=palette["soft"][0], linewidth=0.9)
        for row, cell in enumerate(cells):
            for name, shift in (("direction", -0.12), ("point", 0.12)):
                _interval(panel, row + shift, cell["groups"].get(name, {}).get(key), 100.0, _colours[name])
    panel.set_xlim(left=min(panel.get_xlim()[0], 60.0), right=101.0)
    panel.set_title("inside 68 and 95 %, %")


def _interval(panel: Axes, row: float, interval: dict[str, float] | None, factor: float, role: str) -> None:
    if interval is None:
        return
    colour = palette[role][0]
    if interval["low"] is not None:
        panel.plot([factor * interval["low"], factor * interval["high"]], [row, row], color=colour, linewidth=2.0)
    panel.plot(factor * interval["value"], row, "o", color=colour, markersize=4.5)


def _legend(figure: Figure) -> None:
    def dot(role: str, label: str) -> Line2D:
        return Line2D([], [], color=palette[role][0], marker="o", markersize=4.5, linewidth=2.0, label=label)

    handles: list[Any] = [
        dot("accent", "root mean square error, NEES, with 95 % interval"),
        Line2D([], [], color=palette["ink"][0], marker="|", markersize=11, linestyle="", label="predicted"),
        dot(_colours["direction"], "directions"),
        dot(_colours["point"], "points"),
    ]
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, 1.0), ncols=len(handles), columnspacing=1.4)
