"""A campaign's summary as text: a table with a row a cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from circlepoint.campaign.config import SWEPT
from circlepoint.report.rounding import ABSENT, PLUS_MINUS, significant

if TYPE_CHECKING:
    from circlepoint.document import Document

QUANTITIES = (
    ("end-point, mm", ("end_point",), 1e3),
    ("direction, mrad", ("groups", "direction"), 1e3),
    ("point, mm", ("groups", "point"), 1e3),
)
"""What is shown of a cell: title, place in its entry, and factor from SI units."""


def format_summary(summary: Document) -> str:
    """Return the table, and what it says of trials that failed."""
    rows = [["", "", *[text for title, _, _ in QUANTITIES for text in (title, "")], "inside, %", "", "NEES"]]
    names = swept(summary)
    rows.append([", ".join(names) or "cell", "trials", *("rmse", "predicted") * len(QUANTITIES), "68", "95", "lines"])
    rows += [
        [
            cell_label(cell, names),
            str(cell["trials"]),
            *(text for _, place, factor in QUANTITIES for text in _figure(_at(cell, place), factor)),
            _share(cell["lines"]["coverage_68"]),
            _share(cell["lines"]["coverage_95"]),
            _uncertain(cell["lines"]["nees"], 1.0),
        ]
        for cell in summary["cells"]
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = [
        "  ".join(
            text.ljust(width) if column == 0 else text.rjust(width)
            for column, (text, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    return "\n".join([*lines, *_complaints(summary)])


def swept(summary: Document) -> list[str]:
    """Return the sections in which the cells differ."""
    return [name for name in SWEPT if len({cell[name] for cell in summary["cells"]}) > 1]


def cell_label(cell: Document, names: list[str]) -> str:
    """Return what sets a cell apart."""
    return ", ".join(cell[name] for name in names) or str(cell["method"])


def _at(cell: Document, place: tuple[str, ...]) -> Any:
    for key in place:
        cell = cell.get(key, {})
    return cell


def _figure(entry: Document, factor: float) -> tuple[str, str]:
    predicted = entry.get("predicted")
    return _uncertain(entry.get("rmse"), factor), ABSENT if predicted is None else significant(factor * predicted, 3)


def _uncertain(interval: Document | None, factor: float) -> str:
    """Return a statistic with half its 95 % interval."""
    if interval is None:
        return ABSENT
    value = significant(factor * interval["value"], 3)
    if interval["low"] is None:
        return value
    return f"{value} {PLUS_MINUS} {significant(0.5 * factor * (interval['high'] - interval['low']), 1)}"


def _share(interval: Document | None) -> str:
    """Return a coverage in per cent with half its 95 % interval."""
    if interval is None:
        return ABSENT
    return f"{100 * interval['value']:.1f} {PLUS_MINUS} {50 * (interval['high'] - interval['low']):.1f}"


def _complaints(summary: Document) -> list[str]:
    lines = []
    names = swept(summary)
    for cell in summary["cells"]:
        for kind, what in (("failed", "no estimate"), ("incomplete", "joints without a line")):
            if cell[kind]:
                lines.append(f"{cell_label(cell, names)}: {what} in {cell[kind]} of {cell['trials']} trials")
        lines += [f"  {reason['trials']} x {reason['reason']}" for reason in cell["reasons"]]
    return lines
