"""Value ± standard uncertainty, rounded as physicists do.

The rule of the Particle Data Group: if the three leading digits of the uncertainty lie between 100 and 354, two digits
are kept; between 355 and 949, one; from 950 it is rounded up to 1000 and two are kept. The value ends at the same
digit.
"""

from __future__ import annotations

import math

PLUS_MINUS = "\N{PLUS-MINUS SIGN}"
MINUS = "\N{MINUS SIGN}"
FREE = "free"
ABSENT = "\N{EN DASH}"
_most_decimals = 9
_smallest_plain, _largest_plain = 1e-6, 1e6


def decimals_of(std: float | None, default: int) -> int:
    """Return how many decimals a value with this standard uncertainty carries."""
    if std is None or not math.isfinite(std) or std <= 0.0:
        return default
    exponent = math.floor(math.log10(std))
    leading = round(std / 10.0 ** (exponent - 2))
    if leading >= 950:
        exponent, digits = exponent + 1, 2
    else:
        digits = 2 if leading < 355 else 1
    return min(max(digits - 1 - exponent, 0), _most_decimals)


def format_value(value: float | None, decimals: int) -> str:
    """Return the value with that many decimals; no negative zero."""
    if value is None:
        return ABSENT
    text = f"{value:.{decimals}f}"
    return text[1:] if text.startswith("-") and float(text) == 0.0 else text


def format_uncertain(value: float | None, std: float | None, default_decimals: int = 3) -> tuple[str, str]:
    """Return value and standard uncertainty with matching digits; without an uncertainty its text is empty."""
    decimals = decimals_of(std, default_decimals)
    if value is None:
        return ABSENT, ""
    return format_value(value, decimals), "" if std is None else format_value(std, decimals)


def format_std(std: float | None) -> str:
    """Return a standard uncertainty by itself, with its one or two digits."""
    return ABSENT if std is None else format_value(std, decimals_of(std, 3))


def significant(value: float | None, digits: int = 2) -> str:
    """Return a number with that many significant digits: in plain notation, unless that is longer than it says."""
    if value is None:
        return ABSENT
    if value == 0.0:
        return "0"
    if not _smallest_plain <= abs(value) < _largest_plain:
        return f"{value:.{digits - 1}e}"
    return format_value(value, max(digits - 1 - math.floor(math.log10(abs(value))), 0))


def align_decimals(texts: list[str]) -> list[str]:
    """Pad numbers on the right so that their decimal points stand under each other when set right-aligned."""

    def tail(text: str) -> int:
        return len(text) - text.index(".") if "." in text else 0

    numeric = [text for text in texts if any(character.isdigit() for character in text)]
    longest = max((tail(text) for text in numeric), default=0)
    return [text + " " * (longest - tail(text)) if any(c.isdigit() for c in text) else text for text in texts]
