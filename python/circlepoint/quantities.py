"""What a log's columns were taken for: quantity, unit, and why that unit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from circlepoint.arm import Arm
    from circlepoint.clocks import Log


@dataclass(frozen=True)
class Quantity:
    """One quantity of a log.

    Attributes
    ----------
    name : str
        ``"time"``, ``"still poses"``, ``"joints"``, ``"specific force"``, ``"gyroscope"`` or ``"temperature"``.
    columns : tuple of str
        As they are in the file.
    unit : str
        What the values were taken to be in.
    reason : str
        Why.
    """

    name: str
    columns: tuple[str, ...]
    unit: str
    reason: str


def quantities(log: Log, arm: Arm) -> tuple[Quantity, ...]:
    """Return what each column of a log was taken for, with the reason for its unit.

    Parameters
    ----------
    log : Log
        As read.
    arm : Arm
        The arm whose joints it holds.
    """
    names = log.columns
    if names.static:
        found = [Quantity("still poses", (names.time,), "numbers", "there is no time")]
    else:
        why = f"steps of {1e3 / log.timeline.sample_rate:.4g} ms"
        found = [_quantity(log, "time", (names.time,), ("t", "s"), why)]
    if log.joint_positions is not None and names.joints:
        found.append(_joint_quantity(log, arm, names.joints, log.joint_positions))
    if log.specific_force is not None and names.specific_force:
        magnitude = float(np.median(np.linalg.norm(log.specific_force, axis=1)))
        why = f"median magnitude {magnitude:.3f} m/s^2 is near gravity"
        found.append(_quantity(log, "specific force", names.specific_force, ("a", "m/s^2"), why))
    if log.angular_velocity is not None and names.angular_velocity:
        why = f"largest {np.abs(log.angular_velocity).max():.3g} rad/s"
        found.append(_quantity(log, "gyroscope", names.angular_velocity, ("g", "rad/s"), why))
    if log.temperature is not None and names.temperature:
        found.append(_quantity(log, "temperature", (names.temperature,), ("temp", "C"), "the default"))
    return tuple(found)


def _joint_quantity(log: Log, arm: Arm, columns: tuple[str, ...], positions: np.ndarray) -> Quantity:
    revolute = [index for index, joint in enumerate(arm.joints) if joint.revolute]
    units = [log.units.get(f"q{index + 1}") for index in range(len(arm.joints))]
    if any(units):
        unit = ", ".join(dict.fromkeys(unit or log.units.get("q", "SI") for unit in units))
        return Quantity("joints", columns, unit, _stated(log, "q1"))
    default = "rad, m" if 0 < len(revolute) < len(arm.joints) else "rad" if revolute else "m"
    if revolute:
        low, high = float(positions[:, revolute].min()), float(positions[:, revolute].max())
        why = f"values {low:.3g} to {high:.3g}"
    else:
        why = f"{positions.min():.3g} to {positions.max():.3g}"
    return _quantity(log, "joints", columns, ("q", default), why)


def _quantity(log: Log, name: str, columns: tuple[str, ...], key_default: tuple[str, str], why: str) -> Quantity:
    key, default = key_default
    if key in log.units:
        return Quantity(name, columns, log.units[key], _stated(log, key))
    return Quantity(name, columns, default, why)


def _stated(log: Log, key: str) -> str:
    written = log.columns.units.get(key)
    return "written in the column's name" if written and written == log.units.get(key) else "stated in the column map"
