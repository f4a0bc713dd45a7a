"""Kinds of accelerometers: the presets that ship with the package, and files of the same form."""

from __future__ import annotations

from pathlib import Path

from circlepoint._core import AccelerometerSpecification, InvalidInput
from circlepoint.yaml_io import load_fields

PRESETS = Path(__file__).parent / "sensors"

_FIELDS = (
    "bias_std",
    "scale_std",
    "misalignment_std",
    "percussion_distance",
    "percussion_distance_std",
    "second_order_std",
    "noise_std",
    "range",
)


def sensor_names() -> list[str]:
    """Return the names of the presets."""
    return sorted(path.stem for path in PRESETS.glob("*.yaml"))


def load_sensor(name_or_path: str | Path) -> AccelerometerSpecification:
    """Load what is known of a kind of accelerometer.

    Parameters
    ----------
    name_or_path
        The name of a preset, or a YAML file with ``name`` and the fields of `AccelerometerSpecification` in SI units;
        a field that is not there is zero, but for ``bias_std``, ``scale_std`` and ``noise_std``, which must be said.

    Returns
    -------
    AccelerometerSpecification

    Raises
    ------
    InvalidInput
        For a name that is neither a preset nor a file, and for a file with an unknown, missing or impossible field.
    """
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
    return AccelerometerSpecification(
        bias_std=fields.number("bias_std", at_least=0.0),
        scale_std=fields.number("scale_std", at_least=0.0),
        misalignment_std=fields.number("misalignment_std", default=0.0, at_least=0.0),
        percussion_distance=fields.number("percussion_distance", default=0.0),
        percussion_distance_std=fields.number("percussion_distance_std", default=0.0, at_least=0.0),
        second_order_std=fields.number("second_order_std", default=0.0, at_least=0.0),
        noise_std=fields.number("noise_std", at_least=0.0),
        range=fields.number("range", default=0.0, at_least=0.0),
    )
