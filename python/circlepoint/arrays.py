"""Recordings from arrays in memory: NumPy, pandas, polars, pyarrow, or anything with named columns."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint._core import STANDARD_GRAVITY, InvalidInput
from circlepoint.column_map import ColumnMap, load_column_map
from circlepoint.log_table import FloatArray, MemoryTable
from circlepoint.recording_io import LoadedRecording, read_tables

if TYPE_CHECKING:
    from collections.abc import Iterator

    from circlepoint.arm import Arm

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
    column_map = load_column_map(columns, arm) if columns is not None else ColumnMap()
    labels = ["table" if len(tables) == 1 else f"table {index + 1}" for index in range(len(tables))]
    memory = [_table(label, table) for label, table in zip(labels, tables, strict=True)]
    return read_tables(memory, arm, column_map, gravity=gravity)


def _table(label: str, table: Any) -> MemoryTable:
    values: dict[str, FloatArray] = {}
    for name, column in _columns(label, table):
        array = _numbers(label, name, column)
        if array is None:
            continue
        if array.ndim == 2:
            members = [f"{name}{axis}" for axis in "xyz"] if name in {"a", "g"} and array.shape[1] == 3 else None
            members = members or [f"{name}{index + 1}" for index in range(array.shape[1])]
            values.update(zip(members, (np.ascontiguousarray(part) for part in array.T), strict=True))
        else:
            values[name] = array
    lengths = {name: array.size for name, array in values.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {size}" for name, size in lengths.items())
        raise InvalidInput(
            f"{label}: the columns differ in length ({listed}); give joints and sensor of two rates as two tables"
        )
    return MemoryTable(Path(label), values)


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


def _numbers(label: str, name: str, column: Any) -> FloatArray | None:
    """Return a column as numbers; None for one of text, which cannot be a sample."""
    array = np.asarray(column)
    if array.dtype.kind == "M":
        stamps = array.astype("datetime64[ns]")
        return (stamps - stamps[0]).astype(np.int64) / _SECOND if stamps.size else np.empty(0)
    if array.dtype.kind == "O":
        try:
            array = array.astype(np.float64)
        except (TypeError, ValueError):
            return None
    if array.dtype.kind not in "fiub":
        return None
    if array.ndim not in {1, 2}:
        raise InvalidInput(f"{label}: column {name!r} has {array.ndim} dimensions; a column is (N,), a group (N, n)")
    return np.ascontiguousarray(array, dtype=np.float64)
