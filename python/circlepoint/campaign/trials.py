"""A batch of trials: run by the core, returned as the table that is written."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

import circlepoint

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from circlepoint.arm import Arm
    from circlepoint.campaign.config import Batch, Campaign, Cell

LINE_COORDINATES = ("d1", "d2", "p1", "p2")
SENSOR_FIGURES = tuple(circlepoint.sensor_figure_names())
STD = "_std"
NEES = "nees"
END_POINT = "end_point"
_kept_conditions = 4


class TrialRunner:
    """Runs a campaign's batches; the conditions of the cells used last are kept at hand."""

    def __init__(self, campaign: Campaign) -> None:
        """Take the campaign."""
        self._campaign = campaign
        self._conditions = functools.lru_cache(maxsize=_kept_conditions)(lambda cell: campaign.cells[cell].conditions())

    def run(self, batch: Batch, threads: int = 1, progress: Callable[[int], None] | None = None) -> pa.Table:
        """Return a batch's results.

        Parameters
        ----------
        batch : Batch
        threads : int
            Of the core; they change the time, not the table.
        progress : callable, optional
            Called with the number of trials done.
        """
        seeds = self._campaign.seeds(batch)
        results = circlepoint.run_trials(self._conditions(batch.cell), seeds, threads, progress)
        return batch_table(batch, self._campaign.cells[batch.cell], seeds, results)


def line_columns(arm: Arm) -> list[tuple[int, str]]:
    """Return the columns of line errors: place among the core's 4 n, and name; a prismatic joint has no point."""
    return [
        (4 * index + k, f"{joint.name}.{coordinate}")
        for index, joint in enumerate(arm.joints)
        for k, coordinate in enumerate(LINE_COORDINATES)
        if joint.revolute or k < 2
    ]


def batch_table(batch: Batch, cell: Cell, seeds: list[int], results: circlepoint.TrialResults) -> pa.Table:
    """Return results as a table, a row a trial; errors (estimate minus truth) in SI units."""
    columns: dict[str, pa.Array] = {
        "cell": pa.array([batch.cell] * batch.trials, pa.int32()),
        "trial": pa.array(range(batch.begin, batch.end), pa.int64()),
        "seed": pa.array(seeds, pa.uint64()),
        "outcome": pa.array([outcome.name for outcome in results.outcome], pa.string()),
        "reason": pa.array([reason or None for reason in results.reason], pa.string()),
        "converged": pa.array(results.converged, pa.bool_()),
        "iterations": pa.array(results.iterations, pa.int32()),
    }
    for place, name in line_columns(cell.arm):
        columns[name] = _figures(results.line_error[:, place])
        columns[name + STD] = _figures(results.line_std[:, place])
    for index, joint in enumerate(cell.arm.joints):
        columns[f"{joint.name}.{NEES}"] = _figures(results.line_nees[:, index])
    for place, name in enumerate(SENSOR_FIGURES):
        columns[name] = _figures(results.sensor_error[:, place])
        columns[name + STD] = _figures(results.sensor_std[:, place])
    columns[END_POINT] = _figures(results.end_point_error)
    columns[END_POINT + STD] = _figures(results.end_point_std)
    return pa.table(columns)


def _figures(values: NDArray[np.float64]) -> pa.Array:
    return pa.array(values, pa.float64(), mask=np.isnan(values))
