"""``circlepoint demo``: simulate the paper's arm, calibrate it, show truth against estimate."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from circlepoint.atomic import require_writable_folder
from circlepoint.cli.options import Subparsers, add_command

if TYPE_CHECKING:
    import argparse

_TEXT = """\
Simulate a seven-joint arm, its accelerometer and the tests of each joint, calibrate the arm from that recording alone,
print the truth against the estimate, and write a full result folder. Needs no input."""

_EXAMPLES = """\
  circlepoint demo
  circlepoint demo --out demo-result      then open demo-result/report.html
"""


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands,
        common,
        "demo",
        summary="calibrate a simulated arm, truth beside the estimate",
        text=_TEXT,
        examples=_EXAMPLES,
    )
    parser.add_argument(
        "--out", type=Path, default=Path("demo-result"), metavar="DIR", help="result folder (default: %(default)s)"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from circlepoint import demo  # noqa: PLC0415  (loads what only this command needs)

    require_writable_folder(options.out)
    status: int | None = demo.run(options.out)
    return status or 0
