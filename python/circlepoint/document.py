"""The document a calibration is written as: ``calibration.json``, its parts, its schema, and writing it whole.

Every field is described, with its unit, in the JSON Schema shipped as ``circlepoint/schema/calibration-1.json``
(`load_schema`). Nothing here computes: it names and arranges what it is given.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from circlepoint._core import JointType, __version__
from circlepoint.atomic import write_atomically

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    import circlepoint
    from circlepoint._core import JointAxis
    from circlepoint.findings import Finding
    from circlepoint.recording_io import LoadedRecording

SCHEMA_NAME = "circlepoint/calibration/1"
"""Value of the field ``schema``: name and version of the format."""

Document = dict[str, Any]


def load_schema() -> Document:
    """Return the JSON Schema (draft 2020-12) of ``calibration.json``."""
    text = resources.files("circlepoint").joinpath("schema/calibration-1.json").read_text(encoding="utf-8")
    schema: Document = json.loads(text)
    return schema


def generator_entry() -> Document:
    """Field ``generator``: the program and its version."""
    return {"name": "circlepoint", "version": __version__}


def estimate_entry(estimate: ArrayLike | None, std: ArrayLike | None) -> Document | None:
    """Return a field of ``sensor``: estimate and standard deviation, or null where there is none."""
    if estimate is None or std is None:
        return None
    return {"estimate": plain(estimate), "std": plain(std)}


def dh_row_entry(values: Mapping[str, float], stds: ArrayLike, free: ArrayLike) -> Document:
    """Return a row of Denavit-Hartenberg or Hayati parameters.

    Parameters
    ----------
    values : mapping
        a, alpha, d, theta and, of a Hayati row, beta; m and rad.
    stds : array_like
        Their standard deviations; NaN where there is none.
    free : array_like of bool
        Whether each is a choice that only places the base or the tool.
    """
    spread: list[float | str | None] = [
        "free" if choice else None if np.isnan(std) else float(std)
        for std, choice in zip(np.asarray(stds, dtype=float), np.asarray(free, dtype=bool), strict=True)
    ]
    return {**{name: float(value) for name, value in values.items()}, "std": dict(zip(values, spread, strict=True))}


def joint_entry(
    name: str,
    joint_type: str,
    *,
    direction: ArrayLike,
    point: ArrayLike | None,
    direction_std: float,
    point_std: float | None,
    covariance: ArrayLike,
    basis: ArrayLike,
    tests: Sequence[Mapping[str, Any]] = (),
    nominal: Mapping[str, Any] | None = None,
) -> Document:
    """Return an entry of ``joints`` whose axis was estimated.

    Parameters
    ----------
    name, joint_type : str
        As the arm's description has them.
    direction : array_like, shape (3,)
        Unit direction, sensor frame at the reference configuration.
    point : array_like, shape (3,), or None
        m; nearest point to the sensor's origin. None for a prismatic joint.
    direction_std : float
        rad.
    point_std : float or None
        m; None for a prismatic joint.
    covariance : array_like, shape (4, 4)
        Of (d1, d2, p1, p2): rad^2, rad m, m^2.
    basis : array_like, shape (2, 3)
        The vectors u and v the local coordinates are along.
    tests : sequence of mapping
        What was recorded of this joint.
    nominal : mapping, optional
        Where the arm's description puts the axis.
    """
    prismatic = joint_type == "prismatic"
    return {
        "name": name,
        "type": joint_type,
        "direction_sensor": plain(direction),
        "direction_std": float(direction_std),
        "point_sensor": None if prismatic or point is None else plain(point),
        "point_std": None if prismatic or point_std is None else float(point_std),
        "covariance": plain(covariance),
        "covariance_basis": plain(basis),
        "reason": None,
        "tests": plain(list(tests)),
        "nominal": plain(nominal),
    }


def missing_joint_entry(
    name: str,
    joint_type: str,
    reason: str,
    tests: Sequence[Mapping[str, Any]] = (),
    vague: JointAxis | None = None,
) -> Document:
    """Return an entry of ``joints`` whose axis could not be estimated, with the reason and what is known of it."""
    line = dict.fromkeys(
        ("direction_sensor", "direction_std", "point_sensor", "point_std", "covariance", "covariance_basis")
    )
    entry: Document = {"name": name, "type": joint_type, **line, "reason": reason, "tests": plain(list(tests))}
    if vague is not None:
        has_point = vague.screw.type == JointType.revolute and math.isfinite(vague.point_std())
        entry["vague"] = {
            "direction_sensor": plain(vague.screw.line.direction),
            "direction_std": vague.direction_std(),
            "point_sensor": plain(vague.screw.line.point) if has_point else None,
            "point_std": vague.point_std() if has_point else None,
        }
    return entry


def with_description(document: Mapping[str, Any], path: Path, base: str | None, tip: str | None) -> Document:
    """Return the document with the arm's description it was made with: a file, and links of a URDF."""
    return {**document, "description": {"file": path.name, "base": base, "tip": tip}}


def with_reading(document: Mapping[str, Any], loaded: LoadedRecording) -> Document:
    """Return the document with what reading the files has shown: clocks, findings, what was recorded.

    Parameters
    ----------
    document : mapping
        A calibration document; fields ``sensor`` and ``findings`` are added to, ``recording`` is set.
    loaded : LoadedRecording
        From `read_recording`.
    """
    recording = loaded.recording
    sensor = dict(document["sensor"])
    if len(loaded.clock_alignments) == 1:
        sensor |= _clock_entries(loaded.clock_alignments[0], document["sensor"], loaded.recording)
    return {
        **document,
        "sensor": sensor,
        "recording": {
            "files": [file.path.name for file in loaded.files],
            "samples": int(recording.samples),
            "duration": float(recording.time[-1] - recording.time[0]),
            "sample_rate": float(recording.sample_rate),
            "spans": len(recording.spans),
            "static": bool(recording.is_static),
        },
        "findings": [*document["findings"], *finding_entries(loaded.findings)],
    }


def _clock_entries(
    clock: circlepoint.ClockAlignment, sensor: Mapping[str, Any], recording: circlepoint.Recording
) -> Document:
    """Return the clocks' relation, the estimate's correction of the alignment included where there is one.

    The recording's time is the joints'; a sample stamped t by it shows the joints at
    t - offset - (rate - 1) (t - middle), with the estimate's offset and rate.
    """
    offset, rate = sensor["clock_offset"], sensor["clock_rate"]
    if offset is None or rate is None:
        return {
            "clock_offset": estimate_entry(clock.offset, clock.offset_std),
            "clock_rate": estimate_entry(clock.rate, clock.rate_std),
        }
    middle = 0.5 * float(recording.time[0] + recording.time[-1])
    slow = rate["estimate"] - 1.0
    at_zero = offset["estimate"] - slow * middle
    return {
        "clock_offset": estimate_entry(
            clock.offset + clock.rate * at_zero, float(np.hypot(offset["std"], middle * rate["std"]))
        ),
        "clock_rate": estimate_entry(clock.rate * (1.0 + slow), rate["std"]),
    }


def finding_entries(findings: Sequence[Finding]) -> list[Document]:
    """Field ``findings``."""
    return [{"code": finding.code, "message": finding.message, "joint": finding.joint} for finding in findings]


def plain(value: Any) -> Any:
    """`value` as JSON has it: arrays as lists, NumPy numbers as numbers, paths as text."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    return value


def require_consistent(document: Mapping[str, Any]) -> None:
    """Raise ValueError unless the document has every field, no unknown one, finite numbers and sizes that agree.

    The full shape is in the schema; this is what must not be wrong in a file others act on.
    """
    schema = load_schema()
    missing = [name for name in schema["required"] if name not in document]
    unknown = [name for name in document if name not in schema["properties"]]
    if missing or unknown:
        raise ValueError(f"calibration document: missing fields {missing}, fields not in the schema {unknown}")
    if document["schema"] != SCHEMA_NAME:
        raise ValueError(f"calibration document: schema is {document['schema']!r}, must be {SCHEMA_NAME!r}")
    _require_finite(document, "")
    joints = document["joints"]
    if len(joints) != len(document["reference_configuration"]):
        raise ValueError(
            f"calibration document: {len(joints)} joints, reference of {len(document['reference_configuration'])}"
        )
    estimated = [joint["direction_sensor"] is not None for joint in joints]
    if document["complete"] != all(estimated):
        raise ValueError(f"calibration document: complete is {document['complete']}, joints estimated are {estimated}")
    for joint in joints:
        if joint["direction_sensor"] is None and not joint.get("reason"):
            raise ValueError(f"calibration document: joint {joint['name']!r} is not estimated and has no reason")
    covariance = document["covariance"]
    if covariance is not None:
        size = len(covariance["parameters"])
        if np.shape(covariance["matrix"]) != ((size, size) if size else (0,)):
            raise ValueError(
                f"calibration document: covariance of {np.shape(covariance['matrix'])} for {size} parameters"
            )


def write_document(path: str | Path, document: Mapping[str, Any]) -> None:
    """Write a calibration document, whole or not at all.

    Parameters
    ----------
    path : str or Path
        The file; its folder must exist. An earlier file stays untouched until the new one is complete.
    document : mapping
        The fields the schema describes; arrays and NumPy numbers are written as lists and numbers.

    Raises
    ------
    ValueError
        When the document is not consistent (`require_consistent`): a fault of the program, not of the data.
    OSError
        When the file cannot be written.
    """
    content = plain(document)
    require_consistent(content)
    write_atomically(Path(path), (json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n").encode())


def _require_finite(value: Any, where: str) -> None:
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"calibration document: {where} is {value}, must be finite or null")
    if isinstance(value, Mapping):
        for key, item in value.items():
            _require_finite(item, f"{where}.{key}" if where else str(key))
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value):
            _require_finite(item, f"{where}[{index}]")
