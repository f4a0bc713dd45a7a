"""The study in words and cells, the same for Markdown and for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from circlepoint.report.rounding import ABSENT, significant
from circlepoint.reproduce.study import Reproduction, agreement, rows

if TYPE_CHECKING:
    from circlepoint.reproduce.findings import Table
    from circlepoint.reproduce.trials import Spread

TITLE = "The paper, reproduced"
SOURCE = (
    "G. Canepa, J. M. Hollerbach, A. J. M. A. Boelen: Kinematic Calibration by Means of a Triaxial Accelerometer, 1994."
)
COLUMNS = ("section", "what", "paper", "ours, the paper's method", "ours, the best method", "")
VERDICTS = {
    "agrees": "agrees",
    "smaller": "ours is smaller",
    "larger": "ours is larger",
    "no number": ABSENT,
}
ASSUMED = (
    (
        "Arm: seven joints, link lengths assumed (arms/sarcos.yaml); built 1 mm and 3 mrad off its drawing, on a "
        "base of random tilt with every axis at least 30 degrees off gravity."
    ),
    (
        "Handle: 0.5 m as stated, across the last joint's axis (assumed). End stops, the reference configuration: "
        "every joint at -75 degrees (assumed)."
    ),
    "Single-joint trials: axis, gravity and lever in random directions, sensor 0.3 to 0.7 m from the axis (assumed).",
    "Sensor: individuals drawn from the QA700 preset, a limit of the data sheet taken as one standard deviation.",
    "Vibration: stated amplitudes, five random frequencies between 10 and 60 Hz in each direction (assumed).",
    "Dynamic test: one period of eq. (11), 2 s (assumed).",
    "The measured case: 100 Hz, 100 mm/s² of cable noise, 0.3 to 0.4 m (the amounts are assumed).",
    (
        "Method 2 as printed: samples count from 2 % of the peak rate on. The paper says “different from zero”; 2 % "
        "was chosen because its figures come out there."
    ),
    (
        "The acquisition: section 3 with 16 bits and filters of second order (assumed), PD loops of 5 Hz (assumed), a "
        "quarter second of rest recorded around the motion (assumed)."
    ),
    (
        "Best method: for the arm's axes, centres and end-point the whole-arm estimate on one continuous log an arm "
        "(a tenth as many arms); for single joints the regression with its delay estimated."
    ),
    "“Standard deviation” of ten tests is read as the root mean square about the truth.",
)
FIGURES = {
    "figure1": (
        "Figure 1",
        "Frames: O_w on the joint's axis, O_a at the mechanical stop, O_m after the joint has turned by θ.",
    ),
    "figure2": ("Figure 2", "Angles of method 2: the lever b stands a quarter turn behind the velocity v."),
    "figure6": ("Figure 6", "Output of the accelerometer during a static measurement: 150 poses one degree apart."),
    "figure7": (
        "Figure 7",
        "Power spectrum during a dynamic measurement (ten periods), and the bandwidth it suggests.",
    ),
    "figure8": (
        "Figure 8",
        "Output of the accelerometer during a dynamic measurement, Butterworth filter of 20 Hz; vibration below.",
    ),
    "figure9": (
        "Figure 9",
        "Trajectory of the accelerometer in O_w, and how well it is tracked without any position sensor.",
    ),
    "figure10": ("Figure 10", "Angular velocity from the encoder, low-passed at 20 Hz and differentiated."),
    "sweeps": ("Centre error over each condition", "Median over groups of ten; all else as simulated."),
    "bound": ("The bound", "Axis errors of all trials by the plane fit, and the bound of section 4."),
}


class Row(NamedTuple):
    """One statement of the paper with ours beside it."""

    id: str
    section: str
    what: str
    paper: str
    by_paper: str
    by_best: str
    verdict: str
    how: str
    remark: str


def statement_rows(reproduction: Reproduction) -> list[Row]:
    """Return the main table's rows."""
    return [
        Row(
            stated.id,
            stated.section,
            stated.quantity,
            stated.printed,
            cell(ours.paper_method, stated.factor, stated.shown),
            cell(ours.best_method, stated.factor, stated.shown),
            agreement(stated, ours),
            stated.how,
            ours.remark,
        )
        for stated, ours in rows(reproduction)
    ]


def cell(spread: Spread | None, factor: float, unit: str = "") -> str:
    """Return a statistic with its interval as text."""
    if spread is None:
        return ABSENT
    middle, low, high = (number(factor * value) for value in (spread.median, spread.low, spread.high))
    text = middle if low == high == middle else f"{middle} [{low}, {high}]"
    return f"{text} {unit}".strip()


def number(value: float) -> str:
    """Return a number as it is read: three digits, whole from a hundred."""
    if abs(value - round(value)) < 1e-9 * max(1.0, abs(value)):
        return str(round(value))
    return f"{value:.0f}" if abs(value) >= 100.0 else significant(value, 2 if abs(value) < 10.0 else 3)


def table_cells(table: Table) -> list[tuple[str, list[str]]]:
    """Return a table's rows as text."""
    return [(label, [cell(value, table.factor) for value in values]) for label, values in table.rows]


def verdict(reproduction: Reproduction) -> str:
    """Return the study in one sentence."""
    verdicts = [row.verdict for row in statement_rows(reproduction)]
    compared = [each for each in verdicts if each != "no number"]
    agree = compared.count("agrees")
    differ = len(compared) - agree
    return f"{agree} of the paper's {len(compared)} numbers come out within the spread of ours by its own method" + (
        f"; the reason is given for the other {differ}." if differ else "."
    )


def made(reproduction: Reproduction) -> str:
    """Return how the study was made."""
    return (
        f"{reproduction.trials} independent trials of every case (the paper had ten). In brackets: the interval that "
        "95 % of groups of ten trials fall in, unless said otherwise."
    )
