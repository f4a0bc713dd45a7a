"""Messages decoded by the thousand are what the library's own deserialiser reads, whatever they are mixed with."""

import dataclasses

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from circlepoint.bag_messages import IMU, IMU_COLUMNS, JOINT_STATE, MessageDecoder

ARM = ("shoulder", "elbow", "wrist")
GRIPPER = ("finger",)


class Kind:
    """One serialisation of messages, and a count of how often the library was asked."""

    def __init__(self, name):
        self.ros1 = name == "ROS 1"
        self.little = not name.endswith("big-endian")
        self.store = get_typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.ROS2_HUMBLE)
        self.asked = 0

    def decoder(self, msgtype):
        return MessageDecoder(msgtype, lambda raw: self.read(raw, msgtype), ros1=self.ros1)

    def read(self, raw, msgtype):
        self.asked += 1
        return (self.store.deserialize_ros1 if self.ros1 else self.store.deserialize_cdr)(raw, msgtype)

    def write(self, message, msgtype):
        if self.ros1:
            return bytes(self.store.serialize_ros1(message, msgtype))
        return bytes(self.store.serialize_cdr(message, msgtype, little_endian=self.little))

    def header(self, index, frame):
        stamp = self.store.types["builtin_interfaces/msg/Time"](
            1_700_000_000 + index // 100, 10_000_000 * (index % 100)
        )
        return self.store.types["std_msgs/msg/Header"](
            **({"seq": index} if self.ros1 else {}), stamp=stamp, frame_id=frame
        )

    def joints(self, index, names, positions, *, frame="", effort=0):
        message = self.store.types[JOINT_STATE](
            self.header(index, frame), list(names), np.array(positions, float), np.zeros(len(names)), np.zeros(effort)
        )
        return self.write(message, JOINT_STATE)

    def imu(self, index, force, turn):
        vector = self.store.types["geometry_msgs/msg/Vector3"]
        message = self.store.types[IMU](
            self.header(index, "tool"),
            self.store.types["geometry_msgs/msg/Quaternion"](0.1, 0.2, 0.3, 0.4),
            np.arange(9.0),
            vector(*(turn if turn is not None else (0.0, 0.0, 0.0))),
            np.full(9, 0.5 if turn is not None else -1.0),
            vector(*force),
            np.arange(9.0),
        )
        return self.write(message, IMU)


@pytest.fixture(params=["ROS 1", "ROS 2", "ROS 2 big-endian"])
def kind(request):
    return Kind(request.param)


def by_library(kind, messages):
    found = {}
    for index, raw in enumerate(messages):
        fields = kind.read(raw, JOINT_STATE)
        names = tuple(fields.name) or tuple(f"position_{i}" for i in range(len(fields.position)))
        if names and len(names) == len(fields.position):
            stamp = fields.header.stamp.sec * 10**9 + fields.header.stamp.nanosec
            found.setdefault(names, []).append((index, stamp, *fields.position))
    return found


def test_mixed_joint_states_are_what_the_library_reads_in_their_order(kind):
    random = np.random.default_rng(4)
    messages = []
    for index in range(400):
        names = (ARM, GRIPPER, ARM[::-1], (), ("shoulder", "elbow", "fist!"))[random.integers(5)]
        values = random.normal(size=len(names) if random.random() > 0.1 else 2)
        frame = ("", "base", "world")[random.integers(3)]
        messages.append(kind.joints(index, names, values, frame=frame, effort=int(random.integers(2)) * len(names)))
    rows = kind.decoder(JOINT_STATE).decode(messages)
    expected = by_library(kind, messages)
    assert {each.columns for each in rows} == set(expected)
    for each in rows:
        table = np.array([entry[2:] for entry in expected[each.columns]])
        np.testing.assert_array_equal(each.order, [entry[0] for entry in expected[each.columns]])
        np.testing.assert_array_equal(each.stamps, [entry[1] for entry in expected[each.columns]])
        np.testing.assert_array_equal(each.values, table)


@pytest.mark.parametrize("name", ["ROS 1", "ROS 2"])
def test_the_library_is_asked_once_a_layout(name):
    kind = Kind(name)
    decoder = kind.decoder(JOINT_STATE)
    for begin in (0, 1000):
        (rows,) = decoder.decode([kind.joints(begin + i, ARM, (i, 2 * i, 3 * i)) for i in range(1000)])
        np.testing.assert_array_equal(rows.values, np.outer(np.arange(1000), (1, 2, 3)))
    assert kind.asked == 1
    decoder.decode([kind.joints(i, ARM if i % 2 else GRIPPER, np.zeros(3 if i % 2 else 1)) for i in range(1000)])
    assert kind.asked == 2


def test_an_imu_without_gyroscope_has_none_and_each_message_says_so_itself(kind):
    force = np.random.default_rng(5).normal(size=(50, 3))
    messages = [kind.imu(i, force[i], None if i % 3 else 2 * force[i]) for i in range(50)]
    (rows,) = kind.decoder(IMU).decode(messages)
    assert rows.columns == IMU_COLUMNS
    measured = (np.arange(50) % 3 == 0)[:, None]
    np.testing.assert_array_equal(rows.values, np.hstack([force, np.where(measured, 2 * force, np.nan)]))


def test_what_the_library_reads_otherwise_is_left_to_the_library():
    kind = Kind("ROS 2")
    original = kind.read

    def other(raw, msgtype):  # a bag's own definition of the message, in which fields stand elsewhere
        fields = original(raw, msgtype)
        return dataclasses.replace(fields, position=fields.position[::-1])

    kind.read = other
    (rows,) = kind.decoder(JOINT_STATE).decode([kind.joints(i, ARM, (i, 5, -i - 1)) for i in range(20)])
    np.testing.assert_array_equal(rows.values[:, 0], -np.arange(20) - 1)


@pytest.mark.parametrize("length", [3, 11, 40, 60])
def test_a_message_that_is_cut_off_is_refused_by_the_library(kind, length):
    whole = kind.joints(1, ARM, (1, 2, 3))
    with pytest.raises(Exception, match=r"."):
        kind.decoder(JOINT_STATE).decode([whole, whole[:length], whole])
