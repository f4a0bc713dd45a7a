"""Independent trials in a pool of threads, and what a statistic over ten of them, as the paper's, may come out as.

Trial i of a study takes its seed from (study, i) and nothing else: any number of threads gives the same results. The
core releases the interpreter while it simulates and estimates.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np

import circlepoint
from circlepoint.reproduce.conditions import REPEATS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from circlepoint.reproduce.one_joint import Array

Result = TypeVar("Result")
_groups = 2000  # drawn from the trials to see how a statistic over ten scatters
_level = 0.95


@dataclass(frozen=True)
class Spread:
    """A statistic: its median over groups of ten trials, and the interval that 95 % of the groups lie in."""

    median: float
    low: float
    high: float


@dataclass(frozen=True)
class ErrorSummary:
    """Errors of many trials: as the paper states them, over ten, and over all."""

    trials: int
    max_of_ten: Spread
    std_of_ten: Spread
    rms_of_ten: Spread
    rms: float
    rms_low: float
    rms_high: float
    quantile_95: float
    max: float


class Runner:
    """Runs trials on a number of threads, reporting each study as it begins."""

    def __init__(self, jobs: int, begin: Callable[[str], None]) -> None:
        """Take the number of threads and what to call with a study's name."""
        self._pool = ThreadPoolExecutor(max_workers=jobs)
        self.begin = begin

    def run(self, trial: Callable[[int], Result], seed: int, count: int) -> list[Result]:
        """Return the results of trials 0 to `count` - 1, in order; each is given its own seed."""
        return list(self._pool.map(trial, [circlepoint.derive_seed(seed, i) for i in range(count)]))

    def close(self) -> None:
        """Drop what has not begun."""
        self._pool.shutdown(cancel_futures=True)


def summarise(errors: Sequence[float] | Array, seed: int = 0) -> ErrorSummary:
    """Return the statistics of error magnitudes (N,): groups of ten are drawn without replacement, 2000 times.

    The paper's "standard deviation" over ten tests may be that of the ten magnitudes or the root mean square about the
    truth: both are given. The overall rms carries a bootstrap interval of 95 %.
    """
    values = np.asarray(errors, dtype=float)
    random = np.random.default_rng(seed)
    size = min(REPEATS, len(values))
    groups = values[np.argsort(random.random((_groups, len(values))), axis=1)[:, :size]]
    again = values[random.integers(len(values), size=(_groups, len(values)))]
    low, high = np.quantile(_rms(again), _tails())
    return ErrorSummary(
        trials=len(values),
        max_of_ten=spread_of(groups.max(axis=1)),
        std_of_ten=spread_of(groups.std(axis=1, ddof=1)),
        rms_of_ten=spread_of(_rms(groups)),
        rms=float(_rms(values)),
        rms_low=float(low),
        rms_high=float(high),
        quantile_95=float(np.quantile(values, 0.95)),
        max=float(values.max()),
    )


def spread_of(values: Sequence[float] | Array) -> Spread:
    """Return the median and the central 95 % of values (N,)."""
    low, middle, high = np.quantile(np.asarray(values, dtype=float), (_tails()[0], 0.5, _tails()[1]))
    return Spread(float(middle), float(low), float(high))


def _tails() -> tuple[float, float]:
    return 0.5 * (1.0 - _level), 0.5 * (1.0 + _level)


def _rms(values: Array) -> Array:
    return np.asarray(np.sqrt(np.mean(values**2, axis=-1)))
