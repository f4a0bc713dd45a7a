"""What a log looks like to its reader: named columns of numbers, and the place of each row for messages.

A file of rows (`circlepoint.tables`), a topic of a bag (`circlepoint.bags`) and arrays in memory
(`circlepoint.arrays`) are read alike.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    from circlepoint._core import InvalidInput
    from circlepoint.findings import Finding

FloatArray = NDArray[np.float64]

MANY_ROWS = 1_500_000
"""Rows above which a log is thinned out while it is read (`circlepoint.long_logs`)."""
PIECE_ROWS = 1 << 17
"""Rows of a piece of a log."""


class LogTable(Protocol):
    """Named columns of numbers, one row a sample."""

    @property
    def path(self) -> Path:
        """Where it is."""

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""

    @property
    def label(self) -> str:
        """What messages call it."""

    @property
    def part(self) -> str:
        """Which part of the file it is, such as a topic; empty: all."""

    @property
    def hint(self) -> str:
        """What else is there; empty, or a clause for messages about what is missing."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What opening it has shown."""

    @property
    def long(self) -> bool:
        """Whether it may be too long for memory."""

    def error(self, message: str, row: int | None = None) -> InvalidInput:
        """Return an InvalidInput about the table, or about one of its rows (0-based)."""

    def read(self, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return columns (N,) by name; NaN where a cell is empty."""

    def batches(self, names: Sequence[str]) -> Iterator[dict[str, FloatArray]]:
        """Yield the same columns piece by piece, in order."""


@dataclass(frozen=True)
class RowsWith:
    """The rows of a table that hold some of its columns: those of one of the two rates a log can have.

    Attributes
    ----------
    table : LogTable
        The log.
    group : tuple of str
        Rows in which all of these are empty belong to the other rate.
    """

    table: LogTable
    group: tuple[str, ...]

    @property
    def path(self) -> Path:
        """Where the table is."""
        return self.table.path

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return self.table.columns

    @property
    def label(self) -> str:
        """What messages call it."""
        return self.table.label

    @property
    def part(self) -> str:
        """Which part of the file the table is."""
        return self.table.part

    @property
    def hint(self) -> str:
        """What else is there."""
        return self.table.hint

    @property
    def long(self) -> bool:
        """Whether the table may be too long for memory."""
        return self.table.long

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What opening the table has shown."""
        return self.table.findings

    def error(self, message: str, row: int | None = None) -> InvalidInput:
        """Return an InvalidInput about the table, or about one of these rows (0-based)."""
        if row is not None:
            row = next(itertools.islice(self._rows(), row, None), row)
        return self.table.error(message, row)

    def read(self, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return columns (N,) by name."""
        return joined(self.batches(names), names)

    def batches(self, names: Sequence[str]) -> Iterator[dict[str, FloatArray]]:
        """Yield the same columns piece by piece, in order."""
        for piece in self.table.batches(list(dict.fromkeys([*names, *self.group]))):
            there = ~empty_rows(piece, self.group)
            if there.any():
                yield {name: piece[name][there] for name in names}

    def _rows(self) -> Iterator[int]:
        """Yield which row of the table each of these rows is."""
        first = 0
        for piece in self.table.batches(self.group):
            empty = empty_rows(piece, self.group)
            yield from (first + np.flatnonzero(~empty)).tolist()
            first += empty.size


def joined(pieces: Iterable[Mapping[str, FloatArray]], names: Sequence[str]) -> dict[str, FloatArray]:
    """Return the columns (N,) of a log that comes in pieces."""
    parts: dict[str, list[FloatArray]] = {name: [np.empty(0)] for name in names}
    for piece in pieces:
        for name, values in parts.items():
            values.append(piece[name])
    return {name: np.concatenate(values) for name, values in parts.items()}


def empty_rows(piece: Mapping[str, FloatArray], group: Sequence[str]) -> NDArray[np.bool_]:
    """Say in which rows all columns of a group are empty."""
    empty: NDArray[np.bool_] = np.logical_and.reduce([np.isnan(piece[name]) for name in group])
    return empty


def require_finite(table: LogTable, name: str, values: FloatArray, first_row: int = 0, *, static: bool = False) -> None:
    """Raise InvalidInput at the first value that is empty, NaN or infinite.

    `values` begin at `first_row`; `static`: rows are still poses.
    """
    bad = np.flatnonzero(~np.isfinite(values))
    if not bad.size:
        return
    row = int(bad[0])
    others = f" ({bad.size} such values in this column)" if bad.size > 1 else ""
    if np.isinf(values[row]):
        raise table.error(f"column `{name}` is {values[row]}, must be finite{others}; remove the row", first_row + row)
    if static:
        raise table.error(f"column `{name}` is empty or not a number{others}; remove the row", first_row + row)
    raise table.error(
        f"column `{name}` is empty or not a number{others}; remove such rows (a gap is handled); rows that hold only "
        f"joints beside rows that hold only the sensor are two rates in one log, and are taken as such when there are "
        f"many of both",
        first_row + row,
    )
