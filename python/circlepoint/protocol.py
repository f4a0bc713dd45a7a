"""Test plans: what the arm is to do, from a YAML file to joint trajectories.

A plan says the sample rate, where the joints rest, and a list of tests: stepped sweeps and raised cosines (eq. (11) of
Canepa, Hollerbach, Boelen 1994) of one joint or of every joint in turn, and motions of all joints at once. For a
simulation it may also say how the recording is acquired (`circlepoint.acquisition`). ``plans/paper.yaml`` in the
package is one, ``plans/paper-acquisition.yaml`` one with the paper's acquisition chain.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from circlepoint._core import (
    Dwell,
    InvalidInput,
    JointTrajectory,
    MultiJointMotion,
    RaisedCosine,
    SteppedSweep,
    joint_trajectory,
)
from circlepoint.acquisition import Acquisition, read_acquisition
from circlepoint.yaml_io import Fields, describe, load_fields

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    Piece = Dwell | SteppedSweep | RaisedCosine | MultiJointMotion

PAPER_PLAN = Path(__file__).parent / "plans" / "paper.yaml"

_PLAN = ("name", "rate_hz", "rest_deg", "rest", "pause", "tests", "acquisition")
_TEST = ("joint", "static", "dynamic", "free")
_STATIC = ("span_deg", "span_m", "steps", "dwell", "move", "return")
_DYNAMIC = ("span_deg", "span_m", "frequency_hz", "duration")
_FREE = (
    "amplitude_deg",
    "amplitude_m",
    "duration",
    "frequency_min_hz",
    "frequency_max_hz",
    "harmonics",
    "ramp",
    "seed",
)


@dataclass(frozen=True)
class Plan:
    """A motion to run or to simulate.

    Attributes
    ----------
    name : str
    sample_rate : float
        Hz.
    rest : (n,) ndarray
        rad or m: where the joints are before, between and after the tests.
    pieces : tuple
        The motions in order.
    pause : float
        s of rest before the first motion, between any two and after the last.
    acquisition : Acquisition or None
        How a simulated recording is acquired.
    """

    name: str
    sample_rate: float
    rest: NDArray[np.float64]
    pieces: tuple[Piece, ...]
    pause: float
    acquisition: Acquisition | None = None

    def trajectory(self) -> JointTrajectory:
        """Return the joint trajectory of the whole plan on one clock: with an acquisition, its analogue one."""
        oversampling = 1 if self.acquisition is None else self.acquisition.oversampling
        return joint_trajectory(self.rest, list(self.pieces), self.sample_rate * oversampling, self.pause)


def load_plan(path: str | Path, joint_names: Sequence[str], joint_types: Sequence[str] | None = None) -> Plan:
    """Read a plan for an arm.

    Parameters
    ----------
    path
        YAML file with ``rate_hz``, ``rest_deg`` (or ``rest`` in rad and m), optional ``name``, ``pause`` (s) and
        ``acquisition`` (see `circlepoint.acquisition`), and ``tests``: a list of ``{joint: NAME | all, static: {...},
        dynamic: {...}}`` and ``{free: {...}}``. Ranges are ``span_deg`` and ``amplitude_deg`` for revolute joints,
        ``span_m`` and ``amplitude_m`` for prismatic ones.
    joint_names
        The arm's joints, base to tip.
    joint_types
        ``"revolute"`` or ``"prismatic"`` for each; all revolute when not given.

    Returns
    -------
    Plan

    Raises
    ------
    InvalidInput
        Naming file, field, value and remedy: for an unknown, missing or impossible field, and for a joint the arm does
        not have.
    """
    names = list(joint_names)
    prismatic = [kind == "prismatic" for kind in joint_types or ["revolute"] * len(names)]
    if not names or len(prismatic) != len(names):
        raise InvalidInput(
            f"{len(names)} joint names and {len(prismatic)} joint types; give one of each for every joint"
        )
    fields = load_fields(path, _PLAN)
    name = fields.text("name", "a name", default=Path(path).stem)
    sample_rate = fields.number("rate_hz", above=0.0)
    rest = _rest(fields, prismatic)
    pause = fields.number("pause", default=0.5, at_least=0.0)
    pieces: list[Piece] = []
    for test in fields.each("tests", "a list of tests", _TEST):
        pieces.extend(_test(test, names, prismatic))
    acquisition = read_acquisition(fields, len(names))
    plan = Plan(
        name=name, sample_rate=sample_rate, rest=rest, pieces=tuple(pieces), pause=pause, acquisition=acquisition
    )
    _require_feasible(plan, fields.file.path)
    return plan


def paper_plan(joint_names: Sequence[str]) -> Plan:
    """Return the paper's protocol for an arm of revolute joints: per joint a stepped sweep, then eq. (11)."""
    return load_plan(PAPER_PLAN, joint_names)


def _require_feasible(plan: Plan, path: Path) -> None:
    """Let the core check what a single field cannot show, such as a raised cosine of a fractional number of cycles."""
    for index, piece in enumerate(plan.pieces):
        try:
            joint_trajectory(plan.rest, [piece], 1.0)
        except InvalidInput as error:
            raise InvalidInput(f"{path}: motion {index + 1} of {len(plan.pieces)} is not possible: {error}") from error


def _rest(fields: Fields, prismatic: list[bool]) -> NDArray[np.float64]:
    """Return where the joints rest, rad or m."""
    if "rest" in fields and "rest_deg" in fields:
        fields.fail("rest", "rest_deg is given too; keep one")
    key = "rest" if "rest" in fields else "rest_deg"
    need = f"one number, or a list of {len(prismatic)}, one a joint (rest_deg in degrees, or rest in rad and m)"
    value = fields.value(key, need)
    if isinstance(value, list) and len(value) != len(prismatic):
        fields.fail(key, f"is {describe(value)}, must be {need}")
    if key == "rest_deg" and any(prismatic):
        fields.fail(key, f"is {describe(value)}, but the arm has prismatic joints: give rest, in rad and m")
    if isinstance(value, list):
        rest = np.array([fields.checked((key, index), entry) for index, entry in enumerate(value)])
    else:
        rest = np.full(len(prismatic), fields.checked((key,), value))
    return rest if key == "rest" else np.radians(rest)


def _test(test: Fields, names: list[str], prismatic: list[bool]) -> Iterator[Piece]:
    """Yield the motions of one entry of the list of tests, in the order they are run."""
    if "free" in test:
        for key in ("joint", "static", "dynamic"):
            if key in test:
                test.fail(key, "does not go with free, a motion of all joints; make it a test of its own")
        yield _free(test.fields("free", _FREE), prismatic)
        return
    joint = test.text("joint", "a joint's name, or all")
    if joint not in (*names, "all"):
        test.fail("joint", f"is {joint!r}; the arm's joints are {', '.join(names)}; or say all")
    tests = [
        (motion, test.fields(kind, allowed))
        for kind, motion, allowed in (("static", _static, _STATIC), ("dynamic", _dynamic, _DYNAMIC))
        if kind in test
    ]
    if not tests:
        test.fail("joint", f"is {joint!r}, but nothing is to be done; give static, dynamic or both")
    chosen = range(len(names)) if joint == "all" else [names.index(joint)]
    for _, fields in tests:
        _require_units_used(fields, "span", [prismatic[index] for index in chosen])
    for index in chosen:
        for motion, fields in tests:
            yield motion(fields, index, prismatic)


def _static(fields: Fields, joint: int, prismatic: list[bool]) -> SteppedSweep:
    default = SteppedSweep(joint=0, span=1.0)
    return SteppedSweep(
        joint=joint,
        span=_length(fields, "span", is_prismatic=prismatic[joint]),
        steps=fields.integer("steps", at_least=2),
        dwell=fields.number("dwell", default=default.dwell, above=0.0),
        move=fields.number("move", default=default.move, above=0.0),
        return_duration=fields.number("return", default=default.return_duration, above=0.0),
    )


def _dynamic(fields: Fields, joint: int, prismatic: list[bool]) -> RaisedCosine:
    return RaisedCosine(
        joint=joint,
        span=_length(fields, "span", is_prismatic=prismatic[joint]),
        frequency=fields.number("frequency_hz", above=0.0),
        duration=fields.number("duration", above=0.0),
    )


def _free(fields: Fields, prismatic: list[bool]) -> MultiJointMotion:
    default = MultiJointMotion(duration=1.0, amplitude=np.zeros(len(prismatic)))
    _require_units_used(fields, "amplitude", prismatic)
    return MultiJointMotion(
        duration=fields.number("duration", above=0.0),
        amplitude=np.array([_length(fields, "amplitude", is_prismatic=slides) for slides in prismatic]),
        frequency_min=fields.number("frequency_min_hz", default=default.frequency_min, above=0.0),
        frequency_max=fields.number("frequency_max_hz", default=default.frequency_max, above=0.0),
        harmonics=fields.integer("harmonics", default=default.harmonics, at_least=1),
        ramp=fields.number("ramp", default=default.ramp, above=0.0),
        seed=fields.integer("seed", default=default.seed, at_least=0),
    )


def _length(fields: Fields, name: str, *, is_prismatic: bool) -> float:
    """Return a range of motion in the joint's own unit: m, or degrees as rad."""
    if is_prismatic:
        return fields.number(f"{name}_m")
    return math.radians(fields.number(f"{name}_deg"))


def _require_units_used(fields: Fields, name: str, prismatic: Sequence[bool]) -> None:
    """Refuse a range given for a kind of joint that does not take part."""
    if f"{name}_m" in fields and not any(prismatic):
        fields.fail(f"{name}_m", f"no prismatic joint takes part; give {name}_deg only")
    if f"{name}_deg" in fields and all(prismatic):
        fields.fail(f"{name}_deg", f"no revolute joint takes part; give {name}_m only")
