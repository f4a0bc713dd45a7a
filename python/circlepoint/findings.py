"""What is suspicious but legal: said, never silently repaired and never fatal."""

from dataclasses import dataclass


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
