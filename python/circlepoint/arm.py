"""The arm as its owner describes it: joints from base to tip, nominal Denavit-Hartenberg rows, encoders.

``arm.yaml``::

    name: sarcos-dextrous-arm
    joints:                                  # base to tip
      - {name: joint1, type: revolute}       # or prismatic; optional: limits: [lo, hi], velocity, acceleration
    dh:                                      # nominal, optional: lines need no nominal
      convention: standard                   # or modified (Craig)
      rows: [{a: 0.0, alpha: 1.5708, d: 0.0, theta: 0.0}]
    encoder: {counts_per_revolution: 400000} # optional; one value or a list (null: unknown)

Units: m, rad, and per s. A prismatic joint's limits, velocity and acceleration are in m. Its encoder is described by
``encoder: {counts_per_metre: 1000000}``, again one value or a list with null for the others; without it, its entry of
counts_per_revolution counts per metre.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from circlepoint._core import InvalidInput
from circlepoint.yaml_io import Fields, describe, load_fields

JointType = Literal["revolute", "prismatic"]
DhConvention = Literal["standard", "modified"]

_JOINT_KEYS = ("name", "type", "limits", "velocity", "acceleration")
_JOINT_TYPES: dict[str, JointType] = {"revolute": "revolute", "prismatic": "prismatic"}
_CONVENTIONS: dict[str, DhConvention] = {"standard": "standard", "modified": "modified"}
_DH_PARAMETERS = ("a", "alpha", "d", "theta")
_COUNTS = "counts_per_revolution"
_COUNTS_PER_METRE = "counts_per_metre"
_DH_NUMBER = "a finite number (0.0 where it is zero)"
_LARGEST_LIMIT = 8 * math.pi  # rad: four turns either way; beyond that a limit was written in degrees
_LONGEST_LINK = 20.0  # m: beyond that a length was written in millimetres


@dataclass(frozen=True)
class Joint:
    """One joint. Units: rad when revolute, m when prismatic."""

    name: str
    type: JointType
    limits: tuple[float, float] | None = None
    velocity: float | None = None
    acceleration: float | None = None

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
    """

    name: str
    joints: tuple[Joint, ...]
    dh: NominalDh | None = None
    encoder_counts: tuple[float | None, ...] | None = None

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


def load_arm(path: str | Path) -> Arm:
    """Read an arm description (``arm.yaml``).

    Parameters
    ----------
    path : str or Path
        The file; its format is described at the top of this module.

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
    if _is_urdf(path):
        raise InvalidInput(
            f"{path}: is a URDF, which is not read yet; describe the arm in an arm.yaml instead: its joints from base "
            "to tip as `joints: [{name: ..., type: revolute}, ...]`"
        )
    fields = load_fields(path, ("name", "joints", "dh", "encoder"))
    name = fields.text("name", "the arm's name")
    joints = _joints(fields)
    return Arm(
        name=name,
        joints=joints,
        dh=_nominal_dh(fields.fields("dh", ("convention", "rows")), len(joints)) if fields.given("dh") else None,
        encoder_counts=_encoder_counts(fields.fields("encoder", (_COUNTS, _COUNTS_PER_METRE)), joints)
        if fields.given("encoder")
        else None,
    )


def _is_urdf(path: Path) -> bool:
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
    if revolute and max(abs(low), abs(high)) > _LARGEST_LIMIT:
        fields.fail(
            "limits",
            f"[{low:g}, {high:g}] looks like degrees; write radians: [{math.radians(low):.6f}, "
            f"{math.radians(high):.6f}] (leave limits out for a joint that turns without end)",
        )
    if not revolute and max(abs(low), abs(high)) > _LONGEST_LINK:
        fields.fail("limits", f"[{low:g}, {high:g}] looks like millimetres; write metres")
    return low, high


def _nominal_dh(fields: Fields, joints: int) -> NominalDh:
    convention = fields.choice("convention", _CONVENTIONS)
    rows = tuple(_dh_row(row) for row in fields.each("rows", "a list with one row a joint", _DH_PARAMETERS))
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
    if abs(length) > _LONGEST_LINK:
        fields.fail(key, f"{length:g} looks like millimetres; write metres: {length / 1000:g}")
    return length


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
