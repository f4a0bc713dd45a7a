"""The joint and Denavit-Hartenberg tables as plain text, for a terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from circlepoint.report.comparison import line_errors, nominal_differences
from circlepoint.report.inputs import Document, is_estimated, number, vector
from circlepoint.report.rounding import (
    ABSENT,
    FREE,
    PLUS_MINUS,
    align_decimals,
    decimals_of,
    format_std,
    format_uncertain,
    format_value,
    significant,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_gap = "  "


def format_joint_table(document: Document, truth: Mapping[str, Any] | None = None) -> str:
    """Format the joint axes as a table for a terminal.

    Parameters
    ----------
    document : mapping
        The content of `calibration.json`.
    truth : mapping, optional
        The known arm (`joints[i]` with `direction_sensor`, `point_sensor` in m); adds the columns of true errors.

    Returns
    -------
    str
        One row a joint: direction, nearest point in mm, standard deviations in mrad and mm; under them the reasons
        why joints could not be estimated. No rows where none could.
    """
    joints = document["joints"]
    columns = [["", "joint", *(joint["name"] for joint in joints)]]
    columns += _components("direction", joints, ("direction_sensor", "direction_std"), 1.0, 5)
    columns += _components("nearest point, mm", joints, ("point_sensor", "point_std"), 1e3, 2)
    columns.append(["std", "mrad", *align_decimals([_scaled_std(joint, "direction_std") for joint in joints])])
    columns.append(["", "mm", *align_decimals([_scaled_std(joint, "point_std") for joint in joints])])
    if truth is not None:
        errors = line_errors(document, truth)
        columns.append(["error", "mrad", *align_decimals([milli(error.direction) for error in errors])])
        columns.append(["", "mm", *align_decimals([milli(error.point) for error in errors])])
    nominal = None if truth is not None else nominal_differences(document)
    if nominal is not None:
        columns.append(["off nominal", "mrad", *align_decimals([milli(entry.direction) for entry in nominal])])
        columns.append(["", "mm", *align_decimals([milli(entry.point) for entry in nominal])])
    lines = _layout(columns, header_rows=2) if any(map(is_estimated, joints)) else []
    lines += [f"{', '.join(names)}: not estimated. {reason}" for reason, names in missing_joints(document).items()]
    lines += [f"{joint['name']}, {seen}" for joint in joints if (seen := as_far_as_seen(joint))]
    return "\n".join(lines) + "\n"


def missing_joints(document: Document) -> dict[str, list[str]]:
    """Return the names of the joints that were not estimated, by reason."""
    reasons: dict[str, list[str]] = {}
    for joint in document["joints"]:
        if not is_estimated(joint):
            reasons.setdefault(joint.get("reason") or "No reason was given.", []).append(joint["name"])
    return reasons


def as_far_as_seen(joint: Document) -> str:
    """Return what is known of a joint's axis that is too vague to be given; empty where nothing is."""
    vague = joint.get("vague")
    if vague is None:
        return ""
    direction = ", ".join(f"{component:.4f}" for component in vague["direction_sensor"])
    std = significant(1e3 * vague["direction_std"])
    seen = f"as far as it is seen: direction ({direction}) {PLUS_MINUS} {std} mrad"
    if vague["point_sensor"] is not None:
        point = ", ".join(f"{1e3 * component:.0f}" for component in vague["point_sensor"])
        seen += f", nearest point ({point}) {PLUS_MINUS} {significant(1e3 * vague['point_std'])} mm"
    return seen


def format_dh_table(document: Document) -> str:
    """Format the Denavit-Hartenberg parameters, value ± standard deviation, in mm and degrees.

    Parameters
    ----------
    document : mapping
        The content of `calibration.json`.

    Returns
    -------
    str
        One row a joint; parameters that only place the base are marked "free". One line of explanation where the
        document has no parameters.
    """
    dh = document.get("dh")
    rows = (dh or {}).get("rows")
    if not dh or not rows:
        return "No Denavit-Hartenberg parameters: they need every joint's axis.\n"
    names = [joint["name"] for joint in document["joints"]]
    columns = [["joint", *(names[i] if i < len(names) else str(i + 1) for i in range(len(rows)))]]
    for key, unit, scale in dh_columns(dh):
        cells = [dh_cell(row, key, scale) for row in rows]
        values = align_decimals([value for value, _ in cells])
        stds = align_decimals([std for _, std in cells])
        value_width = max(len(value) for value in values)
        std_width = max(len(std) for std in stds)
        joined = [
            f"{value:>{value_width}} {_uncertainty(std):<{std_width + 2}}"
            for value, std in zip(values, stds, strict=True)
        ]
        columns.append([f"{key} {unit}", *joined])
    lines = [dh_title(dh)]
    return "\n".join(lines + _layout(columns)) + "\n"


def dh_title(dh: Document) -> str:
    """Return what the parameters are called."""
    convention = dh.get("convention", "standard")
    if convention == "hayati":
        return "Denavit-Hartenberg parameters, with Hayati rows (beta) before nearly parallel axes"
    return f"{convention} Denavit-Hartenberg parameters"


def dh_columns(dh: Document) -> list[tuple[str, str, float]]:
    """Return the parameters in their order: key, unit shown, factor from SI."""
    columns = [
        ("a", "mm", 1e3),
        ("alpha", "deg", math.degrees(1.0)),
        ("d", "mm", 1e3),
        ("theta", "deg", math.degrees(1.0)),
    ]
    return [*columns, ("beta", "deg", math.degrees(1.0))] if dh.get("convention") == "hayati" else columns


def dh_cell(row: Document, key: str, scale: float) -> tuple[str, str]:
    """Return value and uncertainty of one parameter of a row; the uncertainty of a free one is the word."""
    value, std = number(row.get(key)), row.get("std", {}).get(key)
    if key == ("d" if row.get("form") == "hayati" else "beta" if "form" in row else None):
        return "", ""  # not a parameter of this row
    if std == FREE:
        return format_value(0.0 if value is None else value * scale, 0 if not value else 3), FREE
    std = number(std)
    return format_uncertain(
        None if value is None else value * scale,
        None if std is None else std * scale,
        3,
    )


def line_components(joint: Document, keys: tuple[str, str], scale: float, default: int) -> list[str]:
    """Return the three components of a joint's vector, ending at the digit its standard deviation allows."""
    components = vector(joint.get(keys[0])) if is_estimated(joint) else None
    if components is None:
        return [ABSENT] * 3
    std = number(joint.get(keys[1]))
    decimals = decimals_of(None if std is None else std * scale, default)
    return [format_value(component * scale, decimals) for component in components]


def _components(
    title: str, joints: Sequence[Document], keys: tuple[str, str], scale: float, default: int
) -> list[list[str]]:
    rows = [line_components(joint, keys, scale, default) for joint in joints]
    return [[title if k == 0 else "", axis, *align_decimals([row[k] for row in rows])] for k, axis in enumerate("xyz")]


def _scaled_std(joint: Document, key: str) -> str:
    std = number(joint.get(key)) if is_estimated(joint) else None
    return format_std(None if std is None else std * 1e3)


def milli(value: float | None) -> str:
    """Return a thousandfold with two significant digits: rad in mrad, m in mm."""
    return significant(None if value is None else value * 1e3)


def _uncertainty(std: str) -> str:
    return std if std.strip() in {"", FREE} else f"{PLUS_MINUS} {std}"


def _layout(columns: list[list[str]], header_rows: int = 1) -> list[str]:
    """Set columns side by side; a title in the upper of two header rows may run over the empty ones to its right."""
    widths = [max(len(cell) for cell in column[header_rows - 1 :]) for column in columns]
    lines = []
    for row in zip(*(column[header_rows - 1 :] for column in columns), strict=True):
        cells = [f"{row[0]:<{widths[0]}}"]
        cells += [f"{cell:>{width}}" for cell, width in zip(row[1:], widths[1:], strict=True)]
        lines.append(_gap.join(cells).rstrip())
    rule = "-" * max(len(line) for line in lines)
    if header_rows == 1:
        return [lines[0], rule, *lines[1:]]
    titles, position = "", 0
    for column, width in zip(columns, widths, strict=True):
        if column[0]:
            titles = f"{titles:<{position}}{column[0]}"
        position += width + len(_gap)
    return [titles, lines[0], rule, *lines[1:]]
