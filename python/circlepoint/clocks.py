"""Logs of joints and logs of a sensor become recordings: one clock, or two that are aligned.

Logs of two files have two clocks: their relation is estimated from the motions (`circlepoint.align_clocks`). Stamps in
one log (the topics of a bag, two rates in one file) claim one clock. They are believed unless the motions contradict
them by more than four standard deviations; both what was found and what was done is reported.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import circlepoint
from circlepoint.findings import Finding

if TYPE_CHECKING:
    from collections.abc import Sequence

    from circlepoint.column_map import FileColumns
    from circlepoint.log_table import LogTable

FloatArray = NDArray[np.float64]

_CONTRADICTION = 4.0  # standard deviations
_TIMELY = 1e-3  # s: delays below are left to the estimate of the clock offset ...
_STEADY = 1e-4  # ... and rates this near to one to the stamps


@dataclass(frozen=True)
class Log:
    """One log's samples in SI units, each checked.

    `one_clock` says that joints and sensor of the same file claim to be stamped by one clock.
    """

    table: LogTable
    columns: FileColumns
    time: FloatArray
    joint_positions: FloatArray | None
    specific_force: FloatArray | None
    angular_velocity: FloatArray | None
    temperature: FloatArray | None
    timeline: circlepoint.TimelineReport
    findings: list[Finding]
    units: dict[str, str]
    one_clock: bool = False


@dataclass(frozen=True)
class Assembly:
    """Recordings in the order of the files, and how their clocks stand."""

    recordings: list[circlepoint.Recording]
    alignments: list[circlepoint.ClockAlignment]
    findings: list[Finding]


def assemble(logs: Sequence[Log]) -> Assembly:
    """Pair logs of joints with logs of a sensor, in the order given, and align their clocks.

    Parameters
    ----------
    logs : sequence of Log
        As many of joints alone as of a sensor alone.

    Returns
    -------
    Assembly
    """
    assembly = Assembly([], [], [])
    sensors = iter([log for log in logs if log.joint_positions is None])
    for log in logs:
        if log.joint_positions is None:
            continue
        whole = log if log.specific_force is not None else None
        sensor = log if whole else next(sensors)
        if whole is None and log.one_clock and sensor.one_clock and np.array_equal(log.time, sensor.time):
            whole = replace(sensor, joint_positions=log.joint_positions)
        if whole is not None and whole.joint_positions is not None and whole.specific_force is not None:
            assembly.recordings.append(_recording(whole, whole.joint_positions, whole.specific_force))
        else:
            _pair(assembly, log, sensor)
    return assembly


def _recording(log: Log, joint_positions: FloatArray, specific_force: FloatArray) -> circlepoint.Recording:
    """Return the recording of a log that holds joints and sensor on one clock, or of still poses."""
    gyroscope, temperature = log.angular_velocity, log.temperature
    if log.columns.static:
        return circlepoint.make_static_recording(
            joint_positions, specific_force, angular_velocity=gyroscope, temperature=temperature
        )
    return circlepoint.make_recording(
        log.time, joint_positions, specific_force, angular_velocity=gyroscope, temperature=temperature
    )


def _pair(assembly: Assembly, joints: Log, sensor: Log) -> None:
    """Add the recording of two logs."""
    clock = circlepoint.ClockModel()
    try:
        if joints.one_clock and sensor.one_clock:
            alignment = _claimed_clock(assembly, joints, sensor)
        else:
            alignment = _align(joints, sensor)
        if alignment is not None:
            assembly.alignments.append(alignment)
            clock = alignment.clock
        recording = circlepoint.make_recording(
            joints.time,
            _required(joints.joint_positions),
            sensor.time,
            _required(sensor.specific_force),
            clock,
            angular_velocity=sensor.angular_velocity,
            temperature=sensor.temperature,
        )
    except circlepoint.Error as error:
        names = joints.table.label if joints.table.label == sensor.table.label else _both(joints, sensor)
        raise type(error)(f"{names}: {error}") from error
    assembly.recordings.append(recording)


def _align(joints: Log, sensor: Log) -> circlepoint.ClockAlignment:
    return circlepoint.align_clocks(
        joints.time, _required(joints.joint_positions), sensor.time, _required(sensor.specific_force)
    )


def _claimed_clock(assembly: Assembly, joints: Log, sensor: Log) -> circlepoint.ClockAlignment | None:
    """Return the alignment where the motions contradict the stamps, None where these can stand."""
    source = str(joints.table.path)
    try:
        alignment = _align(joints, sensor)
    except circlepoint.Error:
        message = (
            f"{source}: joints and sensor are stamped by one clock, as far as the stamps say; the motions do not tell"
        )
        assembly.findings.append(Finding("clock", message))
        return None
    at = alignment.reference_time
    delay = alignment.offset + alignment.rate * at - at
    drift = alignment.rate - 1.0 if alignment.rate_determined else 0.0
    seen = f"the sensor's stamps are {1e3 * delay:+.2f} ± {1e3 * alignment.reference_std:.2f} ms from the joints'"
    if alignment.rate_determined:
        seen += f", their rate {1e6 * drift:+.0f} ± {1e6 * alignment.rate_std:.0f} ppm"
    contradicted = abs(delay) > max(_TIMELY, _CONTRADICTION * alignment.reference_std) or (
        abs(drift) > max(_STEADY, _CONTRADICTION * alignment.rate_std)
    )
    done = "taken as two clocks" if contradicted else "taken as the one clock they claim"
    assembly.findings.append(Finding("clock", f"{source}: going by the motions, {seen}: {done}"))
    return alignment if contradicted else None


def _both(joints: Log, sensor: Log) -> str:
    return f"{joints.table.label} and {sensor.table.label}"


def _required(values: FloatArray | None) -> FloatArray:
    assert values is not None, "a log of joints or of a sensor holds its samples"
    return values
