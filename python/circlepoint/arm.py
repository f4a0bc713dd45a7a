"""The arm as its owner describes it: joints from base to tip, nominal Denavit-Hartenberg rows or lines, encoders.

``arm.yaml``::

    name: sarcos-dextrous-arm
    joints:                                  # base to tip
      - {name: joint1, type: revolute}       # or prismatic; optional: limits: [lo, hi], velocity, acceleration
    dh:                                      # nominal, optional: lines need no nominal
      convention: standard                   # or modified (Craig)
      rows: [{a: 0.0, alpha: 1.5708, d: 0.0, theta: 0.0}]
    lines:                                   # nominal, instead of dh: each axis in the base frame, m
      reference_configuration: [0.0]         # optional: where the joints stand then; zeros
      rows: [{direction: [0, 0, 1], point: [0, 0, 0.3]}]
    encoder: {counts_per_revolution: 400000} # optional; one value or a list (null: unknown)

A URDF is read instead where one is given (`circlepoint.urdf`).

Units: m, rad, and per s. A prismatic joint's limits, velocity and acceleration are in m. Its encoder is described by
``encoder: {counts_per_metre: 1000000}``, again one value or a list with null for the others; without it, its entry of
counts_per_revolution counts per metre.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from circlepoint._core import InvalidInput
from circlepoint.yaml_io import Fields, describe, load_fields

if TYPE_CHECKING:
    from numpy.typing import NDArray

    FloatArray = NDArray[np.float64]

JointType = Literal["revolute", "prismatic"]
DhConvention = Literal["standard", "modified"]

_JOINT_KEYS = ("name", "type", "limits", "velocity", "acceleration")
_JOINT_TYPES: dict[str, JointType] = {"revolute": "revolute", "prismatic": "prismatic"}
_CONVENTIONS: dict[str, DhConvention] = {"standard": "standard", "modified": "modified"}
DH_PARAMETERS = ("a", "alpha", "d", "theta")
_COUNTS = "counts_per_revolution"
_LINE_FIELDS = ("reference_configuration", "rows")
_COUNTS_PER_METRE = "counts_per_metre"
_DH_NUMBER = "a finite number (0.0 where it is zero)"
LARGEST_LIMIT = 8 * math.pi
"""rad: four turns either way; beyond that a limit was written in degrees."""
LONGEST_LINK = 20.0
"""m: beyond that a length was written in millimetres."""


@dataclass(frozen=True)
class Mimic:
    """That a joint has no encoder: its position is `multiplier` times that of the joint `joint`, plus `offset`."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Joint:
    """One joint. Units: rad when revolute, m when prismatic."""

    name: str
    type: JointType
    limits: tuple[float, float] | None = None
    velocity: float | None = None
    acceleration: float | None = None
    mimic: Mimic | None = None

    @property
    def revolute(self) -> bool:
        """Whether it turns."""
        return self.type == "revolute"

    @property
    def unit(self) -> str:
        """Unit of its position: ``"rad"`` or ``"m"``."""
        return "rad" if self.revolute else "m"


@dataclass(frozen=True)
class DhRow:
    """One row of Denavit-Hartenberg parameters: m and rad; `theta` or `d` is the joint's offset."""

    a: float
    alpha: float
    d: float
    theta: float


@dataclass(frozen=True)
class NominalDh:
    """Nominal Denavit-Hartenberg parameters, one row a joint."""

    convention: DhConvention
    rows: tuple[DhRow, ...]


@dataclass(frozen=True)
class NominalLine:
    """A joint's axis in the base frame: unit direction, and a point on it, m."""

    direction: tuple[float, float, float]
    point: tuple[float, float, float]


@dataclass(frozen=True)
class NominalLines:
    """Nominal axes in the base frame where the joints stand at a reference configuration.

    `tip` is the pose of the tip link there, (4, 4), where it is known.
    """

    reference_configuration: tuple[float, ...]
    rows: tuple[NominalLine, ...]
    tip: tuple[tuple[float, ...], ...] | None = None


@dataclass(frozen=True)
class Arm:
    """A serial arm.

    Attributes
    ----------
    name : str
        The arm's name.
    joints : tuple of Joint
        Base to tip.
    dh : NominalDh or None
        Nominal parameters, where known.
    encoder_counts : tuple of (float or None), or None
        Counts per revolution (per metre when prismatic), one a joint, where known.
    lines : NominalLines or None
        Nominal axes, where these are known instead of parameters.
    beside : tuple of Joint
        Joints outside the arm that some of its joints mimic.
    """

    name: str
    joints: tuple[Joint, ...]
    dh: NominalDh | None = None
    encoder_counts: tuple[float | None, ...] | None = None
    lines: NominalLines | None = None
    beside: tuple[Joint, ...] = ()

    @property
    def driven(self) -> Arm:
        """The joints whose positions are recorded: those that mimic no other, and those beside that are mimicked."""
        if all(joint.mimic is None for joint in self.joints):
            return self
        by_name = {joint.name: joint for joint in (*self.joints, *self.beside)}
        names = dict.fromkeys(joint.mimic.joint if joint.mimic else joint.name for joint in self.joints)
        counts = dict(zip(self.joint_names, self.encoder_counts, strict=True)) if self.encoder_counts else None
        return Arm(
            self.name,
            tuple(by_name[name] for name in names),
            encoder_counts=None if counts is None else tuple(counts.get(name) for name in names),
        )

    def follow(self, driven: FloatArray) -> FloatArray:
        """Return the positions (N, n) of all joints where those that are driven have positions (N, k), rad or m."""
        if all(joint.mimic is None for joint in self.joints):
            return driven
        names = self.driven.joint_names
        mimics = [joint.mimic or Mimic(joint.name, 1.0, 0.0) for joint in self.joints]
        return np.column_stack([driven[:, names.index(each.joint)] * each.multiplier + each.offset for each in mimics])

    def lead(self, positions: FloatArray) -> FloatArray:
        """Return the positions (N, k) of the joints that are driven where all have positions (N, n), rad or m."""
        driven = self.driven
        if driven is self:
            return positions
        columns = []
        for name in driven.joint_names:
            if name in self.joint_names:
                columns.append(positions[:, self.joint_names.index(name)])
            else:  # beside the arm: what follows it tells
                index, mimic = next(
                    (index, joint.mimic)
                    for index, joint in enumerate(self.joints)
                    if joint.mimic is not None and joint.mimic.joint == name
                )
                columns.append((positions[:, index] - mimic.offset) / mimic.multiplier)
        return np.column_stack(columns)

    def coupled(self, joint: int) -> tuple[str, ...]:
        """Return the names of the other joints that one encoder moves together with a joint (0-based)."""
        sources = [each.mimic.joint if each.mimic else each.name for each in self.joints]
        return tuple(
            each.name for index, each in enumerate(self.joints) if index != joint and sources[index] == sources[joint]
        )

    @property
    def has_nominal(self) -> bool:
        """Whether its axes are known nominally."""
        return self.dh is not None or self.lines is not None

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names, base to tip."""
        return tuple(joint.name for joint in self.joints)

    def encoder_step(self, joint: int) -> float | None:
        """Size of one encoder count of a joint (0-based), rad or m; None where unknown."""
        counts = self.encoder_counts[joint] if self.encoder_counts else None
        if counts is None:
            return None
        return (2 * math.pi if self.joints[joint].revolute else 1.0) / counts


def load_arm(path: str | Path, *, base: str | None = None, tip: str | None = None) -> Arm:
    """Read an arm description (``arm.yaml`` or a URDF).

    Parameters
    ----------
    path : str or Path
        The file; the format of ``arm.yaml`` is described at the top of this module.
    base, tip : str, optional
        Links of a URDF between which the arm lies (see `circlepoint.urdf.read_urdf`).

    Returns
    -------
    Arm
        The description, every field checked.

    Raises
    ------
    InvalidInput
        When the file cannot be read or a field is missing, unknown, of the wrong kind or implausible; the message
        names file, line, field, value and remedy.
    """
    path = Path(path)
    if is_urdf(path):
        from circlepoint.urdf import read_urdf  # noqa: PLC0415  (an arm.yaml needs no XML)

        return read_urdf(path, base, tip)
    if base is not None or tip is not None:
        raise InvalidInput(f"{path}: is not a URDF; base and tip are links of a URDF, leave them out")
    fields = load_fields(path, ("name", "joints", "dh", "lines", "encoder"))
    name = fields.text("name", "the arm's name")
    joints = _joints(fields)
    if fields.given("dh") and fields.given("lines"):
        fields.fail("lines", "is given beside dh; keep one of the two")
    return Arm(
        name=name,
        joints=joints,
        dh=_nominal_dh(fields.fields("dh", ("convention", "rows")), len(joints)) if fields.given("dh") else None,
        encoder_counts=_encoder_counts(fields.fields("encoder", (_COUNTS, _COUNTS_PER_METRE)), joints)
        if fields.given("encoder")
        else None,
        lines=_nominal_lines(fields.fields("lines", _LINE_FIELDS), len(joints)) if fields.given("lines") else None,
    )


def is_urdf(path: Path) -> bool:
    """Whether a file is a URDF and no ``arm.yaml``: by its name or, where that says nothing, by what is in it."""
    if path.suffix.lower() in {".urdf", ".xacro", ".xml"}:
        return True
    try:
        with path.open("rb") as stream:
            start = stream.read(4096).lstrip(b"\xef\xbb\xbf \t\r\n")
    except OSError:
        return False  # said with its reason where the file is read
    return start.startswith(b"<") and (b"<robot" in start or start.startswith(b"<?xml"))


def _joints(fields: Fields) -> tuple[Joint, ...]:
    joints: list[Joint] = []
    for entry in fields.each("joints", "a list of joints, base to tip", _JOINT_KEYS):
        joint = _joint(entry)
        if joint.name in (other.name for other in joints):
            entry.fail("name", f"{joint.name!r} names an earlier joint too; names must differ")
        joints.append(joint)
    return tuple(joints)


def _joint(fields: Fields) -> Joint:
    return Joint(
        name=fields.text("name", "a name"),
        type=fields.choice("type", _JOINT_TYPES),
        limits=_limits(fields) if fields.given("limits") else None,
        velocity=fields.number("velocity", above=0.0) if fields.given("velocity") else None,
        acceleration=fields.number("acceleration", above=0.0) if fields.given("acceleration") else None,
    )


def _limits(fields: Fields) -> tuple[float, float]:
    value = fields.value("limits", "[lowest, highest]")
    if not isinstance(value, list) or len(value) != 2:
        fields.fail("limits", f"is {describe(value)}, must be [lowest, highest]")
    low, high = (fields.checked(("limits", index), entry) for index, entry in enumerate(value))
    if low >= high:
        fields.fail("limits", f"the lowest, {low:g}, is not below the highest, {high:g}")
    revolute = fields.values["type"] == "revolute"
    if revolute and max(abs(low), abs(high)) > LARGEST_LIMIT:
        fields.fail(
            "limits",
            f"[{low:g}, {high:g}] looks like degrees; write radians: [{math.radians(low):.6f}, "
            f"{math.radians(high):.6f}] (leave limits out for a joint that turns without end)",
        )
    if not revolute and max(abs(low), abs(high)) > LONGEST_LINK:
        fields.fail("limits", f"[{low:g}, {high:g}] looks like millimetres; write metres")
    return low, high


def _nominal_dh(fields: Fields, joints: int) -> NominalDh:
    convention = fields.choice("convention", _CONVENTIONS)
    rows = tuple(_dh_row(row) for row in fields.each("rows", "a list with one row a joint", DH_PARAMETERS))
    if len(rows) != joints:
        fields.fail("rows", f"has {len(rows)} rows for {joints} joints; one row a joint is needed")
    return NominalDh(convention, rows)


def _dh_row(fields: Fields) -> DhRow:
    return DhRow(
        a=_length(fields, "a"),
        alpha=_angle(fields, "alpha"),
        d=_length(fields, "d"),
        theta=_angle(fields, "theta"),
    )


def _angle(fields: Fields, key: str) -> float:
    angle = fields.number(key, need=_DH_NUMBER)
    if abs(angle) > 2 * math.pi:
        fields.fail(key, f"{angle:g} looks like degrees; write radians: {math.radians(angle):.10g}")
    return angle


def _length(fields: Fields, key: str) -> float:
    length = fields.number(key, need=_DH_NUMBER)
    if abs(length) > LONGEST_LINK:
        fields.fail(key, f"{length:g} looks like millimetres; write metres: {length / 1000:g}")
    return length


def _nominal_lines(fields: Fields, joints: int) -> NominalLines:
    rows = []
    for row in fields.each("rows", "a list with one row a joint", ("direction", "point")):
        direction, point = _vector(row, "direction", 3), _vector(row, "point", 3)
        length = math.hypot(*direction)
        if length < 1e-9:
            row.fail("direction", "has no length; give the axis' direction")
        if math.hypot(*point) > LONGEST_LINK:
            row.fail("point", f"{list(point)} looks like millimetres; write metres")
        x, y, z = (component / length for component in direction)
        rows.append(NominalLine((x, y, z), (point[0], point[1], point[2])))
    if len(rows) != joints:
        fields.fail("rows", f"has {len(rows)} rows for {joints} joints; one row a joint is needed")
    given = fields.given("reference_configuration")
    reference = _vector(fields, "reference_configuration", joints) if given else (0.0,) * joints
    return NominalLines(reference, tuple(rows))


def _vector(fields: Fields, key: str, count: int) -> tuple[float, ...]:
    value = fields.value(key, f"a list of {count} numbers")
    if not isinstance(value, list) or len(value) != count:
        fields.fail(key, f"is {describe(value)}, must be a list of {count} numbers")
    return tuple(fields.checked((key, index), entry) for index, entry in enumerate(value))


def _encoder_counts(fields: Fields, joints: tuple[Joint, ...]) -> tuple[float | None, ...]:
    """Return each joint's counts: what concerns its own kind, for a prismatic joint per metre where that is given."""
    if _COUNTS not in fields and _COUNTS_PER_METRE not in fields:
        fields.value(_COUNTS, f"a number, or a list with one a joint (null: unknown); {_COUNTS_PER_METRE} likewise")
    per_revolution = _counts(fields, _COUNTS, len(joints))
    if _COUNTS_PER_METRE not in fields:
        return per_revolution
    if all(joint.revolute for joint in joints):
        fields.fail(_COUNTS_PER_METRE, f"is given, but no joint is prismatic; give {_COUNTS}")
    per_metre = _counts(fields, _COUNTS_PER_METRE, len(joints))
    return tuple(
        turns if joint.revolute else slides
        for joint, turns, slides in zip(joints, per_revolution, per_metre, strict=True)
    )


def _counts(fields: Fields, key: str, joints: int) -> tuple[float | None, ...]:
    if key not in fields:
        return (None,) * joints
    value = fields.value(key, "a number, or a list with one a joint (null: unknown)")
    if not isinstance(value, list):
        return (fields.number(key, above=0.0),) * joints
    if len(value) != joints:
        fields.fail(key, f"has {len(value)} values for {joints} joints; give one, or one a joint")
    return tuple(
        None if entry is None else fields.checked((key, index), entry, above=0.0) for index, entry in enumerate(value)
    )
