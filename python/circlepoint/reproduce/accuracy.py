"""Section 4: axis direction, centre of rotation, its iterations, and the bound."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.report.rounding import significant
from circlepoint.reproduce.conditions import ENVIRONMENT_STD, WORST_ERROR, Conditions, only
from circlepoint.reproduce.estimates import (
    BEST,
    METHODS,
    NOT_ZERO,
    Centre,
    JointErrors,
    angle_between,
    chart_axis,
    evaluate,
    static_axis,
)
from circlepoint.reproduce.findings import Findings, Ours, Table, exactly
from circlepoint.reproduce.one_joint import Joint, Readings, draw_joint, run_tests, static_test
from circlepoint.reproduce.trials import Runner, Spread, summarise

if TYPE_CHECKING:
    from collections.abc import Mapping

SEEDS = {"joint": 1994, "bound": 1995}
_bound_share = 5  # trials of the bound for each trial of the rest: 1,000 at 200


def joint_trial(conditions: Conditions, methods: Mapping[str, Centre], seed: int) -> JointErrors:
    """Return the errors of every method on one joint of random direction, distance and sensor."""
    joint = draw_joint(conditions, seed)
    return evaluate(joint, run_tests(joint, conditions, seed), conditions, methods)


def axis_table(run: Runner, trials: int, found: Findings) -> None:
    """Study the static axis and the centre in simulation; what single errors of the sensor do to them."""
    run.begin("single joint, every method")
    conditions = Conditions()
    base = run.run(partial(joint_trial, conditions, METHODS), SEEDS["joint"], trials)
    run.begin("which error of the sensor does what")
    sensor = conditions.sensor
    cases = {
        "noise and bias only": only(sensor, "bias_std"),
        "… and scale factor, 200 ppm": only(sensor, "bias_std", "scale_std"),
        "… and second-order nonlinearity": only(sensor, "bias_std", "second_order_std"),
        "… and misalignment, 0.05 mrad": only(sensor, "bias_std", "misalignment_std"),
        "… and percussion distance, 0.25 mm": only(sensor, "bias_std", "percussion_distance_std"),
    }
    rows = []
    for label, kind in cases.items():
        errors = run.run(partial(joint_trial, replace(conditions, sensor=kind), METHODS), SEEDS["joint"], trials)
        rows.append((label, _row(errors)))
    rows.append(("all of them", _row(base)))
    found.tables.append(
        Table(
            id="sensor_errors",
            title="Which error of the sensor makes the figures of section 4",
            explanation="Median over groups of ten trials of the root mean square error, and the interval of 95 % of "
            "the groups; the axis in mrad, the centres in mm. The axis owes its error to the scale factors, method 1 "
            "and the least squares of method 2 to the tolerance of the percussion distance, the printed method 2 to "
            "its means.",
            columns=("axis, plane fit", *_titles()),
            rows=tuple(rows),
            unit="mrad, mm",
            factor=1e3,
        )
    )
    quiet, scales, distance = rows[0][1], rows[1][1], rows[4][1]
    reasons = {
        "axis": (
            f"Noise alone would give {_milli(quiet[0])} mrad rms, with the scale factors {_milli(scales[0])}: they "
            "are the cause. The best method estimates them from the magnitude of gravity over all joints' dwells."
        ),
        "centre_position": (
            f"Noise and vibration alone give {_milli(quiet[1])} mm rms, with the tolerance of the percussion distance "
            f"{_milli(distance[1])}: the method takes the nominal 18.2 mm. Vibration below 10 Hz adds to it (table "
            "“What the paper leaves open”)."
        ),
        "centre_velocity": (
            f"The printed mean of |v|/|w| over nearly all samples costs most of it: {_milli(quiet[2])} mm rms with "
            f"noise alone, by least squares {_milli(quiet[3])} (table “Method 2 as printed”)."
        ),
    }
    errors_of = {
        "axis": [errors.axis for errors in base],
        "centre_position": [errors.centre["position"] for errors in base],
        "centre_velocity": [errors.centre["velocity_means"] for errors in base],
    }
    for key, values in errors_of.items():
        text = reasons[key]
        summary = summarise(values)
        found.ours[f"{key}_max"] = Ours(summary.max_of_ten, None, trials, text)
        found.ours[f"{key}_std"] = Ours(summary.rms_of_ten, None, trials, text)


def threshold_table(run: Runner, trials: int, found: Findings) -> None:
    """Study from which rate on method 2 uses its samples."""
    run.begin("significant samples of method 2")
    shares = (0.5, 0.2, 0.05, 0.02, 0.01, NOT_ZERO)
    methods = {f"{share:g}": Centre("velocity", least_squares=False, significant_rate=share) for share in shares}
    errors = run.run(partial(joint_trial, Conditions(), methods), SEEDS["joint"], trials)
    rows = []
    for share in shares:
        centre = summarise([e.centre[f"{share:g}"] for e in errors])
        rows.append((f"|w| above {100 * share:g} % of its peak", (centre.max_of_ten, centre.rms_of_ten)))
    found.tables.append(
        Table(
            id="threshold",
            title="Method 2 as printed: where v is “different from zero”",
            explanation="r is the mean of |v|/|w|. Near the turning points both vanish and the ratio is noise, so the "
            "result depends on how slow a sample may be: the printed figures (3 mm, 2 mm) are those of counting nearly "
            "every sample, and slow samples left out give better ones.",
            columns=("max of ten", "rms of ten"),
            rows=tuple(rows),
            unit="mm",
            factor=1e3,
        )
    )


def iteration_table(run: Runner, trials: int, found: Findings) -> None:
    """Study how many corrections for the centre of percussion method 1 needs, by distance."""
    run.begin("iterations of the centre of percussion")
    counts: tuple[int | None, ...] = (0, 1, 2, 3, 4, 6, None)
    methods = {str(count): Centre("position", corrections=count) for count in counts}
    bands = ((0.25, 0.4), (0.4, 0.6), (0.6, 0.8), (0.8, 1.0))
    columns, needed = [], []
    for band in bands:
        conditions = replace(Conditions(), distance=band)
        errors = run.run(partial(joint_trial, conditions, methods), SEEDS["joint"], trials)
        summaries = [summarise([e.centre[str(count)] for e in errors]) for count in counts]
        columns.append([summary.rms_of_ten for summary in summaries])
        final = summaries[-1].rms_of_ten.median
        needed.append(next(c for c, s in zip(counts, summaries, strict=True) if s.rms_of_ten.median < 1.25 * final))
    found.tables.append(
        Table(
            id="iterations",
            title="Corrections for the centre of percussion, method 1",
            explanation="The rate is |v|/r of the previous estimate, so the error shrinks by about d/r times a "
            "factor of the motion at each correction. Two suffice at a metre, the workspace the paper speaks of; "
            "below 0.4 m two leave an error of centimetres, which is the size measured in section 5.",
            columns=tuple(f"{low:g} to {high:g} m" for low, high in bands),
            rows=tuple(
                ("to convergence" if count is None else str(count), tuple(column[i] for column in columns))
                for i, count in enumerate(counts)
            ),
            unit="mm",
            factor=1e3,
        )
    )
    amounts = [float(20 if count is None else count) for count in needed]
    found.ours["percussion_iterations"] = Ours(
        Spread(amounts[-1], min(amounts), max(amounts)),
        exactly(0.0),
        trials,
        f"{amounts[-1]:.0f} at 0.8 to 1 m, {amounts[0]:.0f} at 0.25 to 0.4 m (until within a quarter of the converged "
        "error): what is left shrinks with d/r at each correction. Method 2 takes the rate from the encoder and "
        "needs one; the regression has the distance in its model.",
    )


def static_trial(conditions: Conditions, seed: int) -> tuple[float, float, float]:
    """Return the axis errors (rad) by sphere and by the paper's chart, and 1.0 where the chart's iteration arrived."""
    joint = draw_joint(conditions, seed)
    readings = static_readings(joint, conditions, seed)
    sphere = static_axis(readings).direction
    chart, arrived = chart_axis(readings)
    return angle_between(sphere, joint.axis), angle_between(chart, joint.axis), float(arrived)


def bound(run: Runner, trials: int, found: Findings) -> None:
    """Compute the paper's bound from the sensor's figures, and try it."""
    run.begin("the error bound")
    count = _bound_share * trials
    conditions = Conditions()
    errors = np.array(run.run(partial(static_trial, conditions), SEEDS["bound"], count))
    g = circlepoint.STANDARD_GRAVITY
    limit = (ENVIRONMENT_STD + WORST_ERROR) / g
    three = (3.0 * ENVIRONMENT_STD + WORST_ERROR) / g
    largest = float(errors[:, 0].max())
    broken = int(np.sum(errors[:, 0] > limit))
    arrived = errors[:, 2] > 0.0
    text = (
        "(0.5 + 5) mm/s² / g. The printed number takes one standard deviation for the random part; three, as the "
        f"text says, give {1e3 * three:.2f} mrad. Largest axis error in {count} trials: {1e3 * largest:.2f} mrad, "
        f"{broken} above the bound."
    )
    found.ours["bound_angle"] = Ours(exactly(limit), exactly(largest), count, text)
    found.ours["bound_end_point"] = Ours(
        exactly(limit * 1.0), exactly(largest * 1.0), count, "The same angle at a reach of 1 m."
    )
    found.signals["bound"] = {"errors": errors[:, 0], "limit": limit, "three": three}
    spread = summarise(errors[:, 0])
    chart = summarise(errors[arrived, 1])
    share = float(np.mean(arrived))
    found.tables.append(
        Table(
            id="chart",
            title="The axis in the paper's parameters and on the sphere",
            explanation="The chart l, m, sqrt(1 - l² - m²) (constraint corrected) reaches the same minimum where it "
            f"arrives at all: in {100 * share:.1f} % of {count} trials from its centre. The others have their axis "
            "near the sensor's x-y plane, where the chart ends. The sphere has no such place.",
            columns=("max of ten", "rms of ten"),
            rows=(
                ("sphere, closed form", (spread.max_of_ten, spread.rms_of_ten)),
                (f"chart, where it arrived ({100 * share:.1f} %)", (chart.max_of_ten, chart.rms_of_ten)),
            ),
            unit="mrad",
            factor=1e3,
        )
    )


def static_readings(joint: Joint, conditions: Conditions, seed: int) -> Readings:
    """Return a static test without a motion."""
    angle, force = static_test(joint, conditions, seed)
    return Readings(angle, force, np.zeros(0), np.zeros((0, 3)), math.nan)


def _milli(spread: Spread) -> str:
    return significant(1e3 * spread.median)


def _titles() -> tuple[str, ...]:
    return ("centre, position", "centre, velocity as printed", "centre, velocity least squares", "centre, regression")


def _row(errors: list[JointErrors]) -> tuple[Spread, ...]:
    axis = summarise([e.axis for e in errors]).rms_of_ten
    return (axis, *(summarise([e.centre[name] for e in errors]).rms_of_ten for name in (*METHODS, BEST)))
