"""Logs of arms that are built of modules, each with a joint, an accelerometer and a clock, as HEBI's record them.

Columns are numbered base to tip: ``hwt1, q1, a1x, a1y, a1z, w1x ...``. A module's sensor sits in its body, which the
joints before it move and its own does not: of an arm of n joints the sensor of module n + 1 is at the end-point.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from circlepoint.column_names import AXES

if TYPE_CHECKING:
    from circlepoint.arm import Arm
    from circlepoint.column_names import ColumnNames


@dataclass(frozen=True)
class ModuleColumns:
    """The columns of an arm of modules; `notes` say which sensor was taken; `beyond` are joints that do not move it."""

    joints: tuple[str, ...]
    specific_force: tuple[str, ...]
    angular_velocity: tuple[str, ...] | None
    time: str | None
    notes: tuple[str, ...]
    beyond: tuple[int, ...]


def module_columns(names: ColumnNames, arm: Arm) -> ModuleColumns | None:
    """Return the columns of an arm of modules; None where the log is not of one.

    Parameters
    ----------
    names : ColumnNames
        What is there.
    arm : Arm
        Its joints are the first of the modules'.
    """
    joints: list[str] = []
    sensors: dict[int, tuple[str, ...]] = {}
    while found := names.find(f"q{len(joints) + 1}", "q"):
        joints.append(found[0])
        force = _triple(names, f"a{len(joints)}", "a")
        if force is not None:
            sensors[len(joints)] = force
    count = len(arm.joints)
    if len(sensors) < 2 or count > len(joints):
        return None
    number = count + 1 if count + 1 in sensors else max(sensors)
    clock = names.find(f"hwt{number}", "t")
    taken = f"that of module {number} was taken ({', '.join(sensors[number])})"
    moved = f"which joints 1 to {min(number - 1, count)} move"
    notes = [f"{len(sensors)} modules with an accelerometer each: {taken}, {moved}"]
    if number <= count:
        notes.append(f"joint {count} ({arm.joint_names[-1]}) is in the last module and does not move any accelerometer")
    if clock:
        notes.append(f"the clock of module {number} ({clock[0]}) was taken for the whole row")
    return ModuleColumns(
        tuple(joints[:count]),
        sensors[number],
        _triple(names, f"w{number}", "g"),
        clock and clock[0],
        tuple(notes),
        tuple(range(number - 1, count)),
    )


def _triple(names: ColumnNames, stem: str, quantity: str) -> tuple[str, ...] | None:
    found = names.family([f"{stem}{axis}" for axis in AXES], quantity)
    columns = tuple(column for column in found.columns if column is not None)
    return columns if len(columns) == len(AXES) else None
