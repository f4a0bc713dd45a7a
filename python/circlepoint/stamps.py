"""The time stamps of a table: in order, advancing, no row twice."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.findings import Finding

if TYPE_CHECKING:
    from circlepoint.log_table import FloatArray, LogTable


def require_order(table: LogTable, name: str, stamps: FloatArray) -> None:
    """Raise InvalidInput where the stamps of the column `name`, in the file's unit, run backwards."""
    backwards = np.flatnonzero(np.diff(stamps) < 0)
    if backwards.size:
        row = int(backwards[0]) + 1
        raise table.error(
            f"time runs backwards: column `{name}` is {stamps[row]:.12g} after {stamps[row - 1]:.12g} "
            f"({backwards.size} such rows); sort "
            "the rows, or split the log there into two files",
            row,
        )


def table_timeline(
    table: LogTable, time: FloatArray, options: circlepoint.TimelineOptions | None = None
) -> circlepoint.TimelineReport:
    """Return what is in the stamps (N,), s; raise InvalidInput where they stand still or rows were written twice."""
    if time[0] == time[-1]:
        raise table.error(f"time stands still: every stamp is {time[0]:.12g} s; log the time each sample was taken")
    timeline = circlepoint.analyse_timeline(time, options or circlepoint.TimelineOptions())
    if timeline.surplus:
        first = timeline.surplus[0]
        raise table.error(
            f"the time stamp {first.value:.12g} s comes again, and the rows around it are more than the "
            f"{timeline.sample_rate:.6g} Hz clock can "
            f"have made ({len(timeline.surplus)} such rows): rows written twice, or stamps that are too coarse; "
            f"remove the repeated rows",
            int(first.index),
        )
    return timeline


def timeline_findings(timeline: circlepoint.TimelineReport, source: str) -> list[Finding]:
    """Return what the stamps have shown; of a rate out of range `circlepoint.plausibility` speaks."""
    notes = [note for note in timeline.notes if not note.startswith("the sample rate is")]
    return [Finding("timeline", f"{source}: {note}") for note in notes]
