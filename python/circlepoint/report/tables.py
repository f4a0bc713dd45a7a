"""The page's tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from circlepoint.report.comparison import line_errors, nominal_differences
from circlepoint.report.figures import position_unit
from circlepoint.report.html import Column, escaped, numbers, table
from circlepoint.report.inputs import CalibrationResult, Document, is_estimated, number, vector
from circlepoint.report.rounding import (
    ABSENT,
    FREE,
    PLUS_MINUS,
    format_std,
    format_uncertain,
    format_value,
    significant,
)
from circlepoint.report.text import as_far_as_seen, dh_cell, dh_columns, dh_title, line_components, milli

_sensor_rows = [  # key, label, names of the components, unit, factor from SI
    ("bias", "bias", "xyz", "mm/s²", 1e3),
    ("scale", "scale error", "xyz", "ppm", 1e6),
    ("misalignment", "misalignment", ("yx", "zx", "zy"), "mrad", 1e3),
    ("percussion_distance", "percussion distance", "xyz", "mm", 1e3),
    ("clock_offset", "clock offset", ("",), "ms", 1e3),
    ("clock_rate", "clock rate", ("",), "1", 1.0),
]
_gyroscope_rows = [("bias", "gyroscope's bias", "xyz", "mrad/s", 1e3), ("delay", "gyroscope's delay", ("",), "ms", 1e3)]


def joint_table(document: Document, truth: Mapping[str, Any] | None) -> str:
    """Return the table of joint axes; joints without a line carry the reason underneath."""
    joints: Sequence[Document] = document["joints"]
    columns = [
        Column("joint", [_joint_name(i, joint) for i, joint in enumerate(joints)], "name"),
        Column("at q<sub>ref</sub>", _reference(document), group=""),
    ]
    directions = [line_components(joint, ("direction_sensor", "direction_std"), 1.0, 5) for joint in joints]
    points = [line_components(joint, ("point_sensor", "point_std"), 1e3, 2) for joint in joints]
    columns += [
        Column(axis, numbers([row[k] for row in directions]), group="direction") for k, axis in enumerate("xyz")
    ]
    columns += [
        Column(axis, numbers([row[k] for row in points]), group="nearest point, mm") for k, axis in enumerate("xyz")
    ]
    for title, key in (("mrad", "direction_std"), ("mm", "point_std")):
        values = [number(joint.get(key)) if is_estimated(joint) else None for joint in joints]
        columns.append(
            Column(title, numbers([format_std(None if v is None else 1e3 * v) for v in values]), group="std")
        )
    if truth is not None:
        errors = line_errors(document, truth)
        columns.append(Column("mrad", numbers([milli(e.direction) for e in errors]), group="true error"))
        columns.append(Column("mm", numbers([milli(e.point) for e in errors]), group="true error"))
    nominal = None if truth is not None else nominal_differences(document)
    if nominal is not None:
        columns.append(Column("mrad", numbers([milli(e.direction) for e in nominal]), group="off nominal"))
        columns.append(Column("mm", numbers([milli(e.point) for e in nominal]), group="off nominal"))
    missing = [_not_estimated(joint) for joint in joints if not is_estimated(joint)]
    caption = "Joint axes in the sensor frame at the reference configuration"
    return table(columns, caption) + (f'<ul class="missing">{"".join(missing)}</ul>' if missing else "")


def _not_estimated(joint: Document) -> str:
    said = [joint.get("reason") or "No reason was given.", as_far_as_seen(joint)]
    text = "; ".join(part.removesuffix(".") for part in said if part)
    return f"<li><strong>{escaped(joint['name'])}</strong> is not estimated: {escaped(text)}.</li>"


def dh_table(document: Document) -> str:
    """Return the table of Denavit-Hartenberg parameters; the free ones say so."""
    dh = document["dh"]
    rows = dh["rows"]
    joints: Sequence[Document] = document["joints"]
    names = [_joint_name(i, joints[i]) if i < len(joints) else str(i + 1) for i in range(len(rows))]
    columns = [Column("joint", names, "name")]
    symbols = {"a": "a", "alpha": "\N{GREEK SMALL LETTER ALPHA}", "d": "d", "theta": "θ", "beta": "β"}
    for key, unit, scale in dh_columns(dh):
        cells = [dh_cell(row, key, scale) for row in rows]
        group = f"{symbols[key]}, {unit}"
        columns.append(Column("value", numbers([value for value, _ in cells]), group=group))
        columns.append(Column("std", [_uncertainty(std) for _, std in cells], "std", group=group))
    return table(columns, escaped(dh_title(dh)))


def test_table(calibration: CalibrationResult) -> str:
    """Return what was recorded of each joint, and what its model left."""
    joints: Sequence[Document] = calibration.document["joints"]
    segments, time = calibration.segmentation, calibration.recording.time
    rows: list[list[str]] = []
    for index, joint in enumerate(joints):
        scale, unit = position_unit(joint)
        tests = [test for test in segments.tests if test.joint == index]
        fits = [fit for fit in calibration.fits if fit.joint == index]
        name = _joint_name(index, joint)
        if not tests:
            rows.append([name, "none", *[ABSENT] * 6])
        for order, test in enumerate(tests):
            motions = [segments.motions[i] for i in test.motions]
            moving = sum(float(time[m.samples.end - 1] - time[m.samples.begin]) for m in motions)
            peak = max((m.peak_velocity for m in motions), default=0.0)
            residual = format_value(1e3 * fits[order].residual_rms, 1) if order < len(fits) else ABSENT
            rows.append(
                [
                    name,
                    str(len(test.dwells)),
                    f"{test.dwell_span * scale:.0f} {unit}" if test.dwells else ABSENT,
                    str(len(motions)),
                    f"{test.motion_span * scale:.0f} {unit}" if motions else ABSENT,
                    f"{peak * scale:.0f} {unit}/s" if motions else ABSENT,
                    f"{moving:.1f}" if motions else ABSENT,
                    residual,
                ]
            )
    titles = ["joint", "dwells", "span", "motions", "largest travel", "peak speed", "moving, s", "residual rms, mm/s²"]
    columns = [
        Column(title, [row[k] if k == 0 else escaped(row[k]) for row in rows], "name" if k == 0 else "number")
        for k, title in enumerate(titles)
    ]
    return table(columns, "Single-joint tests found in the log")


def hold_out_table(document: Document) -> str:
    """Return residuals by kind of motion, also on data the estimate did not see; empty where the result has none."""
    entries: Sequence[Document] = document.get("hold_out") or []
    if not entries:
        return ""
    names = {joint["name"]: index for index, joint in enumerate(document["joints"])}

    def listed(key: str, scale: float) -> list[str]:
        values = [number(entry.get(key)) for entry in entries]
        return [significant(None if value is None else scale * value, 3) for value in values]

    titles = [
        _joint_name(names[entry["name"]], document["joints"][names[entry["name"]]])
        if entry["name"] in names
        else escaped(entry["name"])
        for entry in entries
    ]
    columns = [
        Column("motion", titles, "name"),
        Column("rows", [escaped(entry["samples"]) for entry in entries]),
        Column("mm/s²", numbers(listed("residual_rms", 1e3)), group="residual"),
        Column("normalised", numbers(listed("normalised_rms", 1.0)), group="residual"),
        Column("mm/s²", numbers(listed("held_out_rms", 1e3)), group="on data not used"),
        Column("normalised", numbers(listed("held_out_normalised_rms", 1.0)), group="on data not used"),
    ]
    return table(columns, "Residuals, and those of estimates that did not see the stretch or dwell in question")


def sensor_table(document: Document, truth: Mapping[str, Any] | None) -> str:
    """Return the table of the sensor's parameters."""
    sensor = document.get("sensor") or {}
    gyroscope = sensor.get("gyroscope")
    known: Mapping[str, Any] = {**(truth or {}), **((truth or {}).get("sensor") or {})}
    names, values, stds, truths, units = [], [], [], [], []
    rows = [(sensor.get(row[0]), known.get(row[0]), *row[1:]) for row in _sensor_rows]
    if gyroscope is not None:
        rows += [(gyroscope.get(row[0]), None, *row[1:]) for row in _gyroscope_rows]
    for entry, true_entry, label, components, unit, scale in rows:
        estimate, deviation = _entry(entry)
        true_values = _entry(true_entry)[0] or []
        if estimate is None:
            estimate, deviation = [None], []
        for k, value in enumerate(estimate):
            component = components[k] if len(estimate) == len(components) else str(k + 1) if len(estimate) > 1 else ""
            std = deviation[k] if k < len(deviation) else None
            text, uncertainty = format_uncertain(
                None if value is None else scale * value, None if std is None else scale * std, 4
            )
            true_value = true_values[k] if k < len(true_values) else true_values[0] if true_values else None
            names.append(escaped(f"{label} {component}".strip()))
            values.append(text)
            stds.append(_uncertainty(uncertainty) if value is not None else "not estimated")
            truths.append(significant(None if true_value is None else scale * true_value, 4))
            units.append(escaped("ratio" if unit == "1" else unit))
    columns = [Column("parameter", names, "name"), Column("value", numbers(values)), Column("std", stds, "std")]
    if any(any(character.isdigit() for character in text) for text in truths):
        columns.append(Column("true", numbers(truths)))
    columns.append(Column("unit", units, "name"))
    return table(columns, "Accelerometer" if gyroscope is None else "Accelerometer and gyroscope")


def frame_table(title: str, matrix: Any) -> str:
    """Return a rigid transform: rotation, and translation in mm. Empty where the document has none."""
    entries = vector(matrix)
    if entries is None or len(entries) != 16:
        return ""
    rows = [entries[4 * i : 4 * i + 4] for i in range(3)]
    columns = [Column("", list("xyz"), "name")]
    columns += [
        Column(axis, numbers([format_value(row[k], 6) for row in rows]), group="rotation")
        for k, axis in enumerate("xyz")
    ]
    columns.append(Column("mm", numbers([format_value(1e3 * row[3], 3) for row in rows]), group="translation"))
    return table(columns, title)


def _joint_name(index: int, joint: Document) -> str:
    kind = "" if joint.get("type", "revolute") == "revolute" else f" <small>{escaped(joint['type'])}</small>"
    return f'<i class="dot" style="background:var(--joint{index % 8})"></i>{escaped(joint["name"])}{kind}'


def _reference(document: Document) -> list[str]:
    positions = vector(document.get("reference_configuration")) or []
    texts = []
    for index, joint in enumerate(document["joints"]):
        scale, unit = position_unit(joint)
        texts.append(f"{positions[index] * scale:.1f} {unit}" if index < len(positions) else ABSENT)
    return [escaped(text.replace("-", "\N{MINUS SIGN}")) for text in texts]


def _uncertainty(std: str) -> str:
    if std == FREE:
        return f'<em class="free">{FREE}</em>'
    return f"{PLUS_MINUS}\N{NO-BREAK SPACE}{escaped(std)}" if std else ""


def _entry(value: Any) -> tuple[list[float | None] | None, list[float | None]]:
    """Return an entry's components and their standard deviations, whether it is one number or several."""

    def listed(part: Any) -> list[float | None]:
        if isinstance(part, Sequence) and not isinstance(part, str):
            return [entry for item in part for entry in listed(item)]
        return [number(part)]

    if value is None:
        return None, []
    if isinstance(value, Mapping):
        values, stds = listed(value.get("value", value.get("estimate"))), listed(value.get("std"))
    else:
        values, stds = listed(value), []
    if all(entry is None for entry in values):
        return None, []
    return values, stds
