"""Files written whole or not at all."""

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from circlepoint._core import InvalidInput


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary file beside `path` that takes its place when the block ends, and vanishes when it fails.

    It is on the disk before it takes that place: a machine that loses power has the old file or the new one.

    Parameters
    ----------
    path : Path
        The file to write or replace; its folder must exist.

    Yields
    ------
    Path
        Where to write.

    Raises
    ------
    OSError
        With `path` as its file name, which errors on the way do not have (a full disk), or not this one.
    """
    try:
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=path.suffix, dir=path.parent)
    except OSError as error:
        raise _about(path, error) from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        _flush(temporary)
        temporary.replace(path)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename in {None, name}:
            raise _about(path, error) from error
        raise


def _about(path: Path, error: OSError) -> OSError:
    number = error.errno or errno.EIO
    return OSError(number, os.strerror(number), str(path))


def _flush(path: Path) -> None:
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file so that a reader finds the old one or the new one, never a part of it."""
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def require_writable_folder(folder: Path) -> None:
    """Raise InvalidInput when `folder` is not a folder to write into and cannot become one; makes nothing."""
    existing = folder
    while not existing.exists() and existing != existing.parent:
        existing = existing.parent
    if not existing.is_dir():
        raise InvalidInput(f"{folder}: cannot be made, {existing} is a file; choose another place for the output")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise InvalidInput(
            f"{folder}: cannot be written, no permission in {existing}; choose another place for the output"
        )
