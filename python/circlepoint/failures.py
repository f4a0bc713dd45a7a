"""What to tell a user of a failure, and the exit status it stands for."""

import errno

import circlepoint

DONE = 0
DATA_INSUFFICIENT = 1
BAD_INPUT = 2

_REMEDIES = {
    errno.ENOSPC: "; make room there and run it again",
    errno.EFBIG: "; raise the limit on the size of files, or choose another place, and run it again",
    errno.EDQUOT: "; make room there and run it again",
    errno.EACCES: "; change the permissions there, or choose another place",
    errno.EPERM: "; change the permissions there, or choose another place",
    errno.EROFS: "; choose another place",
}


def explain(error: Exception) -> tuple[str, int]:
    """Return one clear message and the exit status."""
    if isinstance(error, circlepoint.NotIdentifiable | circlepoint.DidNotConverge):
        return str(error), DATA_INSUFFICIENT
    if isinstance(error, circlepoint.Error):
        return str(error), BAD_INPUT
    if isinstance(error, OSError):
        place = f"{error.filename}: " if error.filename else ""
        remedy = _REMEDIES.get(error.errno or 0, "")
        return f"{place}{error.strerror or error}{remedy}", BAD_INPUT
    if isinstance(error, MemoryError):
        return "not enough memory for this recording; split it, or thin it out", BAD_INPUT
    what = f"{type(error).__name__}: {error}"
    return f"a fault in circlepoint itself, please report it: {what} (--debug shows where)", BAD_INPUT
