"""Nominal chains from an arm's description."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint._core import InvalidInput

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from circlepoint.arm import Arm, NominalLines

DhChain = circlepoint.StandardDhChain | circlepoint.ModifiedDhChain


def joint_types(arm: Arm) -> list[circlepoint.JointType]:
    """Return the joint types, base to tip."""
    return [
        circlepoint.JointType.revolute if joint.revolute else circlepoint.JointType.prismatic for joint in arm.joints
    ]


def nominal_dh_chain(arm: Arm) -> DhChain | None:
    """Return the arm's nominal Denavit-Hartenberg chain, base and tool at identity; None without nominal rows."""
    if arm.dh is None:
        return None
    kind = circlepoint.StandardDhChain if arm.dh.convention == "standard" else circlepoint.ModifiedDhChain
    rows = [circlepoint.DhRow(row.a, row.alpha, row.d, row.theta) for row in arm.dh.rows]
    return kind(rows, joint_types(arm))


def nominal_chain(arm: Arm, reference_configuration: ArrayLike) -> circlepoint.ScrewChain:
    """Return the arm's nominal axes in its base frame, at a reference configuration.

    Parameters
    ----------
    arm : Arm
        With nominal Denavit-Hartenberg rows or lines.
    reference_configuration : array_like, shape (n,)
        rad or m.

    Raises
    ------
    InvalidInput
        When the arm has neither.
    """
    reference = np.ascontiguousarray(reference_configuration, dtype=float)
    chain = nominal_dh_chain(arm)
    if chain is not None:
        return circlepoint.to_screws(chain, reference, circlepoint.BaseFrame.chain_base)
    if arm.lines is None:
        raise InvalidInput(f"arm {arm.name!r} has no nominal `dh` or `lines`; add them to the arm's description")
    return _moved(_line_chain(arm, arm.lines), reference)


def _line_chain(arm: Arm, lines: NominalLines) -> circlepoint.ScrewChain:
    axes = [
        circlepoint.ScrewAxis(type=kind, line=circlepoint.make_line(np.array(row.direction), np.array(row.point)))
        for kind, row in zip(joint_types(arm), lines.rows, strict=True)
    ]
    home = np.eye(4) if lines.tip is None else np.array(lines.tip)
    return circlepoint.ScrewChain(axes, np.array(lines.reference_configuration), home)


def _moved(chain: circlepoint.ScrewChain, reference: NDArray[np.float64]) -> circlepoint.ScrewChain:
    """Return the same chain in the same base frame, its joints standing elsewhere."""
    pose = np.eye(4)
    axes = []
    for axis, turn in zip(chain.axes, reference - chain.reference_configuration, strict=True):
        axes.append(circlepoint.ScrewAxis(type=axis.type, line=circlepoint.transform(pose, axis.line)))
        pose = pose @ circlepoint.screw_exp(axis, float(turn))
    return circlepoint.ScrewChain(axes, reference, pose @ chain.home)
