"""What a study comes to: a value beside each of the paper's, tables that show why, and the signals the figures draw."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from circlepoint.reproduce.trials import Spread


@dataclass(frozen=True)
class Ours:
    """Our value of something the paper states, SI."""

    paper_method: Spread | None = None
    """By the paper's own method (as printed, errata corrected)."""
    best_method: Spread | None = None
    """By the whole-arm estimate where there is an arm, by the regression for a joint by itself."""
    trials: int = 0
    remark: str = ""
    """What was found: how the two compare, and why where they differ."""


@dataclass(frozen=True)
class Table:
    """Conditions against what they do: every cell is a statistic with the interval of 95 % of groups of ten."""

    id: str
    title: str
    explanation: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[Spread | None, ...]], ...]
    unit: str
    """Of what is shown, `mrad`."""
    factor: float
    """From SI to that."""


@dataclass
class Findings:
    """Everything found, filled by one study after the other."""

    ours: dict[str, Ours] = field(default_factory=dict)
    """By the id of the paper's statement (`registry`)."""
    tables: list[Table] = field(default_factory=list)
    signals: dict[str, Any] = field(default_factory=dict)
    """What the figures draw, by figure."""


def exactly(value: float) -> Spread:
    """Return a value that does not scatter."""
    return Spread(value, value, value)
