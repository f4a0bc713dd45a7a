"""Long recordings as short lines: what a figure of this width can show, and nothing across gaps."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from circlepoint.report.inputs import Array


def contiguous(time: Array, sample_rate: float) -> list[slice]:
    """Return the pieces of a recording between gaps longer than one and a half samples."""
    if len(time) == 0:
        return []
    breaks = np.flatnonzero(np.diff(time) > 1.5 / sample_rate) + 1
    edges = [0, *breaks.tolist(), len(time)]
    return [slice(begin, end) for begin, end in pairwise(edges)]


def decimate(time: Array, values: Array, buckets: int) -> tuple[Array, Array]:
    """Keep each bucket's lowest and highest sample, in their order, so that no peak is lost."""
    if len(time) <= 2 * buckets:
        return time, values
    keep: list[int] = [0]
    edges = np.linspace(0, len(time), buckets + 1).astype(int)
    for begin, end in pairwise(edges):
        piece = values[begin:end]
        keep += sorted({begin + int(np.argmin(piece)), begin + int(np.argmax(piece))})
    keep.append(len(time) - 1)
    chosen = np.unique(keep)
    return time[chosen], values[chosen]


def broken_line(time: Array, values: Array, sample_rate: float, buckets: int) -> tuple[Array, Array]:
    """Decimate each contiguous piece; pieces are joined by a NaN, where a plotted line breaks."""
    pieces = contiguous(time, sample_rate)
    times, kept = [], []
    for piece in pieces:
        share = max(2, round(buckets * (piece.stop - piece.start) / len(time)))
        t, v = decimate(time[piece], values[piece], share)
        times += [t, t[-1:]]
        kept += [v, np.array([np.nan])]
    return (np.concatenate(times), np.concatenate(kept)) if pieces else (time, values)
