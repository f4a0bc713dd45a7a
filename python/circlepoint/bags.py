"""ROS 1 and ROS 2 bags as tables: joint states and the IMU, without ROS.

A bag gives one table a topic: the positions of a ``sensor_msgs/JointState`` by joint name, whatever their order in the
message, and linear acceleration and angular velocity of a ``sensor_msgs/Imu``. Time is the stamp in the messages'
headers, in seconds from the bag's first; where these are not set, the time of logging, and a finding says so.
"""

from __future__ import annotations

from array import array
from collections import defaultdict
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint._core import InvalidInput
from circlepoint.column_names import plain
from circlepoint.findings import Finding
from circlepoint.log_table import FloatArray, MemoryTable

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from circlepoint.arm import Arm
    from circlepoint.column_map import ColumnMap

_MAGIC = (b"#ROSBAG V", b"SQLite format 3\0", b"\x89MCAP0\r\n")
_SUFFIXES = (".bag", ".db3", ".mcap")
_JOINT_STATE = "sensor_msgs/msg/JointState"
_IMU = "sensor_msgs/msg/Imu"
_KINDS = {_JOINT_STATE: ("joint", "sensor_msgs/JointState"), _IMU: ("imu", "sensor_msgs/Imu")}
_IMU_COLUMNS = (
    *(f"linear_acceleration.{axis}" for axis in "xyz"),
    *(f"angular_velocity.{axis}" for axis in "xyz"),
)
_NOT_MEASURED = -1.0  # first element of an Imu's covariance: there is no such quantity


@dataclass
class _Stream:
    """Messages of one kind as they are read: stamps in ns, values a message."""

    columns: tuple[str, ...]
    stamps: array[int] = field(default_factory=lambda: array("q"))
    logged: array[int] = field(default_factory=lambda: array("q"))
    values: array[float] = field(default_factory=lambda: array("d"))

    @property
    def has_header_stamps(self) -> bool:
        """Whether the headers are stamped at all."""
        return not self.stamps or (min(self.stamps) != max(self.stamps))


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
    path: Path, arm: Arm, column_map: ColumnMap, joint_topic: str | None, imu_topic: str | None
) -> list[MemoryTable]:
    """Read the joint states and the IMU of a bag.

    Parameters
    ----------
    path : Path
        ROS 1 (``.bag``) or ROS 2 (the folder with ``metadata.yaml``, or its ``.db3`` or ``.mcap`` file).
    arm : Arm
        Its joints' names say which of several joint states are meant.
    column_map : ColumnMap
        Its names for ``q`` are joint names here.
    joint_topic, imu_topic : str or None
        The topics, where there are several of a kind.

    Returns
    -------
    list of MemoryTable
        Joints, sensor, or both.

    Raises
    ------
    InvalidInput
        When the bag cannot be read or holds neither, or several of a kind and none was chosen; names the topics.
    """
    with _reading(path), _reader(path) as reader:
        topics = {connection.topic: connection.msgtype for connection in reader.connections}
        chosen = {
            _JOINT_STATE: _choose(path, topics, _JOINT_STATE, joint_topic),
            _IMU: _choose(path, topics, _IMU, imu_topic),
        }
        names = [name for group in chosen.values() for name in group]
        if not names:
            raise InvalidInput(
                f"{path}: has no topic of type sensor_msgs/JointState or sensor_msgs/Imu; {_listed(topics)}"
            )
        streams = _read_streams(reader, names)
    found: list[tuple[str, _Stream]] = []
    if chosen[_JOINT_STATE]:
        found.append(_joint_stream(path, streams, chosen[_JOINT_STATE], arm, column_map))
    found += [(topic, stream) for topic in chosen[_IMU] for stream in streams[topic] or [_Stream(_IMU_COLUMNS)]]
    unset = [topic for topic, stream in found if not stream.has_header_stamps]
    for _, stream in found if unset else ():
        stream.stamps = stream.logged
    origin = min((stream.stamps[0] for _, stream in found if stream.stamps), default=0)
    hint = _listed(topics)
    return [_table(path, topic, stream, origin, hint, stamped=not unset) for topic, stream in found]


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
    if kind == _IMU and len(candidates) > 1:
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


def _read_streams(reader: Any, topics: list[str]) -> dict[str, list[_Stream]]:
    """Read the messages of some topics, apart by their columns: several publishers may share a topic."""
    streams: dict[str, dict[tuple[str, ...], _Stream]] = defaultdict(dict)
    connections = [connection for connection in reader.connections if connection.topic in topics]
    for connection, logged, raw in reader.messages(connections=connections):
        message = reader.deserialize(raw, connection.msgtype)
        if connection.msgtype == _JOINT_STATE:
            columns, values = _joint_values(message)
        else:
            columns, values = _IMU_COLUMNS, _imu_values(message)
        if not columns:
            continue
        stream = streams[connection.topic].setdefault(columns, _Stream(columns))
        stamp = message.header.stamp
        stream.stamps.append(stamp.sec * 1_000_000_000 + stamp.nanosec)
        stream.logged.append(logged)
        stream.values.extend(values)
    return {topic: list(streams[topic].values()) for topic in topics}


def _joint_values(message: Any) -> tuple[tuple[str, ...], list[float]]:
    values = message.position.tolist()
    names = tuple(message.name)
    if not names:
        names = tuple(f"position_{index}" for index in range(len(values)))
    return (names, values) if len(names) == len(values) else ((), [])


def _imu_values(message: Any) -> list[float]:
    force, turn = message.linear_acceleration, message.angular_velocity
    if message.angular_velocity_covariance[0] == _NOT_MEASURED:
        return [force.x, force.y, force.z, np.nan, np.nan, np.nan]
    return [force.x, force.y, force.z, turn.x, turn.y, turn.z]


def _joint_stream(
    path: Path, streams: dict[str, list[_Stream]], topics: list[str], arm: Arm, column_map: ColumnMap
) -> tuple[str, _Stream]:
    """Return the stream of joint states that holds the arm's joints."""
    candidates = [(topic, stream) for topic in topics for stream in streams[topic]]
    if not candidates:
        return topics[0], _Stream(tuple(arm.joint_names))
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


def _table(path: Path, topic: str, stream: _Stream, origin: int, hint: str, *, stamped: bool) -> MemoryTable:
    findings: list[Finding] = []
    if not stamped:
        findings.append(
            Finding(
                "stamps",
                f"{path}, topic {topic}: stamps in the messages' headers are not set: the times of logging were taken, "
                f"which come later and less evenly",
            )
        )
    stamps = np.array(stream.stamps, dtype=np.int64)
    values = np.array(stream.values).reshape(-1, len(stream.columns))
    columns: dict[str, FloatArray] = {"t": (stamps - origin) / 1e9}
    for index, name in enumerate(stream.columns):
        column = np.ascontiguousarray(values[:, index])
        if not (name.startswith("angular_velocity") and np.isnan(column).all()):
            columns[name] = column
    return MemoryTable(path, columns, "message", f"topic {topic}", hint, tuple(findings))
