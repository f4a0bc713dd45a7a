"""How the whole-arm estimate treats a group of its parameters: fixed, free, or free with a prior."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from circlepoint._core import InvalidInput, ParameterTreatment

if TYPE_CHECKING:
    from collections.abc import Mapping

    from circlepoint._core import Recording, WholeArmOptions
    from circlepoint.document import Document

PARAMETER_GROUPS = {
    "bias": "m/s^2",
    "scale": "1",
    "misalignment": "rad",
    "percussion_distance": "m",
    "second_order": "s^2/m",
    "gravity": "m/s^2",
    "clock_offset": "s",
    "clock_rate": "1",
    "encoder_gain": "1",
    "eccentricity": "rad",
    "gyroscope_bias": "rad/s",
    "gyroscope_matrix": "1",
    "gyroscope_delay": "s",
}
"""Names, as those of `circlepoint.WholeArmOptions`, with the unit of a prior's standard deviation."""


_OF_GYROSCOPE = {name for name in PARAMETER_GROUPS if name.startswith("gyroscope")}
_OF_MOTION = {"percussion_distance", "clock_offset", "clock_rate"}


def require_visible(recording: Recording, treatments: Mapping[str, ParameterTreatment]) -> None:
    """Require that a recording is of the kind that has the parameters.

    Parameters
    ----------
    recording : Recording
    treatments : mapping of str to ParameterTreatment
        By names of `PARAMETER_GROUPS`.

    Raises
    ------
    InvalidInput
        For a gyroscope's where there is none, and for what still poses cannot show.
    """
    for name in treatments:
        if name in _OF_GYROSCOPE and recording.angular_velocity is None:
            raise InvalidInput(f"{name}: this recording has no gyroscope; leave it out")
        if recording.is_static and name in _OF_GYROSCOPE | _OF_MOTION:
            raise InvalidInput(f"{name}: still poses show nothing of it; leave it out")


def read_treatment(text: str) -> tuple[str, ParameterTreatment]:
    """Read ``NAME=fixed``, ``NAME=free`` or ``NAME=STD``.

    Parameters
    ----------
    text : str

    Returns
    -------
    name : str
        One of `PARAMETER_GROUPS`.
    treatment : ParameterTreatment
        Fixed at its nominal value, free, or with a Gaussian prior of that standard deviation about it.

    Raises
    ------
    InvalidInput
        Naming what was given and what may be.
    """
    name, _, how = text.partition("=")
    if name not in PARAMETER_GROUPS:
        raise InvalidInput(f"{text!r} names no group of parameters; there are {', '.join(PARAMETER_GROUPS)}")
    if how == "fixed":
        return name, ParameterTreatment(estimated=False)
    if how == "free":
        return name, ParameterTreatment()
    try:
        std = float(how)
    except ValueError:
        std = math.nan
    if not 0.0 < std < math.inf:
        raise InvalidInput(
            f"{text!r} says nothing of {name}; give {name}=fixed, {name}=free or {name}=STD, its standard deviation in "
            f"{PARAMETER_GROUPS[name]}"
        )
    return name, ParameterTreatment(std=std)


def set_treatments(options: WholeArmOptions, treatments: Mapping[str, ParameterTreatment]) -> None:
    """Set the options of the groups named.

    Parameters
    ----------
    options : WholeArmOptions
        Changed.
    treatments : mapping of str to ParameterTreatment
        By names of `PARAMETER_GROUPS`.

    Raises
    ------
    InvalidInput
        For another name, or a treatment that says nothing else than leaving the group out.
    """
    for name, treatment in treatments.items():
        if name not in PARAMETER_GROUPS:
            raise InvalidInput(f"{name!r} is no group of parameters; there are {', '.join(PARAMETER_GROUPS)}")
        if treatment.estimated and treatment.std == 0.0:
            raise InvalidInput(f"{name}: std is 0; give estimated=False to fix it, or leave it out")
        if treatment.where_evident:
            raise InvalidInput(f"{name}: where_evident is how encoders' errors are treated anyway; leave it out")
        setattr(options, name, treatment)


def treatment_entries(treatments: Mapping[str, ParameterTreatment]) -> Document:
    """Return what was asked as a document has it: ``"fixed"``, ``"free"``, or the prior's standard deviation."""
    return {name: _entry(treatment) for name, treatment in treatments.items()}


def _entry(treatment: ParameterTreatment) -> str | float:
    if not treatment.estimated:
        return "fixed"
    return treatment.std if math.isfinite(treatment.std) else "free"
