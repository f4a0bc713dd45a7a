"""``circlepoint calibrate``: the main job."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from circlepoint._core import InvalidInput
from circlepoint.atomic import require_writable_folder
from circlepoint.cli.options import Subparsers, add_command, add_recording, arm_of, numbers, progress
from circlepoint.findings import few_gaps
from circlepoint.result_folder import CalibrationJob, calibrate_into
from circlepoint.sensor_presets import load_sensor
from circlepoint.treatments import PARAMETER_GROUPS, read_treatment

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from circlepoint._core import ParameterTreatment
    from circlepoint.arm import Arm

METHODS = ("whole-arm", "joint", "position", "velocity")

_TEXT = """\
Estimate the axis of every joint as a line in the sensor's frame, the Denavit-Hartenberg parameters that follow from
them, and the sensor's own errors, each with its standard deviation. Writes DIR/calibration.json (whole or not at all)
and DIR/report.html with figures.

Exit status 0: every joint was estimated. 1: some could not be (the result says which, why and what to record; what
could be estimated is written, complete: false). 2: bad input, nothing written."""

_EXAMPLES = """\
  circlepoint calibrate log.csv --arm arm.yaml --out result
  circlepoint calibrate joints.csv sensor.csv --arm arm.yaml --out result        two files, two clocks
  circlepoint calibrate log.bag --arm arm.urdf --tip tool0 --out result           a ROS bag, the arm from its URDF
  circlepoint calibrate log.csv --arm arm.yaml --out result --sensor qa700 --method velocity
  circlepoint calibrate log.csv --arm arm.yaml --out result --reference-configuration -1.2,0,0.5,0,0,0
  circlepoint calibrate log.csv --arm arm.yaml --out result --parameter encoder_gain=fixed --parameter gravity=0.02
"""


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands,
        common,
        "calibrate",
        summary="estimate the arm's axes from a recording",
        text=_TEXT,
        examples=_EXAMPLES,
    )
    add_recording(parser)
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="result folder; made if it is not there")
    parser.add_argument(
        "--method",
        choices=METHODS,
        default="whole-arm",
        help="whole-arm: everything at once, from any motion (default); joint: regression, joint by joint; position, "
        "velocity: the two methods of Canepa et al. 1994",
    )
    parser.add_argument(
        "--sensor", metavar="PRESET|FILE", help="what is known of the sensor: a preset's name or a data sheet file"
    )
    parser.add_argument(
        "--reference-configuration",
        type=numbers,
        metavar="Q1,Q2,...",
        help="joint positions (rad or m) at which the lines are given (default: chosen from the recording)",
    )
    parser.add_argument(
        "--parameter",
        action="append",
        type=_treatment,
        default=[],
        metavar="NAME=HOW",
        help="how whole-arm treats a group of parameters: fixed at its nominal value, free, or the standard deviation "
        "of what is known of it; NAME is one of "
        + ", ".join(f"{name} ({unit})" for name, unit in PARAMETER_GROUPS.items()),
    )
    parser.add_argument("--json", action="store_true", help="print calibration.json instead of tables")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    require_writable_folder(options.out)
    treatments = _treatments(options)
    arm = arm_of(options)
    _require_reference(options.reference_configuration, arm)
    sensor = None if options.sensor is None else load_sensor(options.sensor)
    job = CalibrationJob(
        logs=tuple(options.logs),
        arm_file=options.arm,
        base=options.base,
        tip=options.tip,
        columns=options.columns,
        method=options.method,
        sensor=sensor,
        gravity=options.gravity,
        reference_configuration=options.reference_configuration,
        treatments=treatments,
        joint_topic=options.joint_topic,
        imu_topic=options.imu_topic,
    )
    with progress(3, quiet=options.json) as begin:
        calibration = calibrate_into(options.out, job, arm, begin)
    document = calibration.document
    if options.json:
        print(json.dumps(document, indent=1, allow_nan=False))
    else:
        _print_tables(document, options.out)
    missing = [joint for joint in document["joints"] if joint["direction_sensor"] is None]
    if missing:
        names = ", ".join(joint["name"] for joint in missing)
        print(
            f"circlepoint: {len(missing)} of {len(document['joints'])} joints not estimated: {names}; the reason of "
            f"each, and what to record, is in the table and in {options.out / 'calibration.json'}",
            file=sys.stderr,
        )
    return 1 if missing else 0


def _print_tables(document: Mapping[str, Any], folder: Path) -> None:
    from circlepoint.report import format_dh_table, format_joint_table  # noqa: PLC0415

    print(f"{format_joint_table(document)}\n{format_dh_table(document)}")
    offset, rate = document["sensor"]["clock_offset"], document["sensor"]["clock_rate"]
    if offset is not None and rate is not None:
        print(
            f"two clocks: sensor time = {offset['estimate']:.4f} ± {offset['std']:.4f} s "
            f"+ {rate['estimate']:.6f} ± {rate['std']:.6f} x joint time"
        )
    for combination in document["identifiability"]["unseen"]:
        if not any(combination.startswith(f"{joint['name']} line:") for joint in document["joints"] if joint["reason"]):
            print(f"hardly seen: {combination}")
    for message in few_gaps([finding["message"] for finding in document["findings"]]):
        print(f"note: {message}")
    print(f"written: {folder / 'calibration.json'}, {folder / 'report.html'}")


def _treatment(text: str) -> tuple[str, ParameterTreatment]:
    try:
        return read_treatment(text)
    except InvalidInput as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _treatments(options: argparse.Namespace) -> dict[str, ParameterTreatment]:
    said = [name for name, _ in options.parameter]
    twice = next((name for name in said if said.count(name) > 1), None)
    if twice is not None:
        raise InvalidInput(f"--parameter says {twice} more than once; say it once")
    if said and options.method != "whole-arm":
        raise InvalidInput(f"--parameter {said[0]} is for --method whole-arm, not {options.method}; leave it out")
    return dict(options.parameter)


def _require_reference(reference: tuple[float, ...] | None, arm: Arm) -> None:
    if reference is not None and len(reference) != len(arm.joints):
        raise InvalidInput(
            f"--reference-configuration has {len(reference)} values, the arm {arm.name!r} has {len(arm.joints)} "
            f"joints; give one a joint"
        )
