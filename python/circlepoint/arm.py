"""The arm as its owner describes it: joints from base to tip, nominal Denavit-Hartenberg rows, encoders.

``arm.yaml``::

    name: sarcos-dextrous-arm
    joints:                                  # base to tip
      - {name: joint1, type: revolute}       # or prismatic; optional: limits: [lo, hi], velocity, acceleration
    dh:                                      # nominal, optional: lines need no nominal
      convention: standard                   # or modified (Craig)
      rows: [{a: 0.0, alpha: 1.5708, d: 0.0, theta: 0.0}]
    encoder: {counts_per_revolution: 400000} # optional; one value or a list (null: unknown)

Units: m, rad, and per s. A prismatic joint's limits, velocity and acceleration are in m, its encoder counts per metre.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, cast

from circlepoint._core import InvalidInput
from circlepoint.yaml_io import YamlFile, describe, load_yaml

JointType = Literal["revolute", "prismatic"]
DhConvention = Literal["standard", "modified"]

_JOINT_TYPES = ("revolute", "prismatic")
_CONVENTIONS = ("standard", "modified")
_DH_PARAMETERS = ("a", "alpha", "d", "theta")
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
            f"to "
            "tip as `joints: [{name: ..., type: revolute}, ...]`"
        )
    document = load_yaml(path)
    document.only_keys((), document.data, ("name", "joints", "dh", "encoder"))
    for key in ("name", "joints"):
        if key not in document.data:
            raise document.error((), f"the key `{key}` is missing")
    joints = _joints(document)
    return Arm(
        name=document.text(("name",), document.data["name"]),
        joints=joints,
        dh=_nominal_dh(document, len(joints)) if "dh" in document.data else None,
        encoder_counts=_encoder_counts(document, len(joints)) if "encoder" in document.data else None,
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


def _joints(document: YamlFile) -> tuple[Joint, ...]:
    entries = document.data["joints"]
    if not isinstance(entries, list) or not entries:
        raise document.error(("joints",), f"is {describe(entries)}, must be a list of joints, base to tip")
    joints: list[Joint] = []
    for index, entry in enumerate(entries):
        joint = _joint(document, ("joints", index), entry)
        if joint.name in (other.name for other in joints):
            raise document.error(
                ("joints", index, "name"), f"{joint.name!r} names an earlier joint too; names must differ"
            )
        joints.append(joint)
    return tuple(joints)


def _joint(document: YamlFile, where: tuple[str, int], entry: Any) -> Joint:
    document.only_keys(where, entry, ("name", "type", "limits", "velocity", "acceleration"))
    for key in ("name", "type"):
        if key not in entry:
            raise document.error(where, f"the key `{key}` is missing")
    kind = entry["type"]
    if kind not in _JOINT_TYPES:
        raise document.error((*where, "type"), f"is {describe(kind)}, must be revolute or prismatic")
    rates = {}
    for key in ("velocity", "acceleration"):
        if entry.get(key) is not None:
            rates[key] = document.number((*where, key), entry[key])
            if rates[key] <= 0:
                raise document.error((*where, key), f"is {rates[key]:g}, must be greater than zero")
    return Joint(
        name=document.text((*where, "name"), entry["name"]),
        type=cast("JointType", kind),
        limits=_limits(document, (*where, "limits"), entry["limits"], kind)
        if entry.get("limits") is not None
        else None,
        velocity=rates.get("velocity"),
        acceleration=rates.get("acceleration"),
    )


def _limits(document: YamlFile, where: tuple[str | int, ...], value: Any, kind: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise document.error(where, f"is {describe(value)}, must be [lowest, highest]")
    low, high = (document.number((*where, index), item) for index, item in enumerate(value))
    if low >= high:
        raise document.error(where, f"the lowest, {low:g}, is not below the highest, {high:g}")
    if kind == "revolute" and max(abs(low), abs(high)) > _LARGEST_LIMIT:
        raise document.error(
            where,
            f"[{low:g}, {high:g}] looks like degrees; write radians: [{math.radians(low):.6f}, "
            f"{math.radians(high):.6f}] "
            "(leave limits out for a joint that turns without end)",
        )
    if kind == "prismatic" and max(abs(low), abs(high)) > _LONGEST_LINK:
        raise document.error(where, f"[{low:g}, {high:g}] looks like millimetres; write metres")
    return low, high


def _nominal_dh(document: YamlFile, joints: int) -> NominalDh | None:
    if document.data["dh"] is None:
        return None
    section = document.only_keys(("dh",), document.data["dh"], ("convention", "rows"))
    for key in ("convention", "rows"):
        if key not in section:
            raise document.error(("dh",), f"the key `{key}` is missing")
    convention = section["convention"]
    if convention not in _CONVENTIONS:
        raise document.error(("dh", "convention"), f"is {describe(convention)}, must be standard or modified (Craig)")
    rows = section["rows"]
    if not isinstance(rows, list):
        raise document.error(("dh", "rows"), f"is {describe(rows)}, must be a list with one row a joint")
    if len(rows) != joints:
        raise document.error(("dh", "rows"), f"has {len(rows)} rows for {joints} joints; one row a joint is needed")
    return NominalDh(
        cast("DhConvention", convention), tuple(_dh_row(document, index, row) for index, row in enumerate(rows))
    )


def _dh_row(document: YamlFile, index: int, row: Any) -> DhRow:
    where = ("dh", "rows", index)
    document.only_keys(where, row, _DH_PARAMETERS)
    values: dict[str, float] = {}
    for key in _DH_PARAMETERS:
        if key not in row:
            raise document.error(where, f"the key `{key}` is missing (write 0.0 where it is zero)")
        values[key] = document.number((*where, key), row[key])
        if key in {"alpha", "theta"} and abs(values[key]) > 2 * math.pi:
            raise document.error(
                (*where, key),
                f"{values[key]:g} looks like degrees; write radians: {math.radians(values[key]):.10g}",
            )
        if key in {"a", "d"} and abs(values[key]) > _LONGEST_LINK:
            raise document.error(
                (*where, key), f"{values[key]:g} looks like millimetres; write metres: {values[key] / 1000:g}"
            )
    return DhRow(**values)


def _encoder_counts(document: YamlFile, joints: int) -> tuple[float | None, ...] | None:
    if document.data["encoder"] is None:
        return None
    section = document.only_keys(("encoder",), document.data["encoder"], ("counts_per_revolution",))
    where = ("encoder", "counts_per_revolution")
    if "counts_per_revolution" not in section:
        raise document.error(("encoder",), "the key `counts_per_revolution` is missing")
    value = section["counts_per_revolution"]
    entries = value if isinstance(value, list) else [value] * joints
    if len(entries) != joints:
        raise document.error(where, f"has {len(entries)} values for {joints} joints; give one, or one a joint")
    counts: list[float | None] = []
    for index, entry in enumerate(entries):
        place = (*where, index) if isinstance(value, list) else where
        if entry is None and isinstance(value, list):
            counts.append(None)
            continue
        number = document.number(place, entry)
        if number <= 0:
            raise document.error(place, f"is {number:g}, must be greater than zero")
        counts.append(number)
    return tuple(counts)
