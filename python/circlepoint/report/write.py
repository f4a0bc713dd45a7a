"""Writing the report: every figure and the page, each whole or not at all."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from circlepoint.atomic import write_atomically
from circlepoint.report.axes_figure import draw_axes
from circlepoint.report.figures import draw_overview, draw_test
from circlepoint.report.page import Drawings, TestDrawing, render_page
from circlepoint.report.scene import build_scene
from circlepoint.report.style import png_bytes, svg_text

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from circlepoint.report.inputs import CalibrationResult, Document

_own_figures = re.compile(r"test_\d+(_\d+)?\.svg|axes\.(png|svg)")


def write_report(directory: Path, calibration: CalibrationResult, truth: Mapping[str, Any] | None = None) -> None:
    """Write `report.html` and its figures.

    The page holds everything it shows and opens without a network. The same drawings are written beside it, under
    `figures/`: `axes.png`, `axes.svg`, `overview.svg` and `test_<joint>.svg` (joints counted from 1). Figures of an
    earlier report there that this one does not have are removed.

    Parameters
    ----------
    directory : Path
        Where to write; made if it is not there.
    calibration : CalibrationResult
        The calibration to show, complete or not.
    truth : mapping, optional
        The known arm of simulated data: `joints[i]` with `direction_sensor` and `point_sensor` in m, and sensor
        parameters under their names. Adds the true errors.

    Raises
    ------
    OSError
        If the directory cannot be written.
    """
    scene = build_scene(calibration.document, truth)
    files: dict[str, bytes] = {}
    if scene is not None:
        figure = draw_axes(scene)
        files["axes.png"] = png_bytes(figure)
        files["axes.svg"] = svg_text(figure).encode()
    overview = svg_text(draw_overview(calibration))
    files["overview.svg"] = overview.encode()
    tests = []
    seen: dict[int, int] = {}
    for fit in calibration.fits:
        order = seen[fit.joint] = seen.get(fit.joint, 0) + 1
        joints = calibration.document["joints"]
        joint: Document = joints[fit.joint] if 0 <= fit.joint < len(joints) else {}
        svg = svg_text(draw_test(fit, joint))
        files[f"test_{fit.joint + 1}{f'_{order}' if order > 1 else ''}.svg"] = svg.encode()
        tests.append(TestDrawing(fit.joint_name if order == 1 else f"{fit.joint_name}, test {order}", fit, svg))
    page = render_page(calibration, truth, Drawings(scene, files.get("axes.png"), overview, tests))
    figures = directory / "figures"
    figures.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        write_atomically(figures / name, content)
    for stale in figures.iterdir():
        if stale.name not in files and _own_figures.fullmatch(stale.name):
            stale.unlink()
    write_atomically(directory / "report.html", page.encode())
