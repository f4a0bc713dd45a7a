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

import circlepoint
from circlepoint._core import STANDARD_GRAVITY, InvalidInput
from circlepoint.bags import is_bag, open_bag
from circlepoint.clocks import Log, assemble
from circlepoint.column_map import (
    ColumnMap,
    FileColumns,
    find_columns,
    load_column_map,
    missing_joints,
    missing_specific_force,
)
from circlepoint.plausibility import (
    encoder_findings,
    encoder_step,
)
from circlepoint.quantities import Quantity, quantities
from circlepoint.table_logs import read_logs
from circlepoint.tables import open_table

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from circlepoint.arm import Arm
    from circlepoint.findings import Finding
    from circlepoint.log_table import LogTable


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
        for log in read_logs(table, names, driven, column_map, gravity)
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
