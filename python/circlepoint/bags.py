"""ROS 1 and ROS 2 bags as tables: joint states and the IMU, without ROS.

A bag gives one table a topic: the positions of a ``sensor_msgs/JointState`` by joint name, whatever their order in the
message, and linear acceleration and angular velocity of a ``sensor_msgs/Imu``. Time is the stamp in the messages'
headers, in seconds from the bag's first; where these are not set, the time of logging, and a finding says so. The bag
is read once, from end to end; its rows are kept aside (`circlepoint.scratch`), so that a long one needs no memory.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint._core import InvalidInput
from circlepoint.bag_messages import IMU, IMU_COLUMNS, JOINT_STATE, MessageDecoder
from circlepoint.column_names import plain
from circlepoint.findings import Finding
from circlepoint.log_table import MANY_ROWS, FloatArray, joined
from circlepoint.scratch import Scratch

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from contextlib import ExitStack
    from pathlib import Path

    from numpy.typing import NDArray

    from circlepoint.arm import Arm
    from circlepoint.bag_messages import Rows
    from circlepoint.column_map import ColumnMap

_MAGIC = (b"#ROSBAG V", b"SQLite format 3\0", b"\x89MCAP0\r\n")
_SUFFIXES = (".bag", ".db3", ".mcap")
_KINDS = {JOINT_STATE: ("joint", "sensor_msgs/JointState"), IMU: ("imu", "sensor_msgs/Imu")}
_BATCH = 4096  # messages of a topic that are decoded at once


@dataclass
class _Stream:
    """What was read of one kind of message: stamps of the headers and of the logging in ns, values."""

    columns: tuple[str, ...]
    scratch: Scratch
    first: tuple[int, int] = (0, 0)  # stamp and time of logging
    stamped: bool = False  # whether the headers' stamps differ at all
    measured: set[str] = field(default_factory=set)  # columns with a value that is a number

    @classmethod
    def of(cls, columns: tuple[str, ...]) -> _Stream:
        """Return a stream without rows."""
        return cls(columns, Scratch(np.dtype([("stamp", "i8"), ("logged", "i8"), ("values", "f8", (len(columns),))])))

    def add(self, rows: Rows, logged: NDArray[np.int64]) -> None:
        """Add rows, logged at these times (K,), ns."""
        if not self.scratch.rows:
            self.first = int(rows.stamps[0]), int(logged[0])
        self.stamped |= bool((rows.stamps != self.first[0]).any())
        if len(self.measured) < len(self.columns):
            self.measured |= {
                name for name, column in zip(self.columns, rows.values.T, strict=True) if not np.isnan(column).all()
            }
        block = np.empty(rows.stamps.size, dtype=self.scratch.dtype)
        block["stamp"], block["logged"], block["values"] = rows.stamps, logged, rows.values
        self.scratch.append(block)


@dataclass(frozen=True)
class TopicTable:
    """The rows of one topic of a bag.

    Attributes
    ----------
    path : Path
        The bag.
    part : str
        Which topic.
    hint : str
        What else the bag holds.
    findings : tuple of Finding
        What reading it has shown.
    """

    path: Path
    part: str
    hint: str
    findings: tuple[Finding, ...]
    _stream: _Stream = field(repr=False)
    _stamp: str = field(repr=False)  # which stamp is the time
    _origin: int = field(repr=False)  # ns, of t = 0

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns; angular velocity only where some was measured."""
        names = self._stream.columns
        return ("t", *(name for name in names if name in self._stream.measured or not name.startswith("angular")))

    @property
    def label(self) -> str:
        """What messages call it."""
        return f"{self.path}, {self.part}"

    @property
    def long(self) -> bool:
        """Whether it may be too long for memory."""
        return self._stream.scratch.rows > MANY_ROWS

    def error(self, message: str, row: int | None = None) -> InvalidInput:
        """Return an InvalidInput about the topic, or about one of its messages (0-based)."""
        return InvalidInput(f"{self.label}{'' if row is None else f', message {row + 1}'}: {message}")

    def read(self, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return columns (N,) by name."""
        return joined(self.batches(names), names)

    def batches(self, names: Sequence[str]) -> Iterator[dict[str, FloatArray]]:
        """Yield the same columns piece by piece, in order."""
        for piece in self._stream.scratch.pieces():
            yield {
                name: (piece[self._stamp] - self._origin) / 1e9
                if name == "t"
                else np.ascontiguousarray(piece["values"][:, self._stream.columns.index(name)])
                for name in names
            }


def is_bag(path: Path) -> bool:
    """Whether a path is a ROS bag, by what is in it or, where that says nothing, by its name."""
    if path.is_dir():
        return (path / "metadata.yaml").is_file()
    try:
        with path.open("rb") as stream:
            start = stream.read(16)
    except OSError:
        return False  # said with its reason where the file is read
    return start.startswith(_MAGIC) or path.suffix.lower() in _SUFFIXES


def open_bag(
    path: Path,
    arm: Arm,
    column_map: ColumnMap,
    topics: tuple[str | None, str | None],
    opened: ExitStack,
) -> list[TopicTable]:
    """Read the joint states and the IMU of a bag.

    Parameters
    ----------
    path : Path
        ROS 1 (``.bag``) or ROS 2 (the folder with ``metadata.yaml``, or its ``.db3`` or ``.mcap`` file).
    arm : Arm
        Its joints' names say which of several joint states are meant.
    column_map : ColumnMap
        Its names for ``q`` are joint names here.
    topics : (str or None, str or None)
        The topics of joint states and of the IMU, where there are several of a kind.
    opened : ExitStack
        Closes what the tables keep aside, once they are not needed any more.

    Returns
    -------
    list of TopicTable
        Joints, sensor, or both.

    Raises
    ------
    InvalidInput
        When the bag cannot be read or holds neither, or several of a kind and none was chosen; names the topics.
    """
    with _reading(path), _reader(path) as reader:
        kinds = {connection.topic: connection.msgtype for connection in reader.connections}
        chosen = {kind: _choose(path, kinds, kind, topic) for kind, topic in zip(_KINDS, topics, strict=True)}
        names = [name for group in chosen.values() for name in group]
        if not names:
            raise InvalidInput(
                f"{path}: has no topic of type sensor_msgs/JointState or sensor_msgs/Imu; {_listed(kinds)}"
            )
        streams = _read_streams(reader, names, opened)
    found: list[tuple[str, _Stream]] = []
    if chosen[JOINT_STATE]:
        found.append(_joint_stream(path, streams, chosen[JOINT_STATE], arm, column_map))
    found += [(topic, stream) for topic in chosen[IMU] for stream in streams[topic] or [_Stream.of(IMU_COLUMNS)]]
    unset = any(not stream.stamped for _, stream in found if stream.scratch.rows > 1)
    origin = min((stream.first[unset] for _, stream in found if stream.scratch.rows), default=0)
    return [
        TopicTable(
            path,
            f"topic {topic}",
            _listed(kinds),
            (_unstamped(path, topic),) if unset else (),
            stream,
            "logged" if unset else "stamp",
            origin,
        )
        for topic, stream in found
    ]


@contextmanager
def _reading(path: Path) -> Iterator[None]:
    """Turn what goes wrong inside a bag into InvalidInput."""
    try:
        yield
    except InvalidInput:
        raise
    except Exception as error:  # a damaged bag fails in whatever part reads it
        said = (str(error).splitlines() or [type(error).__name__])[0]
        raise InvalidInput(
            f"{path}: cannot be read as a bag ({said}); a recording that was cut off is repaired by `rosbag reindex` "
            f"(ROS 1), `ros2 bag reindex` or `mcap recover` (ROS 2)"
        ) from error


@contextmanager
def _reader(path: Path) -> Iterator[Any]:
    from rosbags.highlevel import AnyReader  # noqa: PLC0415  (only who reads a bag waits for it)
    from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415

    with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
        yield reader


def _choose(path: Path, topics: dict[str, str], kind: str, wanted: str | None) -> list[str]:
    """Return the topics of a kind to read: one, several joint states to choose from by joint names, or none."""
    option, name = _KINDS[kind]
    candidates = sorted(topic for topic, msgtype in topics.items() if msgtype == kind)
    if wanted is not None:
        if wanted not in candidates:
            known = f"; topics of that type: {', '.join(candidates)}" if candidates else ""
            raise InvalidInput(
                f"{path}: --{option}-topic {wanted} is not a topic of type {name}{known}; {_listed(topics)}"
            )
        return [wanted]
    if kind == IMU and len(candidates) > 1:
        raise InvalidInput(
            f"{path}: has {len(candidates)} topics of type {name}: {', '.join(candidates)}; choose the one on the "
            f"end-point by --{option}-topic, or `{option}_topic:` in a column map"
        )
    return candidates


def _listed(topics: dict[str, str]) -> str:
    if not topics:
        return "the bag has no topics"
    return "the bag's topics are " + ", ".join(
        f"{topic} ({msgtype.replace('/msg/', '/')})" for topic, msgtype in sorted(topics.items())
    )


def _read_streams(reader: Any, topics: list[str], opened: ExitStack) -> dict[str, list[_Stream]]:
    """Read the messages of some topics, apart by their columns: several publishers may share a topic."""
    connections = [connection for connection in reader.connections if connection.topic in topics]
    readings = {connection.topic: _Reading.of(reader, connection.msgtype, opened) for connection in connections}
    for connection, logged, message in reader.messages(connections=connections) if connections else ():
        reading = readings[connection.topic]
        reading.messages.append(message)
        reading.logged.append(logged)
        if len(reading.messages) == _BATCH:
            reading.flush()
    for reading in readings.values():
        reading.flush()
    return {topic: list(readings[topic].streams.values()) for topic in topics}


@dataclass
class _Reading:
    """The messages of one topic that were read and not yet decoded, and what was decoded."""

    decoder: MessageDecoder
    opened: ExitStack
    messages: list[bytes] = field(default_factory=list)
    logged: list[int] = field(default_factory=list)
    streams: dict[tuple[str, ...], _Stream] = field(default_factory=dict)

    @classmethod
    def of(cls, reader: Any, msgtype: str, opened: ExitStack) -> _Reading:
        """Return the reading of a topic of this type."""
        return cls(MessageDecoder(msgtype, lambda raw: reader.deserialize(raw, msgtype), ros1=not reader.is2), opened)

    def flush(self) -> None:
        """Decode what was read."""
        logged = np.array(self.logged, dtype=np.int64)
        for rows in self.decoder.decode(self.messages):
            if rows.columns not in self.streams:
                self.streams[rows.columns] = _Stream.of(rows.columns)
                self.opened.callback(self.streams[rows.columns].scratch.close)
            self.streams[rows.columns].add(rows, logged[rows.order])
        self.messages.clear()
        self.logged.clear()


def _joint_stream(
    path: Path, streams: dict[str, list[_Stream]], topics: list[str], arm: Arm, column_map: ColumnMap
) -> tuple[str, _Stream]:
    """Return the stream of joint states that holds the arm's joints."""
    candidates = [(topic, stream) for topic in topics for stream in streams[topic]]
    if not candidates:
        return topics[0], _Stream.of(tuple(arm.joint_names))
    stated = {name for quantity, name in column_map.names.items() if quantity.startswith("q")}
    wanted = {plain(name) for name in stated or arm.joint_names}
    holding = [(topic, stream) for topic, stream in candidates if wanted <= {plain(name) for name in stream.columns}]
    if len(holding) == 1:
        return holding[0]
    if not holding and len(candidates) == 1:
        return candidates[0]
    told = "; ".join(f"{topic} of {', '.join(stream.columns)}" for topic, stream in holding or candidates)
    if holding:
        raise InvalidInput(
            f"{path}: several joint states hold the arm's joints: {told}; choose a topic by --joint-topic, or "
            f"`joint_topic:` in a column map"
        )
    raise InvalidInput(
        f"{path}: no joint state holds all joints of the arm {arm.name!r} ({', '.join(arm.joint_names)}): {told}; "
        f"name the joints in the arm's description as the bag does, or give `q: [...]`, base to tip, in a column map"
    )


def _unstamped(path: Path, topic: str) -> Finding:
    return Finding(
        "stamps",
        f"{path}, topic {topic}: stamps in the messages' headers are not set: the times of logging were taken, which "
        f"come later and less evenly",
    )
