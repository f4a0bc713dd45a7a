"""One table as a log: joints, sensor or both, in SI units on the table's clock.

A table with joints and sensor at two rates, or with a clock of the sensor's own, is two logs.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import circlepoint
from circlepoint.clocks import Log
from circlepoint.column_map import (
    ACCELERATION_UNITS,
    RATE_UNITS,
    TEMPERATURE_UNITS,
    TIME_UNITS,
    ColumnMap,
    FileColumns,
)
from circlepoint.findings import Finding
from circlepoint.log_table import LogTable, RowsWith, empty_rows, require_finite
from circlepoint.long_logs import gap_options, read_column, thin, thinning_factor
from circlepoint.plausibility import (
    joint_findings,
    specific_force_findings,
    time_findings,
    unwrap_joints,
)
from circlepoint.stamps import require_order, table_timeline, timeline_findings

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from circlepoint.arm import Arm

FloatArray = NDArray[np.float64]

MIN_SAMPLES = 8
"""Fewer rows have no sample rate."""
MIN_POSES = 3
"""Still poses in a table of them."""
MIN_SHARE = 0.02
"""Part of the rows without joints, and of those without sensor, above which one log holds two rates."""


def read_logs(table: LogTable, names: FileColumns, arm: Arm, column_map: ColumnMap, gravity: float) -> Iterator[Log]:
    """Yield the log in a table, or the two of different rates or clocks.

    Parameters
    ----------
    table : LogTable
    names : FileColumns
        Which of its columns are what.
    arm : Arm
        The joints that are driven.
    column_map : ColumnMap
        Units and signs, where they are not those of the columns' names.
    gravity : float
        m/s^2, against which the accelerometer's unit is judged.

    Yields
    ------
    Log
        Joint positions (N, n) in rad or m, specific force (N, 3) in m/s^2, or both.

    Raises
    ------
    InvalidInput
        Naming table, row, column, value and remedy.
    """
    data = None if table.long else table.read(names.used)
    halves: list[tuple[LogTable, FileColumns]] = [(table, names)]
    if names.joints and names.specific_force and not names.static:
        pieces = table.batches([*names.joints, *names.specific_force]) if data is None else [data]
        if _have_two_rates(pieces, names.joints, names.specific_force):
            halves = [
                (RowsWith(table, names.joints), names.joint_half),
                (RowsWith(table, names.specific_force), names.sensor_half),
            ]
        elif names.sensor_time:
            halves = [(table, names.joint_half), (table, names.sensor_half)]
    claimed = bool(table.part) or (len(halves) == 2 and not names.sensor_time)
    for half, columns in halves:
        if half.long:
            log = _read_long_log(half, columns, arm, column_map, gravity)
        else:
            values = data if half is table and data is not None else half.read(columns.used)
            log = _read_log(half, columns, values, arm, column_map, gravity=gravity)
        yield replace(log, one_clock=claimed)


def _have_two_rates(pieces: Iterable[dict[str, FloatArray]], joints: tuple[str, ...], force: tuple[str, ...]) -> bool:
    """Whether many rows of a log have no joints, or no sensor."""
    rows = 0
    empty = np.zeros(2, dtype=int)
    for piece in pieces:
        rows += piece[joints[0]].size
        empty += [np.count_nonzero(empty_rows(piece, group)) for group in (joints, force)]
    return rows >= MIN_SAMPLES and bool(empty.max() >= MIN_SHARE * rows)


def _read_long_log(table: LogTable, names: FileColumns, arm: Arm, column_map: ColumnMap, gravity: float) -> Log:
    """Read a log that may be too long for memory: its time first, which says how much of it to keep."""
    units = {**names.units, **column_map.units}
    second = TIME_UNITS[units.get("t", "s")]
    stamps = read_column(table, names.time)
    rate = (stamps.size - 1) / max(float(stamps[-1] - stamps[0]) * second, 1e-9) if stamps.size > 1 else 0.0
    factor = thinning_factor(stamps.size, rate) if np.isfinite(rate) else 1
    if factor == 1:
        del stamps
        return _read_log(table, names, table.read(names.used), arm, column_map, gravity=gravity)
    require_finite(table, names.time, stamps)
    require_order(table, names.time, stamps)
    stamps *= second
    timeline = table_timeline(table, stamps, gap_options(factor))
    thinned = thin(
        table,
        names,
        stamps,
        timeline,
        factor=factor,
        units=(second, ACCELERATION_UNITS[units.get("a", "m/s^2")]),
    )
    del stamps
    log = _read_log(table, names, thinned.data, arm, column_map, gravity=gravity)
    notes = timeline_findings(timeline, table.label)
    kept = [finding for finding in log.findings if finding.code not in {"timeline", "clipping"}]
    return replace(log, timeline=timeline, findings=[*notes, *thinned.findings, *kept])


def _read_log(
    table: LogTable,
    names: FileColumns,
    data: dict[str, FloatArray],
    arm: Arm,
    column_map: ColumnMap,
    *,
    gravity: float,
) -> Log:
    column_map = replace(column_map, units={**names.units, **column_map.units})
    rows = data[names.time].size
    if names.static and rows < MIN_POSES:
        raise table.error(f"has {rows} still poses, at least {MIN_POSES} are needed, better four a joint")
    if not names.static and rows < MIN_SAMPLES:
        raise table.error(
            f"has {rows} samples, at least {MIN_SAMPLES} are needed (a calibration takes minutes of them)"
        )
    for name in (names.time, *(names.joints or ()), *(names.specific_force or ())):
        require_finite(table, name, data[name], static=names.static)
    source = table.label
    findings = [*table.findings, *(Finding("columns", f"{source}: {note}") for note in names.notes)]
    if names.static:
        _require_one_row_a_pose(table, names.time, data[names.time])
        time = np.arange(rows, dtype=float)
        shown = f"{source}: {rows} still poses show directions of axes and no distances"
        findings.append(Finding("still-poses", shown))
    else:
        time = data[names.time] * TIME_UNITS[column_map.units.get("t", "s")]
        require_order(table, names.time, data[names.time])
        timeline = table_timeline(table, time)
        findings += timeline_findings(timeline, source)
        findings += time_findings(time, timeline.sample_rate, source, column_map)
    positions = force = None
    if names.joints:
        factors = [column_map.joint_factor(arm, index) for index in range(len(arm.joints))]
        positions = np.column_stack([data[name] * factor for name, factor in zip(names.joints, factors, strict=True)])
        findings += joint_findings(positions, arm, source, column_map)
        if not names.static:
            positions, jumps = unwrap_joints(positions, time, arm, source)
            findings += jumps
    if names.specific_force:
        force = np.column_stack([data[name] for name in names.specific_force])
        force *= ACCELERATION_UNITS[column_map.units.get("a", "m/s^2")]
        findings += specific_force_findings(
            time, force, names.specific_force, source, column_map=column_map, gravity=gravity
        )
    gyroscope, temperature, more = _optional_columns(table, names, data, time, column_map)
    findings += more
    if names.static:
        assert positions is not None, "a table of still poses holds joints and a sensor"
        assert force is not None, "a table of still poses holds joints and a sensor"
        timeline = circlepoint.make_static_recording(positions, force).timeline
    return Log(table, names, time, positions, force, gyroscope, temperature, timeline, findings, dict(column_map.units))


def _require_one_row_a_pose(table: LogTable, name: str, numbers: FloatArray) -> None:
    first: dict[float, int] = {}
    for row, number in enumerate(numbers.tolist()):
        if first.setdefault(number, row) != row:
            raise table.error(
                f"column `{name}` is {number:.12g} again: keep one row a pose, the mean of what the one sensor on the "
                f"end-point read at rest; if this is a log, name its time column in a column map (`t:`)",
                row,
            )


def _optional_columns(
    table: LogTable, names: FileColumns, data: dict[str, FloatArray], time: FloatArray, column_map: ColumnMap
) -> tuple[FloatArray | None, FloatArray | None, list[Finding]]:
    """Gyroscope and temperature, where they can be used; a finding where not."""
    findings: list[Finding] = []
    gyroscope = temperature = None
    if names.angular_velocity:
        gyroscope = (
            np.column_stack([data[name] for name in names.angular_velocity])
            * RATE_UNITS[column_map.units.get("g", "rad/s")]
        )
        if not np.isfinite(gyroscope).all():
            findings.append(Finding("gyroscope", f"{table.label}: the gyroscope's columns have empty cells: not used"))
            gyroscope = None
        elif np.abs(gyroscope).max() > 40.0 and "g" not in column_map.units:
            largest = np.abs(gyroscope).max()
            findings.append(
                Finding(
                    "gyroscope",
                    f"{table.label}: the gyroscope reads up to {largest:.4g} rad/s: if that is deg/s, add `units: "
                    f"{{g: deg/s}}` to a column map",
                )
            )
    if names.temperature:
        factor, shift = TEMPERATURE_UNITS[column_map.units.get("temp", "C")]
        values = data[names.temperature] * factor + shift
        known = np.isfinite(values)
        if known.any():
            temperature = np.interp(time, time[known], values[known])
        if not known.all():
            share = f"{np.count_nonzero(~known)} of {known.size} cells of `{names.temperature}` are empty"
            done = "interpolated between the others" if known.any() else "not used"
            findings.append(Finding("temperature", f"{table.label}: {share}: {done}"))
    return gyroscope, temperature, findings
