"""The figure of a campaign: errors against prediction, coverage and consistency, a row a cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from circlepoint.campaign.presentation import QUANTITIES, cell_label, swept
from circlepoint.report.style import figure_style, palette, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from circlepoint.document import Document

_width = 12.5  # in
_row = 0.34  # in
_frame = 1.35  # in, title, legend and labels
_tallest = 60.0  # in
_longest_label = 44


def draw_summary(summary: Document) -> Figure:
    """Draw each cell's errors and what was predicted, coverage with the nominal shares, and NEES."""
    cells = summary["cells"]
    names = swept(summary)
    titles = [plain(cell_label(cell, names), _longest_label) for cell in cells]
    height = min(_frame + _row * len(cells), _tallest)
    with figure_style():
        figure = Figure(figsize=(_width, height))
        margin = 0.1 + 0.072 * max(len(title) for title in titles)
        panels = figure.subplots(
            1,
            len(QUANTITIES) + 2,
            sharey=True,
            gridspec_kw={
                "left": margin / _width,
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
            _scale(panel)
        _coverage(panels[-2], cells)
        for row, cell in enumerate(cells):
            _interval(panels[-1], row, cell["lines"]["nees"], 1.0, "accent")
        panels[-1].axvline(1.0, color=palette["soft"][0], linewidth=0.9)
        panels[-1].set_title("NEES of the lines")
        panels[0].set_yticks(range(len(cells)), titles)
        panels[0].set_ylim(len(cells) - 0.5, -0.5)
        for panel in panels:
            panel.tick_params(left=False)
            panel.grid(axis="y", visible=False)
        _legend(figure)
    return figure


def _scale(panel: Axes) -> None:
    """Begin at zero, but for errors of different orders of magnitude."""
    low, high = panel.dataLim.intervalx
    if 0.0 < 8.0 * low < high:
        panel.set_xscale("log")
    else:
        panel.set_xlim(left=0.0)


def _coverage(panel: Axes, cells: list[Document]) -> None:
    for key, nominal in (("coverage_68", 68.0), ("coverage_95", 95.0)):
        panel.axvline(nominal, color=palette["soft"][0], linewidth=0.9)
        for row, cell in enumerate(cells):
            for name, colour, shift in (("direction", "x", -0.12), ("point", "y", 0.12)):
                _interval(panel, row + shift, cell["groups"].get(name, {}).get(key), 100.0, colour)
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
        dot("x", "directions"),
        dot("y", "points"),
    ]
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, 1.0), ncols=len(handles), columnspacing=1.4)
