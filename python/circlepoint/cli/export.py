"""``circlepoint export``: the calibrated arm in the form a controller takes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from circlepoint.cli.options import Subparsers, add_command
from circlepoint.export import FORMS, export_result, write_export
from circlepoint.export.form import json_text

if TYPE_CHECKING:
    import argparse

_TEXT = """\
Write the calibrated arm of a result folder in the form a controller or a program takes:

  urdf       the arm's own URDF, its joint origins moved onto the calibrated axes and nothing else changed; a minimal
             one where the arm came without. Beside it FILE.yaml: what was kept nominal, where the sensor is
  dh, mdh    Denavit-Hartenberg parameters, standard and modified (Craig); Hayati rows where axes are nearly parallel
  hayati     the same with Hayati rows wherever neighbours are nearly parallel
  poe        product of exponentials: screws, home, reference
  ur         kinematics calibration of Universal Robots' descriptions (default_kinematics.yaml)
  kdl        segments and joints of a KDL chain
  pinocchio  joint placements
  table      before and after, degrees and millimetres with 95 % intervals (Markdown and CSV)

What the calibration cannot see - the base under the first joint, the tip on the last one, the zeros of both - keeps
its nominal value; the file lists it. The nominal arm is --arm, else nominal.urdf or arm.yaml in DIR; without one, the
base is the sensor frame at the reference configuration.

Exit status 0: written. 1: a joint has no axis, nothing is written. 2: bad input, nothing is written."""

_EXAMPLES = """\
  circlepoint export result --to dh
  circlepoint export result --to urdf --arm ur5.urdf --base base_link --tip tool0
  circlepoint export result --to poe --out arm.json          .json or .yaml, as the name ends
"""


def register(commands: Subparsers, common: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser = add_command(
        commands,
        common,
        "export",
        summary="the calibrated arm as a controller takes it",
        text=_TEXT,
        examples=_EXAMPLES,
    )
    parser.add_argument("folder", type=Path, metavar="DIR", help="result folder with calibration.json")
    parser.add_argument("--to", choices=FORMS, required=True, dest="form", help="the form")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="where to (default: a file named after the form in DIR)"
    )
    parser.add_argument("--arm", type=Path, metavar="ARM", help="the arm's nominal description, arm.yaml or URDF")
    parser.add_argument(
        "--base", metavar="LINK", help="URDF: base link (default: as calibrated, else the first joint's parent)"
    )
    parser.add_argument(
        "--tip", metavar="LINK", help="URDF: tip link (default: as calibrated, else the last joint's child)"
    )
    parser.add_argument("--hash", metavar="TEXT", dest="checksum", help="ur: the controller's calibration checksum")
    parser.add_argument("--json", action="store_true", help="print the document as JSON; a file only with --out")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    export = export_result(
        options.folder,
        options.form,
        arm=options.arm,
        base=options.base,
        tip=options.tip,
        checksum=options.checksum,
    )
    written: list[Path] = []
    if options.out is not None or not options.json:
        written = write_export(export, options.folder, options.form, options.out)
    if options.json:
        print(json_text(export.document), end="")
        return 0
    if "table" in export.form:
        print(export.texts[".md"], end="")
    for note in export.notes:
        print(f"note: {note}")
    for entry in export.document["kept_nominal"]:
        print(f"kept nominal: {entry['quantity']} ({entry['reason']})")
    print(f"written: {', '.join(map(str, written))}")
    return 0
