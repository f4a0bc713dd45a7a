"""Names of columns that are recognised without being told, and units written into them.

A name is compared without case and punctuation: ``/imu/linear_acceleration.x`` reads ``imu_linear_acceleration_x``. A
family of names may stand behind a common prefix (``imu_``), and a unit may follow (``ax [g]``, ``q1_deg``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

AXES = ("x", "y", "z")

TIME_NAMES = (
    *("t", "time", "timestamp", "field_header_stamp", "header_stamp", "stamp", "time_stamp", "elapsed", "elapsed_time"),
    *("t_joint", "joint_time", "log_time", "t_pc", "pc_time", "t_host", "host_time", "rosbagtimestamp"),
)
SENSOR_TIME_NAMES = ("t_sensor", "sensor_t", "sensor_time", "t_imu", "imu_t", "imu_time", "hwt")
POSE_NAMES = ("pose", "pose_id", "pose_index", "pose_number", "still_pose", "static_pose")
TEMPERATURE_NAMES = ("temp", "temperature", "sensor_temperature", "imu_temperature")

JOINT_TEMPLATES = (
    *(("q{}", 1), ("q_{}", 1), ("actual_q_{}", 0), ("actual_q{}", 0), ("q{}", 0), ("q_{}", 0)),
    *(
        (template, first)
        for template in (
            *("joint_{}", "joint{}", "joint_{}_position", "joint{}_position", "joint_{}_pos", "joint{}_pos"),
            *("joint_position_{}", "joint_positions_{}", "joint_pos_{}", "position_{}", "position{}"),
            *("pos_{}", "pos{}", "theta_{}", "theta{}", "j_{}", "j{}"),
        )
        for first in (1, 0)
    ),
)
"""Numbered joint columns and their first number."""

_JOINT_NAME_TEMPLATES = (
    *("{}", "position_{}", "{}_position", "pos_{}", "{}_pos", "q_{}", "{}_q", "actual_{}", "{}_actual"),
    *("actual_position_{}", "{}_actual_position", "joint_position_{}"),
)

ACCELERATION_FAMILIES = (
    ("ax", "ay", "az"),
    *(
        tuple(f"{stem}{axis}" for axis in AXES)
        for stem in ("accel_", "acc_", "acceleration_", "linear_acceleration_", "a_", "accelerometer_")
    ),
    *(tuple(f"{stem}{axis}" for axis in AXES) for stem in ("specific_force_", "accel", "acc", "linacc_", "lin_acc_")),
    *(
        tuple(f"{stem}{index}" for index in range(3))
        for stem in ("actual_tool_accelerometer_", "tool_accelerometer_", "linear_acceleration_")
    ),
)
GYROSCOPE_FAMILIES = (
    ("gx", "gy", "gz"),
    ("wx", "wy", "wz"),
    *(
        tuple(f"{stem}{axis}" for axis in AXES)
        for stem in ("gyro_", "angular_velocity_", "gyroscope_", "gyro", "w_", "g_", "omega_", "ang_vel_")
    ),
)

_COMMANDED = re.compile(r"target|command|cmd|desired|reference|setpoint|goal")
_UNIT_MARK = re.compile(r"\s*[\[({]\s*([^\])}]*[^\d\s\])}][^\])}]*)\s*[\])}]\s*$")
_UNIT_SUFFIX = re.compile(r"[_ ](?P<unit>[A-Za-z0-9/^]+)$")
_UNIT_SPELLINGS = {
    "t": {
        **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), "s"),
        **dict.fromkeys(("ms", "msec", "millis", "milliseconds"), "ms"),
        **dict.fromkeys(("us", "usec", "micros", "microseconds"), "us"),
        **dict.fromkeys(("ns", "nsec", "nanos", "nanoseconds", "nsecs"), "ns"),
    },
    "q": {
        **dict.fromkeys(("rad", "radian", "radians", "rads"), "rad"),
        **dict.fromkeys(("deg", "degree", "degrees"), "deg"),
        **{unit: unit for unit in ("mrad", "rev", "m", "mm", "cm", "um", "in")},
    },
    "a": {
        **dict.fromkeys(("m/s^2", "m/s2", "m/s²", "m/s/s", "ms2", "ms-2", "mps2", "m_s2", "m/s**2", "mss"), "m/s^2"),
        **dict.fromkeys(("g", "gs", "gees"), "g"),
        **dict.fromkeys(("mg", "millig"), "mg"),
        **{unit: unit for unit in ("mm/s^2", "cm/s^2")},
    },
    "g": {
        **dict.fromkeys(("rad/s", "rads", "rad_s", "rps", "radps"), "rad/s"),
        **dict.fromkeys(("deg/s", "dps", "deg_s", "degps", "°/s"), "deg/s"),
        **{unit: unit for unit in ("mrad/s", "rpm")},
    },
    "temp": {
        **dict.fromkeys(("c", "degc", "°c", "celsius"), "C"),
        **dict.fromkeys(("k", "kelvin"), "K"),
        **dict.fromkeys(("f", "degf", "°f"), "F"),
    },
}


@dataclass(frozen=True)
class Match:
    """Columns found for a family of names: as they are in the file, None where one is missing."""

    columns: tuple[str | None, ...]
    units: tuple[str | None, ...]

    @property
    def found(self) -> int:
        """Number of members found."""
        return sum(column is not None for column in self.columns)


class ColumnNames:
    """The names of a file's columns, ready to be searched.

    Parameters
    ----------
    columns : sequence of str
        As they are in the file; of equal names the first is taken.
    """

    def __init__(self, columns: Sequence[str]) -> None:
        self.columns = tuple(columns)
        self._exact = {name.lower(): name for name in reversed(columns)}
        self._plain = {plain(name): name for name in reversed(columns)}
        self._marked: dict[str, dict[str, tuple[str, str]]] = {}

    def find(self, name: str, quantity: str) -> tuple[str, str | None] | None:
        """Return the column of this name and the unit written into it, if any.

        Parameters
        ----------
        name : str
            As `plain` gives it.
        quantity : str
            ``t``, ``q``, ``a``, ``g`` or ``temp``: whose units may follow the name.
        """
        column = self._exact.get(name) or self._plain.get(name)
        if column is not None:
            return column, None
        return self._with_units(quantity).get(name)

    def family(self, members: Sequence[str], quantity: str) -> Match:
        """Return the columns of a family of names, none of them behind a prefix."""
        found = [self.find(name, quantity) for name in members]
        return Match(tuple(each and each[0] for each in found), tuple(each and each[1] for each in found))

    def best(self, families: Sequence[Sequence[str]], quantity: str) -> Match:
        """Return the family with most members here, the first of equals."""
        matches = [self.family(family, quantity) for family in families]
        return max(matches, key=lambda match: match.found)

    def behind_prefix(self, families: Sequence[Sequence[str]], quantity: str) -> dict[str, Match]:
        """Return the complete families that stand behind a common prefix, by prefix; the best family of each."""
        found: dict[str, Match] = {}
        plains = {**self._plain, **dict.fromkeys(self._with_units(quantity), "")}
        for family in families:
            ending = "_" + family[0]
            for name in plains:
                prefix = name[: -len(ending)]
                if not name.endswith(ending) or not prefix or prefix in found or _COMMANDED.search(prefix):
                    continue
                match = self.family([f"{prefix}_{member}" for member in family], quantity)
                if match.found == len(family) and match not in found.values():
                    found[prefix] = match
        return found

    def _with_units(self, quantity: str) -> dict[str, tuple[str, str]]:
        if quantity in self._marked:
            return self._marked[quantity]
        spelled = _UNIT_SPELLINGS[quantity]
        found: dict[str, tuple[str, str]] = {}
        for column in reversed(self.columns):
            for stem, unit in _split_unit(column):
                if unit.lower() in spelled:
                    found[plain(stem)] = (column, spelled[unit.lower()])
        self._marked[quantity] = found
        return found


def plain(name: str) -> str:
    """Return a column's name in small letters, with one underscore for each run of punctuation."""
    return re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")


def joint_families(names: Sequence[str], columns: ColumnNames) -> dict[tuple[str, int] | str, list[str]]:
    """Return the families of joint columns that a file may use, by template and first number, or by template of names.

    Parameters
    ----------
    names : sequence of str
        The arm's joints.
    columns : ColumnNames
        What is there: a family from 1 does not hold where there is a 0.
    """
    families: dict[tuple[str, int] | str, list[str]] = {}
    for template, first in JOINT_TEMPLATES:
        if first == 0 or columns.find(template.format(0), "q") is None:
            families[template, first] = [template.format(index + first) for index in range(len(names))]
    for template in _JOINT_NAME_TEMPLATES:
        families[template] = [template.format(plain(name)) for name in names]
    return families


def joints_behind_prefix(families: Mapping[tuple[str, int] | str, list[str]], columns: ColumnNames) -> Match | None:
    """Return the one set of joint columns behind a prefix; None where there is none, or several, or more of them."""
    found: dict[tuple[str | None, ...], Match] = {}
    for key, family in families.items():
        for prefix, match in columns.behind_prefix([family], "q").items():
            if isinstance(key, tuple):  # numbered: as many as the arm has, not a part of more
                template, first = key
                outside = [first + len(family), *([0] if first else [])]
                if any(columns.find(f"{prefix}_{template.format(number)}", "q") for number in outside):
                    continue
            found[match.columns] = match
    return next(iter(found.values())) if len(found) == 1 else None


def _split_unit(column: str) -> Iterator[tuple[str, str]]:
    marked = _UNIT_MARK.search(column)
    if marked:
        yield column[: marked.start()], marked.group(1).strip().replace(" ", "")
        return
    ending = _UNIT_SUFFIX.search(column)
    if ending:
        yield column[: ending.start()], ending.group("unit")
