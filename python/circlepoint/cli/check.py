"""``circlepoint check``: what is in a log, and what is missing."""

from __future__ import annotations

import json
import math
import textwrap
from typing import TYPE_CHECKING, Any

from circlepoint.check import JointCheck, LogCheck, check_recording
from circlepoint.cli.options import Subparsers, add_command, add_recording, arm_of, recording_of
from circlepoint.document import finding_entries
from circlepoint.findings import few_gaps
from circlepoint.text_table import aligned

if TYPE_CHECKING:
    import argparse

    from circlepoint.recording_io import LogFile

_TEXT = """\
Show what is in a log: sample rate, jitter and gaps, clipping, what the sensor reads at rest, the encoders' steps, how
each joint moved, the tests of each joint alone that were found, and what to record next.

Exit status 0: `calibrate` can find every joint, as far as the motion tells. 1: some it cannot. 2: bad input."""

_EXAMPLES = """\
  circlepoint check log.csv --arm arm.yaml
  circlepoint check joints.csv sensor.csv --arm arm.yaml          two files, two clocks
  circlepoint check rtde.csv --arm arm.yaml --columns map.yaml    other names and units
  circlepoint check log.mcap --arm arm.urdf --tip tool0           a ROS 2 bag, the arm from its URDF
  circlepoint check log.csv --arm arm.yaml --json
"""

_WIDTH = 118


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands, common, "check", summary="what is in a log, what is missing", text=_TEXT, examples=_EXAMPLES
    )
    add_recording(parser)
    parser.add_argument("--json", action="store_true", help="print the answer as JSON")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    arm = arm_of(options)
    loaded = recording_of(options, arm)
    result = check_recording(loaded, arm, gravity=options.gravity)
    print(json.dumps(check_document(result), indent=1, allow_nan=False) if options.json else format_check(result))
    return 0 if result.ready else 1


def check_document(result: LogCheck) -> dict[str, Any]:
    """Return the answer as JSON has it; SI units and radians."""
    recording = result.loaded.recording
    names = [joint.joint.name for joint in result.joints]
    return {
        "ready": result.ready,
        "files": [_file_document(file) for file in result.loaded.files],
        "samples": int(recording.samples),
        "sample_rate": recording.sample_rate,
        "spans": len(recording.spans),
        "clocks": [
            {"offset": clock.offset, "offset_std": clock.offset_std, "rate": clock.rate, "rate_std": clock.rate_std}
            for clock in result.loaded.clock_alignments
        ],
        "rests": result.rests,
        "rest_magnitude": result.rest_magnitude,
        "rest_magnitude_std": result.rest_magnitude_std,
        "rest_noise": result.rest_noise,
        "largest_force": result.largest_force,
        "gravity": result.gravity,
        "joints": [_joint_document(joint, names) for joint in result.joints],
        "gravity_motion": None
        if result.gravity_motion is None
        else {"turn": result.gravity_motion.turn, "second": result.gravity_motion.second},
        "gravity_status": result.gravity_status,
        "gravity_advice": result.gravity_advice,
        "ready_alone": result.ready_alone,
        "findings": finding_entries(result.findings),
    }


def format_check(result: LogCheck) -> str:
    """Return the answer on one screen."""
    recording = result.loaded.recording
    lines = [line for file in result.loaded.files for line in (_file_line(file), *_column_lines(file))]
    lines += [
        f"clocks      sensor time = {clock.offset:.4f} s + {clock.rate:.6f} x joint time  "
        f"(std {clock.offset_std:.2g} s, {clock.rate_std:.2g})"
        for clock in result.loaded.clock_alignments
    ]
    lines.append(
        f"recording   {recording.samples} still poses, {recording.joints} joints"
        if recording.is_static
        else f"recording   {recording.samples} samples at {recording.sample_rate:.6g} Hz in {len(recording.spans)} "
        f"span{'s' if len(recording.spans) != 1 else ''}, {recording.joints} joints"
    )
    lines += [_rest_line(result), _range_line(result), _gravity_line(result)]
    lines += ["", *_joint_table(result.joints), ""]
    lines += _wrapped(_advice(result), "to record")
    lines += _wrapped(few_gaps([_short(finding.message, result) for finding in result.findings]), "findings")
    return "\n".join([*lines, *_verdicts(result)])


def _verdicts(result: LogCheck) -> list[str]:
    """Return what either way of calibrating can do with the log."""
    count = len(result.joints)
    lines = []
    for name, whole in (("calibrate (whole-arm)", True), ("--method joint, position, velocity", False)):
        status = {joint.joint.name: joint.whole_arm if whole else joint.status for joint in result.joints}
        missing = [joint for joint, found in status.items() if found == "missing"]
        weak = [joint for joint, found in status.items() if found == "weak"]
        if whole and result.gravity_status == "missing":
            said = "cannot tell the sensor's errors from the arm's"
        elif missing:
            said = f"cannot find {f'any of the {count} joints' if len(missing) == count else ', '.join(missing)}"
        else:
            said = "can find every joint"
        if weak and len(missing) < count:
            said += f"; badly: {f'all {count} joints' if len(weak) == count else ', '.join(weak)}"
        elif whole and result.gravity_status == "weak":
            said += "; badly, as gravity turns too little"
        lines += textwrap.wrap(f"{name}: {said}", _WIDTH, subsequent_indent="  ", break_on_hyphens=False)
    return lines


def _file_line(file: LogFile) -> str:
    timeline = file.timeline
    part = f" {file.part}," if file.part else ""
    what = "joints, sensor" if file.joints and file.sensor else "joints" if file.joints else "sensor"
    if file.static:
        return f"{file.path.name:<11}{part} {what}: {file.samples} still poses"
    missing = sum(gap.missing for gap in timeline.gaps)
    gaps = f"{len(timeline.gaps)} gaps ({missing} samples missing)" if timeline.gaps else "no gaps"
    return (
        f"{file.path.name:<11}{part} {what}: {file.samples} samples, {timeline.duration:.1f} s, "
        f"{timeline.sample_rate:.6g} Hz, "
        f"jitter {1e3 * timeline.jitter_std:.3g} ms (max {1e3 * timeline.jitter_max:.3g}), {gaps}"
    )


def _column_lines(file: LogFile) -> list[str]:
    """Return what each column was taken for, and why in that unit."""
    lines = []
    for quantity in file.quantities:
        names = quantity.columns
        listed = ", ".join(names)
        listed = listed if len(listed) < 40 else f"{names[0]} .. {names[-1]}"
        lines.append(f"  {quantity.name}: {listed} in {quantity.unit} ({quantity.reason})")
    return lines


def _short(message: str, result: LogCheck) -> str:
    """Return a finding with its file's name in place of the whole path: one screen is meant."""
    for file in result.loaded.files:
        message = message.replace(str(file.path), file.path.name)
    return message


def _range_line(result: LogCheck) -> str:
    clipped = sum(finding.code == "clipping" for finding in result.findings)
    seen = f"{clipped} channel ends clipped (see the findings)" if clipped else "no clipping"
    return f"range       largest reading of a channel {result.largest_force:.4g} m/s^2, {seen}"


def _gravity_line(result: LogCheck) -> str:
    turned = result.gravity_motion
    if turned is None:
        return "gravity     too short to say how it turned"
    return (
        f"gravity     turned by {math.degrees(turned.turn):.0f} deg in the sensor's frame, and by "
        f"{math.degrees(turned.second):.0f} deg out of the plane it turned in most: {result.gravity_status}"
    )


def _rest_line(result: LogCheck) -> str:
    if result.rest_magnitude is None or result.rest_magnitude_std is None:
        return "at rest     the arm never rests: let all joints stand still for 1 s now and then"
    deviation = 100 * (result.rest_magnitude / result.gravity - 1)
    noise = "" if result.rest_noise is None else f", noise {result.rest_noise:.2g} a sample"
    return (
        f"at rest     {result.rests} rests, |f| = {result.rest_magnitude:.4f} m/s^2 ({deviation:+.2f} % of "
        f"{result.gravity:.5f}), "
        f"varying by {result.rest_magnitude_std:.2g}{noise}"
    )


def _joint_table(joints: tuple[JointCheck, ...]) -> list[str]:
    header = ["joint", "travel", "speed", "moving", "whole-arm", "step", "tests", "rests", "motions", "strokes", "rate"]
    header += ["gravity", "alone"]
    rows = [header, *(_joint_row(index, joint) for index, joint in enumerate(joints))]
    table = aligned(rows, left={0, len(header) - 1})
    return [table[0], "-" * max(len(line) for line in table), *table[1:]]


def _joint_row(index: int, check: JointCheck) -> list[str]:
    factor, unit = (math.degrees(1), "deg") if check.joint.revolute else (1e3, "mm")
    step = "-"
    if check.encoder_step is not None:
        step = f"{1e6 * check.encoder_step:.3g} u{check.joint.unit}"
    motion = check.motion
    return [
        f"{index + 1} {check.joint.name}",
        f"{factor * motion.travel:.3g} {unit}",
        f"{factor * motion.speed:.3g} /s",
        f"{motion.time:.1f} s",
        check.whole_arm,
        step,
        str(check.tests) if check.tests else "-",
        f"{check.dwells} / {factor * check.dwell_span:.0f} {unit}" if check.dwells else "-",
        f"{check.motions} / {factor * check.motion_span:.0f} {unit}" if check.motions else "-",
        str(check.strokes) if check.motions else "-",
        f"{check.frequency:.2f} Hz" if check.frequency is not None else "-",
        f"{check.gravity_share:.2f} g" if check.gravity_share is not None else "-",
        check.status,
    ]


def _advice(result: LogCheck) -> list[str]:
    """Return what to record, joints with the same advice together: for whole-arm, then for tests of joints alone."""
    advice = [result.gravity_advice] if result.gravity_advice else []
    advice += _grouped([(joint.whole_arm_advice, joint.joint.name) for joint in result.joints])
    alone = _grouped([(joint.advice, joint.joint.name) for joint in result.joints])
    return advice + [f"for --method joint: {text}" for text in alone]


def _grouped(said: list[tuple[str, str]]) -> list[str]:
    named: dict[str, list[str]] = {}
    for advice, name in said:
        if advice:
            named.setdefault(advice, []).append(name)
    return [
        f"{'every joint' if len(names) == len(said) else ', '.join(names)}: {advice}" for advice, names in named.items()
    ]


def _wrapped(items: list[str], title: str) -> list[str]:
    if not items:
        return []
    lines = [f"{title}:"]
    for item in items:
        lines += textwrap.wrap(item, _WIDTH, initial_indent="  - ", subsequent_indent="    ", break_on_hyphens=False)
    return [*lines, ""]


def _file_document(file: LogFile) -> dict[str, Any]:
    timeline = file.timeline
    gaps = [
        {"start": gap.start, "length": gap.length, "missing": int(gap.missing), "filled": gap.filled}
        for gap in timeline.gaps
    ]
    return {
        "path": str(file.path),
        "part": file.part,
        "columns": [
            {"quantity": each.name, "columns": list(each.columns), "unit": each.unit, "reason": each.reason}
            for each in file.quantities
        ],
        "samples": file.samples,
        "joints": file.joints,
        "sensor": file.sensor,
        "duration": timeline.duration,
        "sample_rate": timeline.sample_rate,
        "static": file.static,
        "jitter_std": timeline.jitter_std,
        "jitter_max": timeline.jitter_max,
        "gaps": gaps,
    }


def _joint_document(check: JointCheck, names: list[str]) -> dict[str, Any]:
    return {
        "name": check.joint.name,
        "type": check.joint.type,
        "status": check.status,
        "advice": check.advice,
        "tests": check.tests,
        "dwells": check.dwells,
        "dwell_span": check.dwell_span,
        "motions": check.motions,
        "motion_span": check.motion_span,
        "motion_time": check.motion_time,
        "strokes": check.strokes,
        "frequency": check.frequency,
        "encoder_step": check.encoder_step,
        "gravity_share": check.gravity_share,
        "whole_arm": check.whole_arm,
        "whole_arm_advice": check.whole_arm_advice,
        "travel": check.motion.travel,
        "speed": check.motion.speed,
        "acceleration": check.motion.acceleration,
        "moving_time": check.motion.time,
        "in_step": [names[other] for other in check.motion.in_step],
    }
