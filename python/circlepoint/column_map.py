"""Which column of a log is what, in which unit.

Names recognised without being told (the first complete family found is taken, letters in any case):

========================  =======================================================================================
time                      ``t``, ``time``, ``timestamp``, ``time_s``, ``t_s``
joint positions           ``q1..qn``, ``q_1..q_n``, ``actual_q_0..``, ``q0..``, ``q_0..``, the arm's joint names
specific force            ``ax, ay, az``; ``accel_x..``; ``acc_x..``; ``actual_tool_accelerometer_0..2``;
                          ``linear_acceleration_x..`` (also with a dot)
angular velocity          ``gx, gy, gz``; ``wx..``; ``gyro_x..``; ``angular_velocity_x..`` (optional)
temperature               ``temp``, ``temperature`` (optional)
========================  =======================================================================================

Other names and units are given by a column map (``--columns map.yaml``)::

    t: stamp                                   # one name a quantity ...
    q: [pan, lift, elbow, w1, w2, w3]          # ... or a list; the same as q1: pan, q2: lift, ...
    a: [imu_0, imu_1, imu_2]                   # the same as ax, ay, az
    g: [rate_0, rate_1, rate_2]                # gyroscope: the same as gx, gy, gz
    temp: board_temperature
    units: {t: ms, q: deg, q3: mm, a: g, g: deg/s, temp: C}

What the map does not name is still recognised. A unit given for `q` holds for the revolute joints when it is an angle
and for the prismatic ones when it is a length; `q3` holds for joint 3 alone. Stating a unit that is the default
(``q: rad``) also says that the values are meant, however large they look.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from circlepoint._core import STANDARD_GRAVITY
from circlepoint.arm import Arm
from circlepoint.tables import TableFile
from circlepoint.yaml_io import YamlFile, describe, load_yaml

TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
ANGLE_UNITS = {"rad": 1.0, "deg": math.pi / 180, "mrad": 1e-3, "rev": 2 * math.pi}
LENGTH_UNITS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "in": 0.0254}
ACCELERATION_UNITS = {
    "m/s^2": 1.0,
    "m/s2": 1.0,
    "g": STANDARD_GRAVITY,
    "mg": STANDARD_GRAVITY / 1000,
    "mm/s^2": 1e-3,
    "cm/s^2": 1e-2,
}
RATE_UNITS = {"rad/s": 1.0, "deg/s": math.pi / 180, "mrad/s": 1e-3, "rpm": 2 * math.pi / 60}
TEMPERATURE_UNITS = {"C": (1.0, 0.0), "K": (1.0, -273.15), "F": (5 / 9, -160 / 9)}

_AXES = ("x", "y", "z")
_TIME_NAMES = ("t", "time", "timestamp", "time_s", "t_s")
_TEMPERATURE_NAMES = ("temp", "temperature")
_JOINT_STEMS = (("q", 1), ("q_", 1), ("actual_q_", 0), ("q", 0), ("q_", 0))
_ACCELERATION_FAMILIES = (
    ("ax", "ay", "az"),
    *(tuple(f"{stem}{axis}" for axis in _AXES) for stem in ("accel_", "acc_", "acceleration_")),
    tuple(f"actual_tool_accelerometer_{index}" for index in range(3)),
    *(tuple(f"linear_acceleration{mark}{axis}" for axis in _AXES) for mark in "_."),
)
_GYROSCOPE_FAMILIES = (
    ("gx", "gy", "gz"),
    ("wx", "wy", "wz"),
    *(tuple(f"{stem}{axis}" for axis in _AXES) for stem in ("gyro_", "angular_velocity_", "angular_velocity.")),
)


@dataclass(frozen=True)
class ColumnMap:
    """Names and units the user stated; what is absent is recognised or SI.

    Attributes
    ----------
    names : dict of str to str
        Column by quantity: ``t``, ``q1`` .., ``ax`` .., ``gx`` .., ``temp``.
    units : dict of str to str
        Unit by quantity, as stated: ``t``, ``q``, ``q3``, ``a``, ``g``, ``temp``.
    source : YamlFile or None
        Where it came from, for messages.
    """

    names: dict[str, str] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    source: YamlFile | None = None

    def joint_factor(self, arm: Arm, joint: int) -> float:
        """Return what a value of this joint's column is multiplied by to give rad or m."""
        revolute = arm.joints[joint].revolute
        own, other = (ANGLE_UNITS, LENGTH_UNITS) if revolute else (LENGTH_UNITS, ANGLE_UNITS)
        name = f"q{joint + 1}"
        unit = self.units.get(name, self.units.get("q"))
        if unit is None or (unit in other and name not in self.units):
            return 1.0
        if unit not in own and self.source is not None:
            kind = "revolute" if revolute else "prismatic"
            raise self.source.error(
                ("units", name), f"is {unit!r}, but joint {joint + 1} is {kind}: one of {', '.join(own)}"
            )
        return own[unit]

    def joint_unit_stated(self, joint: int) -> bool:
        """Whether the user said what unit this joint is in."""
        return "q" in self.units or f"q{joint + 1}" in self.units


@dataclass(frozen=True)
class FileColumns:
    """The columns of one file by meaning; None where the file has no such quantity."""

    time: str
    joints: tuple[str, ...] | None
    specific_force: tuple[str, ...] | None
    angular_velocity: tuple[str, ...] | None
    temperature: str | None


def load_column_map(path: str | Path, arm: Arm) -> ColumnMap:
    """Read a column map for an arm.

    Parameters
    ----------
    path : str or Path
        YAML file in the format at the top of this module.
    arm : Arm
        The arm whose joints ``q1 .. qn`` are.

    Returns
    -------
    ColumnMap
        Names and units.

    Raises
    ------
    InvalidInput
        For an unknown key or unit, a list of the wrong length, a name given twice.
    """
    document = load_yaml(path)
    joints = [f"q{index + 1}" for index in range(len(arm.joints))]
    groups = {"q": joints, "a": [f"a{axis}" for axis in _AXES], "g": [f"g{axis}" for axis in _AXES]}
    single = ["t", "temp", *(name for group in groups.values() for name in group)]
    document.only_keys((), document.data, [*single, *groups, "units"])
    names: dict[str, str] = {}
    for key, value in document.data.items():
        if key == "units":
            continue
        if key in groups:
            if not isinstance(value, list) or len(value) != len(groups[key]):
                count = f"{len(groups[key])} column names"
                raise document.error(
                    (key,), f"is {describe(value)}, must be a list of {count} ({', '.join(groups[key])})"
                )
            members = dict(zip(groups[key], value, strict=True))
        else:
            members = {key: value}
        for name, column in members.items():
            if name in names:
                raise document.error((key,), f"`{name}` is named twice, as {names[name]!r} and {column!r}; keep one")
            if column in names.values():
                raise document.error((key,), f"column {column!r} is used for two quantities")
            names[name] = document.text((key,), column)
    return ColumnMap(names, _units(document, joints), document)


def find_columns(table: TableFile, arm: Arm, column_map: ColumnMap) -> FileColumns:
    """Find out what each column of a file is.

    Parameters
    ----------
    table : TableFile
        The file's header.
    arm : Arm
        Its joints say how many position columns there must be.
    column_map : ColumnMap
        What the user stated.

    Returns
    -------
    FileColumns
        Column names as they are in the file.

    Raises
    ------
    InvalidInput
        When time is missing, neither joints nor specific force are there, joints are incomplete or more than the arm
        has, or a name that is used appears twice.
    """
    lookup = {name.lower(): name for name in reversed(table.columns)}
    stated = {quantity: name for quantity, name in column_map.names.items() if name in table.columns}

    def one(quantity: str, known: Sequence[str]) -> str | None:
        return stated.get(quantity) or next((lookup[name] for name in known if name in lookup), None)

    def three(letter: str, families: Sequence[Sequence[str]]) -> list[str | None]:
        return _family([f"{letter}{axis}" for axis in _AXES], stated, families, lookup)

    time = one("t", _TIME_NAMES)
    force = three("a", _ACCELERATION_FAMILIES)
    if any(force) and not all(force):
        axis = _AXES[force.index(None)]
        raise table.error(
            f"the column of specific force a{axis} is missing, though {_present(force)} is there; {_found(table)}"
        )
    rate = three("g", _GYROSCOPE_FAMILIES)
    columns = FileColumns(
        time=time or "",
        joints=_joint_columns(table, arm, stated, lookup),
        specific_force=_complete(force),
        angular_velocity=_complete(rate),
        temperature=one("temp", _TEMPERATURE_NAMES),
    )
    if time is None:
        raise table.error(f"the time column is missing (t, time or timestamp); {_found(table)}")
    if columns.joints is None and columns.specific_force is None:
        raise table.error(
            f"neither joint positions (q1 .. q{len(arm.joints)}) nor specific force (ax, ay, az) are among the "
            f"columns; {_found(table)}"
        )
    used = [columns.time, *(columns.joints or ()), *(columns.specific_force or ()), *(columns.angular_velocity or ())]
    for name in [*used, *([columns.temperature] if columns.temperature else [])]:
        if table.columns.count(name) > 1:
            raise table.error(
                f"column `{name}` is there {table.columns.count(name)} times; rename or remove all but one"
            )
    return columns


def missing_specific_force(table: TableFile) -> str:
    """Return what to say of a log without any accelerometer in it."""
    return f"the specific force columns (ax, ay, az) are missing; {_found(table)}"


def missing_joints(table: TableFile, arm: Arm) -> str:
    """Return what to say of a log without any joint positions in it."""
    return f"the joint position columns (q1 .. q{len(arm.joints)}) are missing; {_found(table)}"


def _units(document: YamlFile, joints: list[str]) -> dict[str, str]:
    if document.data.get("units") is None:
        return {}
    known: dict[str, Any] = {"t": TIME_UNITS, "a": ACCELERATION_UNITS, "g": RATE_UNITS, "temp": TEMPERATURE_UNITS}
    known |= dict.fromkeys(["q", *joints], ANGLE_UNITS | LENGTH_UNITS)
    units: dict[str, str] = {}
    for key, value in document.only_keys(("units",), document.data["units"], known).items():
        if not isinstance(value, str) or value not in known[key]:
            raise document.error(("units", key), f"is {describe(value)}, must be one of {', '.join(known[key])}")
        units[key] = value
    return units


def _family(
    quantities: Sequence[str], stated: dict[str, str], families: Sequence[Sequence[str]], lookup: dict[str, str]
) -> list[str | None]:
    """Columns of a group of quantities: as stated, else of the family of known names with most members here."""
    best = max(families, key=lambda family: sum(name in lookup for name in family))
    return [stated.get(quantity) or lookup.get(name) for quantity, name in zip(quantities, best, strict=True)]


def _joint_columns(
    table: TableFile, arm: Arm, stated: dict[str, str], lookup: dict[str, str]
) -> tuple[str, ...] | None:
    count = len(arm.joints)
    quantities = [f"q{index + 1}" for index in range(count)]
    numbered = {
        (stem, first): [f"{stem}{index + first}" for index in range(count)]
        for stem, first in _JOINT_STEMS
        if first == 0 or f"{stem}0" not in lookup
    }
    families = [*numbered.values(), [joint.name.lower() for joint in arm.joints]]
    columns = _family(quantities, stated, families, lookup)
    if not any(columns):
        return None
    remedy = "use the arm that was recorded, or name the columns with --columns map.yaml"
    for (stem, first), family in numbered.items():
        if stated or columns != [lookup.get(name) for name in family]:
            continue
        there = sum(f"{stem}{index + first}" in lookup for index in range(count + 100))
        if there != count:
            raise table.error(
                f"has {there} joint columns ({stem}{first} .. {stem}{there - 1 + first}), but the arm {arm.name!r} "
                f"has {count} joints; "
                f"{remedy}"
            )
    if not all(columns):
        joint = columns.index(None)
        raise table.error(
            f"the column of joint {joint + 1} ({arm.joints[joint].name}) is missing, though {_present(columns)} is "
            f"there; {_found(table)}"
        )
    return _complete(columns)


def _complete(columns: Sequence[str | None]) -> tuple[str, ...] | None:
    names = tuple(column for column in columns if column is not None)
    return names if len(names) == len(columns) else None


def _present(columns: Sequence[str | None]) -> str:
    return "`" + next(column for column in columns if column is not None) + "`"


def _found(table: TableFile) -> str:
    shown = ", ".join(table.columns[:40]) + (", ..." if len(table.columns) > 40 else "")
    return f"the columns found are {shown}; other names are given with --columns map.yaml"
