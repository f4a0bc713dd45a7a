"""Messages of a bag decoded by the thousand: joint states and IMU readings as rows of numbers.

A recorder writes messages of one layout: the same frame, the same joint names, so the numbers stand at the same bytes.
The layout is worked out from one message and believed only after the library's own deserialiser reads the same values
from it. Every later message is compared with it byte by byte outside its numbers; those that are equal are read as one
block, those that are not teach a further layout, and what fits none is left to the library.
"""

from __future__ import annotations

import struct
from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from circlepoint.log_table import FloatArray

JOINT_STATE = "sensor_msgs/msg/JointState"
IMU = "sensor_msgs/msg/Imu"
IMU_COLUMNS = (
    *(f"linear_acceleration.{axis}" for axis in "xyz"),
    *(f"angular_velocity.{axis}" for axis in "xyz"),
)
_NOT_MEASURED = -1.0  # first element of an Imu's covariance: there is no such quantity
_STAMP = 4  # byte of a message's stamp in either serialisation: behind the encapsulation, or the sequence number
_FRAME = 12
_CDR_LITTLE = b"\0\1"
_LAYOUTS = 8  # of one length; more of them have nothing in common
_IMU_NUMBERS = 4 + 9 + 3 + 9 + 3 + 9
_TURN, _TURN_COVARIANCE, _FORCE = 4 + 9, 4 + 9 + 3, 4 + 9 + 3 + 9


@dataclass(frozen=True)
class Rows:
    """Messages that give the same columns.

    Attributes
    ----------
    columns : tuple of str
    order : ndarray, shape (K,)
        Which of the messages each row is.
    stamps : ndarray, shape (K,)
        ns, of the headers.
    values : ndarray, shape (K, columns)
        NaN where a message says that something was not measured.
    """

    columns: tuple[str, ...]
    order: NDArray[np.intp]
    stamps: NDArray[np.int64]
    values: FloatArray


@dataclass(frozen=True)
class _Layout:
    """Where the numbers of a message stand, and what stands between them."""

    columns: tuple[str, ...]
    numbers: tuple[int, int]  # bytes of its block of float64
    between: tuple[tuple[int, bytes], ...]  # what is the same in every message, by where it begins

    def fits(self, block: NDArray[np.uint8]) -> NDArray[np.bool_]:
        """Say which messages (K, length) have this layout."""
        fitting = np.ones(block.shape[0], dtype=np.bool_)
        for begin, text in self.between:
            fitting &= (block[:, begin : begin + len(text)] == np.frombuffer(text, np.uint8)).all(axis=1)
        return fitting

    def read(self, block: NDArray[np.uint8]) -> FloatArray:
        """Return the numbers (K, m) of messages (K, length)."""
        begin, end = self.numbers
        return np.ascontiguousarray(block[:, begin:end]).view("<f8").astype(np.float64, copy=False)


class MessageDecoder:
    """Decodes the messages of one topic.

    Parameters
    ----------
    msgtype : str
        `JOINT_STATE` or `IMU`.
    deserialize : callable
        The library's own way from a message's bytes to its fields.
    ros1 : bool
        How messages are serialised: as ROS 1 does, else as CDR.
    """

    def __init__(self, msgtype: str, deserialize: Callable[[bytes], Any], *, ros1: bool) -> None:
        self._msgtype = msgtype
        self._deserialize = deserialize
        self._ros1 = ros1
        self._layouts: dict[int, list[_Layout]] = defaultdict(list)

    def decode(self, messages: Sequence[bytes]) -> list[Rows]:
        """Return the rows that messages give, in their order; messages without numbers give none."""
        parts: dict[tuple[str, ...], list[Rows]] = defaultdict(list)
        lengths = np.fromiter(map(len, messages), dtype=np.intp, count=len(messages))
        for length in np.unique(lengths):
            chosen = np.flatnonzero(lengths == length)
            picked = messages if chosen.size == len(messages) else [messages[int(index)] for index in chosen]
            block = np.frombuffer(b"".join(picked), np.uint8).reshape(chosen.size, length)
            for rows in self._decode_block(block, chosen):
                if rows.columns:
                    parts[rows.columns].append(rows)
        return [_merged(group) for group in parts.values()]

    def _decode_block(self, block: NDArray[np.uint8], order: NDArray[np.intp]) -> Iterator[Rows]:
        """Yield the rows of messages of one length."""
        layouts = self._layouts[block.shape[1]]
        known = 0
        while block.shape[0]:
            if known == len(layouts):
                layout = self._learned(block[0].tobytes()) if known < _LAYOUTS else None
                if layout is None:
                    yield from self._by_library(block, order)
                    return
                layouts.append(layout)
            layout = layouts[known]
            known += 1
            fitting = layout.fits(block)
            if fitting.all():
                yield self._rows(layout, block, order)
                return
            if fitting.any():
                yield self._rows(layout, block[fitting], order[fitting])
                block, order = block[~fitting], order[~fitting]

    def _rows(self, layout: _Layout, block: NDArray[np.uint8], order: NDArray[np.intp]) -> Rows:
        seconds = np.ascontiguousarray(block[:, _STAMP : _STAMP + 8]).view("<u4" if self._ros1 else "<i4")
        nanoseconds = seconds[:, 1].view("<u4").astype(np.int64)
        stamps = seconds[:, 0].astype(np.int64) * 1_000_000_000 + nanoseconds
        values = layout.read(block)
        if self._msgtype == IMU:
            unknown = values[:, _TURN_COVARIANCE] == _NOT_MEASURED
            values = np.hstack([values[:, _FORCE : _FORCE + 3], values[:, _TURN : _TURN + 3]])
            values[unknown, 3:] = np.nan
        return Rows(layout.columns, order, stamps, values)

    def _by_library(self, block: NDArray[np.uint8], order: NDArray[np.intp]) -> Iterator[Rows]:
        for message, index in zip(block, order, strict=True):
            columns, stamp, values = self._fields(message.tobytes())
            yield Rows(columns, np.array([index]), np.array([stamp]), np.array(values, dtype=np.float64)[None])

    def _fields(self, message: bytes) -> tuple[tuple[str, ...], int, list[float]]:
        """Return what the library reads from one message."""
        fields = self._deserialize(message)
        stamp = fields.header.stamp
        columns, values = _joint_values(fields) if self._msgtype == JOINT_STATE else (IMU_COLUMNS, _imu_values(fields))
        return columns, stamp.sec * 1_000_000_000 + stamp.nanosec, values

    def _learned(self, message: bytes) -> _Layout | None:
        """Return a message's layout, once the library has read the same from it; None where there is none."""
        try:
            layout = _layout(message, self._msgtype, ros1=self._ros1)
        except (struct.error, UnicodeDecodeError):  # it is cut off, or not what it is taken for: the library says so
            return None
        if layout is None:
            return None
        columns, stamp, values = self._fields(message)
        rows = self._rows(layout, np.frombuffer(message, np.uint8)[None], np.zeros(1, dtype=np.intp))
        same = (
            columns == layout.columns
            and rows.stamps[0] == stamp
            and np.array_equal(rows.values[0], np.array(values, dtype=np.float64), equal_nan=True)
        )
        return layout if same else None


def _merged(group: Sequence[Rows]) -> Rows:
    """Return rows of the same columns as one, in the order of the messages."""
    if len(group) == 1:
        return group[0]
    order = np.concatenate([rows.order for rows in group])
    by_message = np.argsort(order)
    return Rows(
        group[0].columns,
        order[by_message],
        np.concatenate([rows.stamps for rows in group])[by_message],
        np.concatenate([rows.values for rows in group])[by_message],
    )


def _joint_values(fields: Any) -> tuple[tuple[str, ...], list[float]]:
    values = fields.position.tolist()
    names = tuple(fields.name) or tuple(f"position_{index}" for index in range(len(values)))
    return (names, values) if len(names) == len(values) else ((), [])


def _imu_values(fields: Any) -> list[float]:
    force, turn = fields.linear_acceleration, fields.angular_velocity
    if fields.angular_velocity_covariance[0] == _NOT_MEASURED:
        return [force.x, force.y, force.z, np.nan, np.nan, np.nan]
    return [force.x, force.y, force.z, turn.x, turn.y, turn.z]


def _layout(message: bytes, msgtype: str, *, ros1: bool) -> _Layout | None:
    """Work out the layout of one message; None for a serialisation that is not little-endian CDR or ROS 1's."""
    if not ros1 and message[:2] != _CDR_LITTLE:
        return None
    walk = _Walk(message, aligned=not ros1)
    if not ros1:
        walk.between.append((0, message[:2]))
    walk.text()  # the frame
    if msgtype == IMU:
        columns, count = IMU_COLUMNS, _IMU_NUMBERS
    else:
        columns = tuple(walk.text() for _ in range(walk.count()))
        count = walk.count()
        columns = columns or tuple(f"position_{index}" for index in range(count))
        if len(columns) != count:
            columns, count = (), 0
    begin = walk.numbers() if count else walk.at
    if begin + 8 * count > len(message):
        return None
    return _Layout(columns, (begin, begin + 8 * count), tuple(walk.between))


class _Walk:
    """Goes through a message from its frame on, keeping what must be equal in others of its layout."""

    def __init__(self, message: bytes, *, aligned: bool) -> None:
        self.message = message
        self.at = _FRAME
        self.between: list[tuple[int, bytes]] = []
        self._aligned = aligned

    def count(self) -> int:
        """Take a length."""
        self._align(4)
        (value,) = struct.unpack_from("<I", self.message, self.at)
        self._take(4)
        return int(value)

    def text(self) -> str:
        """Take a string."""
        length = self.count()
        text = self._take(length)
        return text.rstrip(b"\0").decode() if self._aligned else text.decode()

    def numbers(self) -> int:
        """Return where float64 begin."""
        self._align(8)
        return self.at

    def _align(self, size: int) -> None:
        if self._aligned:  # from behind the encapsulation
            self.at = 4 + -(-(self.at - 4) // size) * size

    def _take(self, length: int) -> bytes:
        text = self.message[self.at : self.at + length]
        if len(text) != length:
            raise struct.error("cut off")
        begin, before = self.between[-1] if self.between else (self.at, b"")
        if begin + len(before) == self.at:  # one comparison for what is side by side; padding may hold anything
            self.between[-1:] = [(begin, before + text)]
        else:
            self.between.append((self.at, text))
        self.at += length
        return text
