"""Section 3: what filters, converter and encoders do to the centre, and the delay that explains it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from circlepoint.reproduce.accuracy import SEEDS, joint_trial
from circlepoint.reproduce.conditions import ACQUISITION, MARGIN, Conditions, acquired
from circlepoint.reproduce.estimates import BEST, METHODS, reading_delay
from circlepoint.reproduce.findings import Findings, Table
from circlepoint.reproduce.one_joint import draw_joint, run_tests
from circlepoint.reproduce.trials import Runner, Spread, spread_of, summarise

_methods = {
    "position": METHODS["position"],
    "position_aligned": replace(METHODS["position"], aligned=True),
    "velocity_means": METHODS["velocity_means"],
    "velocity": METHODS["velocity"],
}
_columns = (
    "position, converged",
    "position, delay corrected",
    "velocity, as printed",
    "velocity, least squares",
    "regression, delay estimated",
)
_labels = {
    "sensor": "… with frequency response of Table 1, noise by band",
    "filter": "… with the 250 Hz filter",
    "converter": "… with the multiplexed converter, 16 bits",
    "encoders": "… with encoders read at 1 kHz",
}


def delay_trial(conditions: Conditions, seed: int) -> float:
    """Return the delay, s, that the regression finds between one joint's readings and its encoder."""
    return reading_delay(run_tests(draw_joint(conditions, seed), conditions, seed))


def acquisition_table(run: Runner, trials: int, found: Findings) -> tuple[Spread, Spread]:
    """Study the acquisition chain part by part; return method 1's error (m) behind it, and its delay (s)."""
    run.begin("the acquisition of section 3")
    held = replace(acquired(Conditions()), acquisition=())
    cases = {
        "as simulated, a quarter second of rest around": replace(Conditions(), margin=MARGIN),
        "joints held by PD loops": held,
        **{_labels[part]: replace(held, acquisition=(part,)) for part in ACQUISITION},
        "… with all four": acquired(Conditions()),
    }
    rows = []
    for label, conditions in cases.items():
        errors = run.run(partial(joint_trial, conditions, _methods), SEEDS["joint"], trials)
        rows.append((label, tuple(summarise([e.centre[m] for e in errors]).rms_of_ten for m in (*_methods, BEST))))
    delays = spread_of(run.run(partial(delay_trial, acquired(Conditions())), SEEDS["joint"], trials))
    low, middle, high = (f"{1e3 * value:.2f}" for value in (delays.low, delays.median, delays.high))
    found.tables.append(
        Table(
            id="acquisition",
            title="The acquisition of section 3, which the paper's simulation leaves out",
            explanation="Each part by itself on joints held by PD loops, then all. Filter and sensor delay the "
            "readings; encoders read apart are up to a millisecond old, which takes some of it back. Gravity is "
            "subtracted at the wrong angle, and method 1 integrates the difference twice. The regression "
            f"finds the delay from its own residual: {middle} ms [{low}, {high}]. With the encoder shifted by it, "
            "method 1 is as good as without the chain, so the delay is the cause. Where channels differ in their "
            "response, a little is left.",
            columns=_columns,
            rows=tuple(rows),
            unit="mm",
            factor=1e3,
        )
    )
    return rows[-1][1][0], delays
