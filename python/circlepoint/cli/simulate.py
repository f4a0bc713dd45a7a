"""``circlepoint simulate``: a recording with its ground truth beside it."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from circlepoint._core import InvalidInput
from circlepoint.atomic import require_writable_folder, write_atomically
from circlepoint.cli.options import Subparsers, add_arm, add_command, add_gravity, arm_of, progress, whole_number

_TEXT = """\
Simulate what an arm's encoders and accelerometer would record of a plan of tests. Writes the recording to LOG (.csv,
.csv.gz or .parquet) and what is true of it to <LOG without its ending>.truth.json. The arm is the nominal one of ARM,
standing upright, with the sensor at its last Denavit-Hartenberg frame; the sensor is an individual of the kind given,
drawn with the seed. A plan with an `acquisition` section is recorded through the paper's chain (conditioning filters,
multiplexed converter, encoders read apart) or the one it describes; the sensor then has its noise by band, its
frequency response, and the temperature errors its calibration sheet corrects. The same seed gives the same
recording."""

_EXAMPLES = """\
  circlepoint simulate plan.yaml --arm arm.yaml --sensor qa700 --out log.csv --seed 1
  circlepoint simulate plan.yaml --arm arm.yaml --sensor sensor.yaml --out log.parquet --seed 7
"""


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands, common, "simulate", summary="a recording with ground truth beside it", text=_TEXT, examples=_EXAMPLES
    )
    parser.add_argument("plan", type=Path, metavar="PLAN", help="the tests, plan.yaml")
    add_arm(parser, "the arm's description with its nominal dh or lines, arm.yaml, or a URDF")
    parser.add_argument(
        "--sensor",
        required=True,
        metavar="PRESET|FILE",
        help="the kind of sensor: a preset's name or a data sheet file",
    )
    parser.add_argument("--out", type=Path, required=True, metavar="LOG", help="recording to write")
    parser.add_argument("--seed", type=_seed, required=True, metavar="N", help="of the sensor's errors and its noise")
    add_gravity(parser)
    parser.add_argument("--json", action="store_true", help="print the truth as JSON")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    import circlepoint  # noqa: PLC0415  (keeps `circlepoint --help` quick)
    from circlepoint.coupling import leading  # noqa: PLC0415
    from circlepoint.experiment import Setting, make_experiment  # noqa: PLC0415
    from circlepoint.protocol import load_plan  # noqa: PLC0415
    from circlepoint.recording_files import recording_stem, require_format, write_recording  # noqa: PLC0415
    from circlepoint.sensor_presets import load_sensor  # noqa: PLC0415
    from circlepoint.truth import truth_document  # noqa: PLC0415

    require_format(options.out)
    require_writable_folder(options.out.parent)
    arm = arm_of(options)
    if not arm.has_nominal:
        raise InvalidInput(f"{options.arm}: has no `dh` or `lines`; a simulation needs the arm's nominal parameters")
    specification = load_sensor(options.sensor)
    plan = load_plan(options.plan, arm.driven.joint_names, [joint.type for joint in arm.driven.joints])
    experiment = make_experiment(arm, plan, specification, setting=Setting(gravity=options.gravity))
    with progress(2, quiet=options.json) as begin:
        begin("simulating")
        simulated = circlepoint.simulate_experiment(experiment, options.seed)
        recording = simulated.recording
        begin("writing")
        truth = truth_document(
            arm,
            simulated.chain,
            simulated.up_gravity_sensor.tolist(),
            simulated.sensor,
            options.seed,
            sheet=simulated.sheet,
        )
        text = json.dumps(truth, indent=1, allow_nan=False) + "\n"
        truth_path = options.out.with_name(f"{recording_stem(options.out)}.truth.json")
        options.out.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(truth_path, text.encode())
        write_recording(options.out, leading(arm, recording))
    if options.json:
        print(text, end="")
    else:
        print(
            f"written: {options.out} ({recording.samples} samples at {recording.sample_rate:g} Hz, {recording.joints} "
            f"joints), "
            f"{truth_path}"
        )
    return 0


def _seed(text: str) -> int:
    seed = whole_number(text)
    if not 0 <= seed < 2**64:
        raise argparse.ArgumentTypeError(f"{text} is not within 0 to 2^64 - 1")
    return seed
