"""Denavit-Hartenberg parameters, standard and modified; Hayati rows instead where neighbours are nearly parallel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import circlepoint
from circlepoint.arm import DH_PARAMETERS
from circlepoint.dh_rows import nearly_parallel, row_std
from circlepoint.document import dh_row_entry, plain
from circlepoint.export.form import Export, header
from circlepoint.export.hayati import export_hayati
from circlepoint.transforms import inverse, rigid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.export.placement import PlacedArm
    from circlepoint.nominal import DhChain

Convention = Literal["standard", "modified"]
_FORMS: dict[Convention, str] = {"standard": "dh", "modified": "mdh"}
_FORMULAS = {
    "standard": "T_i = Rz(theta_i + q_i) Tz(d_i) Tx(a_i) Rx(alpha_i)",
    "modified": "T_i = Rx(alpha_i) Tx(a_i) Rz(theta_i + q_i) Tz(d_i)",
}
PRODUCT = "T_base_sensor(q) = base T_1(q_1) ... T_n(q_n) tool"
PRISMATIC_RULE = "a prismatic joint adds q to d instead"


@dataclass(frozen=True)
class DhParameters:
    """Rows in one convention with their standard deviations; base and tool in the arm's base frame."""

    chain: DhChain
    nominal: DhChain | None
    std: NDArray[np.float64]
    """(n, 4) a, alpha, d, theta; nan without a derivative."""
    free: NDArray[np.bool_]
    """(n, 4)"""


def export_dh(placed: PlacedArm, convention: Convention = "standard") -> Export:
    """Return Denavit-Hartenberg rows, or Hayati rows where neighbouring axes are nearly parallel.

    Parameters
    ----------
    placed : PlacedArm
    convention : {"standard", "modified"}
    """
    names = placed.arm.joint_names
    near = [(names[i], names[i + 1], angle) for i, angle in nearly_parallel(placed.arm.chain.axes)]
    if near:
        pairs = ", ".join(f"{first} and {second} ({math.degrees(angle):.3g} deg)" for first, second, angle in near)
        note = (
            f"{convention} Denavit-Hartenberg parameters were asked for; the axes of {pairs} are nearly parallel, "
            "their common normal is far away and d would be a length of the order of gap / angle: these rows are "
            "Hayati rows (beta instead of d)"
        )
        return export_hayati(
            placed,
            notes=(note,),
            asked=_FORMS[convention],
        )
    found = dh_parameters(placed, convention)
    return Export(
        _FORMS[convention],
        header(placed, _FORMS[convention])
        | {
            "convention": convention,
            "formula": f"{PRODUCT}, {_FORMULAS[convention]}; {PRISMATIC_RULE}",
            "rows": [_row(found, index, name) for index, name in enumerate(names)],
            "base": plain(np.asarray(found.chain.base)),
            "tool": plain(np.asarray(found.chain.tool)),
            "frames": "tool is the sensor in the last row's frame. The last row is nominal (or zero): its frame is the "
            "nominal flange. A controller without a base transform leaves base out: row 1's frame is then the base.",
        },
    )


def dh_parameters(placed: PlacedArm, convention: Convention) -> DhParameters:
    """Return the rows of a convention, on the branch of the nominal rows where there are any."""
    chain = placed.arm.chain
    nominal = nominal_rows(placed, convention)
    if convention == "standard":
        options = nominal if isinstance(nominal, circlepoint.StandardDhChain) else None
        standard = circlepoint.to_standard_dh(chain, options)
        rows: DhChain = standard.chain
        free, std = standard.free, row_std(chain, standard, placed.arm.covariance)
        moved: DhChain = circlepoint.StandardDhChain(rows.rows, rows.types, placed.T_base_sensor @ rows.base, rows.tool)
    else:
        options_modified = nominal if isinstance(nominal, circlepoint.ModifiedDhChain) else None
        modified = circlepoint.to_modified_dh(chain, options_modified)
        rows = modified.chain
        free, std = modified.free, row_std(chain, modified, placed.arm.covariance)
        moved = circlepoint.ModifiedDhChain(rows.rows, rows.types, placed.T_base_sensor @ rows.base, rows.tool)
    return DhParameters(moved, nominal, std, np.asarray(free, dtype=bool))


def nominal_rows(placed: PlacedArm, convention: Convention) -> DhChain | None:
    """Return the nominal arm in a convention, base and tool such that it lies on the calibrated one; None without."""
    nominal = placed.nominal
    if nominal is None:
        return None
    base = inverse(placed.T_base_sensor)
    own = nominal.dh
    # A nominal arm of another convention, or of none, is converted: its own branch then counts for nothing.
    if convention == "standard":
        if isinstance(own, circlepoint.StandardDhChain):
            rows, frame = own.rows, rigid()
        else:
            found = circlepoint.to_standard_dh(nominal.chain(placed.arm.reference)).chain
            rows, frame = found.rows, np.asarray(found.base)
        return circlepoint.StandardDhChain(rows, placed.arm.joint_types, base @ frame, placed.T_tip_sensor)
    if isinstance(own, circlepoint.ModifiedDhChain):
        rows, frame = own.rows, rigid()
    else:
        converted = circlepoint.to_modified_dh(nominal.chain(placed.arm.reference)).chain
        rows, frame = converted.rows, np.asarray(converted.base)
    return circlepoint.ModifiedDhChain(rows, placed.arm.joint_types, base @ frame, placed.T_tip_sensor)


def _row(found: DhParameters, index: int, name: str) -> dict[str, Any]:
    row = found.chain.rows[index]
    values = (row.a, row.alpha, row.d, row.theta)
    named = dict(zip(DH_PARAMETERS, values, strict=True))
    entry: dict[str, Any] = {"joint": name, **dh_row_entry(named, found.std[index], found.free[index])}
    if found.nominal is not None:
        nominal = found.nominal.rows[index]
        expected = (nominal.a, nominal.alpha, nominal.d, nominal.theta)
        entry["nominal"] = dict(zip(DH_PARAMETERS, expected, strict=True))
        moves = 3 if found.chain.types[index] == circlepoint.JointType.revolute else 2
        entry["joint_offset"] = values[moves] - expected[moves]
    return entry
