"""What the report takes: a calibration's document and the arrays it was made from, by shape rather than by class."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Document = Mapping[str, Any]


class NamedJoint(Protocol):
    """A joint of the arm."""

    @property
    def name(self) -> str: ...  # noqa: D102


class NamedArm(Protocol):
    """The arm: its name and its joints, base to tip."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def joints(self) -> Sequence[NamedJoint]: ...  # noqa: D102


class Range(Protocol):
    """Half-open range of sample indices."""

    @property
    def begin(self) -> int: ...  # noqa: D102
    @property
    def end(self) -> int: ...  # noqa: D102


class Log(Protocol):
    """A log or still poses: time (N,) s, joints (N, n) rad or m, specific force (N, 3) m/s^2, rate Hz."""

    @property
    def time(self) -> Array: ...  # noqa: D102
    @property
    def joint_positions(self) -> Array: ...  # noqa: D102
    @property
    def specific_force(self) -> Array: ...  # noqa: D102
    @property
    def sample_rate(self) -> float: ...  # noqa: D102
    @property
    def is_static(self) -> bool: ...  # noqa: D102


class Dwell(Protocol):
    """A stretch at rest."""

    @property
    def samples(self) -> Range: ...  # noqa: D102


class Motion(Protocol):
    """A stretch in which one joint moved."""

    @property
    def joint(self) -> int: ...  # noqa: D102
    @property
    def samples(self) -> Range: ...  # noqa: D102
    @property
    def peak_velocity(self) -> float: ...  # noqa: D102


class Test(Protocol):
    """Everything of one joint recorded with the others at one configuration; dwells and motions by index."""

    @property
    def joint(self) -> int: ...  # noqa: D102
    @property
    def dwells(self) -> Sequence[int]: ...  # noqa: D102
    @property
    def motions(self) -> Sequence[int]: ...  # noqa: D102
    @property
    def dwell_span(self) -> float: ...  # noqa: D102
    @property
    def motion_span(self) -> float: ...  # noqa: D102


class Segments(Protocol):
    """The tests found in the log."""

    @property
    def dwells(self) -> Sequence[Dwell]: ...  # noqa: D102
    @property
    def motions(self) -> Sequence[Motion]: ...  # noqa: D102
    @property
    def tests(self) -> Sequence[Test]: ...  # noqa: D102


class TestFit(Protocol):
    """One test, measured and modelled through the same zero-phase filter, m/s^2; dwells as means, joint in rad or m."""

    @property
    def joint(self) -> int: ...  # noqa: D102
    @property
    def joint_name(self) -> str: ...  # noqa: D102
    @property
    def time(self) -> Array: ...  # noqa: D102
    @property
    def position(self) -> Array: ...  # noqa: D102
    @property
    def measured(self) -> Array: ...  # noqa: D102
    @property
    def modelled(self) -> Array: ...  # noqa: D102
    @property
    def dwell_positions(self) -> Array: ...  # noqa: D102
    @property
    def dwell_measured(self) -> Array: ...  # noqa: D102
    @property
    def dwell_modelled(self) -> Array: ...  # noqa: D102
    @property
    def residual_rms(self) -> float: ...  # noqa: D102
    @property
    def cutoff(self) -> float: ...  # noqa: D102


class CalibrationResult(Protocol):
    """A finished calibration with its intermediates; `document` is the content of calibration.json."""

    @property
    def document(self) -> Document: ...  # noqa: D102
    @property
    def arm(self) -> NamedArm: ...  # noqa: D102
    @property
    def fits(self) -> Sequence[TestFit]: ...  # noqa: D102
    @property
    def recording(self) -> Log: ...  # noqa: D102
    @property
    def segmentation(self) -> Segments: ...  # noqa: D102


def number(value: Any) -> float | None:
    """Return a document's number, or None where it is null or marked as a word."""
    if isinstance(value, Mapping):
        return number(value.get("value", value.get("estimate")))
    if isinstance(value, int | float) and not isinstance(value, bool) and np.isfinite(value):
        return float(value)
    return None


def vector(value: Any) -> list[float] | None:
    """Return a document's list of finite numbers, or None."""
    if isinstance(value, Mapping):
        return vector(value.get("value", value.get("estimate")))
    if not isinstance(value, Sequence | np.ndarray) or isinstance(value, str):
        return None
    numbers = [number(entry) for entry in np.asarray(value, dtype=object).ravel().tolist()]
    return None if any(entry is None for entry in numbers) else [entry for entry in numbers if entry is not None]


def is_estimated(joint: Document) -> bool:
    """Tell whether a document's joint has a line (a direction is enough for a prismatic joint)."""
    if vector(joint.get("direction_sensor")) is None:
        return False
    return joint.get("type") == "prismatic" or vector(joint.get("point_sensor")) is not None


def predicted_end_point_std(document: Document) -> tuple[float | None, float | None]:
    """Return the end-point's predicted standard deviation over the workspace: rms and largest, m."""
    end_point = document.get("end_point") or {}
    return number(end_point.get("rms")), number(end_point.get("max"))
