"""``circlepoint reproduce``: the paper's whole study, its numbers and figures with ours beside them."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

from circlepoint.atomic import require_writable_folder
from circlepoint.cli.options import Subparsers, add_command, progress, whole_number
from circlepoint.text_table import aligned

_TEXT = """\
Run the whole study of Canepa, Hollerbach and Boelen (1994) in simulation and write, for every number the paper states,
the paper's, ours by the paper's own method and ours by the best method, with intervals: reproduction.html,
reproduction.md, reproduction.json, and the paper's figures. Needs no input. Threads change the time, not the
numbers."""

_EXAMPLES = """\
  circlepoint reproduce --out reproduction      then open reproduction/reproduction.html
  circlepoint reproduce --out quick --trials 20
"""
_fewest = 10


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands,
        common,
        "reproduce",
        summary="every number and figure of the paper, with ours",
        text=_TEXT,
        examples=_EXAMPLES,
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to write")
    parser.add_argument(
        "--trials",
        type=_trials,
        default=200,
        metavar="N",
        help="trials of each case, at least 10 (default: %(default)s)",
    )
    parser.add_argument(
        "--jobs", type=_jobs, default=len(os.sched_getaffinity(0)), metavar="N", help="threads (default: %(default)s)"
    )
    parser.add_argument("--json", action="store_true", help="print reproduction.json")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from circlepoint.reproduce.presentation import statement_rows, verdict  # noqa: PLC0415  (keeps --help quick)
    from circlepoint.reproduce.study import STEPS, reproduce  # noqa: PLC0415
    from circlepoint.reproduce.write import write_reproduction  # noqa: PLC0415

    require_writable_folder(options.out)
    with progress(STEPS, quiet=options.json) as begin:
        reproduction = reproduce(options.trials, options.jobs, begin)
    content = write_reproduction(options.out, reproduction)
    if options.json:
        print(json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False))
        return 0
    rows = [(row.what, row.paper, row.by_paper, row.by_best) for row in statement_rows(reproduction)]
    rows.insert(0, ("", "paper", "ours, the paper's method", "ours, the best method"))
    print("\n".join(aligned(rows, left=range(4))))
    print()
    print(f"{verdict(reproduction)} {reproduction.trials} trials, {reproduction.seconds:.0f} s.")
    print(f"written: {options.out}/ (open {options.out / 'reproduction.html'})")
    return 0


def _trials(text: str) -> int:
    return _at_least(text, _fewest)


def _jobs(text: str) -> int:
    return _at_least(text, 1)


def _at_least(text: str, least: int) -> int:
    count = whole_number(text)
    if count < least:
        raise argparse.ArgumentTypeError(f"{text} is less than {least}")
    return count
