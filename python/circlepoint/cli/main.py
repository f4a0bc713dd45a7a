"""Arguments in, exit status out; every failure becomes one clear message."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from typing import TYPE_CHECKING

import circlepoint
from circlepoint.cli import calibrate, campaign, check, demo, export, reproduce, simulate
from circlepoint.failures import BAD_INPUT, explain

if TYPE_CHECKING:
    from collections.abc import Sequence

INTERRUPTED = 130
PIPE_CLOSED = 141

_DESCRIPTION = "Calibrate the kinematics of a robot arm from a triaxial accelerometer on its end-point."
_EPILOG = """\
exit status:
  0  done
  1  the data does not allow it (says what is missing; what could be estimated is still written)
  2  bad input (says file, line or field, value and remedy)

examples:
  circlepoint demo --out demo-result
  circlepoint check log.csv --arm arm.yaml
  circlepoint calibrate log.csv --arm arm.yaml --out result
  circlepoint export result --to urdf --arm arm.urdf
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments without the program's name; those of the process by default.

    Returns
    -------
    int
        Exit status: 0 done, 1 the data does not allow it, 2 bad input, 130 interrupted.
    """
    arguments = _join_negative_lists(list(sys.argv[1:] if argv is None else argv))
    try:
        options = _parser().parse_args(arguments)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else BAD_INPUT
    try:
        status: int = options.run(options)
        sys.stdout.flush()
    except KeyboardInterrupt as stop:
        return _fail(f"interrupted; {str(stop) or 'nothing was left half-written'}", INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE_CLOSED
    except Exception as error:  # noqa: BLE001  (no traceback reaches a user who did not ask for it)
        if options.debug:
            traceback.print_exc()
        return _fail(*explain(error))
    return status


def _parser() -> argparse.ArgumentParser:
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--debug", action="store_true", help="show where in the program a failure came from")
    parser = argparse.ArgumentParser(
        prog="circlepoint",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"circlepoint {circlepoint.__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in (demo, calibrate, check, simulate, export, reproduce, campaign):
        command.register(commands, common)
    return parser


def _join_negative_lists(arguments: list[str]) -> list[str]:
    """``--reference-configuration -1.2,0.3`` as one word: argparse takes a leading minus for an option."""
    joined: list[str] = []
    words = iter(arguments)
    for word in words:
        value = next(words, None) if word == "--reference-configuration" else None
        joined.append(word if value is None else f"{word}={value}")
    return joined


def _fail(message: str, status: int) -> int:
    print(f"circlepoint: {message}", file=sys.stderr)
    return status
