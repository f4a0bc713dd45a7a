"""Rows of a log kept aside while it is read: in memory while they are few, in an unnamed file when they are many."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, field
from typing import IO, TYPE_CHECKING

import numpy as np

from circlepoint._core import InvalidInput
from circlepoint.log_table import PIECE_ROWS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

IN_MEMORY = 1 << 26
"""Bytes of a log's rows that are kept in memory."""


def _unnamed_file() -> IO[bytes]:
    return tempfile.SpooledTemporaryFile(max_size=IN_MEMORY)


@dataclass
class Scratch:
    """Rows of one structured type, written once, read as often as one likes; `close` throws them away."""

    dtype: np.dtype[np.void]
    rows: int = 0
    _file: IO[bytes] = field(default_factory=_unnamed_file)

    def append(self, rows: NDArray[np.void]) -> None:
        """Add rows (K,)."""
        try:
            self._file.seek(0, 2)
            self._file.write(rows.tobytes())
        except OSError as error:
            raise InvalidInput(
                f"{tempfile.gettempdir()}: cannot hold what is read from a long bag ({error.strerror or error}); free "
                f"some space, or set TMPDIR to a folder that has it"
            ) from error
        self.rows += rows.size

    def pieces(self) -> Iterator[NDArray[np.void]]:
        """Yield the rows in order, piece by piece."""
        for first in range(0, self.rows, PIECE_ROWS):
            count = min(PIECE_ROWS, self.rows - first)
            self._file.seek(first * self.dtype.itemsize)
            yield np.frombuffer(self._file.read(count * self.dtype.itemsize), dtype=self.dtype)

    def close(self) -> None:
        """Throw the rows away."""
        self._file.close()
