"""The page: sections in the order a reader asks for them, everything it needs inside it."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from circlepoint.report import tables
from circlepoint.report.html import asset, definitions, escaped, paragraph, script_data, section
from circlepoint.report.inputs import CalibrationResult, Document, TestFit, number
from circlepoint.report.scene import Scene, as_json
from circlepoint.report.style import inline_svg, page_variables
from circlepoint.report.summary import findings, key_numbers, method_name, next_tests, verdict

_policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
_labels = {
    "samples": "samples used",
    "noise_std": "noise of a sample, m/s²",
    "normalised_residual_rms": "normalised residual rms",
    "static_noise_std": "noise of dwell means, m/s²",
    "residual_rms": "residual rms, m/s²",
    "noise_inflation": "noise variance inflated by",
    "parameters": "parameters asked for",
    "condition_number": "condition number",
}


class TestDrawing(NamedTuple):
    """A test's fit with its drawing as SVG."""

    title: str
    fit: TestFit
    svg: str


class Drawings(NamedTuple):
    """The figures the page shows; `axes_png` is the printed view of the scene."""

    scene: Scene | None
    axes_png: bytes | None
    overview_svg: str
    tests: Sequence[TestDrawing]


def render_page(calibration: CalibrationResult, truth: Mapping[str, Any] | None, drawings: Drawings) -> str:
    """Return the whole page as text."""
    document = calibration.document
    name = escaped(calibration.arm.name)
    sections = [
        _next_section(document),
        _axes_section(document, truth, drawings),
        _dh_section(document),
        _recording_section(calibration, drawings),
        _tests_section(document, drawings),
        _sensor_section(document, truth),
        _reading_section(drawings, truth),
    ]
    script = f"<script>{asset('axes_view.js')}</script>" if drawings.scene is not None else ""
    return (
        "<!DOCTYPE html>\n"
        f'<html lang="en"><head><meta charset="utf-8"><title>Calibration of {name}</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{_policy}">'
        f"<style>{page_variables()}{asset('page.css')}</style></head><body>"
        f"{_header(calibration, truth)}<main>{''.join(sections)}</main>"
        f"<footer>{paragraph('Made by circlepoint. The same numbers, in full, are in calibration.json.')}</footer>"
        f"{script}</body></html>\n"
    )


def _header(calibration: CalibrationResult, truth: Mapping[str, Any] | None) -> str:
    document = calibration.document
    complete = bool(document.get("complete"))
    tiles = "".join(
        f"<li><span>{escaped(entry.title)}</span><b>{escaped(entry.value)} <i>{escaped(entry.unit)}</i></b>"
        f"<small>{escaped(entry.remark)}</small></li>"
        for entry in key_numbers(document, truth)
    )
    links = [
        ("next", "Findings"),
        ("axes", "Joint axes"),
        ("dh", "Denavit-Hartenberg"),
        ("recording", "Recording"),
        ("tests", "Tests"),
        ("sensor", "Sensor and fit"),
        ("reading", "How to read this"),
    ]
    navigation = "".join(f'<a href="#{target}">{escaped(text)}</a>' for target, text in links)
    status = f'<span class="status {"good" if complete else "bad"}">{"complete" if complete else "incomplete"}</span>'
    return (
        f"<header><p class=kicker>Kinematic calibration by accelerometer {status}</p>"
        f"<h1>{escaped(calibration.arm.name)}</h1>{paragraph(verdict(document), 'verdict')}"
        f"{paragraph(_sentence(method_name(document)), 'soft')}"
        f"<ul class=tiles>{tiles}</ul><nav>{navigation}</nav></header>"
    )


def _next_section(document: Document) -> str:
    items = "".join(
        f'<li class="{kind}"><strong>{escaped(heading)}</strong> {escaped(text)}</li>'
        for kind, heading, text in findings(document)
    )
    asked = "".join(f'<li class="next"><strong>Next</strong> {escaped(text)}</li>' for text in next_tests(document))
    body = f"<ul class=findings>{items}{asked}</ul>" if items or asked else paragraph("Nothing to report.")
    return section("next", "Findings, and what to record next", [body])


def _axes_section(document: Document, truth: Mapping[str, Any] | None, drawings: Drawings) -> str:
    parts = []
    if drawings.scene is not None and drawings.axes_png is not None:
        factor = f"{drawings.scene.tube_factor:g}"
        picture = base64.b64encode(drawings.axes_png).decode("ascii")
        buttons = "".join(
            f'<button type="button" data-action="{action}">{label}</button>'
            for action, label in (
                ("front", "front"),
                ("side", "side"),
                ("top", "top"),
                ("closer", "+"),
                ("farther", "\N{MINUS SIGN}"),
                ("reset", "reset"),
            )
        )
        shown = (
            "The joint axes at the reference configuration, seen with gravity downwards; grey lines join neighbouring "
            "axes where they are closest, and the last one to the sensor (dot, with its x, y, z). "
            f"Shaded: {factor} \N{MULTIPLICATION SIGN} the standard deviation."
        )
        if truth is not None:
            shown += " Dashed, drawn longer: the true axes."
        parts.append(
            '<figure id="axes-view"><svg viewBox="0 0 960 560" role="img" tabindex="0" '
            'aria-label="Joint axes in three dimensions"></svg>'
            f'<img alt="Joint axes" src="data:image/png;base64,{picture}">'
            f"<div class=controls><span>drag to turn</span>{buttons}</div><figcaption>{escaped(shown)}</figcaption>"
            f"{script_data('scene', as_json(drawings.scene))}</figure>"
        )
    parts.append(tables.joint_table(document, truth))
    return section("axes", "Joint axes", parts)


def _dh_section(document: Document) -> str:
    dh = document.get("dh")
    if not dh or not dh.get("rows"):
        text = "There are no parameters yet: they follow from the lines of all joints, and some are missing."
        return section("dh", "Denavit-Hartenberg parameters", [paragraph(text)])
    parts = [tables.dh_table(document)]
    parallel = "; ".join(" and ".join(pair) for pair in dh.get("near_parallel") or [])
    if parallel:
        text = f"Nearly parallel neighbours: {parallel}. "
        if dh.get("convention") == "hayati":
            text += (
                "Their common normal is far away, so the first of each pair has a Hayati row, with \u03b2 instead of d."
            )
        else:
            text += "Their common normal, and so a and d, is poorly defined; the arm as a whole is not: use the lines."
        parts.append(paragraph(text, "soft"))
    frames = tables.frame_table("Base frame", dh.get("base")) + tables.frame_table("Tool frame", dh.get("tool"))
    if frames:
        parts.append(f"<details><summary>Base and tool frames</summary><div class=pair>{frames}</div></details>")
    return section("dh", "Denavit-Hartenberg parameters", parts)


def _recording_section(calibration: CalibrationResult, drawings: Drawings) -> str:
    log, segments = calibration.recording, calibration.segmentation
    duration = float(log.time[-1] - log.time[0]) if len(log.time) else 0.0
    rows = f"{len(log.time):,}".replace(",", "\N{THIN SPACE}")
    text = (
        f"{rows} still poses, of each the mean of the readings."
        if log.is_static
        else f"{rows} samples at {log.sample_rate:g} Hz over {duration:.1f} s; "
        f"{len(segments.dwells)} dwells and {len(segments.motions)} single-joint motions."
    )
    picture = inline_svg(drawings.overview_svg, "overview", "Joint positions and specific force over the whole log")
    parts = [paragraph(text), f"<figure>{picture}</figure>", tables.test_table(calibration)]
    return section("recording", "What was recorded", parts)


def _tests_section(document: Document, drawings: Drawings) -> str:
    held_out = tables.hold_out_table(document)
    if not drawings.tests and not held_out:
        return section("tests", "Measured against modelled", [paragraph("No test was fitted.")])
    parts = [held_out]
    for index, test in enumerate(drawings.tests):
        label = escaped(f"{test.title}: measured against modelled specific force, with residuals")
        facts = f"residual {1e3 * test.fit.residual_rms:.1f} mm/s² rms"
        if len(test.fit.time):
            facts += f" below {test.fit.cutoff:.3g} Hz (measured and modelled through the same filter)"
        parts.append(
            f"<figure class=test><h3>{escaped(test.title)} <small>{escaped(facts)}</small></h3>"
            f"{inline_svg(test.svg, f'test{index}', label)}</figure>"
        )
    return section("tests", "Measured against modelled", parts)


def _sensor_section(document: Document, truth: Mapping[str, Any] | None) -> str:
    entries = [
        (_labels.get(key, key.replace("_", " ")), _shown(value))
        for part in ("fit", "identifiability")
        for key, value in (document.get(part) or {}).items()
        if not isinstance(value, Mapping | list | tuple) and value is not None
    ]
    facts = f"<div><h3>Fit</h3>{definitions(entries)}</div>" if entries else ""
    return section("sensor", "Sensor and fit", [f"<div class=pair>{tables.sensor_table(document, truth)}{facts}</div>"])


def _reading_section(drawings: Drawings, truth: Mapping[str, Any] | None) -> str:
    entries = [
        (
            "Sensor frame",
            "All lines are given in the accelerometer's axes, with the arm at the reference configuration.",
        ),
        (
            "Nearest point",
            "The point of the joint's axis that is nearest to the sensor; the axis is a line through it.",
        ),
        ("±", "One standard deviation, rounded to one or two digits; the value ends at the same digit."),
        ("free", "A choice, not an estimate: where along and around its first axis the base frame sits."),
        ("Normalised residual", "Its rms is 1 where the assumed noise explains what the model leaves."),
        (
            "On data not used",
            "Each stretch of motion and each dwell as predicted by an estimate without it: what the model is worth.",
        ),
        ("Residual", "Measured minus modelled. It should look like noise; a wave in it is something the model lacks."),
    ]
    if drawings.scene is not None:
        text = f"The shading shows where an axis may lie, {drawings.scene.tube_factor:g} times enlarged."
        entries.insert(2, ("Tubes in the view", text))
    if truth is not None:
        text = (
            "Angle and distance to the known axis. About six in seven should lie within twice the standard deviation."
        )
        entries.append(("True error", text))
    return section("reading", "How to read this", [definitions(entries)])


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    amount = number(value)
    if amount is None or isinstance(value, str):
        return str(value)
    return f"{value:,}".replace(",", "\N{THIN SPACE}") if isinstance(value, int) else f"{amount:.4g}"


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."
