"""Nominal chains from an arm's description."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint._core import InvalidInput

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from circlepoint.arm import Arm

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
        With nominal Denavit-Hartenberg rows.
    reference_configuration : array_like, shape (n,)
        rad or m.

    Raises
    ------
    InvalidInput
        When the arm has no nominal rows.
    """
    chain = nominal_dh_chain(arm)
    if chain is None:
        raise InvalidInput(f"arm {arm.name!r} has no nominal `dh`; add its rows to the arm's description")
    reference = np.ascontiguousarray(reference_configuration, dtype=float)
    return circlepoint.to_screws(chain, reference, circlepoint.BaseFrame.chain_base)
