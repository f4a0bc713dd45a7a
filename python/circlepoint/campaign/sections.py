"""The sections of a campaign's file: each a value or a list of values that are swept."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import circlepoint
from circlepoint.experiment import UPRIGHT, Noise, Setting, vibration
from circlepoint.sensor_presets import sensor_names
from circlepoint.yaml_io import Fields, describe

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Iterator

    from numpy.typing import NDArray

    from circlepoint.calibration import Method

PACKAGE = Path(circlepoint.__file__).parent
METHODS: dict[str, Method] = {
    "whole-arm": "whole-arm",
    "joint": "joint",
    "position": "position",
    "velocity": "velocity",
}
KNOWN, UNSPECIFIED = "known", "unspecified"

_ARM = ("name", "file", "base", "tip", "up", "tool", "built", "compliance")
_TOOL = ("xyz", "rotation_deg")
_BUILT = ("direction_std", "point_std")
_NOISE = ("name", "white", "vibration", "encoder_counts")
_VIBRATION = ("tangential", "orthogonal", "from_hz", "to_hz")
_METHOD = ("name", "sensor")


@dataclass(frozen=True)
class ArmChoice:
    """An arm and how it is set up."""

    label: str
    file: str
    base: str | None
    tip: str | None
    setting: Setting
    where: tuple[Hashable, ...]


@dataclass(frozen=True)
class FileChoice:
    """A preset of the package, or a file."""

    label: str
    file: str
    where: tuple[Hashable, ...]


@dataclass(frozen=True)
class NoiseChoice:
    """One combination of disturbances; `counts` a revolution: None as the arm says, 0 exact."""

    label: str
    noise: Noise
    counts: float | None
    where: tuple[Hashable, ...]


@dataclass(frozen=True)
class MethodChoice:
    """A method, and what it is told of the sensor: the kind simulated (None), nothing, or another kind."""

    label: str
    method: Method
    sensor: str | None
    where: tuple[Hashable, ...]


def entries(fields: Fields, key: str, need: str) -> Iterator[tuple[tuple[Hashable, ...], Any]]:
    """Yield the values of a section with their places: of a list each, else the one."""
    value = fields.value(key, need)
    if not isinstance(value, list):
        yield (*fields.where, key), value
        return
    if not value:
        fields.fail(key, f"is an empty list; {need} is needed")
    for index, item in enumerate(value):
        yield (*fields.where, key, index), item


def read_arms(fields: Fields, gravity: float) -> list[ArmChoice]:
    """Return the arms."""
    need = "an arm's file, `sarcos`, or a mapping with file"
    choices = []
    for where, value in entries(fields, "arm", need):
        if not isinstance(value, dict):
            file = fields.file.text(where, value)
            choices.append(ArmChoice(Path(file).stem, file, None, None, Setting(gravity=gravity), where))
            continue
        arm = Fields.of(fields.file, where, value, _ARM)
        file = arm.text("file", "the arm's description, arm.yaml or a URDF, or `sarcos`")
        built = arm.fields("built", _BUILT) if "built" in arm else None
        setting = Setting(
            up=_direction(arm, "up") if "up" in arm else UPRIGHT,
            tool=_tool(arm) if "tool" in arm else np.eye(4),
            direction_std=built.number("direction_std", default=0.0, at_least=0.0) if built else 0.0,
            point_std=built.number("point_std", default=0.0, at_least=0.0) if built else 0.0,
            compliance=arm.number("compliance", default=0.0, at_least=0.0),
            gravity=gravity,
        )
        choices.append(
            ArmChoice(
                arm.text("name", "a name", default=Path(file).stem),
                file,
                arm.text("base", "a link's name") if "base" in arm else None,
                arm.text("tip", "a link's name") if "tip" in arm else None,
                setting,
                where,
            )
        )
    return choices


def read_files(fields: Fields, key: str, need: str) -> list[FileChoice]:
    """Return the sensors or the plans."""
    choices = []
    for where, value in entries(fields, key, need):
        file = fields.file.text(where, value)
        choices.append(FileChoice(Path(file).stem, file, where))
    return choices


def read_noises(fields: Fields) -> list[NoiseChoice]:
    """Return every combination of disturbances; one without any where the section is not there."""
    if "noise" not in fields:
        return [NoiseChoice("as stated", Noise(), None, (*fields.where, "noise"))]
    choices = []
    for where, value in entries(fields, "noise", f"a mapping with the keys {', '.join(_NOISE)}"):
        section = Fields.of(fields.file, where, value, _NOISE)
        axes = [
            _axis(section, "white", _white),
            _axis(section, "vibration", _vibration),
            _axis(section, "encoder_counts", _counts),
        ]
        name = section.text("name", "a name") if "name" in section else None
        for white, shaking, counts in product(*axes):
            said = [text for text, _ in (white, shaking, counts) if text]
            swept = [text for axis, (text, _) in zip(axes, (white, shaking, counts), strict=True) if len(axis) > 1]
            label = ", ".join(said) or "as stated" if name is None else ", ".join([name, *swept])
            noise = Noise(white=white[1], vibration=shaking[1] or circlepoint.VibrationOptions())
            choices.append(NoiseChoice(label, noise, counts[1], where))
    return choices


def read_methods(fields: Fields) -> list[MethodChoice]:
    """Return the methods."""
    need = f"one of {', '.join(METHODS)}"
    choices = []
    for where, value in entries(fields, "method", need):
        if isinstance(value, dict):
            section = Fields.of(fields.file, where, value, _METHOD)
            name = section.choice("name", METHODS)
            told = section.text("sensor", "known, unspecified, a preset or a file", default=KNOWN)
        elif isinstance(value, str) and value in METHODS:
            name, told = METHODS[value], KNOWN
        else:
            raise fields.file.error(where, f"is {describe(value)}, must be {need}")
        label = name if told == KNOWN else f"{name}, sensor {Path(told).stem}"
        choices.append(MethodChoice(label, name, None if told == KNOWN else told, where))
    return choices


def labels(choices: Iterable[ArmChoice | FileChoice | NoiseChoice | MethodChoice]) -> list[str]:
    """Return a section's labels; those that come twice are numbered."""
    plain = [choice.label for choice in choices]
    return [
        text if plain.count(text) == 1 else f"{text} ({1 + plain[:index].count(text)})"
        for index, text in enumerate(plain)
    ]


def preset(kind: str, file: str) -> Path | None:
    """Return the package's own file of that name; None where there is none."""
    folder = {"arm": "arms", "plan": "plans", "sensor": "sensors"}[kind]
    path = PACKAGE / folder / f"{file}.yaml"
    return path if Path(file).name == file and path.is_file() else None


def presets(kind: str) -> list[str]:
    """Return the names of the package's own arms, plans or sensors."""
    if kind == "sensor":
        return sensor_names()
    return sorted(path.stem for path in (PACKAGE / {"arm": "arms", "plan": "plans"}[kind]).glob("*.yaml"))


def _axis(section: Fields, key: str, read: Callable[[Fields, str, Any], Any]) -> list[tuple[str, Any]]:
    """Return the values of one disturbance with their texts; one that says nothing where it is not given."""
    if not section.given(key):
        return [("", None)]
    value = section.values[key]
    if not isinstance(value, list):
        return [read(section, key, value)]
    if not value:
        section.fail(key, "is an empty list; give one value at least, or leave it out")
    return [read(section, key, item) for item in value]


def _white(section: Fields, key: str, value: Any) -> tuple[str, float]:
    number = section.checked((key,), value, at_least=0.0)
    return f"white {number:g}", number


def _counts(section: Fields, key: str, value: Any) -> tuple[str, float]:
    number = section.checked((key,), value, at_least=0.0)
    return (f"{number:g} counts" if number else "exact encoders"), number


def _vibration(section: Fields, key: str, value: Any) -> tuple[str, circlepoint.VibrationOptions]:
    if not isinstance(value, dict):
        amplitude = section.checked((key,), value, at_least=0.0)
        return f"vibration {amplitude:g}", vibration(amplitude)
    found = Fields.of(section.file, (*section.where, key), value, _VIBRATION)
    tangential = found.number("tangential", at_least=0.0)
    default = circlepoint.VibrationOptions()
    low = found.number("from_hz", default=default.frequency_min, above=0.0)
    return f"vibration {tangential:g}", vibration(
        tangential,
        found.number("orthogonal", default=0.1 * tangential, at_least=0.0),
        frequency_min=low,
        frequency_max=found.number("to_hz", default=max(default.frequency_max, low), at_least=low),
    )


def _triple(fields: Fields, key: str) -> tuple[float, float, float]:
    value = fields.value(key, "a list of three numbers")
    if not isinstance(value, list) or len(value) != 3:
        fields.fail(key, f"is {describe(value)}, must be a list of three numbers")
    x, y, z = (fields.checked((key, index), entry) for index, entry in enumerate(value))
    return x, y, z


def _direction(fields: Fields, key: str) -> tuple[float, float, float]:
    direction = _triple(fields, key)
    if not any(direction):
        fields.fail(key, "is zero; give a direction, its length does not matter")
    return direction


def _tool(arm: Fields) -> NDArray[np.float64]:
    """Return the sensor's pose in the last frame: m, and a rotation vector in degrees."""
    tool = arm.fields("tool", _TOOL)
    pose = np.eye(4)
    if "xyz" in tool:
        pose[:3, 3] = _triple(tool, "xyz")
    if "rotation_deg" in tool:
        pose[:3, :3] = circlepoint.rotation_exp(np.radians(_triple(tool, "rotation_deg")))
    return pose
