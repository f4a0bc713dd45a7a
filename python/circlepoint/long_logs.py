"""Logs that are thinned out while they are read, so that memory does not grow with their length.

A log of more than `MANY_ROWS` rows is read twice: its time stamps alone, which give the clock and the gaps, then all
columns piece by piece. Every m-th tick of the clock is kept, m chosen so that at most `KEPT` rows remain, and no more
than leaves `SLOWEST` Hz. The sensor's readings pass a linear-phase low pass first (no delay: each kept sample is a
weighted mean of the readings on both sides of it); joint positions are kept as the encoders gave them, so that their
steps stay what they are. Missing or jittered rows are interpolated linearly, which at these rates is finer than the
motion. No mean crosses a gap. Every raw value is checked for being finite, and for clipping.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.findings import Finding
from circlepoint.log_table import MANY_ROWS, FloatArray, joined, require_finite
from circlepoint.plausibility import clipping_finding, find_clipped

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from circlepoint.column_map import FileColumns
    from circlepoint.log_table import LogTable

KEPT = 1_250_000
"""Rows that remain at most."""
SLOWEST = 50.0
"""Hz: no rate is reduced below this."""

_HALF = 16  # kept samples on each side that a mean extends over
_CUTOFF = 0.4  # of the kept rate
_WINDOW = 9.0  # Kaiser's beta: 90 dB
_OFF_GRID = 1e-6  # ticks


@dataclass(frozen=True)
class Thinned:
    """What remains of a long log.

    Attributes
    ----------
    data : dict of str to ndarray
        Columns (K,) in the file's units, stamps included.
    timeline : TimelineReport
        Of the stamps as recorded.
    findings : list of Finding
        What was done, and where the sensor was at its range's end.
    """

    data: dict[str, FloatArray]
    timeline: circlepoint.TimelineReport
    findings: list[Finding]


def read_column(table: LogTable, name: str) -> FloatArray:
    """Return one column (N,) read piece by piece."""
    return joined(table.batches([name]), [name])[name]


def thinning_factor(rows: int, sample_rate: float) -> int:
    """Return m of "every m-th row" for a log of this length; 1: all of them."""
    if rows <= MANY_ROWS:
        return 1
    return max(1, min(math.ceil(rows / KEPT), int(sample_rate / SLOWEST)))


def gap_options(factor: int) -> circlepoint.TimelineOptions:
    """Return how gaps are judged in a log that is thinned out: as much time is bridged as in one at the kept rate."""
    return circlepoint.TimelineOptions(max_filled=3 * factor)


def thin(
    table: LogTable,
    names: FileColumns,
    time: FloatArray,
    timeline: circlepoint.TimelineReport,
    *,
    factor: int,
    units: tuple[float, float],
) -> Thinned:
    """Read a long log, keeping every m-th tick.

    Parameters
    ----------
    table : LogTable
        The log.
    names : FileColumns
        Its columns.
    time : ndarray, shape (N,)
        Its stamps, s, in order.
    timeline : TimelineReport
        Of these stamps.
    factor : int
        m.
    units : (float, float)
        s and m/s^2 in the file's units of time and specific force.

    Returns
    -------
    Thinned

    Raises
    ------
    InvalidInput
        At the first value that is empty, not a number or infinite.
    """
    smooth = [*(names.specific_force or ()), *(names.angular_velocity or ())]
    picked = [*(names.joints or ()), *([names.temperature] if names.temperature else [])]
    required = [*(names.joints or ()), *(names.specific_force or ())]
    clipping = _Clipping(names.specific_force or (), units[1])
    sieve = _Sieve(factor, len(smooth), len(picked))
    runs = _runs(time, timeline)
    rows = 0
    for piece in table.batches([*smooth, *picked]):
        size = next(iter(piece.values())).size
        for name in required:
            require_finite(table, name, piece[name], rows)
        clipping.look(piece, time[rows : rows + size])
        values = np.column_stack([piece[name] for name in (*smooth, *picked)])
        for run in runs:
            begin, end = max(run.begin, rows), min(run.end, rows + size)
            if begin < end:
                sieve.take(run, run.ticks(time, begin, end), values[begin - rows : end - rows])
        rows += size
    kept, values = sieve.kept()
    data = {name: np.ascontiguousarray(values[:, index]) for index, name in enumerate([*smooth, *picked])}
    data[names.time] = kept / units[0]
    note = (
        f"{table.label}: {time.size} rows at {timeline.sample_rate:.6g} Hz were thinned out to {kept.size} at "
        f"{timeline.sample_rate / factor:.6g} Hz (low pass at {_CUTOFF * timeline.sample_rate / factor:.3g} Hz)"
    )
    findings = [Finding("thinned", note), *clipping.findings(table.label, time)]
    return Thinned(data, timeline, findings)


@dataclass(frozen=True)
class _Run:
    """Rows between two gaps, and the clock they are on: tick 0 of the log is its first row's."""

    begin: int
    end: int
    start: float  # s, of the run's own tick `first`
    first: int
    rate: float
    missing_at: tuple[tuple[int, int], ...]
    regular: bool

    def ticks(self, time: FloatArray, begin: int, end: int) -> FloatArray:
        """Return where on the clock these rows are: whole ticks unless the stamps are to be believed."""
        if not self.regular:
            ticks: FloatArray = self.first + (time[begin:end] - self.start) * self.rate
            return np.maximum.accumulate(ticks)
        steps = np.arange(begin, end, dtype=float) + (self.first - self.begin)
        for row, missing in self.missing_at:
            steps[max(row - begin, 0) :] += missing if row < end else 0
        return steps


def _runs(time: FloatArray, timeline: circlepoint.TimelineReport) -> list[_Run]:
    rate = timeline.sample_rate
    regular = timeline.rule == circlepoint.StampRule.regularised
    edges = [0, *(int(gap.index) for gap in timeline.gaps if not gap.filled), time.size]
    filled = [(int(gap.index), int(gap.missing)) for gap in timeline.gaps if gap.filled]
    runs = []
    for begin, end in pairwise(edges):
        inside = tuple((row, missing) for row, missing in filled if begin < row < end)
        first = round((time[begin] - time[0]) * rate)
        run = _Run(begin, end, float(time[begin]), first, rate, inside, regular)
        if regular:  # the stamps are rounded: the phase of the clock is their mean
            offset = float(np.mean(time[begin:end] - run.ticks(time, begin, end) / rate))
            run = _Run(begin, end, offset + first / rate, first, rate, inside, regular)
        runs.append(run)
    return runs


@dataclass
class _Sieve:
    """Takes rows in order and keeps every m-th tick of each run."""

    factor: int
    smooth: int
    picked: int
    _pieces: list[tuple[FloatArray, FloatArray]] = field(default_factory=list)
    _run: _Run | None = None
    _buffer: FloatArray = field(default_factory=lambda: np.empty((0, 0)))
    _begin: int = 0  # tick of the buffer's first row
    _last: tuple[float, FloatArray] | None = None  # tick and values of the last row taken

    def __post_init__(self) -> None:
        reach = _HALF * self.factor
        distance = np.arange(-reach, reach + 1) / self.factor
        weights = np.sinc(2 * _CUTOFF * distance) * np.kaiser(2 * reach + 1, _WINDOW)
        self._reach = reach
        self._weights: FloatArray = weights / weights.sum()  # what is constant stays what it is

    def take(self, run: _Run, ticks: FloatArray, values: FloatArray) -> None:
        """Add rows (K, channels) of a run at their ticks (K,)."""
        if run is not self._run:
            self._run, self._last = run, None
            self._begin = math.ceil(ticks[0] - _OFF_GRID)
            self._buffer = np.empty((0, values.shape[1]))
        self._buffer = np.concatenate([self._buffer, self._on_grid(ticks, values)])
        self._last = (float(ticks[-1]), values[-1])
        self._sift(run)

    def kept(self) -> tuple[FloatArray, FloatArray]:
        """Return times (K,), s, and values (K, channels) of what was kept."""
        times = [time for time, _ in self._pieces]
        values = [value for _, value in self._pieces]
        self._pieces = []
        if not times:
            return np.empty(0), np.empty((0, self.smooth + self.picked))
        return np.concatenate(times), np.concatenate(values)

    def _on_grid(self, ticks: FloatArray, values: FloatArray) -> FloatArray:
        following = self._begin + self._buffer.shape[0]
        if ticks[0] == following and ticks[-1] - ticks[0] == ticks.size - 1 and ticks[0] == int(ticks[0]):
            return values
        if self._last is not None:
            ticks = np.concatenate([[self._last[0]], ticks])
            values = np.concatenate([self._last[1][None], values])
        grid = np.arange(following, math.floor(ticks[-1] + _OFF_GRID) + 1)
        return np.column_stack([np.interp(grid, ticks, column) for column in values.T])

    def _sift(self, run: _Run) -> None:
        reach, m = self._reach, self.factor
        first = m * math.ceil((self._begin + reach) / m)
        count = (self._begin + self._buffer.shape[0] - 1 - reach - first) // m + 1
        if count <= 0:
            return
        ticks = first + m * np.arange(count)
        centres = ticks - self._begin
        values = np.empty((count, self._buffer.shape[1]))
        values[:, self.smooth :] = self._buffer[centres, self.smooth :]
        for channel in range(self.smooth):
            windows = np.lib.stride_tricks.sliding_window_view(self._buffer[:, channel], 2 * reach + 1)
            values[:, channel] = windows[first - reach - self._begin :: m][:count] @ self._weights
        self._pieces.append((run.start + (ticks - run.first) / run.rate, values))
        done = int(ticks[-1]) + m - reach - self._begin
        self._buffer = self._buffer[done:].copy()
        self._begin += done


class _Clipping:
    """The extremes of each channel of a log that goes by in pieces, and the samples stuck there."""

    def __init__(self, names: Sequence[str], unit: float) -> None:
        self._names = names
        self._unit = unit  # m/s^2
        self._seen: dict[tuple[str, int], tuple[float, int, int]] = {}  # extreme, samples stuck, first row
        self._rows = 0

    def look(self, piece: dict[str, FloatArray], time: FloatArray) -> None:
        """Look at the next piece."""
        if not self._names:
            return
        force = self._unit * np.column_stack([piece[name] for name in self._names])
        for channel, name in enumerate(self._names):
            for sign in (1, -1):
                extreme = float((sign * force[:, channel]).max())
                known, count, first = self._seen.get((name, sign), (-math.inf, 0, 0))
                if extreme < known:
                    continue
                stuck = find_clipped(force, channel, sign * extreme)
                found = int(stuck.sum())
                if extreme > known:
                    count = 0
                if found and not count:
                    first = self._rows + int(np.argmax(stuck))
                self._seen[name, sign] = (extreme, count + found, first)
        self._rows += time.size

    def findings(self, source: str, time: FloatArray) -> Iterator[Finding]:
        """Yield what was clipped."""
        for (name, sign), (extreme, count, first) in self._seen.items():
            if count:
                yield clipping_finding(
                    source, name, sign * extreme, count=count, rows=self._rows, first=float(time[first])
                )
