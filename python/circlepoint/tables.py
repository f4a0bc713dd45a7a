"""Tables of numbers in files: CSV (also compressed) and Parquet, with the place of every value.

The fast path is pyarrow's reader. When it stumbles, or a value read is no use, the file is walked again line by line to
say where and why: file, line, column, value and what to do.
"""

import csv
import gzip
import io
import itertools
import math
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TextIO

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
from numpy.typing import NDArray

from circlepoint._core import InvalidInput
from circlepoint.findings import Finding
from circlepoint.log_table import MANY_ROWS, PIECE_ROWS

_DELIMITERS = (",", ";", "\t")
_COMPRESSION = 10  # of a CSV file, at most
_BLOCK_BYTES = 1 << 22  # bytes of a piece of a CSV file


@dataclass(frozen=True)
class TableFile:
    """A file whose header was read: where it is, how it is written, the columns it names."""

    path: Path
    kind: Literal["csv", "parquet"]
    columns: tuple[str, ...]
    delimiter: str = ","
    decimal_point: str = "."
    header_line: int = 1

    @property
    def label(self) -> str:
        """What messages call it."""
        return str(self.path)

    @property
    def part(self) -> str:
        """Which part of the file it is: all."""
        return ""

    @property
    def hint(self) -> str:
        """What else is there."""
        return ""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What opening it has shown: nothing."""
        return ()

    @property
    def long(self) -> bool:
        """Whether it may be too long for memory, by its size; CSV says its number of rows only when read."""
        if self.kind == "parquet":
            with _parquet_blame(self):
                return int(pyarrow.parquet.read_metadata(self.path).num_rows) > MANY_ROWS
        size = self.path.stat().st_size * (_COMPRESSION if self.path.suffix.lower() == ".gz" else 1)
        return size > 2 * MANY_ROWS * len(self.columns)  # a cell has two characters at least

    def read(self, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
        """Read columns as numbers (see `read_numbers`)."""
        return read_numbers(self, names)

    def batches(self, names: Sequence[str]) -> Iterator[dict[str, NDArray[np.float64]]]:
        """Read columns as numbers, piece by piece (see `read_numbers`)."""
        columns = list(dict.fromkeys(names))
        for content in _stream_parquet(self, columns) if self.kind == "parquet" else _stream_csv(self, columns):
            yield {name: np.array(_as_float(content.column(name))) for name in columns}
        pa.default_memory_pool().release_unused()  # what reading needed is needed for other things now

    def place(self, row: int) -> str:
        """Where a data row (0-based) is in the file: ``"line 12"``, ``"row 11"`` for Parquet."""
        if self.kind == "parquet":
            return f"row {row + 1}"
        line = next((line for index, (line, _) in enumerate(_data_rows(self)) if index == row), row + 2)
        return f"line {line}"

    def error(self, message: str, row: int | None = None) -> InvalidInput:
        """Return an InvalidInput about the file, or about one of its data rows (0-based)."""
        return InvalidInput(f"{self.path}{'' if row is None else ', ' + self.place(row)}: {message}")


def open_table(path: str | Path) -> TableFile:
    """Read the header of a CSV or Parquet file.

    Parameters
    ----------
    path : str or Path
        The file; ``.gz`` is decompressed. The delimiter may be comma, semicolon or tab.

    Returns
    -------
    TableFile
        What the header says.

    Raises
    ------
    InvalidInput
        When the file cannot be read, is empty, is neither CSV nor Parquet, or has no header line.
    """
    path = Path(path)
    try:
        with path.open("rb") as stream:
            start = stream.read(4)
    except OSError as error:
        hint = "; give the files in it" if path.is_dir() else "; check the path and its permissions"
        raise InvalidInput(f"{path}: cannot be read ({error.strerror or error}){hint}") from error
    if not start:
        raise InvalidInput(f"{path}: is empty; a header line and samples are needed")
    if start == b"PAR1" or path.suffix.lower() == ".parquet":
        try:
            return TableFile(path, "parquet", tuple(pyarrow.parquet.read_schema(path).names))
        except (pa.ArrowException, OSError) as error:
            raise InvalidInput(f"{path}: is not a Parquet file that can be read ({_first_line(error)})") from error
    return _open_csv(path)


def read_numbers(table: TableFile, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    """Read columns as numbers; an empty cell is not a number (NaN).

    Parameters
    ----------
    table : TableFile
        From `open_table`.
    names : sequence of str
        Columns to read; others are not looked at.

    Returns
    -------
    dict of str to ndarray, shape (N,)
        One array a column.

    Raises
    ------
    InvalidInput
        When a cell is not a number or a line has too few or too many cells; names line, column and value.
    """
    columns = list(dict.fromkeys(names))
    content = _read_parquet(table, columns) if table.kind == "parquet" else _read_csv(table, columns)
    return {name: np.ascontiguousarray(_as_float(content.column(name))) for name in columns}


def _open_csv(path: Path) -> TableFile:
    with _text(path) as stream:
        line_number = 0
        header = ""
        for line in stream:
            line_number += 1
            if "\0" in line:
                raise InvalidInput(f"{path}: is not a CSV file (line {line_number} holds binary data)")
            if line.strip():
                header = line.strip("\r\n")
                break
        following = next((line for line in stream if line.strip()), "")
    if not header:
        raise InvalidInput(f"{path}: is empty; a header line and samples are needed")
    delimiter = max(_DELIMITERS, key=header.count)
    if delimiter not in header and _numbers_between_spaces(header, following):
        delimiter = " "
    columns = tuple(name.strip() for name in next(csv.reader([header.removeprefix("#").lstrip()], delimiter=delimiter)))
    if len(columns) < 2:
        raise InvalidInput(
            f"{path}: is not a CSV file with a header line: its first line is {header[:60]!r}, which names one column; "
            "columns are separated by comma, semicolon or tab"
        )
    if sum(_is_number(name) for name in columns) > len(columns) / 2:
        raise InvalidInput(
            f"{path}, line {line_number}: the header line is missing: the first line holds numbers ({header[:60]!r}); "
            "write the columns' names above, such as t,q1,q2,...,ax,ay,az"
        )
    decimal_comma = delimiter == ";" and "," in following and "." not in following
    return TableFile(path, "csv", columns, delimiter, "," if decimal_comma else ".", line_number)


def _numbers_between_spaces(header: str, following: str) -> bool:
    """Whether columns are separated by single spaces, as Universal Robots' own recorder writes them."""
    cells = following.strip().split(" ")
    return len(cells) > 1 and len(cells) == len(header.strip().split(" ")) and all(map(_is_number, cells))


def _read_csv(table: TableFile, names: list[str]) -> pa.Table:
    with _csv_blame(table, names):
        return pyarrow.csv.read_csv(table.path, **_csv_options(table, names))


def _stream_csv(table: TableFile, names: list[str]) -> Iterator[pa.RecordBatch]:
    with (
        _csv_blame(table, names),
        pyarrow.csv.open_csv(table.path, **_csv_options(table, names, block_size=_BLOCK_BYTES)) as stream,
    ):
        yield from stream


def _csv_options(table: TableFile, names: list[str], block_size: int | None = None) -> dict[str, Any]:
    return {
        "read_options": pyarrow.csv.ReadOptions(
            column_names=_unique(table.columns, names),
            skip_rows=table.header_line,
            block_size=block_size,
            use_threads=block_size is None,
        ),
        "parse_options": pyarrow.csv.ParseOptions(delimiter=table.delimiter),
        "convert_options": pyarrow.csv.ConvertOptions(
            include_columns=names,
            column_types=dict.fromkeys(names, pa.float64()),
            null_values=[""],
            decimal_point=table.decimal_point,
        ),
    }


@contextmanager
def _csv_blame(table: TableFile, names: list[str]) -> Iterator[None]:
    """Turn what pyarrow says of a CSV file into InvalidInput with line, column and value."""
    try:
        yield
    except pa.ArrowInvalid as error:
        _blame_cell(table, names)
        raise table.error(f"cannot be read as CSV ({_first_line(error)})") from error
    except (OSError, pa.ArrowException) as error:
        raise table.error(f"cannot be read ({_first_line(error)})") from error


def _read_parquet(table: TableFile, names: list[str]) -> pa.Table:
    with _parquet_blame(table):
        content = pyarrow.parquet.read_table(table.path, columns=names)
    _require_numbers(table, content.schema, names)
    return content


def _stream_parquet(table: TableFile, names: list[str]) -> Iterator[pa.RecordBatch]:
    with (
        _parquet_blame(table),
        pyarrow.parquet.ParquetFile(table.path, buffer_size=_BLOCK_BYTES, pre_buffer=False) as file,
    ):
        _require_numbers(table, file.schema_arrow, names)
        yield from file.iter_batches(batch_size=PIECE_ROWS, columns=names, use_threads=False)


@contextmanager
def _parquet_blame(table: TableFile) -> Iterator[None]:
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        raise table.error(f"cannot be read as Parquet ({_first_line(error)})") from error


def _require_numbers(table: TableFile, schema: pa.Schema, names: list[str]) -> None:
    for name in names:
        kind = schema.field(name).type
        if not (pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_timestamp(kind)):
            raise table.error(f"column `{name}` holds {kind}, must hold numbers")


def _as_float(column: pa.ChunkedArray | pa.Array) -> NDArray[np.float64]:
    if pa.types.is_timestamp(column.type):  # seconds, whatever the file's unit
        column = column.cast(pa.timestamp("ns", column.type.tz), safe=False).cast(pa.int64())
        nanoseconds: NDArray[np.int64] = column.to_numpy(**_COPY if isinstance(column, pa.Array) else {})
        return nanoseconds / 1e9
    column = column.cast(pa.float64(), safe=False)
    values: NDArray[np.float64] = column.to_numpy(**_COPY if isinstance(column, pa.Array) else {})
    return values


def _unique(columns: tuple[str, ...], used: list[str]) -> list[str]:
    """Column names with the unused ones made unique: pyarrow refuses what does not concern us."""
    return [name if name in used else f"\0{index}" for index, name in enumerate(columns)]


def _blame_cell(table: TableFile, names: list[str]) -> None:
    """Raise at the first line that is too short or long, or whose cell in one of the columns is not a number."""
    indices = {name: table.columns.index(name) for name in names}
    for line, cells in _data_rows(table):
        if len(cells) != len(table.columns):
            raise InvalidInput(
                f"{table.path}, line {line}: has {len(cells)} cells, the header line names {len(table.columns)} "
                f"columns; complete "
                "the line, or remove it when logging was cut off there"
            )
        for name, index in indices.items():
            cell = cells[index].strip()
            if cell and not _is_number(cell.replace(",", ".") if table.decimal_point == "," else cell):
                raise InvalidInput(
                    f"{table.path}, line {line}: column `{name}` is {cell[:40]!r}, must be a number; correct or "
                    f"remove the row"
                )


def _data_rows(table: TableFile) -> Iterator[tuple[int, list[str]]]:
    """Yield data rows with their line in the file; empty lines are not rows."""
    with _text(table.path) as stream:
        reader = csv.reader(itertools.islice(stream, table.header_line, None), delimiter=table.delimiter)
        try:
            for cells in reader:
                if cells:
                    yield reader.line_num + table.header_line, cells
        except csv.Error as error:
            line = reader.line_num + table.header_line
            raise InvalidInput(f"{table.path}, line {line}: cannot be read as CSV ({error})") from error


@contextmanager
def _text(path: Path) -> Iterator[TextIO]:
    """Open a file's text, decompressed; what goes wrong while it is read becomes InvalidInput."""
    try:
        with _binary(path) as stream, io.TextIOWrapper(stream, encoding="utf-8-sig", newline="") as text:
            yield text
    except UnicodeDecodeError as error:
        raise InvalidInput(
            f"{path}: is not a CSV file (it holds bytes that are not UTF-8 text); a CSV or Parquet file is needed"
        ) from error
    except (OSError, EOFError, zlib.error) as error:
        raise InvalidInput(f"{path}: cannot be read ({_first_line(error)})") from error


def _binary(path: Path) -> gzip.GzipFile | io.BufferedReader:
    return gzip.open(path, "rb") if path.suffix.lower() == ".gz" else path.open("rb")


def _is_number(cell: str) -> bool:
    try:
        return not math.isnan(float(cell)) or cell.strip().lower() == "nan"
    except ValueError:
        return False


_COPY = {"zero_copy_only": False}


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]
