"""Denavit-Hartenberg rows, with a Hayati row wherever the next axis is nearly parallel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint.dh_rows import HAYATI_PARAMETERS, row_std
from circlepoint.document import dh_row_entry, plain
from circlepoint.export.form import Export, header
from circlepoint.transforms import inverse

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.export.placement import PlacedArm

FORMULA = (
    "T_base_sensor(q) = base T_1(q_1) ... T_n(q_n) tool, "
    "T_i = Rz(theta_i + q_i) Tz(d_i) Tx(a_i) Rx(alpha_i) Ry(beta_i); "
    "a row of form dh has beta = 0, one of form hayati d = 0; a prismatic joint adds q to d instead"
)


@dataclass(frozen=True)
class HayatiParameters:
    """Rows with their standard deviations, the nominal arm in the same form; in the arm's base frame."""

    chain: circlepoint.HayatiChain
    nominal: circlepoint.HayatiChain | None
    std: NDArray[np.float64]
    """(n, 5) a, alpha, d, theta, beta."""
    free: NDArray[np.bool_]
    """(n, 5)"""


def export_hayati(placed: PlacedArm, notes: tuple[str, ...] = (), asked: str = "hayati") -> Export:
    """Return mixed Denavit-Hartenberg and Hayati rows.

    Parameters
    ----------
    placed : PlacedArm
    notes : tuple of str
        Why this form, where another was asked for.
    asked : str
        The form that was asked for.
    """
    found = hayati_parameters(placed)
    document = header(placed, "hayati", notes) | {
        "asked_for": asked,
        "formula": FORMULA,
        "rows": [_row(found, index, name) for index, name in enumerate(placed.arm.joint_names)],
        "base": plain(np.asarray(found.chain.base)),
        "tool": plain(np.asarray(found.chain.tool)),
        "frames": "tool is the sensor in the last row's frame. The last row is nominal (or zero): its frame is the "
        "nominal flange. A controller without a base transform leaves base out: row 1's frame is then the base.",
    }
    return Export("hayati", document, notes=notes)


def hayati_parameters(placed: PlacedArm) -> HayatiParameters:
    """Return the calibrated rows and, where there is a nominal arm, its rows in the same forms."""
    chain, base = placed.arm.chain, inverse(placed.T_base_sensor)
    types = placed.arm.joint_types
    nominal = hint = None
    if placed.nominal is not None:
        own = placed.nominal.dh
        branch = own if isinstance(own, circlepoint.StandardDhChain) else None
        forms = [row.form for row in circlepoint.to_hayati(chain).chain.rows]
        nominal = circlepoint.to_hayati(placed.nominal.chain(placed.arm.reference), branch, forms=forms).chain
        rows = [circlepoint.DhRow(row.a, row.alpha, row.d, row.theta) for row in nominal.rows]
        hint = circlepoint.StandardDhChain(rows, types, base @ nominal.base, placed.T_tip_sensor)
    found = circlepoint.to_hayati(chain, hint)
    return HayatiParameters(
        circlepoint.HayatiChain(found.chain.rows, types, placed.T_base_sensor @ found.chain.base, found.chain.tool),
        nominal,
        row_std(chain, found, placed.arm.covariance),
        np.asarray(found.free, dtype=bool),
    )


def row_values(row: circlepoint.HayatiRow) -> tuple[float, ...]:
    """Return a, alpha, d, theta, beta."""
    return (row.a, row.alpha, row.d, row.theta, row.beta)


def absent_parameter(row: circlepoint.HayatiRow) -> str:
    """Return the parameter a row does not have."""
    return "beta" if row.form == circlepoint.RowForm.dh else "d"


def _row(found: HayatiParameters, index: int, name: str) -> dict[str, Any]:
    row = found.chain.rows[index]
    values = dict(zip(HAYATI_PARAMETERS, row_values(row), strict=True))
    entry: dict[str, Any] = {"joint": name, "form": row.form.name}
    entry |= dh_row_entry(values, found.std[index], found.free[index])
    del entry["std"][absent_parameter(row)]
    if found.nominal is not None:
        expected = dict(zip(HAYATI_PARAMETERS, row_values(found.nominal.rows[index]), strict=True))
        entry["nominal"] = {key: expected[key] for key in HAYATI_PARAMETERS}
        moves = "theta" if found.chain.types[index] == circlepoint.JointType.revolute else "d"
        entry["joint_offset"] = values[moves] - expected[moves]
    return entry
