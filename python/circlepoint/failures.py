"""What to tell a user of a failure, and the exit status it stands for."""

import circlepoint

DONE = 0
DATA_INSUFFICIENT = 1
BAD_INPUT = 2


def explain(error: Exception) -> tuple[str, int]:
    """Return one clear message and the exit status."""
    if isinstance(error, circlepoint.NotIdentifiable | circlepoint.DidNotConverge):
        return str(error), DATA_INSUFFICIENT
    if isinstance(error, circlepoint.Error):
        return str(error), BAD_INPUT
    if isinstance(error, OSError):
        place = f"{error.filename}: " if error.filename else ""
        return f"{place}{error.strerror or error}", BAD_INPUT
    if isinstance(error, MemoryError):
        return "not enough memory for this recording; split it, or thin it out", BAD_INPUT
    what = f"{type(error).__name__}: {error}"
    return f"a fault in circlepoint itself, please report it: {what} (--debug shows where)", BAD_INPUT
