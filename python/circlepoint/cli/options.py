"""Options several commands share."""

from __future__ import annotations

import argparse
import math
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tqdm import tqdm

from circlepoint._core import STANDARD_GRAVITY
from circlepoint.arm import load_arm
from circlepoint.recording_io import read_recording

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from circlepoint.arm import Arm
    from circlepoint.recording_io import LoadedRecording

Subparsers = Any
"""What `argparse.ArgumentParser.add_subparsers` returns; its class has no public name."""


def add_command(
    commands: Subparsers, common: argparse.ArgumentParser, name: str, *, summary: str, text: str, examples: str
) -> argparse.ArgumentParser:
    """Add a command's own parser, with its description and examples."""
    parser: argparse.ArgumentParser = commands.add_parser(
        name,
        help=summary,
        description=text,
        epilog=f"examples:\n{examples}",
        parents=[common],
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    return parser


def add_recording(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that name a recording and its arm."""
    parser.add_argument(
        "logs",
        nargs="+",
        type=Path,
        metavar="LOG",
        help="CSV (also .csv.gz), Parquet, ROS 1 bag or ROS 2 bag: t, q1..qn, ax, ay, az in SI units; several files "
        "are one recording; joints and sensor may be two files with two clocks",
    )
    add_arm(parser)
    parser.add_argument("--columns", type=Path, metavar="MAP", help="column names and units of the logs, map.yaml")
    parser.add_argument("--joint-topic", metavar="TOPIC", help="of a bag with several sensor_msgs/JointState")
    parser.add_argument("--imu-topic", metavar="TOPIC", help="of a bag with several sensor_msgs/Imu")
    add_gravity(parser)


def add_gravity(parser: argparse.ArgumentParser) -> None:
    """Add the local gravity."""
    parser.add_argument(
        "--gravity",
        type=positive,
        default=STANDARD_GRAVITY,
        metavar="G",
        help="local gravity, m/s^2 (default: %(default)s)",
    )


def add_arm(parser: argparse.ArgumentParser, text: str = "the arm's description, arm.yaml or a URDF") -> None:
    """Add the arguments that name an arm."""
    parser.add_argument("--arm", type=Path, required=True, metavar="ARM", help=text)
    parser.add_argument("--base", metavar="LINK", help="link of a URDF where the arm begins (default: its root)")
    parser.add_argument("--tip", metavar="LINK", help="link of a URDF that carries the sensor")


def arm_of(options: argparse.Namespace) -> Arm:
    """Read the arm the arguments name."""
    return load_arm(options.arm, base=options.base, tip=options.tip)


def recording_of(options: argparse.Namespace, arm: Arm) -> LoadedRecording:
    """Read the recording the arguments name."""
    return read_recording(
        options.logs,
        arm,
        options.columns,
        gravity=options.gravity,
        joint_topic=options.joint_topic,
        imu_topic=options.imu_topic,
    )


def positive(text: str) -> float:
    """Read a finite number above zero."""
    number = real(text)
    if number <= 0:
        raise argparse.ArgumentTypeError(f"{text} is not greater than zero")
    return number


def real(text: str) -> float:
    """Read a finite number."""
    try:
        number = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"{text} is not finite")
    return number


def whole_number(text: str) -> int:
    """Read a whole number."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number") from None


def numbers(text: str) -> tuple[float, ...]:
    """Read numbers separated by commas."""
    return tuple(real(part.strip()) for part in text.split(","))


@contextmanager
def progress(total: int, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Give a function to call as each of `total` steps begins: a line on a terminal, nothing in a pipe."""
    layout = "{desc}  {n_fmt}/{total_fmt}  {elapsed}"
    with tqdm(total=total, disable=True if quiet else None, leave=False, bar_format=layout) as bar:

        def begin(step: str) -> None:
            bar.set_description_str(step)
            bar.update()

        yield begin
