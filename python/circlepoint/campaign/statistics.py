"""Statistics of trials, gathered some at a time in constant memory.

Everything is a sum over trials, added in their order and as many at a time, so that the same batches give the same
bits. Figures of one trial depend on each other (its joints share a sensor and a recording); trials do not. Intervals
are therefore those of means over trials, and a share over several parameters counts as as many independent observations
as its scatter from trial to trial says.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEVELS = (0.68, 0.95)
"""Central intervals whose coverage is counted."""
CONFIDENCE = 0.95
"""Of the intervals given with every statistic."""
_z = NormalDist().inv_cdf(0.5 * (1.0 + CONFIDENCE))
_limits = tuple(NormalDist().inv_cdf(0.5 * (1.0 + level)) for level in LEVELS)


@dataclass(frozen=True)
class Interval:
    """A statistic with the interval of 95 % it is known to; None where a single trial does not say."""

    value: float
    low: float | None
    high: float | None


class MeanOfTrials:
    """The mean of one figure a trial, and how well it is known."""

    def __init__(self) -> None:
        """Begin with no trial."""
        self.count = 0
        self._sum = 0.0
        self._squares = 0.0

    def add(self, values: NDArray[np.float64]) -> None:
        """Add trials (N,); those that are not a number are left out."""
        known = values[~np.isnan(values)]
        self.count += len(known)
        self._sum += float(np.sum(known))
        self._squares += float(np.sum(known**2))

    @property
    def mean(self) -> float:
        """Mean over the trials; NaN without any."""
        return self._sum / self.count if self.count else math.nan

    @property
    def variance(self) -> float:
        """Of one trial; NaN with fewer than two."""
        if self.count < 2:
            return math.nan
        return max(self._squares - self.count * self.mean**2, 0.0) / (self.count - 1)

    def interval(self) -> Interval | None:
        """Return the mean with its interval; None without a trial."""
        if not self.count:
            return None
        if self.count == 1:
            return Interval(self.mean, None, None)
        half = _z * math.sqrt(self.variance / self.count)
        return Interval(self.mean, self.mean - half, self.mean + half)

    def root(self) -> Interval | None:
        """Return the root of the mean (of squares), with the interval's ends taken likewise."""
        mean = self.interval()
        return mean and Interval(_root(mean.value), mean.low and _root(mean.low), mean.high and _root(mean.high))


class ErrorStatistics:
    """Errors of one parameter, or of a group of parameters of the same kind, with their predicted deviations."""

    def __init__(self) -> None:
        """Begin with no trial."""
        self._error = MeanOfTrials()
        self._square = MeanOfTrials()
        self._variance = MeanOfTrials()
        self._nees = MeanOfTrials()
        self._inside = tuple(MeanOfTrials() for _ in LEVELS)
        self._observations = 0

    def add(self, error: NDArray[np.float64], std: NDArray[np.float64]) -> None:
        """Add trials: errors and standard deviations (N, K), NaN where there is none.

        A deviation of zero says that the parameter was taken as known: it has no interval to be inside of.
        """
        self._error.add(_row_mean(error))
        self._square.add(_row_mean(error**2))
        self._variance.add(_row_mean(np.where(np.isnan(error), np.nan, std**2)))
        normalised = np.abs(error) / np.where(std > 0.0, std, np.nan)
        known = ~np.isnan(normalised)
        self._observations += int(np.count_nonzero(known))
        self._nees.add(_row_mean(normalised**2))
        for inside, limit in zip(self._inside, _limits, strict=True):
            inside.add(_row_mean(np.where(known, normalised <= limit, np.nan)))

    @property
    def trials(self) -> int:
        """Trials that have it."""
        return self._square.count

    def bias(self) -> Interval | None:
        """Return the mean error."""
        return self._error.interval()

    def rmse(self) -> Interval | None:
        """Return the root mean square error."""
        return self._square.root()

    def predicted(self) -> float | None:
        """Return the root mean square of the predicted deviations."""
        return math.sqrt(self._variance.mean) if self._variance.count else None

    def nees(self) -> Interval | None:
        """Return the mean of (error / deviation)^2; 1 is honest."""
        return self._nees.interval()

    def coverage(self) -> list[Interval | None]:
        """Return the share of true values inside their intervals of each of `LEVELS`, with Wilson's interval."""
        return [self._share(inside) for inside in self._inside]

    def _share(self, inside: MeanOfTrials) -> Interval | None:
        if not inside.count:
            return None
        share = inside.mean
        independent = float(inside.count)
        if self._observations > inside.count and inside.count > 1 and inside.variance > 0.0:
            by_scatter = share * (1.0 - share) / (inside.variance / inside.count)
            independent = min(max(by_scatter, independent), float(self._observations))
        return wilson(share, independent)


def wilson(share: float, observations: float) -> Interval:
    """Return a share of so many independent observations with Wilson's score interval."""
    squared = _z**2 / observations
    middle = (share + 0.5 * squared) / (1.0 + squared)
    half = _z / (1.0 + squared) * math.sqrt(share * (1.0 - share) / observations + 0.25 * squared / observations)
    return Interval(share, max(middle - half, 0.0), min(middle + half, 1.0))


def _root(value: float) -> float:
    return math.sqrt(max(value, 0.0))


def _row_mean(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean of each row over what is a number in it; NaN where nothing is."""
    known = ~np.isnan(values)
    count = np.count_nonzero(known, axis=1)
    total = np.sum(np.where(known, values, 0.0), axis=1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)
