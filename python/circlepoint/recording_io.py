"""Recordings in files: CSV, Parquet and bags, one clock or two, several files as one recording.

A file with joint positions and specific force is a recording. Files with only the one and only the other come from two
machines with two clocks: offset and rate between them are estimated, and the two become one recording. One file may
hold two rates: the topics of a bag, a sensor with its own time column, rows of joints between rows of the sensor.
Several recordings become one, in the order given. A file that numbers its rows as still poses in place of a time is a
table of rests.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import circlepoint
from circlepoint._core import STANDARD_GRAVITY, InvalidInput
from circlepoint.bags import is_bag, open_bag
from circlepoint.clocks import Log, assemble
from circlepoint.column_map import (
    ACCELERATION_UNITS,
    RATE_UNITS,
    TEMPERATURE_UNITS,
    TIME_UNITS,
    ColumnMap,
    FileColumns,
    find_columns,
    load_column_map,
    missing_joints,
    missing_specific_force,
)
from circlepoint.findings import Finding
from circlepoint.log_table import LogTable, RowsWith, empty_rows, require_finite
from circlepoint.long_logs import gap_options, read_column, thin, thinning_factor
from circlepoint.plausibility import (
    encoder_findings,
    encoder_step,
    joint_findings,
    specific_force_findings,
    time_findings,
    unwrap_joints,
)
from circlepoint.quantities import Quantity, quantities
from circlepoint.stamps import require_order, table_timeline, timeline_findings
from circlepoint.tables import open_table

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from circlepoint.arm import Arm

FloatArray = NDArray[np.float64]

MIN_SAMPLES = 8
"""Fewer rows have no sample rate."""
MIN_POSES = 3
"""Still poses in a table of them."""
MIN_SHARE = 0.02
"""Part of the rows without joints, and of those without sensor, above which one log holds two rates."""


@dataclass(frozen=True)
class LogFile:
    """What one file of a recording holds.

    Attributes
    ----------
    path : Path
        The file.
    part : str
        Which part of it, such as a topic of a bag; empty: all.
    samples : int
        Rows.
    joints, sensor : bool
        Whether it holds joint positions, specific force.
    timeline : TimelineReport
        Rate, jitter and gaps of its stamps.
    quantities : tuple of Quantity
        What its columns were taken for.
    beyond : tuple of int
        Joints (0-based) that are known not to move the sensor.
    static : bool
        Whether its rows are still poses, each the mean of one rest.
    """

    path: Path
    part: str
    samples: int
    joints: bool
    sensor: bool
    timeline: circlepoint.TimelineReport
    quantities: tuple[Quantity, ...]
    beyond: tuple[int, ...] = ()
    static: bool = False


@dataclass(frozen=True)
class LoadedRecording:
    """A recording and what reading it has shown.

    Attributes
    ----------
    recording : Recording
        All files as one, on a uniform clock.
    files : tuple of LogFile
        In the order given.
    clock_alignments : tuple of ClockAlignment
        One for each pair of joint and sensor logs on two clocks; empty where one clock stamped both.
    encoder_steps : tuple of (float or None)
        Smallest step seen of each joint, rad or m; None where it never moved, or only stood in still poses.
    findings : tuple of Finding
        What is suspicious but legal.
    """

    recording: circlepoint.Recording
    files: tuple[LogFile, ...]
    clock_alignments: tuple[circlepoint.ClockAlignment, ...]
    encoder_steps: tuple[float | None, ...]
    findings: tuple[Finding, ...]


def read_recording(
    paths: str | Path | Sequence[str | Path],
    arm: Arm,
    columns: str | Path | None = None,
    *,
    gravity: float = STANDARD_GRAVITY,
    joint_topic: str | None = None,
    imu_topic: str | None = None,
) -> LoadedRecording:
    """Read the files of a recording.

    Parameters
    ----------
    paths : path or sequence of paths
        CSV (``.csv``, ``.csv.gz``), Parquet, ROS 1 bag (``.bag``) or ROS 2 bag (a folder, ``.db3``, ``.mcap``), with
        time and joint positions, specific force, or both.
    arm : Arm
        The arm that was recorded.
    columns : path, optional
        Column map for other names and units (see `circlepoint.column_map`).
    gravity : float, optional
        Local gravity, m/s^2, against which the accelerometer's unit is judged.
    joint_topic, imu_topic : str, optional
        Topics of a bag with several ``sensor_msgs/JointState`` or ``sensor_msgs/Imu``.

    Returns
    -------
    LoadedRecording
        The recording, with what reading it has shown.

    Raises
    ------
    InvalidInput
        When the files cannot be used as they are; the message names file, line, column, value and remedy.
    """
    files = [Path(paths)] if isinstance(paths, str | Path) else [Path(path) for path in paths]
    if not files:
        raise InvalidInput("no file was given; give the recording's files")
    for index, path in enumerate(files):
        if path in files[:index]:
            raise InvalidInput(f"{path}: was given twice; give each file once")
    column_map = load_column_map(columns, arm.driven) if columns is not None else ColumnMap()
    topics = (joint_topic or column_map.joint_topic, imu_topic or column_map.imu_topic)
    if any(topics) and not any(is_bag(path) for path in files):
        raise InvalidInput(f"{files[0]}: is not a bag; joint and IMU topics are for bags only")
    tables: list[LogTable] = []
    with ExitStack() as opened:
        for path in files:
            tables += open_bag(path, arm.driven, column_map, topics, opened) if is_bag(path) else [open_table(path)]
        return read_tables(tables, arm, column_map, gravity=gravity)


def read_tables(
    tables: Sequence[LogTable], arm: Arm, column_map: ColumnMap, *, gravity: float = STANDARD_GRAVITY
) -> LoadedRecording:
    """Make one recording of tables that were opened; see `read_recording`."""
    driven = arm.driven
    _require_stated_columns(tables, column_map)
    found = [find_columns(table, driven, column_map) for table in tables]
    _require_both_halves(tables, found, driven)
    logs = [
        log
        for table, names in zip(tables, found, strict=True)
        for log in _read_logs(table, names, driven, column_map, gravity)
    ]
    files = tuple(_describe(log, driven) for log in logs)
    logs = [_following(log, arm) for log in logs]
    assembly = assemble(logs)
    recordings = assembly.recordings
    recording = recordings[0] if len(recordings) == 1 else circlepoint.concatenate(recordings)
    steps = _encoder_steps(logs, len(arm.joints))
    findings = [finding for log in logs for finding in log.findings]
    return LoadedRecording(
        recording=recording,
        files=files,
        clock_alignments=tuple(assembly.alignments),
        encoder_steps=steps,
        findings=(*findings, *assembly.findings, *encoder_findings(steps, arm)),
    )


def _require_stated_columns(tables: Sequence[LogTable], column_map: ColumnMap) -> None:
    present = {name for table in tables for name in table.columns}
    for quantity, name in column_map.names.items():
        if name not in present and column_map.source is not None:
            found = "; ".join(f"{table.label} has {', '.join(table.columns[:40])}" for table in tables)
            raise column_map.source.error((quantity,), f"names the column {name!r}, which no file has: {found}")


def _require_both_halves(tables: Sequence[LogTable], found: Sequence[FileColumns], arm: Arm) -> None:
    joints = [table for table, names in zip(tables, found, strict=True) if names.specific_force is None]
    sensors = [table for table, names in zip(tables, found, strict=True) if names.joints is None]
    if joints and not sensors:
        raise joints[0].error(missing_specific_force(joints[0]))
    if sensors and not joints:
        raise sensors[0].error(missing_joints(sensors[0], arm))
    if len(joints) != len(sensors):
        listed = f"joints: {_paths(joints)}; sensor: {_paths(sensors)}"
        raise InvalidInput(
            f"{len(joints)} files hold only joint positions and {len(sensors)} only specific force ({listed}); they "
            f"are taken in pairs in "
            "the order given, so there must be as many of each"
        )


def _following(log: Log, arm: Arm) -> Log:
    """Return a log with the positions of the joints that mimic others beside those that were recorded."""
    if log.joint_positions is None:
        return log
    return replace(log, joint_positions=arm.follow(log.joint_positions))


def _paths(tables: Iterable[LogTable]) -> str:
    return ", ".join(table.label for table in tables)


def _read_logs(table: LogTable, names: FileColumns, arm: Arm, column_map: ColumnMap, gravity: float) -> Iterator[Log]:
    """Yield the log in a table, or the two of different rates or clocks."""
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


def _encoder_steps(logs: Sequence[Log], joints: int) -> tuple[float | None, ...]:
    steps: list[float | None] = []
    moving = [log.joint_positions for log in logs if log.joint_positions is not None and not log.columns.static]
    for index in range(joints):
        seen = [encoder_step(positions[:, index]) for positions in moving]
        steps.append(min((step for step in seen if step is not None), default=None))
    return tuple(steps)


def _describe(log: Log, arm: Arm) -> LogFile:
    return LogFile(
        path=log.table.path,
        part=log.table.part,
        samples=int(log.time.size),
        joints=log.joint_positions is not None,
        sensor=log.specific_force is not None,
        timeline=log.timeline,
        quantities=quantities(log, arm),
        beyond=log.columns.beyond,
        static=log.columns.static,
    )
