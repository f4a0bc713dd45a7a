"""Which column of a log is what, in which unit.

Names recognised without being told (the most complete family found is taken; see `circlepoint.column_names`):

========================  =======================================================================================
time                      ``t``, ``time``, ``timestamp``, ``header.stamp`` ...
joint positions           ``q1..qn``, ``actual_q_0..``, ``joint_1..``, ``position_0..``, the arm's joint names, also
                          as ``position.NAME`` or ``NAME/position``
specific force            ``ax, ay, az``; ``accel_x..``; ``linear_acceleration.x..``; ``actual_tool_accelerometer_0..``
angular velocity          ``gx, gy, gz``; ``wx..``; ``gyro_x..``; ``angular_velocity_x..`` (optional)
temperature               ``temp``, ``temperature`` (optional)
the sensor's own time     ``t_sensor``, ``imu_time``, ``hwt`` (optional: joints and sensor then have two clocks)
number of a still pose    ``pose`` (instead of time: every row is then the mean of one rest)
an arm of modules         ``q1, a1x.., w1x.., hwt1, q2 ..``: a joint, a sensor and a clock each, as HEBI's record them
========================  =======================================================================================

Other names and units are given by a column map (``--columns map.yaml``)::

    t: stamp                                   # one name a quantity (pose: NAME for a table of still poses) ...
    q: [pan, lift, elbow, w1, w2, w3]          # ... or a list; the same as q1: pan, q2: lift, ...
    a: [imu_0, imu_1, imu_2]                   # the same as ax, ay, az
    g: [rate_0, rate_1, rate_2]                # gyroscope: the same as gx, gy, gz
    temp: board_temperature
    t_sensor: imu_stamp                        # the sensor's own clock, where it has one
    joint_topic: /joint_states                 # of a bag with several
    imu_topic: /imu/data
    units: {t: ms, q: deg, q3: mm, a: g, g: deg/s, temp: C}

What the map does not name is still recognised. A unit given for `q` holds for the revolute joints when it is an angle
and for the prismatic ones when it is a length; `q3` holds for joint 3 alone. Stating a unit that is the default
(``q: rad``) also says that the values are meant, however large they look. A unit in a column's name (``ax [g]``,
``q1_deg``) counts as stated.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from circlepoint._core import STANDARD_GRAVITY, InvalidInput
from circlepoint.column_names import (
    ACCELERATION_FAMILIES,
    AXES,
    GYROSCOPE_FAMILIES,
    POSE_NAMES,
    SENSOR_TIME_NAMES,
    TEMPERATURE_NAMES,
    TIME_NAMES,
    ColumnNames,
    Match,
    joint_families,
    joints_behind_prefix,
)
from circlepoint.modules import module_columns
from circlepoint.yaml_io import YamlFile, describe, load_yaml

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from circlepoint.arm import Arm
    from circlepoint.log_table import LogTable

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

_TOPICS = ("joint_topic", "imu_topic")


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
    joint_topic, imu_topic : str or None
        Topics of a bag.
    """

    names: dict[str, str] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    source: YamlFile | None = None
    joint_topic: str | None = None
    imu_topic: str | None = None

    def joint_factor(self, arm: Arm, joint: int) -> float:
        """Return what a value of this joint's column is multiplied by to give rad or m."""
        revolute = arm.joints[joint].revolute
        own, other = (ANGLE_UNITS, LENGTH_UNITS) if revolute else (LENGTH_UNITS, ANGLE_UNITS)
        name = f"q{joint + 1}"
        unit = self.units.get(name, self.units.get("q"))
        if unit is None or (unit in other and name not in self.units):
            return 1.0
        if unit not in own:
            kind = "revolute" if revolute else "prismatic"
            message = f"is {unit!r}, but joint {joint + 1} is {kind}: one of {', '.join(own)}"
            if self.source is not None and name in self.source.data.get("units", {}):
                raise self.source.error(("units", name), message)
            raise InvalidInput(f"the unit in the name of the column of joint {joint + 1} {message}")
        return own[unit]

    def joint_unit_stated(self, joint: int) -> bool:
        """Whether the user said what unit this joint is in."""
        return "q" in self.units or f"q{joint + 1}" in self.units


@dataclass(frozen=True)
class FileColumns:
    """The columns of one file by meaning; None where the file has no such quantity.

    `units` are those written into the columns' names, by quantity as in a column map; `notes` say which of several
    columns were taken, and why; `beyond` are the joints (0-based) that do not move the sensor. Where `static`, every
    row is the mean of one rest, and `time` is the column that numbers these.
    """

    time: str
    joints: tuple[str, ...] | None
    specific_force: tuple[str, ...] | None
    angular_velocity: tuple[str, ...] | None
    temperature: str | None
    sensor_time: str | None = None
    units: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    beyond: tuple[int, ...] = ()
    static: bool = False

    @property
    def joint_half(self) -> FileColumns:
        """The joints alone."""
        return replace(self, specific_force=None, angular_velocity=None, temperature=None, sensor_time=None)

    @property
    def sensor_half(self) -> FileColumns:
        """The sensor alone, on its own clock where it has one."""
        own = self.sensor_time or self.time
        units = {
            **self.units,
            **({"t": self.units["t_sensor"]} if self.sensor_time and "t_sensor" in self.units else {}),
        }
        return replace(self, time=own, joints=None, sensor_time=None, units=units)

    @property
    def used(self) -> tuple[str, ...]:
        """Every column that is read, once each."""
        groups = ((self.time,), self.joints, self.specific_force, self.angular_velocity)
        single = [name for name in (self.temperature, self.sensor_time) if name]
        return tuple(dict.fromkeys([name for group in groups for name in group or ()] + single))


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
    groups = {"q": joints, "a": [f"a{axis}" for axis in AXES], "g": [f"g{axis}" for axis in AXES]}
    single = ["t", "t_sensor", "pose", "temp", *(name for group in groups.values() for name in group)]
    document.only_keys((), document.data, [*single, *groups, "units", *_TOPICS])
    names: dict[str, str] = {}
    for key, value in document.data.items():
        if key == "units" or key in _TOPICS:
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
    topics = {key: document.text((key,), document.data[key]) for key in _TOPICS if key in document.data}
    return ColumnMap(names, _units(document, joints), document, **topics)


def find_columns(table: LogTable, arm: Arm, column_map: ColumnMap) -> FileColumns:
    """Find out what each column of a file is.

    Parameters
    ----------
    table : LogTable
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
        has, several sensors are there, or a name that is used appears twice.
    """
    names = ColumnNames(table.columns)
    if not column_map.names and (modules := module_columns(names, arm)):
        time = modules.time or next((found[0] for name in TIME_NAMES if (found := names.find(name, "t"))), "")
        return FileColumns(
            time,
            modules.joints,
            modules.specific_force,
            modules.angular_velocity,
            None,
            notes=modules.notes,
            beyond=modules.beyond,
        )
    search = _Search(table, names, column_map)
    force = search.three("a", ACCELERATION_FAMILIES)
    if any(force) and not all(force):
        axis = AXES[force.index(None)]
        raise table.error(
            f"the column of specific force a{axis} is missing, though {_present(force)} is there; {_found(table)}"
        )
    joints = search.joints(arm)
    columns = FileColumns(
        time=search.one("t", TIME_NAMES, "t") or "",
        joints=joints,
        specific_force=_complete(force),
        angular_velocity=_complete(search.three("g", GYROSCOPE_FAMILIES)),
        temperature=search.one("temp", TEMPERATURE_NAMES, "temp"),
        sensor_time=search.one("t_sensor", SENSOR_TIME_NAMES, "t") if joints and all(force) else None,
    )
    if not columns.time:
        pose = None if columns.sensor_time else search.one("pose", POSE_NAMES, "t")
        if pose and joints and columns.specific_force:
            columns = replace(columns, time=pose, static=True)
        else:
            poses = "; a table of still poses holds joints and sensor in the same rows" if pose else ""
            raise table.error(f"the time column is missing (t, time or timestamp){poses}; {_found(table)}")
    if columns.joints is None and columns.specific_force is None:
        raise table.error(
            f"neither joint positions (q1 .. q{len(arm.joints)}) nor specific force (ax, ay, az) are among the "
            f"columns; {_found(table)}"
        )
    for name in columns.used:
        if table.columns.count(name) > 1:
            raise table.error(
                f"column `{name}` is there {table.columns.count(name)} times; rename or remove all but one"
            )
    return replace(columns, units=search.units)


def missing_specific_force(table: LogTable) -> str:
    """Return what to say of a log without any accelerometer in it."""
    return f"the specific force columns (ax, ay, az) are missing; {_found(table)}"


def missing_joints(table: LogTable, arm: Arm) -> str:
    """Return what to say of a log without any joint positions in it."""
    return f"the joint position columns (q1 .. q{len(arm.joints)}) are missing; {_found(table)}"


def _units(document: YamlFile, joints: list[str]) -> dict[str, str]:
    if document.data.get("units") is None:
        return {}
    known: dict[str, Any] = {"t": TIME_UNITS, "t_sensor": TIME_UNITS, "a": ACCELERATION_UNITS, "g": RATE_UNITS}
    known["temp"] = TEMPERATURE_UNITS
    known |= dict.fromkeys(["q", *joints], ANGLE_UNITS | LENGTH_UNITS)
    units: dict[str, str] = {}
    for key, value in document.only_keys(("units",), document.data["units"], known).items():
        if not isinstance(value, str) or value not in known[key]:
            raise document.error(("units", key), f"is {describe(value)}, must be one of {', '.join(known[key])}")
        units[key] = value
    return units


class _Search:
    """Columns by quantity: as stated, else by known names; and the units written into the names."""

    def __init__(self, table: LogTable, names: ColumnNames, column_map: ColumnMap) -> None:
        self.table = table
        self.names = names
        self.stated = {quantity: name for quantity, name in column_map.names.items() if name in table.columns}
        self.units: dict[str, str] = {}

    def one(self, quantity: str, known: Sequence[str], unit: str) -> str | None:
        if quantity in self.stated:
            return self.stated[quantity]
        found = next((match for name in known if (match := self.names.find(name, unit))), None)
        if found and found[1]:
            self.units[quantity] = found[1]
        return found and found[0]

    def three(self, letter: str, families: Sequence[Sequence[str]]) -> list[str | None]:
        quantities = [f"{letter}{axis}" for axis in AXES]
        match = self.names.best(families, letter)
        if match.found < len(AXES) and not any(quantity in self.stated for quantity in quantities):
            behind = self.names.behind_prefix(families, letter)
            self._require_one_sensor(behind, letter)
            match = next(iter(behind.values())) if len(behind) == 1 else match
        self._take_units(dict.fromkeys(quantities, letter), quantities, match)
        return self._columns(quantities, match)

    def joints(self, arm: Arm) -> tuple[str, ...] | None:
        count = len(arm.joints)
        quantities = [f"q{index + 1}" for index in range(count)]
        families = joint_families(arm.joint_names, self.names)
        match = self.names.best(list(families.values()), "q")
        if match.found < count and not any(quantity in self.stated for quantity in quantities):
            match = joints_behind_prefix(families, self.names) or match
        columns = self._columns(quantities, match)
        if not any(columns):
            return None
        for key, family in families.items():
            if isinstance(key, tuple) and not self.stated and columns == list(self.names.family(family, "q").columns):
                self._require_count(arm, *key)
        if not all(columns):
            joint = columns.index(None)
            raise self.table.error(
                f"the column of joint {joint + 1} ({arm.joints[joint].name}) is missing, though {_present(columns)} is "
                f"there; {_found(self.table)}"
            )
        self._take_units({quantity: quantity for quantity in quantities}, quantities, match)
        return _complete(columns)

    def _columns(self, quantities: Sequence[str], match: Match) -> list[str | None]:
        return [self.stated.get(quantity) or column for quantity, column in zip(quantities, match.columns, strict=True)]

    def _take_units(self, keys: dict[str, str], quantities: Sequence[str], match: Match) -> None:
        for quantity, unit in zip(quantities, match.units, strict=True):
            if unit and quantity not in self.stated:
                self.units[keys[quantity]] = unit

    def _require_one_sensor(self, behind: dict[str, Match], letter: str) -> None:
        if len(behind) > 1 and letter == "a":
            first = ", ".join(str(name) for name in next(iter(behind.values())).columns)
            raise self.table.error(
                f"several accelerometers are there ({', '.join(sorted(behind))}); say which one is on the end-point, "
                f"such as `a: [{first}]` in a column map (--columns map.yaml)"
            )

    def _require_count(self, arm: Arm, template: str, first: int) -> None:
        count = len(arm.joints)
        there = sum(self.names.find(template.format(index + first), "q") is not None for index in range(count + 100))
        if there != count:
            raise self.table.error(
                f"has {there} joint columns ({template.format(first)} .. {template.format(there - 1 + first)}), but "
                f"the arm {arm.name!r} has {count} joints; use the arm that was recorded, or name the columns with "
                f"--columns map.yaml"
            )


def _complete(columns: Sequence[str | None]) -> tuple[str, ...] | None:
    names = tuple(column for column in columns if column is not None)
    return names if len(names) == len(columns) else None


def _present(columns: Sequence[str | None]) -> str:
    return "`" + next(column for column in columns if column is not None) + "`"


def _found(table: LogTable) -> str:
    shown = ", ".join(table.columns[:40]) + (", ..." if len(table.columns) > 40 else "")
    hint = table.hint and f"{table.hint}; "
    return f"{hint}the columns found are {shown}; other names are given with --columns map.yaml"
