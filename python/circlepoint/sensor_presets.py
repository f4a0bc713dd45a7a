"""Kinds of accelerometers: the presets that ship with the package, and files of the same form.

A figure is a number in SI units, or a mapping: ``{value: 80, sigmas: 3, unit: mm/s^2, source: "Table 1, max as 3
sigma"}``. ``sigmas`` (default 1) says how many standard deviations the value stands for, ``unit`` is converted, and
``source`` is kept for those who ask where a figure comes from (`sensor_figures`).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from circlepoint._core import (
    STANDARD_GRAVITY,
    AccelerometerSpecification,
    InvalidInput,
    NoiseBand,
    ResponseBand,
    UncorrectedErrors,
)
from circlepoint.yaml_io import Fields, describe, field_name, load_fields

if TYPE_CHECKING:
    from numpy.typing import NDArray

PRESETS = Path(__file__).parent / "sensors"

_ACCELERATION = {
    "m/s^2": 1.0,
    "mm/s^2": 1e-3,
    "um/s^2": 1e-6,
    "g": STANDARD_GRAVITY,
    "mg": 1e-3 * STANDARD_GRAVITY,
    "ug": 1e-6 * STANDARD_GRAVITY,
}
_RATIO = {"1": 1.0, "%": 1e-2, "ppm": 1e-6}
_ANGLE = {"rad": 1.0, "mrad": 1e-3, "urad": 1e-6}
_LENGTH = {"m": 1.0, "mm": 1e-3}
_SECOND_ORDER = {"s^2/m": 1.0, "us^2/m": 1e-6}
_CURRENT_SCALE = {"A s^2/m": 1.0, "mA s^2/m": 1e-3}
_TEMPERATURE = {"degC": 1.0}

_UNITS = {
    "bias_std": _ACCELERATION,
    "scale_std": _RATIO,
    "misalignment_std": _ANGLE,
    "percussion_distance": _LENGTH,
    "percussion_distance_std": _LENGTH,
    "second_order_std": _SECOND_ORDER,
    "noise_std": _ACCELERATION,
    "range": _ACCELERATION,
    "resolution": _ACCELERATION,
    "current_scale_factor": _CURRENT_SCALE,
}
_FIELDS = (*_UNITS, "uncorrected", "noise_bands", "response_bands")
_REQUIRED = ("bias_std", "scale_std", "noise_std")
_UNCORRECTED = ("bias_std", "scale_std", "bias_temperature_std", "scale_temperature_std", "reference_temperature")


@dataclass(frozen=True)
class SensorFigure:
    """One figure of a sensor's file.

    Attributes
    ----------
    name : str
        Its place in the file, such as ``uncorrected.bias_temperature_std[0]``.
    value : float
        As written, in `unit`.
    unit : str
        Empty where the file says none: SI then.
    sigmas : float
        How many standard deviations the value stands for.
    source : str
        Where the figure comes from; empty where the file does not say.
    si : float
        The value in SI units, divided by `sigmas`.
    """

    name: str
    value: float
    unit: str
    sigmas: float
    source: str
    si: float

    @property
    def assumed(self) -> bool:
        """Whether the file itself marks the figure as assumed."""
        return self.source.startswith("assumed")


def sensor_names() -> list[str]:
    """Return the names of the presets."""
    return sorted(path.stem for path in PRESETS.glob("*.yaml"))


def load_sensor(name_or_path: str | Path) -> AccelerometerSpecification:
    """Load what is known of a kind of accelerometer.

    Parameters
    ----------
    name_or_path
        The name of a preset, or a YAML file with ``name`` and the fields of `AccelerometerSpecification`, each a number
        in SI units or a mapping with its unit and source; a field that is not there is zero, but for ``bias_std``,
        ``scale_std`` and ``noise_std``, which must be said.

    Returns
    -------
    AccelerometerSpecification

    Raises
    ------
    InvalidInput
        For a name that is neither a preset nor a file, and for a file with an unknown, missing or impossible field.
    """
    return _read(name_or_path)[0]


def sensor_figures(name_or_path: str | Path) -> tuple[SensorFigure, ...]:
    """Return every figure of a sensor's file with its unit and source; arguments and errors of `load_sensor`."""
    return _read(name_or_path)[1]


def _read(name_or_path: str | Path) -> tuple[AccelerometerSpecification, tuple[SensorFigure, ...]]:
    path = Path(name_or_path)
    if str(name_or_path) in sensor_names():
        path = PRESETS / f"{name_or_path}.yaml"
    elif not path.is_file():
        raise InvalidInput(
            f"sensor {str(name_or_path)!r} is neither a preset nor a file; "
            f"the presets are {', '.join(sensor_names())}, or give the path of a YAML file of the same form"
        )
    fields = load_fields(path, ("name", *_FIELDS))
    fields.text("name", "a name", default=path.stem)
    figures: list[SensorFigure] = []
    read = _Reader(figures)
    for name in _REQUIRED:
        if name not in fields:
            fields.number(name, at_least=0.0)
    scalars = {
        name: read.of(fields, name, units, signed=name == "percussion_distance") for name, units in _UNITS.items()
    }
    specification = AccelerometerSpecification(
        **scalars,
        uncorrected=_uncorrected(fields, read),
        noise_bands=[NoiseBand(*band) for band in _bands(fields, "noise_bands", "rms", _ACCELERATION, read)],
        response_bands=[ResponseBand(*band) for band in _bands(fields, "response_bands", "tolerance", _RATIO, read)],
    )
    return specification, tuple(figures)


class _Reader:
    """Reads figures and keeps a list of them."""

    def __init__(self, figures: list[SensorFigure]) -> None:
        self.figures = figures

    def of(
        self, fields: Fields, key: str, units: dict[str, float], *, signed: bool = False, default: float = 0.0
    ) -> float:
        """Return the figure under a key in SI units."""
        if key not in fields:
            return default
        if isinstance(fields.values[key], dict):
            return self.mapping(fields.fields(key, ("value", "sigmas", "unit", "source")), units, signed=signed)
        value = fields.number(key) if signed else fields.number(key, at_least=0.0)
        self.figures.append(SensorFigure(field_name((*fields.where, key)), value, "", 1.0, "", value))
        return value

    def mapping(self, figure: Fields, units: dict[str, float], *, signed: bool = False) -> float:
        """Return a figure that is a mapping, in SI units."""
        value = figure.number("value") if signed else figure.number("value", at_least=0.0)
        factor = figure.choice("unit", units) if "unit" in figure else 1.0
        sigmas = figure.number("sigmas", default=1.0, above=0.0)
        unit = str(figure.values.get("unit", ""))
        source = figure.text("source", "where the figure comes from") if "source" in figure else ""
        si = float(f"{value * factor / sigmas:.15g}")  # 200 ppm is 2e-4, not its neighbour
        self.figures.append(SensorFigure(field_name(figure.where), value, unit, sigmas, source, si))
        return si


def _uncorrected(fields: Fields, read: _Reader) -> UncorrectedErrors:
    if "uncorrected" not in fields:
        return UncorrectedErrors()
    errors = fields.fields("uncorrected", _UNCORRECTED)
    return UncorrectedErrors(
        bias_std=read.of(errors, "bias_std", _ACCELERATION),
        scale_std=read.of(errors, "scale_std", _RATIO),
        bias_temperature_std=_powers(errors, "bias_temperature_std", _ACCELERATION, read),
        scale_temperature_std=_powers(errors, "scale_temperature_std", _RATIO, read),
        reference_temperature=read.of(
            errors,
            "reference_temperature",
            _TEMPERATURE,
            signed=True,
            default=UncorrectedErrors().reference_temperature,
        ),
    )


def _powers(fields: Fields, key: str, units: dict[str, float], read: _Reader) -> NDArray[np.float64]:
    """Return three figures: per degC, degC^2 and degC^3."""
    if key not in fields:
        return np.zeros(3)
    values = fields.value(key, "a list of three figures")
    if not isinstance(values, list) or len(values) != 3:
        fields.fail(key, f"is {describe(values)}, must be a list of three figures: per degC, degC^2 and degC^3")
    numbers = []
    for power, value in enumerate(values):
        suffix = "/degC" if power == 0 else f"/degC^{power + 1}"
        item = Fields.of(
            fields.file,
            (*fields.where, key, power),
            value if isinstance(value, dict) else {"value": value},
            ("value", "sigmas", "unit", "source"),
        )
        numbers.append(read.mapping(item, {unit + suffix: factor for unit, factor in units.items()}))
    return np.array(numbers)


def _bands(
    fields: Fields, key: str, quantity: str, units: dict[str, float], read: _Reader
) -> list[tuple[float, float, float]]:
    if key not in fields:
        return []
    bands = []
    for band in fields.each(key, "a list of bands", ("from_hz", "to_hz", quantity)):
        low = band.number("from_hz", at_least=0.0)
        high = band.number("to_hz", above=low)
        if quantity not in band:
            band.fail(quantity, "is missing; a figure is needed")
        bands.append((low, high, read.of(band, quantity, units)))
    return bands
