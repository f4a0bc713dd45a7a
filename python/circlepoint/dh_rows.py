"""Lines to Denavit-Hartenberg rows, with Hayati rows where neighbours are nearly parallel; the rows' uncertainty."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.arm import DH_PARAMETERS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from circlepoint.nominal import DhChain

DhConversion = circlepoint.StandardDhConversion | circlepoint.ModifiedDhConversion | circlepoint.HayatiConversion

HAYATI_PARAMETERS = (*DH_PARAMETERS, "beta")
NEAR_PARALLEL = 0.05
"""rad; between axes within it a common normal is far away, and a row magnifies their errors by one over its sine."""
EXACTLY_PARALLEL = 1e-8
"""rad; neighbours within it have as many common normals as one likes: one is chosen."""


def neighbour_angles(axes: Sequence[circlepoint.ScrewAxis]) -> list[float]:
    """Return the angle that each axis and the next enclose, undirected, rad."""
    angles = []
    for first, second in pairwise(axes):
        u, v = np.asarray(first.line.direction), np.asarray(second.line.direction)
        angles.append(float(np.arctan2(np.linalg.norm(np.cross(u, v)), abs(u @ v))))
    return angles


def nearly_parallel(axes: Sequence[circlepoint.ScrewAxis]) -> list[tuple[int, float]]:
    """Return which axes are nearly, and not exactly, parallel to the next, and by which angle, rad."""
    return [
        (index, angle)
        for index, angle in enumerate(neighbour_angles(axes))
        if EXACTLY_PARALLEL <= angle < NEAR_PARALLEL
    ]


def to_rows(chain: circlepoint.ScrewChain, nominal: DhChain | None) -> DhConversion:
    """Return a chain's rows in the convention of the nominal ones (standard without), on their branch.

    Where neighbours are nearly parallel, the rows are standard ones with Hayati rows between.
    """
    if nearly_parallel(chain.axes):
        branch = nominal if isinstance(nominal, circlepoint.StandardDhChain) else None
        return circlepoint.to_hayati(chain, branch, NEAR_PARALLEL)
    if isinstance(nominal, circlepoint.ModifiedDhChain):
        return circlepoint.to_modified_dh(chain, nominal)
    return circlepoint.to_standard_dh(chain, nominal)


def row_parameters(conversion: DhConversion) -> tuple[str, ...]:
    """Return the names of the parameters of a row."""
    return HAYATI_PARAMETERS if isinstance(conversion, circlepoint.HayatiConversion) else DH_PARAMETERS


def row_std(
    chain: circlepoint.ScrewChain, conversion: DhConversion, covariance: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the standard deviation of each row's parameters, (n, 4) or (n, 5); NaN where there is no derivative.

    Parameters
    ----------
    chain : ScrewChain
        What was converted.
    conversion : DhConversion
        Its rows.
    covariance : ndarray, shape (4 n, 4 n)
        Of the axes' local coordinates.
    """
    if isinstance(conversion, circlepoint.HayatiConversion):
        jacobian = circlepoint.hayati_parameter_jacobian(chain, conversion)
    else:
        jacobian = circlepoint.dh_parameter_jacobian(chain, conversion)
    variance = np.einsum("ij,jk,ik->i", jacobian, covariance, jacobian)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)).reshape(-1, len(row_parameters(conversion))))
