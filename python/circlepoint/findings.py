"""What is suspicious but legal: said, never silently repaired and never fatal."""

from collections.abc import Sequence
from dataclasses import dataclass

_GAPS_SHOWN = 3


@dataclass(frozen=True)
class Finding:
    """One observation about the data that the reader of a result should know.

    Attributes
    ----------
    code : str
        Stable name for programs, such as ``"gap"`` or ``"clipping"``.
    message : str
        One sentence or two: what was seen, where, how large, and what to do about it.
    joint : str or None
        Name of the joint it concerns, where it concerns one.
    """

    code: str
    message: str
    joint: str | None = None


def few_gaps(messages: Sequence[str]) -> list[str]:
    """Return messages with the first gaps only: a screen is for what matters."""
    gaps = [message for message in messages if ": a gap of " in message]
    if len(gaps) <= _GAPS_SHOWN:
        return list(messages)
    left_out = set(gaps[_GAPS_SHOWN:])
    more = f"{len(gaps) - _GAPS_SHOWN} more gaps (--json lists all)"
    return [*(message for message in messages if message not in left_out), more]
