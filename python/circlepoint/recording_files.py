"""Writing a recording to a file that `read_recording` reads back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from circlepoint._core import InvalidInput
from circlepoint.atomic import replacing

if TYPE_CHECKING:
    from pathlib import Path

    import circlepoint

FORMATS = (".csv", ".csv.gz", ".parquet")


def require_format(path: Path) -> None:
    """Raise InvalidInput unless the name ends in a format that can be written."""
    if not path.name.lower().endswith(FORMATS):
        raise InvalidInput(f"{path}: the name must end in {', '.join(FORMATS)}, which says the format")


def recording_stem(path: Path) -> str:
    """Return the file's name without its format: what lies beside it carries this name."""
    suffix = next(suffix for suffix in sorted(FORMATS, key=len, reverse=True) if path.name.lower().endswith(suffix))
    return path.name[: -len(suffix)]


def write_recording(path: Path, recording: circlepoint.Recording) -> None:
    """Write a recording, whole or not at all.

    Parameters
    ----------
    path : Path
        Ends in ``.csv``, ``.csv.gz`` or ``.parquet``; its folder must exist.
    recording : Recording
        Written as ``t, q1 .. qn, ax, ay, az`` and, where recorded, ``gx, gy, gz, temp``; SI units. Still poses have
        ``pose``, counted from 0, in place of ``t``.

    Raises
    ------
    InvalidInput
        When the name ends in none of these.
    OSError
        When the file cannot be written.
    """
    require_format(path)
    columns = {"pose" if recording.is_static else "t": recording.time}
    columns |= {f"q{index + 1}": recording.joint_positions[:, index] for index in range(recording.joints)}
    columns |= {f"a{axis}": recording.specific_force[:, index] for index, axis in enumerate("xyz")}
    if recording.angular_velocity is not None:
        columns |= {f"g{axis}": recording.angular_velocity[:, index] for index, axis in enumerate("xyz")}
    if recording.temperature is not None:
        columns["temp"] = recording.temperature
    table = pa.table({name: np.ascontiguousarray(values) for name, values in columns.items()})
    with replacing(path) as temporary:
        if path.suffix.lower() == ".parquet":
            pyarrow.parquet.write_table(table, temporary)
        elif path.suffix.lower() == ".gz":
            with pa.CompressedOutputStream(str(temporary), "gzip") as stream:
                pyarrow.csv.write_csv(table, stream, _CSV)
        else:
            pyarrow.csv.write_csv(table, temporary, _CSV)


_CSV = pyarrow.csv.WriteOptions(quoting_style="none")
