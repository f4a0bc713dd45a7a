"""The calibrated arm out of a result folder: its lines, their covariance, nothing of how they were found."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint._core import InvalidInput, NotIdentifiable
from circlepoint.document import SCHEMA_NAME
from circlepoint.result_document import LINE_COORDINATES

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

_TYPES = {"revolute": circlepoint.JointType.revolute, "prismatic": circlepoint.JointType.prismatic}


@dataclass(frozen=True)
class CalibratedArm:
    """Every axis of an arm, as calibrated.

    Attributes
    ----------
    name : str
        The arm's name.
    joint_names : tuple of str
        Base to tip.
    chain : ScrewChain
        In the sensor frame at the reference configuration; home is the identity.
    covariance : (4 n, 4 n) ndarray
        Of the axes' local coordinates (d1, d2, p1, p2), base to tip; rad^2, rad m, m^2.
    convention : str
        Of the Denavit-Hartenberg parameters in the result: "standard" or "modified".
    mimics : tuple of mapping
        Which joints follow others: ``joint``, ``mimics``, ``multiplier``, ``offset``.
    base, tip : str or None
        Links of the URDF it was calibrated with, where they were said.
    """

    name: str
    joint_names: tuple[str, ...]
    chain: circlepoint.ScrewChain
    covariance: NDArray[np.float64]
    convention: str
    mimics: tuple[Mapping[str, Any], ...] = ()
    base: str | None = None
    tip: str | None = None

    @property
    def joint_types(self) -> list[circlepoint.JointType]:
        """Base to tip."""
        return [axis.type for axis in self.chain.axes]

    @property
    def reference(self) -> NDArray[np.float64]:
        """(n,) rad or m, the reference configuration."""
        return np.asarray(self.chain.reference_configuration)


def load_result(folder: Path) -> CalibratedArm:
    """Read the calibrated arm of a result folder.

    Parameters
    ----------
    folder : Path
        Holds ``calibration.json``.

    Raises
    ------
    InvalidInput
        There is no such file, or it is not a calibration document.
    NotIdentifiable
        A joint's axis is missing.
    """
    path = folder / "calibration.json"
    try:
        document = json.loads(path.read_bytes())
    except OSError as error:
        raise InvalidInput(
            f"{path}: cannot be read ({error.strerror or error}); give the folder `circlepoint calibrate --out` wrote"
        ) from error
    except ValueError as error:
        raise InvalidInput(f"{path}: is not JSON ({error}); calibrate again, the file was changed") from error
    return calibrated_arm(document, where=str(path))


def calibrated_arm(document: Any, *, where: str = "calibration document") -> CalibratedArm:
    """Return the calibrated arm of a calibration document; raises as `load_result`, naming `where`."""
    if not isinstance(document, Mapping) or document.get("schema") != SCHEMA_NAME:
        found = document.get("schema") if isinstance(document, Mapping) else type(document).__name__
        raise InvalidInput(f"{where}: schema is {found!r}, must be {SCHEMA_NAME!r}; give a result of this program")
    try:
        joints = document["joints"]
        _require_complete(joints, where)
        axes = [_axis(joint) for joint in joints]
        reference = np.array(document["reference_configuration"], dtype=float)
        covariance = _covariance(document, axes)
        name, names = str(document["arm"]), tuple(str(joint["name"]) for joint in joints)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        if isinstance(error, circlepoint.Error):
            raise
        raise InvalidInput(
            f"{where}: is not a whole calibration document ({type(error).__name__}: {error}); calibrate again"
        ) from error
    if reference.shape != (len(axes),):
        raise InvalidInput(f"{where}: reference_configuration has {reference.size} values for {len(axes)} joints")
    description = document.get("description") or {}
    return CalibratedArm(
        name=name,
        joint_names=names,
        chain=circlepoint.ScrewChain(axes, reference),
        covariance=covariance,
        convention=(document.get("dh") or {}).get("convention", "standard"),
        mimics=tuple(document.get("mimics", ())),
        base=description.get("base"),
        tip=description.get("tip"),
    )


def _require_complete(joints: list[Mapping[str, Any]], where: str) -> None:
    missing = [joint for joint in joints if joint["direction_sensor"] is None]
    if missing:
        reasons = "; ".join(f"{joint['name']}: {joint.get('reason') or 'no reason given'}" for joint in missing)
        raise NotIdentifiable(
            f"{where}: {len(missing)} of {len(joints)} joints have no axis, so there is no arm to export "
            f"(nothing was written). {reasons}"
        )
    if not joints:
        raise InvalidInput(f"{where}: has no joints")


def _axis(joint: Mapping[str, Any]) -> circlepoint.ScrewAxis:
    point = joint["point_sensor"] if joint["type"] == "revolute" else (0.0, 0.0, 0.0)
    line = circlepoint.make_line(np.array(joint["direction_sensor"], dtype=float), np.array(point, dtype=float))
    return circlepoint.ScrewAxis(_TYPES[joint["type"]], line)


def _covariance(document: Mapping[str, Any], axes: list[circlepoint.ScrewAxis]) -> NDArray[np.float64]:
    """Return the axes' part of the full matrix, else of each joint's own, in the basis of `tangent_basis`."""
    joints = document["joints"]
    full = document.get("covariance")
    names = [f"{joint['name']}.{coordinate}" for joint in joints for coordinate in LINE_COORDINATES]
    size = len(names)
    covariance = np.zeros((size, size))
    if full is not None and set(names) <= set(full["parameters"]):
        keep = [full["parameters"].index(name) for name in names]
        covariance = np.array(full["matrix"], dtype=float)[np.ix_(keep, keep)]
    else:
        for index, joint in enumerate(joints):
            covariance[4 * index : 4 * index + 4, 4 * index : 4 * index + 4] = joint["covariance"]
    turn = np.zeros((size, size))
    for index, (joint, axis) in enumerate(zip(joints, axes, strict=True)):
        own = circlepoint.tangent_basis(axis.line.direction).T
        rotation = own @ np.array(joint["covariance_basis"], dtype=float).T
        for start in (4 * index, 4 * index + 2):
            turn[start : start + 2, start : start + 2] = rotation
    return turn @ covariance @ turn.T
