"""A campaign's summary as text: a table with a row a cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from circlepoint.campaign.config import SWEPT
from circlepoint.report.rounding import ABSENT, PLUS_MINUS, significant
from circlepoint.text_table import aligned

if TYPE_CHECKING:
    from circlepoint.document import Document

QUANTITIES = (
    ("end-point, mm", ("end_point",), 1e3, ()),
    ("direction, mrad", ("groups", "direction"), 1e3, (".d1", ".d2")),
    ("point, mm", ("groups", "point"), 1e3, (".p1", ".p2")),
)
"""What is shown of a cell: title, place in its entry, factor from SI units, and how the names of its parameters end."""


def format_summary(summary: Document) -> str:
    """Return the table, and what it says of trials that failed."""
    titles = [text for title, _, _, parts in QUANTITIES for text in (title, *([""] * (2 if parts else 1)))]
    columns = [text for *_, parts in QUANTITIES for text in ("rmse", "predicted", *(["bias"] if parts else []))]
    rows = [["", "", *titles, "inside, %", "", "NEES"]]
    names = swept(summary)
    rows.append([", ".join(names) or "cell", "trials", *columns, "68", "95", "lines"])
    rows += [
        [
            cell_label(cell, names),
            str(cell["trials"]),
            *(text for _, place, factor, parts in QUANTITIES for text in _figures(cell, place, factor, parts)),
            _share(cell["lines"]["coverage_68"]),
            _share(cell["lines"]["coverage_95"]),
            _uncertain(cell["lines"]["nees"], 1.0),
        ]
        for cell in summary["cells"]
    ]
    return "\n".join([*aligned(rows, left={0}), *_complaints(summary)])


def swept(summary: Document) -> list[str]:
    """Return the sections in which the cells differ."""
    return [name for name in SWEPT if len({cell[name] for cell in summary["cells"]}) > 1]


def cell_label(cell: Document, names: list[str]) -> str:
    """Return what sets a cell apart."""
    return ", ".join(cell[name] for name in names) or str(cell["method"])


def _figures(cell: Document, place: tuple[str, ...], factor: float, parts: tuple[str, ...]) -> list[str]:
    """Return root mean square error, prediction, and the largest mean error among the parameters."""
    entry: Document = cell
    for key in place:
        entry = entry.get(key, {})
    predicted = entry.get("predicted")
    texts = [_uncertain(entry.get("rmse"), factor), ABSENT if predicted is None else significant(factor * predicted, 3)]
    if parts:
        biases = [figures["bias"] for name, figures in cell["parameters"].items() if name.endswith(parts)]
        known = [bias for bias in biases if bias is not None]
        texts.append(_uncertain(max(known, key=lambda bias: abs(bias["value"]), default=None), factor, digits=2))
    return texts


def _uncertain(interval: Document | None, factor: float, digits: int = 3) -> str:
    """Return a statistic with half its 95 % interval."""
    if interval is None:
        return ABSENT
    value = significant(factor * interval["value"], digits)
    if interval["low"] is None:
        return value
    return f"{value} {PLUS_MINUS} {significant(0.5 * factor * (interval['high'] - interval['low']), 1)}"


def _share(interval: Document | None) -> str:
    """Return a coverage in per cent, and how far its 95 % interval reaches on the longer side."""
    if interval is None:
        return ABSENT
    value = interval["value"]
    return f"{100 * value:.1f} {PLUS_MINUS} {100 * max(interval['high'] - value, value - interval['low']):.1f}"


def _complaints(summary: Document) -> list[str]:
    lines = []
    names = swept(summary)
    for cell in summary["cells"]:
        for kind, what in (("failed", "no estimate"), ("incomplete", "joints without a line")):
            if cell[kind]:
                lines.append(f"{cell_label(cell, names)}: {what} in {cell[kind]} of {cell['trials']} trials")
        lines += [f"  {reason['trials']} x {reason['reason']}" for reason in cell["reasons"]]
    return lines
