"""Values that cannot be what they are taken for (an error that names the unit to state), or that look suspicious.

Everything is judged on the values as recorded, before any resampling.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from circlepoint._core import InvalidInput
from circlepoint.arm import Arm
from circlepoint.column_map import ACCELERATION_UNITS, LENGTH_UNITS, TIME_UNITS, ColumnMap
from circlepoint.findings import Finding

FloatArray = NDArray[np.float64]

MIN_RATE = 50.0
MAX_RATE = 10_000.0
"""Hz: the sample rates circlepoint is made for."""

_SLOWEST_RATE = 2.0  # Hz: below, the stamps are in another unit
_LARGEST_TURN = 8 * math.pi  # rad: beyond four turns a position is taken for degrees unless the user says otherwise
_LARGEST_TRAVEL = 20.0  # rad
_LARGEST_REACH = 20.0  # m, of a prismatic joint
_LIMIT_MARGIN = 0.02  # rad or m
_GRAVITY_TOLERANCE = 0.25  # of the median magnitude over a whole log, motions included
_CLIPPED_RUN = 4  # samples in a row at the same extreme
_CLIPPED_MOTION = 0.05  # m/s^2: another channel moves by this much meanwhile, so the sensor is not just at rest
_LARGEST_JUMP = 0.3  # rad or m between two samples ...
_LARGEST_SPEED = 50.0  # ... at more than this speed, rad/s or m/s


def time_findings(time: FloatArray, sample_rate: float, source: str, column_map: ColumnMap) -> list[Finding]:
    """Judge the time stamps (s) of one file; InvalidInput when they are in another unit."""
    if "t" not in column_map.units and sample_rate < _SLOWEST_RATE:
        likely = [unit for unit, factor in TIME_UNITS.items() if 10.0 <= sample_rate / factor <= 2 * MAX_RATE]
        if likely:
            raise InvalidInput(
                f"{source}: the time stamps step by {1 / sample_rate:g}, as if in {likely[0]} rather than seconds; "
                f"state the unit in a "
                f"column map (--columns map.yaml with the line `units: {{t: {likely[0]}}}`)"
            )
    if MIN_RATE * 0.99 <= sample_rate <= MAX_RATE * 1.01:
        return []
    what = "few samples a motion" if sample_rate < MIN_RATE else "thin the log out"
    return [
        Finding(
            "sample-rate",
            f"{source}: {sample_rate:.6g} Hz over {time[-1] - time[0]:.6g} s is outside {MIN_RATE:g} Hz to "
            f"{MAX_RATE / 1000:g} kHz: {what}",
        )
    ]


def joint_findings(positions: FloatArray, arm: Arm, source: str, column_map: ColumnMap) -> list[Finding]:
    """Judge joint positions (N, n), rad or m; InvalidInput when they are in another unit."""
    findings: list[Finding] = []
    for index, joint in enumerate(arm.joints):
        values = positions[:, index]
        low, high = float(values.min()), float(values.max())
        if not column_map.joint_unit_stated(index):
            _require_si_position(low, high, arm, index, source)
        name = f"{source}: joint {index + 1} ({joint.name})"
        if joint.limits and (low < joint.limits[0] - _LIMIT_MARGIN or high > joint.limits[1] + _LIMIT_MARGIN):
            findings.append(
                Finding(
                    "limits",
                    f"{name} was at {low:.4g} to {high:.4g} {joint.unit}, beyond its limits {joint.limits[0]:g} to "
                    f"{joint.limits[1]:g}: "
                    "check the arm's description, the joints' order and their zero",
                    joint.name,
                )
            )
    return findings


def unwrap_joints(positions: FloatArray, time: FloatArray, arm: Arm, source: str) -> tuple[FloatArray, list[Finding]]:
    """Undo jumps by a whole turn between samples (N, n), and report other jumps no joint can make."""
    findings: list[Finding] = []
    turn = 2 * math.pi
    for index, joint in enumerate(arm.joints):
        steps = np.diff(positions[:, index])
        turns = np.round(steps / turn)
        wrapped = (turns != 0) & (np.abs(steps - turns * turn) < _LARGEST_JUMP) & joint.revolute
        name = f"{source}: joint {index + 1} ({joint.name})"
        if wrapped.any():
            positions = positions.copy()
            positions[1:, index] -= np.cumsum(np.where(wrapped, turns * turn, 0.0))
            first = time[int(np.argmax(wrapped)) + 1]
            findings.append(
                Finding(
                    "wrapped",
                    f"{name} jumps by a whole turn between samples {int(wrapped.sum())} times (first at {first:.6g} "
                    f"s): taken for a "
                    "position wrapped into one turn, and made continuous",
                    joint.name,
                )
            )
        jumps = (
            ~wrapped
            & (np.abs(steps) > _LARGEST_JUMP)
            & (np.abs(steps) > _LARGEST_SPEED * np.maximum(np.diff(time), 1e-9))
        )
        if jumps.any():
            row = int(np.argmax(jumps))
            findings.append(
                Finding(
                    "jump",
                    f"{name} jumps by {steps[row]:.4g} {joint.unit} within {time[row + 1] - time[row]:.4g} s at "
                    f"{time[row]:.6g} s "
                    f"({int(jumps.sum())} such jumps): a lost encoder count or rows from two recordings; cut the log "
                    f"there",
                    joint.name,
                )
            )
    return positions, findings


def specific_force_findings(
    time: FloatArray, force: FloatArray, columns: Sequence[str], source: str, *, column_map: ColumnMap, gravity: float
) -> list[Finding]:
    """Judge specific force (N, 3), m/s^2, against gravity (m/s^2); InvalidInput when it is in another unit."""
    magnitude = float(np.median(np.linalg.norm(force, axis=1)))
    _require_si_force(magnitude, source, column_map, gravity)
    findings: list[Finding] = []
    if abs(magnitude / gravity - 1) > _GRAVITY_TOLERANCE:
        findings.append(
            Finding(
                "gravity",
                f"{source}: the specific force is {magnitude:.4g} m/s^2 (median magnitude) where gravity is "
                f"{gravity:.6g}: a scale factor "
                f"{magnitude / gravity:.3f} off, another unit, or an arm that was hardly ever at rest",
            )
        )
    for channel, name in enumerate(columns):
        values = force[:, channel]
        if values.min() == values.max():
            findings.append(
                Finding(
                    "constant",
                    f"{source}: column `{name}` reads {values[0]:.6g} m/s^2 in every row: is this channel connected?",
                )
            )
            continue
        for extreme in (float(values.max()), float(values.min())):
            clipped = find_clipped(force, channel, extreme)
            if clipped.any():
                first, count = float(time[int(np.argmax(clipped))]), int(clipped.sum())
                findings.append(clipping_finding(source, name, extreme, count=count, rows=time.size, first=first))
    return findings


def clipping_finding(source: str, column: str, extreme: float, *, count: int, rows: int, first: float) -> Finding:
    """Return what to say of a channel that was at the end of its range: `count` of `rows` samples, the first at s."""
    return Finding(
        "clipping",
        f"{source}: column `{column}` is stuck at {extreme:.6g} m/s^2 in {count} samples ({100 * count / rows:.2g} %, "
        f"first at {first:.6g} s): the sensor's range ends there; move slower or choose a wider range",
    )


def encoder_step(values: FloatArray) -> float | None:
    """Smallest step between successive positions (N), rad or m, apart from rounding; None when nothing moved."""
    steps = np.abs(np.diff(values))
    steps = steps[steps > 1e-8]
    return float(steps.min()) if steps.size else None


def encoder_findings(steps: Sequence[float | None], arm: Arm) -> list[Finding]:
    """Compare the smallest steps seen with the encoder the arm's description states."""
    findings: list[Finding] = []
    for index, (joint, seen) in enumerate(zip(arm.joints, steps, strict=True)):
        stated = arm.encoder_step(index)
        # A prismatic joint has no slow moves to show its finest steps by: only a log of few digits is coarser.
        finest = 0.0 if joint.revolute else 1e-4
        if seen is not None and stated is not None and max(1.5 * stated, finest) < seen < 0.1:
            findings.append(
                Finding(
                    "encoder",
                    f"joint {index + 1} ({joint.name}) never moves by less than {seen:.3g} {joint.unit}, the arm's "
                    f"encoder is stated to "
                    f"resolve {stated:.3g}: more digits may be needed in the log, or fewer counts in the arm's "
                    f"description",
                    joint.name,
                )
            )
    return findings


def _require_si_position(low: float, high: float, arm: Arm, index: int, source: str) -> None:
    joint = arm.joints[index]
    largest = max(abs(low), abs(high))
    name = f"{source}: joint {index + 1} ({joint.name}) was at {low:.6g} to {high:.6g}"
    state = "state the unit in a column map (--columns map.yaml with the line `units: {%s}`)"
    if joint.revolute:
        if joint.limits:
            lowest, highest = joint.limits
            span = highest - lowest
            outside = low < lowest - 0.25 * span or high > highest + 0.25 * span
            as_degrees = lowest <= math.radians(low) + _LIMIT_MARGIN and math.radians(high) <= highest + _LIMIT_MARGIN
            implausible = outside and as_degrees and not _whole_turns_away(low, high, lowest, highest)
        else:
            implausible = largest > _LARGEST_TURN or high - low > _LARGEST_TRAVEL
        if implausible:
            raise InvalidInput(
                f"{name}: too far for radians, it looks like degrees; {state % 'q: deg'}; if the joint does turn that "
                f"far, "
                f"say so with `units: {{q{index + 1}: rad}}`"
            )
    elif largest > _LARGEST_REACH:
        likely = "mm" if largest < _LARGEST_REACH / LENGTH_UNITS["mm"] else "um"
        raise InvalidInput(f"{name}: too far for metres, it looks like {likely}; {state % f'q{index + 1}: {likely}'}")


def _whole_turns_away(low: float, high: float, lowest: float, highest: float) -> bool:
    """Whether a joint that can make a whole turn, as wrists do, may have made several."""
    turn = 2 * math.pi
    turns = round(((low + high) - (lowest + highest)) / (2 * turn)) * turn
    return (
        highest - lowest >= turn
        and max(abs(low), abs(high)) < _LARGEST_TURN
        and lowest <= low - turns
        and high - turns <= highest
    )


def _require_si_force(magnitude: float, source: str, column_map: ColumnMap, gravity: float) -> None:
    stated = column_map.units.get("a", "m/s^2")
    raw = magnitude / ACCELERATION_UNITS[stated]
    if 0.5 < magnitude / gravity < 2.0:
        return
    fit = {unit: abs(math.log(max(raw, 1e-12) * factor / gravity)) for unit, factor in ACCELERATION_UNITS.items()}
    likely = min(fit, key=lambda unit: fit[unit])
    if fit[likely] < 0.2:
        entry = f"`units: {{a: {likely}}}`"
        raise InvalidInput(
            f"{source}: the specific force is {raw:.4g} (median magnitude), which is gravity ({gravity:.6g} m/s^2) in "
            f"{likely} rather than "
            f"{stated}; state the unit in a column map (--columns map.yaml with the line {entry})"
        )
    if magnitude < 0.3 * gravity:
        raise InvalidInput(
            f"{source}: the specific force is {magnitude:.4g} m/s^2 (median magnitude) where gravity is "
            f"{gravity:.6g}: gravity seems to have been "
            "removed, or the unit is unknown; record what the accelerometer itself reads (at rest +g upwards), or "
            "state its unit as "
            "`units: {a: ...}` in a column map (--columns)"
        )


def find_clipped(force: FloatArray, channel: int, extreme: float) -> NDArray[np.bool_]:
    """Find samples of one channel in long runs at its extreme while another channel moves."""
    at = np.asarray(force[:, channel] == extreme, dtype=np.bool_)
    clipped: NDArray[np.bool_] = np.zeros(at.shape, dtype=np.bool_)
    if np.count_nonzero(at) < _CLIPPED_RUN:
        return clipped
    edges = np.flatnonzero(np.diff(np.concatenate(([0], at.view(np.int8), [0]))))
    others = [index for index in range(3) if index != channel]
    for begin, end in edges.reshape(-1, 2):
        around = force[max(begin - 2, 0) : end + 2][:, others]
        if end - begin >= _CLIPPED_RUN and np.ptp(around, axis=0).max() > _CLIPPED_MOTION:
            clipped[begin:end] = True
    return clipped
