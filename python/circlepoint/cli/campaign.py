"""``circlepoint campaign``: many trials, or many logs, resumable, on one machine or on a cluster."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from tqdm import tqdm

from circlepoint.atomic import require_writable_folder, write_atomically
from circlepoint.cli.options import Subparsers, add_command, whole_number

if TYPE_CHECKING:
    from circlepoint.document import Document

_TEXT = """\
Run trials of simulate, calibrate, compare with the truth, as CONFIG says: arms, sensors, plans, noise and methods, each
one value or a list that is swept. Or, where CONFIG has a `fleet`, calibrate the logs of many arms. Results are written
to DIR batch by batch as Parquet; a run that was stopped, however hard, goes on when the same command is given again.
Workers, threads and machines change the time, never the results."""

_EXAMPLES = """\
  circlepoint campaign campaign.yaml --out study
  circlepoint campaign campaign.yaml --out study --workers 8
  circlepoint campaign campaign.yaml --out study --scheduler tcp://10.0.0.1:8786
  circlepoint campaign fleet.yaml --out calibrated
"""


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands,
        common,
        "campaign",
        summary="many simulated trials, or the logs of many arms; resumable",
        text=_TEXT,
        examples=_EXAMPLES,
    )
    parser.add_argument("config", type=Path, metavar="CONFIG", help="what to run, a YAML file")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to write, or to go on with")
    parser.add_argument(
        "--workers",
        type=_workers,
        default=len(os.sched_getaffinity(0)),
        metavar="N",
        help="threads for trials, processes for a fleet (default: %(default)s)",
    )
    parser.add_argument(
        "--scheduler",
        metavar="tcp://HOST:PORT",
        help="run on the workers of this Dask cluster (needs circlepoint[dask])",
    )
    parser.add_argument("--json", action="store_true", help="print summary.json")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from circlepoint.campaign.fleet_config import is_fleet  # noqa: PLC0415  (keeps `circlepoint --help` quick)

    require_writable_folder(options.out)
    try:
        return _run_fleet(options) if is_fleet(options.config) else _run_trials(options)
    except KeyboardInterrupt:
        raise KeyboardInterrupt("what is finished is kept, and the same command goes on with the rest") from None


def _run_trials(options: argparse.Namespace) -> int:
    from circlepoint.campaign.config import load_campaign  # noqa: PLC0415
    from circlepoint.campaign.figure import draw_summary  # noqa: PLC0415
    from circlepoint.campaign.presentation import format_summary  # noqa: PLC0415
    from circlepoint.campaign.run import run_campaign  # noqa: PLC0415
    from circlepoint.report.style import png_bytes, svg_text  # noqa: PLC0415

    campaign = load_campaign(options.config)
    with _Progress("trial", quiet=options.json) as progress:
        summary = run_campaign(
            campaign, options.out, workers=options.workers, scheduler=options.scheduler, watcher=progress
        )
    figure = draw_summary(summary)
    write_atomically(options.out / "summary.svg", svg_text(figure).encode())
    write_atomically(options.out / "summary.png", png_bytes(figure))
    _write_summary(options, summary)
    if not options.json:
        print(format_summary(summary))
        print(f"written: {options.out}/ (summary.json, summary.png, trials/)")
    return 0


def _run_fleet(options: argparse.Namespace) -> int:
    from circlepoint.campaign.fleet import format_fleet, run_fleet  # noqa: PLC0415
    from circlepoint.campaign.fleet_config import load_fleet  # noqa: PLC0415

    fleet = load_fleet(options.config)
    with _Progress("log", quiet=options.json) as progress:
        summary = run_fleet(fleet, options.out, workers=options.workers, scheduler=options.scheduler, watcher=progress)
    _write_summary(options, summary)
    if not options.json:
        print(format_fleet(summary))
        print(f"written: {options.out}/ (fleet.parquet, joints.parquet, results/)")
    missing = [row["name"] for row in summary["logs"] if row["outcome"] != "complete"]
    if missing:
        print(
            f"circlepoint: {len(missing)} of {len(summary['logs'])} logs not whole: {', '.join(missing)}; the "
            f"reason of each is in {options.out / 'fleet.parquet'}",
            file=sys.stderr,
        )
    return 1 if missing else 0


def _write_summary(options: argparse.Namespace, summary: Document) -> None:
    text = json.dumps(summary, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
    write_atomically(options.out / "summary.json", text.encode())
    if options.json:
        print(text, end="")


class _Progress:
    """A line with rate and time left on a terminal, nothing in a pipe."""

    def __init__(self, unit: str, *, quiet: bool) -> None:
        self._unit, self._quiet = unit, quiet
        self._bar: tqdm[Any] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def begin(self, total: int, finished: int) -> None:
        """Show how many there are, and how many were finished before."""
        self._bar = tqdm(
            total=total,
            initial=finished,
            unit=f" {self._unit}s",
            smoothing=0.05,
            leave=False,
            disable=True if self._quiet else None,
            bar_format="{percentage:3.0f} %  {n_fmt} of {total_fmt}{unit}  {rate_fmt}  {remaining} left",
        )

    def advance(self, done: int) -> None:
        """Count on."""
        if self._bar is not None:
            self._bar.update(done)

    def tell(self, message: str) -> None:
        """Say why nothing comes, also in a pipe."""
        tqdm.write(f"circlepoint: {message}", file=sys.stderr)


def _workers(text: str) -> int:
    count = whole_number(text)
    if count < 1:
        raise argparse.ArgumentTypeError(f"{text} is less than 1")
    return count
