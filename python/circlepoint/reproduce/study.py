"""The whole study, one part after the other."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from circlepoint.reproduce import accuracy, arm_study, measured, signals
from circlepoint.reproduce.findings import Findings, Ours
from circlepoint.reproduce.registry import STATED, Stated
from circlepoint.reproduce.trials import Runner

if TYPE_CHECKING:
    from collections.abc import Callable

TRIALS = 200
STEPS = 18


@dataclass(frozen=True)
class Reproduction:
    """The study's findings and how they were made."""

    findings: Findings
    trials: int
    seconds: float


def reproduce(trials: int = TRIALS, jobs: int = 2, begin: Callable[[str], None] = lambda _: None) -> Reproduction:
    """Run the paper's study.

    Parameters
    ----------
    trials : int
        Independent trials of each case, at least 10; the paper had ten. The bound takes five times as many.
    jobs : int
        Threads. They change the time, never the numbers.
    begin : callable
        Called with the name of each part as it begins.

    Returns
    -------
    Reproduction
    """
    started = time.monotonic()
    run = Runner(jobs, begin)
    found = Findings()
    try:
        accuracy.axis_table(run, trials, found)
        accuracy.threshold_table(run, trials, found)
        accuracy.iteration_table(run, trials, found)
        accuracy.bound(run, trials, found)
        arm_study.angle_between_axes(run, trials, found)
        measured.causes(run, trials, found)
        measured.vibration_table(run, trials, found)
        measured.improvements(run, trials, found)
        measured.sweeps(run, trials, found)
        arm_study.whole_arm(run, trials, found)
        signals.averaging(run, trials, found)
        signals.spectrum(run, trials, found)
        signals.settings(found)
        signals.figures(found)
        signals.tracking(run, trials, found)
    finally:
        run.close()
    return Reproduction(found, trials, time.monotonic() - started)


def agreement(stated: Stated, ours: Ours) -> str:
    """Return how our value by the paper's method compares: `agrees`, `smaller`, `larger`, or `no number`."""
    value, spread = stated.value, ours.paper_method
    if value is None or spread is None:
        return "no number"
    slack = 0.005 * abs(value)  # the paper prints one or two digits
    if (stated.upper and spread.low <= value + slack) or spread.low - slack <= value <= spread.high + slack:
        return "agrees"
    return "smaller" if spread.high < value else "larger"


def rows(reproduction: Reproduction) -> list[tuple[Stated, Ours]]:
    """Return every statement of the paper with ours beside it."""
    return [(stated, reproduction.findings.ours[stated.id]) for stated in STATED]
