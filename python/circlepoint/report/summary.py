"""What the calibration amounts to, in sentences and key numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from circlepoint.report.comparison import largest, line_errors
from circlepoint.report.inputs import Document, is_estimated, number, predicted_end_point_std
from circlepoint.report.rounding import format_std, significant
from circlepoint.treatments import PARAMETER_GROUPS

_methods = {
    "whole-arm": "whole-arm estimate: all axes, gravity, the sensor's errors and the delay by maximum likelihood",
    "position": "position method: static sweep for the axis, twice integrated acceleration for its centre",
    "velocity": "velocity method: static sweep for the axis, once integrated acceleration for its centre",
    "joint": "joint by joint: one regression for each test, other joints' yielding corrected by their encoders",
}
_encoder_codes = ("encoder-gain", "eccentricity")


class KeyNumber(NamedTuple):
    """A number worth a place at the top: what it is, the number, its unit, a remark."""

    title: str
    value: str
    unit: str
    remark: str


def method_name(document: Document) -> str:
    """Return the method in words, with what was asked of its parameters."""
    method = str(document.get("method", "unknown"))
    name = _methods.get(method, f"method: {method}")
    asked = "; ".join(_as_asked(group, how) for group, how in document.get("treatments", {}).items())
    return f"{name}. As asked: {asked}" if asked else name


def _as_asked(group: str, how: str | float) -> str:
    if isinstance(how, str):
        return f"{group} {how}"
    return f"{group} known to {how:g} {PARAMETER_GROUPS[group]}".removesuffix(" 1")


def verdict(document: Document) -> str:
    """Return one sentence (or two) that says how the calibration turned out."""
    joints: Sequence[Document] = document["joints"]
    missing = [joint["name"] for joint in joints if not is_estimated(joint)]
    total = len(joints)
    if len(missing) == total:
        return f"None of the {total} joint axes could be estimated from this recording."
    if missing:
        return (
            f"{total - len(missing)} of {total} joint axes are estimated; {_listed(missing)} "
            f"{'is' if len(missing) == 1 else 'are'} missing, so there is no complete arm yet."
        )
    sentence = f"All {total} joint axes are estimated"
    axis, line = _largest_stds(document)
    if axis is not None:
        sentence += f", directions to {format_std(1e3 * axis[0])} mrad"
        if line is not None:
            sentence += f" and positions to {format_std(1e3 * line[0])} mm"
        sentence += " or better (one standard deviation)"
    sentence += "."
    rms, _ = predicted_end_point_std(document)
    if rms is not None:
        sentence += f" Over the workspace the end-point is predicted to {format_std(1e3 * rms)} mm rms"
        off = sorted({f["joint"] for f in document.get("findings") or [] if f.get("code") in _encoder_codes})
        sentence += f", once the positions of {_listed(off)} are corrected as the findings say." if off else "."
    if not document.get("complete", True):
        sentence += " The calibration is marked incomplete: see the findings."
    return sentence


def key_numbers(document: Document, truth: Mapping[str, Any] | None) -> list[KeyNumber]:
    """Return the numbers a reader looks for first."""
    joints: Sequence[Document] = document["joints"]
    estimated = sum(is_estimated(joint) for joint in joints)
    found = [KeyNumber("joint axes", f"{estimated} of {len(joints)}", "", "estimated")]
    axis, line = _largest_stds(document)
    if axis is not None:
        found.append(KeyNumber("largest axis std", format_std(1e3 * axis[0]), "mrad", joints[axis[1]]["name"]))
    if line is not None:
        found.append(KeyNumber("largest line std", format_std(1e3 * line[0]), "mm", joints[line[1]]["name"]))
    rms, worst = predicted_end_point_std(document)
    if rms is not None:
        remark = "predicted, rms" if worst is None else f"predicted, rms; {format_std(1e3 * worst)} mm at worst"
        found.append(KeyNumber("end-point std", format_std(1e3 * rms), "mm", remark))
    if truth is not None:
        errors = line_errors(document, truth)
        for title, unit, worst_error in (
            ("largest axis error", "mrad", largest([error.direction for error in errors])),
            ("largest line error", "mm", largest([error.point for error in errors])),
        ):
            if worst_error is not None:
                remark = f"against the truth, {joints[worst_error[1]]['name']}"
                found.append(KeyNumber(title, significant(1e3 * worst_error[0]), unit, remark))
    return found


def next_tests(document: Document) -> list[str]:
    """Return what to record next: what the findings ask for, else one test for each missing joint."""
    asked = [
        _finding_text(finding) for finding in document.get("findings") or [] if finding.get("level") in _ask_levels
    ]
    if asked:
        return asked
    joints: Sequence[Document] = document["joints"]
    missing = [joint["name"] for joint in joints if not is_estimated(joint)]
    if missing:
        return [
            f"{name}: move only this joint. Stop at about ten positions spread over its range, a second at each, "
            "then swing it back and forth for a few seconds, as fast as it safely goes."
            for name in missing
        ]
    axis, line = _largest_stds(document)
    weakest = sorted({joints[worst[1]]["name"] for worst in (axis, line) if worst is not None})
    if not weakest:
        return []
    them = "it" if len(weakest) == 1 else "them"
    return [
        f"Nothing is missing. Least certain: {_listed(weakest)}; another test of {them} would improve the arm most."
    ]


def findings(document: Document) -> list[tuple[str, str, str]]:
    """Return each finding's style, heading and text, worst first; requests for tests are not among them."""
    order = {"error": ("bad", "Missing"), "warning": ("warn", "Warning"), "info": ("note", "Note")}
    listed = [
        (*order.get(str(finding.get("level")), order["info"]), _finding_text(finding))
        for finding in document.get("findings") or []
        if finding.get("level") not in _ask_levels
    ]
    unseen = (document.get("identifiability") or {}).get("unseen") or []
    listed += [("warn", "Not seen by this data", _combination(combination)) for combination in unseen]
    styles = ["bad", "warn", "note"]
    return sorted(listed, key=lambda entry: styles.index(entry[0]))


_ask_levels = frozenset({"next", "action", "advice"})


def _finding_text(finding: Document) -> str:
    return str(finding.get("text", finding.get("message", "")))


def _combination(entry: Any) -> str:
    if isinstance(entry, Mapping):
        return ". ".join(str(value) for value in entry.values() if isinstance(value, str))
    return str(entry)


def _largest_stds(document: Document) -> tuple[tuple[float, int] | None, tuple[float, int] | None]:
    joints = [joint if is_estimated(joint) else {} for joint in document["joints"]]
    return (
        largest([number(joint.get("direction_std")) for joint in joints]),
        largest([number(joint.get("point_std")) for joint in joints]),
    )


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
