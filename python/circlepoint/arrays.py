"""Recordings from arrays in memory: NumPy, pandas, polars, pyarrow, or anything with named columns.

Columns stay where they are: what is read of them becomes float64 piece by piece, so that a table that fills half the
memory can be calibrated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint._core import STANDARD_GRAVITY, InvalidInput
from circlepoint.column_map import ColumnMap, load_column_map
from circlepoint.log_table import MANY_ROWS, PIECE_ROWS, FloatArray
from circlepoint.recording_io import LoadedRecording, read_tables

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from circlepoint.arm import Arm
    from circlepoint.findings import Finding

_SECOND = 1e9  # ns


def recording_from_arrays(
    *tables: Any, arm: Arm, columns: str | Path | None = None, gravity: float = STANDARD_GRAVITY
) -> LoadedRecording:
    """Make a recording of columns in memory, by the rules files are read by.

    Parameters
    ----------
    *tables : mapping, DataFrame or structured array
        Columns by name, as a file would have them (docs/recording-format.md): ``t``, joint positions, specific force.
        A group may be one array of shape (N, n): ``{"t": t, "q": q, "a": a}``. Joints and sensor may be two tables,
        each with a time of its own; they are then two clocks. A DataFrame's named index counts as a column, and
        ``datetime64`` times are seconds.
    arm : Arm
        The arm that was recorded.
    columns : path, optional
        Column map for other names and units.
    gravity : float, optional
        Local gravity, m/s^2, against which the accelerometer's unit is judged.

    Returns
    -------
    LoadedRecording
        The recording, with what reading it has shown.

    Raises
    ------
    InvalidInput
        When the columns cannot be used as they are; the message names table, row, column, value and remedy.

    Examples
    --------
    >>> loaded = circlepoint.recording_from_arrays({"t": t, "q": q, "a": a}, arm=arm)  # doctest: +SKIP
    >>> circlepoint.calibrate(loaded.recording, arm)  # doctest: +SKIP
    """
    if not tables:
        raise InvalidInput("no table was given; give columns by name, such as {'t': t, 'q': q, 'a': a}")
    column_map = load_column_map(columns, arm.driven) if columns is not None else ColumnMap()
    labels = ["table" if len(tables) == 1 else f"table {index + 1}" for index in range(len(tables))]
    memory = [_table(label, table) for label, table in zip(labels, tables, strict=True)]
    return read_tables(memory, arm, column_map, gravity=gravity)


@dataclass(frozen=True)
class ArrayTable:
    """Columns in memory, under a name for messages."""

    path: Path
    values: Mapping[str, _Column] = field(repr=False)
    part: str = ""
    hint: str = ""
    findings: tuple[Finding, ...] = ()

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self.values)

    @property
    def label(self) -> str:
        """What messages call it."""
        return str(self.path)

    @property
    def rows(self) -> int:
        """How many samples there are."""
        return next((column.size for column in self.values.values()), 0)

    @property
    def long(self) -> bool:
        """Whether a copy may be too long for memory."""
        return self.rows > MANY_ROWS

    def error(self, message: str, row: int | None = None) -> InvalidInput:
        """Return an InvalidInput about the table, or about one of its rows (0-based)."""
        return InvalidInput(f"{self.label}{'' if row is None else f', row {row + 1}'}: {message}")

    def read(self, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return columns (N,) by name."""
        return {name: self.values[name].piece(0, self.rows) for name in names}

    def batches(self, names: Sequence[str]) -> Iterator[dict[str, FloatArray]]:
        """Yield the same columns piece by piece, in order."""
        for first in range(0, self.rows, PIECE_ROWS):
            yield {name: self.values[name].piece(first, min(first + PIECE_ROWS, self.rows)) for name in names}


@dataclass(frozen=True)
class _Column:
    """A column as its owner holds it: an array (N,), or what pyarrow and polars cut slices from."""

    source: Any
    size: int
    origin: np.datetime64 | None = None  # of time stamps

    def piece(self, begin: int, end: int) -> FloatArray:
        """Return rows as numbers; time stamps as seconds from the first."""
        array = _array(self.source, begin, end)
        if self.origin is not None:
            elapsed: FloatArray = (array.astype("datetime64[ns]") - self.origin).astype(np.int64) / _SECOND
            return elapsed
        return np.ascontiguousarray(array, dtype=np.float64)


def _array(source: Any, begin: int, end: int) -> np.ndarray[Any, Any]:
    return np.asarray(source.slice(begin, end - begin) if hasattr(source, "slice") else source[begin:end])


def _table(label: str, table: Any) -> ArrayTable:
    values: dict[str, _Column] = {}
    for name, column in _columns(label, table):
        values.update(_numbers(label, name, column))
    lengths = {name: column.size for name, column in values.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {size}" for name, size in lengths.items())
        raise InvalidInput(
            f"{label}: the columns differ in length ({listed}); give joints and sensor of two rates as two tables"
        )
    return ArrayTable(Path(label), values)


def _columns(label: str, table: Any) -> Iterator[tuple[str, Any]]:
    names = getattr(getattr(table, "dtype", None), "names", None)
    if names:
        yield from ((name, table[name]) for name in names)
        return
    if isinstance(table, Mapping):
        yield from ((str(name), column) for name, column in table.items())
        return
    names = getattr(table, "column_names", None) or getattr(table, "columns", None)
    if names is None:
        raise InvalidInput(
            f"{label}: is a {type(table).__name__}; give columns by name: a mapping such as {{'t': t, 'q': q, 'a': a}},"
            f" a DataFrame or a structured array"
        )
    index = getattr(table, "index", None)
    if index is not None and getattr(index, "name", None):
        yield str(index.name), index
    yield from ((str(name), table[name]) for name in names)


def _numbers(label: str, name: str, column: Any) -> dict[str, _Column]:
    """Return a column by its name, or a group's by theirs; nothing for one of text, which cannot be a sample."""
    source = column if hasattr(column, "slice") else np.asarray(column)
    if isinstance(source, np.ndarray) and source.ndim not in {1, 2}:
        raise InvalidInput(f"{label}: column {name!r} has {source.ndim} dimensions; a column is (N,), a group (N, n)")
    first = _array(source, 0, 1)
    if first.ndim == 2:
        members = [f"{name}{axis}" for axis in "xyz"] if name in {"a", "g"} and first.shape[1] == 3 else None
        members = members or [f"{name}{index + 1}" for index in range(first.shape[1])]
        return {each: found for index, each in enumerate(members) if (found := _column(source[:, index]))}
    found = _column(source)
    return {name: found} if found else {}


def _column(source: Any) -> _Column | None:
    first = _array(source, 0, 1)
    if first.dtype.kind == "M":
        return _Column(source, len(source), first.astype("datetime64[ns]")[0] if first.size else None)
    if first.dtype.kind == "O":
        try:
            return _Column(np.asarray(source).astype(np.float64), len(source))
        except (TypeError, ValueError):
            return None
    return _Column(source, len(source)) if first.dtype.kind in "fiub" else None
