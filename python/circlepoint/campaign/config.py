"""A campaign of simulated trials: its YAML file, the grid of cells it spans, and the batches a cell is run in."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import circlepoint
from circlepoint._core import InvalidInput
from circlepoint.arm import Arm, load_arm
from circlepoint.calibration import joint_options, whole_arm_options
from circlepoint.campaign import sections
from circlepoint.experiment import Noise, Setting, make_experiment, with_encoders
from circlepoint.protocol import Plan, load_plan
from circlepoint.result_document import workspace
from circlepoint.sensor_presets import load_sensor
from circlepoint.yaml_io import Fields, load_fields

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator, Mapping

    from circlepoint.calibration import Method

KEYS = ("name", "arm", "sensor", "plan", "noise", "method", "trials", "seed", "batch", "gravity")
SWEPT = ("arm", "sensor", "plan", "noise", "method")
DEFAULT_BATCH = 100
LARGEST_SEED = 2**64 - 1


@dataclass(frozen=True)
class Cell:
    """One combination of the swept values.

    Attributes
    ----------
    index : int
        Its place in the grid.
    recordings : int
        Its place in the grid without the methods: cells that differ in the method alone see the same recordings.
    labels : dict
        What was chosen, by section.
    arm : Arm
        With the encoders that are simulated.
    """

    index: int
    recordings: int
    labels: dict[str, str]
    arm: Arm
    plan: Plan
    sensor: circlepoint.AccelerometerSpecification
    told_sensor: circlepoint.AccelerometerSpecification | None
    setting: Setting
    noise: Noise
    method: Method

    def experiment(self, trajectory: circlepoint.JointTrajectory | None = None) -> circlepoint.Experiment:
        """Return what is simulated; the plan's motion unless another is given."""
        return make_experiment(
            self.arm,
            self.plan,
            self.sensor,
            setting=self.setting,
            noise=self.noise,
            spread_starts=True,
            trajectory=trajectory,
        )

    def conditions(self) -> circlepoint.TrialConditions:
        """Return what the core runs a trial of."""
        reference = self.arm.follow(self.plan.rest[None])[0]
        options: circlepoint.JointCalibrationOptions | circlepoint.WholeArmOptions
        if self.method == "whole-arm":
            options = whole_arm_options(self.arm, self.told_sensor, self.setting.gravity, reference)
        else:
            options = joint_options(self.arm, self.method, self.told_sensor, self.setting.gravity, reference)
        return circlepoint.TrialConditions(self.experiment(), options, workspace(self.arm, reference))


@dataclass(frozen=True)
class Batch:
    """Trials `begin` to `end` (not included) of a cell: what is written, or lost, together."""

    cell: int
    index: int
    begin: int
    end: int

    @property
    def trials(self) -> int:
        """How many."""
        return self.end - self.begin


@dataclass(frozen=True)
class Campaign:
    """A campaign's file, read.

    Attributes
    ----------
    path : Path
    document : dict
        The file's content as it stands.
    files : dict
        Text of every file it names, under the name it is given there.
    cells : tuple of Cell
        The grid; the method changes fastest.
    """

    path: Path
    name: str
    document: dict[str, Any]
    files: dict[str, str]
    cells: tuple[Cell, ...]
    trials: int
    seed: int
    batch: int

    @property
    def total(self) -> int:
        """Trials of all cells."""
        return self.trials * len(self.cells)

    def batches(self) -> Iterator[Batch]:
        """Yield all batches in order."""
        for cell in range(len(self.cells)):
            for index, begin in enumerate(range(0, self.trials, self.batch)):
                yield Batch(cell, index, begin, min(begin + self.batch, self.trials))

    def seeds(self, batch: Batch) -> list[int]:
        """Return the seeds of a batch's trials: of the campaign's seed, the cell's recordings and the trial alone."""
        parent = circlepoint.derive_seed(self.seed, self.cells[batch.cell].recordings)
        return [circlepoint.derive_seed(parent, trial) for trial in range(batch.begin, batch.end)]


@dataclass
class _Sources:
    """Finds the files a campaign names, reads each once and keeps their texts."""

    fields: Fields
    elsewhere: Mapping[str, Path] | None
    texts: dict[str, str] = field(default_factory=dict)

    def path(self, kind: str, file: str, where: tuple[Hashable, ...]) -> Path:
        own = sections.preset(kind, file)
        if own is not None:
            return own
        path = self.elsewhere[file] if self.elsewhere is not None else self.fields.file.path.parent / file
        if not path.is_file():
            known = ", ".join(sections.presets(kind))
            raise self.fields.file.error(
                where, f"is {file!r}, neither one of the package's ({known}) nor a file: there is no {path}"
            )
        try:
            self.texts[file] = path.read_text(encoding="utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise InvalidInput(f"{path}: cannot be read as text ({error}); check the file") from error
        return path


def load_campaign(path: str | Path, files: Mapping[str, Path] | None = None) -> Campaign:
    """Read a campaign's file and everything it names, and see that each of its cells can be simulated.

    Parameters
    ----------
    path : str or Path
        The YAML file.
    files : mapping, optional
        Where the files it names are; by default beside it.

    Returns
    -------
    Campaign

    Raises
    ------
    InvalidInput
        Naming file, line, field, value and remedy.
    """
    for read in (_arm, _sensor, _plan):
        read.cache_clear()
    fields = load_fields(path, KEYS)
    sources = _Sources(fields, files)
    gravity = fields.number("gravity", default=circlepoint.STANDARD_GRAVITY, above=0.0)
    seed = fields.integer("seed", at_least=0)
    if seed > LARGEST_SEED:
        fields.fail("seed", f"is {seed}, must be below 2^64")
    arms = sections.read_arms(fields, gravity)
    sensors = sections.read_files(fields, "sensor", "a preset's name or a data sheet file")
    plans = sections.read_files(fields, "plan", "`paper` or a plan's file")
    noises = sections.read_noises(fields)
    methods = sections.read_methods(fields)
    swept: list[list[tuple[Any, str]]] = [
        list(zip(choices, sections.labels(choices), strict=True)) for choices in (arms, sensors, plans, noises, methods)
    ]
    cells = tuple(_cell(index, index // len(methods), chosen, sources) for index, chosen in enumerate(product(*swept)))
    for cell in cells[:: len(methods)]:
        _require_possible(fields, cell)
    return Campaign(
        path=Path(path),
        name=fields.text("name", "a name", default=Path(path).stem),
        document=fields.file.data,
        files=sources.texts,
        cells=cells,
        trials=fields.integer("trials", at_least=1),
        seed=seed,
        batch=fields.integer("batch", default=DEFAULT_BATCH, at_least=1),
    )


def _cell(index: int, recordings: int, chosen: tuple[tuple[Any, str], ...], sources: _Sources) -> Cell:
    (arm, _), (sensor, _), (plan, _), (noise, _), (method, _) = chosen
    described = _arm(sources.path("arm", arm.file, arm.where), arm.base, arm.tip)
    if not described.has_nominal:
        raise sources.fields.file.error(
            arm.where, f"is {arm.file!r}, which has no `dh` or `lines`; a simulation needs nominal parameters"
        )
    told = None
    if method.sensor is None:
        told = _sensor(sources.path("sensor", sensor.file, sensor.where))
    elif method.sensor != sections.UNSPECIFIED:
        told = _sensor(sources.path("sensor", method.sensor, method.where))
    return Cell(
        index=index,
        recordings=recordings,
        labels={section: label for section, (_, label) in zip(SWEPT, chosen, strict=True)},
        arm=described if noise.counts is None else with_encoders(described, noise.counts),
        plan=_plan(sources.path("plan", plan.file, plan.where), described),
        sensor=_sensor(sources.path("sensor", sensor.file, sensor.where)),
        told_sensor=told,
        setting=arm.setting,
        noise=noise.noise,
        method=method.method,
    )


def _require_possible(fields: Fields, cell: Cell) -> None:
    """Simulate a moment at rest: what cannot be simulated is told before anything is run."""
    acquisition = cell.plan.acquisition
    rate = cell.plan.sample_rate * (1 if acquisition is None else acquisition.oversampling)
    rest = circlepoint.joint_trajectory(cell.plan.rest, [circlepoint.Dwell(duration=64.0 / rate)], rate)
    try:
        circlepoint.simulate_experiment(cell.experiment(rest), 0)
    except InvalidInput as error:
        chosen = ", ".join(f"{section} {label}" for section, label in cell.labels.items() if section != "method")
        raise InvalidInput(f"{fields.file.path}: {chosen}: cannot be simulated: {error}") from error


# Files are read once a campaign; arms, plans and sensors are immutable.
@functools.lru_cache(maxsize=256)
def _arm(path: Path, base: str | None, tip: str | None) -> Arm:
    return load_arm(path, base=base, tip=tip)


@functools.lru_cache(maxsize=256)
def _sensor(path: Path) -> circlepoint.AccelerometerSpecification:
    return load_sensor(path)


@functools.lru_cache(maxsize=256)
def _plan(path: Path, arm: Arm) -> Plan:
    return load_plan(path, arm.driven.joint_names, [joint.type for joint in arm.driven.joints])
