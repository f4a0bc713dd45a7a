"""What a campaign found: per cell bias, root mean square error, coverage and consistency, from the tables on disk."""

from __future__ import annotations

import re
from collections import Counter
from itertools import groupby
from operator import itemgetter
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from circlepoint._core import InvalidInput
from circlepoint.campaign.statistics import LEVELS, ErrorStatistics, Interval, MeanOfTrials
from circlepoint.campaign.trials import END_POINT, NEES, SENSOR_FIGURES, STD, line_columns
from circlepoint.document import Document, generator_entry

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from circlepoint.campaign.config import Campaign, Cell

SCHEMA_NAME = "circlepoint/campaign-summary/1"
DIRECTION, POINT = "direction", "point"
_most_reasons = 5
_rows_together = 4096
# Reasons that differ in these alone are one, or there would be as many as trials; "joint 2" and a name are no figures.
_figure_in_text = re.compile(r"(?<!joint )(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")


class CellStatistics:
    """Statistics of one cell."""

    def __init__(self, cell: Cell) -> None:
        """Take the cell."""
        self._cell = cell
        self._lines = [name for _, name in line_columns(cell.arm)]
        self._groups: dict[str, list[str]] = {
            DIRECTION: [name for name in self._lines if name.rpartition(".")[2].startswith("d")],
            POINT: [name for name in self._lines if name.rpartition(".")[2].startswith("p")],
        }
        for name in SENSOR_FIGURES:
            self._groups.setdefault(name.rpartition("_")[0], []).append(name)
        self._of_group = {name: ErrorStatistics() for name, members in self._groups.items() if members}
        self._of_parameter = {name: ErrorStatistics() for name in (*self._lines, *SENSOR_FIGURES)}
        self._all_lines = ErrorStatistics()
        self._line_nees = MeanOfTrials()
        self._end_point = MeanOfTrials()
        self._end_point_variance = MeanOfTrials()
        self._outcomes: Counter[str] = Counter()
        self._reasons: Counter[str] = Counter()
        self._first_reason: dict[str, str] = {}
        self._converged = 0

    def add(self, table: pa.Table) -> None:
        """Add a batch."""
        for name, statistics in self._of_parameter.items():
            statistics.add(_columns(table, [name]), _columns(table, [name + STD]))
        for name, statistics in self._of_group.items():
            members = self._groups[name]
            statistics.add(_columns(table, members), _columns(table, [member + STD for member in members]))
        self._all_lines.add(_columns(table, self._lines), _columns(table, [name + STD for name in self._lines]))
        nees = _columns(table, [f"{joint.name}.{NEES}" for joint in self._cell.arm.joints])
        whole = ~np.isnan(nees).any(axis=1)
        self._line_nees.add(nees[whole].mean(axis=1))
        end_point = _columns(table, [END_POINT, END_POINT + STD])
        self._end_point.add(end_point[:, 0] ** 2)
        self._end_point_variance.add(end_point[:, 1] ** 2)
        self._outcomes.update(table.column("outcome").to_pylist())
        for reason in table.column("reason").to_pylist():
            if reason:
                kind = _figure_in_text.sub("#", reason)
                self._first_reason.setdefault(kind, reason)
                self._reasons[kind] += 1
        self._converged += sum(table.column("converged").to_pylist())

    def entry(self) -> Document:
        """Return the cell's part of the summary."""
        variance = self._end_point_variance
        return {
            "cell": self._cell.index,
            **self._cell.labels,
            "trials": sum(self._outcomes.values()),
            **{outcome: self._outcomes[outcome] for outcome in ("complete", "incomplete", "failed")},
            "converged": self._converged,
            "reasons": [
                {"reason": self._first_reason[kind], "trials": count}
                for kind, count in self._reasons.most_common(_most_reasons)
            ],
            "end_point": {
                "rmse": _interval(self._end_point.root()),
                "predicted": float(np.sqrt(variance.mean)) if variance.count else None,
            },
            "lines": {**_coverage(self._all_lines), "nees": _interval(self._line_nees.interval())},
            "groups": {name: _entry(statistics) for name, statistics in self._of_group.items()},
            "parameters": {
                name: {"bias": _interval(statistics.bias()), **_entry(statistics)}
                for name, statistics in self._of_parameter.items()
            },
        }


def summarise(campaign: Campaign, batches: Iterable[tuple[int, Path]]) -> Document:
    """Return a campaign's summary; every field is described in ``circlepoint/schema/campaign-summary-1.json``.

    Parameters
    ----------
    campaign : Campaign
    batches : iterable of (cell, path)
        The tables of all batches, in order; some thousand rows are in memory at a time.
    """
    cells = [CellStatistics(cell) for cell in campaign.cells]
    for cell, of_cell in groupby(batches, key=itemgetter(0)):
        for table in _together(_read(path) for _, path in of_cell):
            cells[cell].add(table)
    return {
        "schema": SCHEMA_NAME,
        "generator": generator_entry(),
        "campaign": campaign.name,
        "seed": campaign.seed,
        "trials_per_cell": campaign.trials,
        "cells": [cell.entry() for cell in cells],
    }


def _read(path: Path) -> pa.Table:
    try:
        with pq.ParquetFile(path) as file:
            return file.read(use_threads=False)
    except (pa.ArrowException, OSError) as error:
        raise InvalidInput(
            f"{path}: cannot be read ({error}), though it was whole; take it away and run the same command again"
        ) from error


def _together(tables: Iterable[pa.Table]) -> Iterator[pa.Table]:
    """Put small tables together: a million trials are ten thousand tables, and each addition has its cost."""
    held: list[pa.Table] = []
    for table in tables:
        held.append(table)
        if sum(len(part) for part in held) >= _rows_together:
            yield pa.concat_tables(held)
            held = []
    if held:
        yield pa.concat_tables(held)


def _entry(statistics: ErrorStatistics) -> Document:
    return {
        "trials": statistics.trials,
        "rmse": _interval(statistics.rmse()),
        "predicted": statistics.predicted(),
        **_coverage(statistics),
        "nees": _interval(statistics.nees()),
    }


def _coverage(statistics: ErrorStatistics) -> Document:
    return {
        f"coverage_{100 * level:.0f}": _interval(share)
        for level, share in zip(LEVELS, statistics.coverage(), strict=True)
    }


def _interval(found: Interval | None) -> dict[str, Any] | None:
    return None if found is None else {"value": found.value, "low": found.low, "high": found.high}


def _columns(table: pa.Table, names: list[str]) -> NDArray[np.float64]:
    """Return columns as an array (N, K), null as NaN."""
    return np.stack([table.column(name).to_numpy(zero_copy_only=False) for name in names], axis=1).astype(float)
