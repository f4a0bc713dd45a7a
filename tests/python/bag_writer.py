"""Joint states and IMU messages written into bags of every kind, by the library's own writers."""

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

KINDS = {"ROS 1": "log.bag", "ROS 2 sqlite3": "log_sqlite3", "ROS 2 MCAP": "log_mcap"}
EPOCH = 1_700_000_000_123_456_789  # ns
LATE = 1_500_000  # ns, between a header's stamp and its logging


def write_bag(path, kind, topics, *, stamped=True):
    """Write a bag: `topics` are (topic, messages) with messages of (t, names, positions) or (t, force, turning).

    Unless `stamped`, the messages' headers carry no time.
    """
    ros1 = kind == "ROS 1"
    store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.ROS2_HUMBLE)
    if ros1:
        writer, serialize = Writer1(path), store.serialize_ros1
    else:
        plugin = StoragePlugin.MCAP if kind.endswith("MCAP") else StoragePlugin.SQLITE3
        writer, serialize = Writer2(path, version=9, storage_plugin=plugin), store.serialize_cdr
    with writer:
        entries = []
        for topic, messages in topics:
            messages = list(messages)  # noqa: PLW2901
            msgtype = "sensor_msgs/msg/JointState"
            if messages and isinstance(messages[0][1], np.ndarray):
                msgtype = "sensor_msgs/msg/Imu"
            if messages and isinstance(messages[0][1], str):
                msgtype = "std_msgs/msg/String"
            connection = writer.add_connection(topic, msgtype, typestore=store)
            logged = np.maximum.accumulate([message[0] for message in messages])  # the order they came in
            entries += [(at, connection, msgtype, *message) for at, message in zip(logged, messages, strict=True)]
        for logged, connection, msgtype, time, first, second in sorted(entries, key=lambda entry: entry[0]):
            stamp = EPOCH + round(time * 1e9)
            message = _message(store, msgtype, first, second, stamp if stamped else 0, ros1=ros1)
            writer.write(connection, EPOCH + round(logged * 1e9) + LATE, serialize(message, msgtype))
    return path


def _message(store, msgtype, first, second, stamp, *, ros1):
    types = store.types
    if msgtype == "std_msgs/msg/String":
        return types[msgtype](first)
    time = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
    header = types["std_msgs/msg/Header"](**({"seq": 0} if ros1 else {}), stamp=time, frame_id="flange")
    empty = np.empty(0)
    if msgtype == "sensor_msgs/msg/JointState":
        return types[msgtype](header, list(first), np.ascontiguousarray(second, dtype=float), empty, empty)
    vector = types["geometry_msgs/msg/Vector3"]
    unknown = np.full(9, -1.0)
    turning = unknown if second is None else np.zeros(9)
    return types[msgtype](
        header,
        types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0),
        unknown,
        vector(*(second if second is not None else (0.0, 0.0, 0.0))),
        turning,
        vector(*first),
        np.zeros(9),
    )


def write_recording_bag(path, kind, names, *, time, positions, force):
    """Write one physical recording: joint states under these names, and an IMU without gyroscope."""
    joints = ((t, names, q) for t, q in zip(time, positions, strict=True))
    sensor = ((t, f, None) for t, f in zip(time, force, strict=True))
    return write_bag(path, kind, [("/joint_states", joints), ("/imu/data", sensor)])
