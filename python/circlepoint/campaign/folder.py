"""A campaign's folder: what belongs in it, what is finished, and who is writing to it.

Every file is written beside its place and moved there when it is whole, so that a process killed at any moment leaves
finished batches and nothing else that counts.
"""

from __future__ import annotations

import fcntl
import json
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import pyarrow.parquet as pq

from circlepoint._core import InvalidInput, __version__
from circlepoint.atomic import replacing, write_atomically

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

DESCRIPTION = "campaign.json"
_lock = ".lock"
_shown = 60


@contextmanager
def only_writer(folder: Path) -> Iterator[None]:
    """Make the folder, and refuse to write to it while another process does; a killed process holds nothing."""
    folder.mkdir(parents=True, exist_ok=True)
    handle = os.open(folder / _lock, os.O_RDWR | os.O_CREAT, 0o644)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            process = os.read(handle, 32).decode(errors="replace").strip()
            raise InvalidInput(
                f"{folder}: another campaign is running there (process {process or 'unknown'}); wait for it, or give "
                "another folder"
            ) from None
        os.ftruncate(handle, 0)
        os.write(handle, f"{os.getpid()}\n".encode())
        yield
    finally:
        os.close(handle)


def claim(folder: Path, description: Mapping[str, Any], source: Path) -> bool:
    """Write what the campaign is into its folder; where it is there already, refuse any other.

    Parameters
    ----------
    folder : Path
    description : mapping
        ``config``: the file's fields, ``files``: the texts of the files it names; both decide what results are. Other
        fields only inform.
    source : Path
        The campaign's file, for messages.

    Returns
    -------
    bool
        Whether it was begun before.

    Raises
    ------
    InvalidInput
        Naming the field that differs, with both values.
    """
    path = folder / DESCRIPTION
    complete = {"schema": "circlepoint/campaign/1", "version": __version__, **description}
    if not path.exists():
        _require_unused(folder)
        write_atomically(path, (json.dumps(complete, indent=1, ensure_ascii=False, default=str) + "\n").encode())
        return False
    try:
        before = json.loads(path.read_text(encoding="utf-8"))
        was, was_files, was_version = before["config"], before["files"], before["version"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InvalidInput(
            f"{path}: is not a campaign's description ({type(error).__name__}); give another folder"
        ) from error
    now = json.loads(json.dumps(complete, default=str))
    found = _difference(was, now["config"], "")
    if found is not None:
        field, old, new = found
        raise InvalidInput(
            f"{source}: {field}: {folder} was begun with {old}, now it is {new}; put it back, or give another folder"
        )
    for name in sorted({*was_files, *now["files"]}):
        if was_files.get(name) != now["files"].get(name):
            raise InvalidInput(
                f"{source}: {name}: is not what it was when {folder} was begun; put it back (its text is in {path}, "
                "files), or give another folder"
            )
    if was_version != __version__:
        raise InvalidInput(
            f"{folder}: was begun by circlepoint {was_version}, this is {__version__}, and results may differ; finish "
            "it with that version, or give another folder"
        )
    return True


def write_table(path: Path, table: pa.Table) -> None:
    """Write a table as Parquet, whole or not at all; the same table gives the same bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        pq.write_table(table, temporary, compression="zstd")


def finished(path: Path, rows: int) -> bool:
    """Return whether a table is there and whole; one that a failing disk or machine has damaged is taken away."""
    if not path.exists():
        return False
    try:
        if pq.read_metadata(path).num_rows == rows:
            return True
    except (pa.ArrowException, OSError):
        pass
    path.unlink()
    return False


def remove_unfinished(folder: Path) -> None:
    """Take away what killed processes were writing."""
    for pattern in (".*.parquet", ".*.json", ".*.svg", ".*.png"):
        for path in folder.rglob(pattern):
            path.unlink(missing_ok=True)


def _require_unused(folder: Path) -> None:
    others = sorted(path.name for path in folder.iterdir() if not path.name.startswith("."))
    if others:
        raise InvalidInput(
            f"{folder}: is not empty and holds no campaign (there is {others[0]}); give another folder, or empty it"
        )


def _difference(was: Any, now: Any, field: str) -> tuple[str, str, str] | None:
    """Return the first field in which two documents differ, and both values as text."""
    if isinstance(was, dict) and isinstance(now, dict):
        for key in [*was, *(key for key in now if key not in was)]:
            name = f"{field}.{key}" if field else key
            if key not in was or key not in now:
                return name, _text(was.get(key)), _text(now.get(key))
            found = _difference(was[key], now[key], name)
            if found is not None:
                return found
        return None
    if isinstance(was, list) and isinstance(now, list) and len(was) == len(now):
        for index, (old, new) in enumerate(zip(was, now, strict=True)):
            found = _difference(old, new, f"{field}[{index}]")
            if found is not None:
                return found
        return None
    return None if was == now else (field, _text(was), _text(now))


def _text(value: Any) -> str:
    if value is None:
        return "nothing"
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _shown else f"{text[: _shown - 3]}..."
