"""What the whole-arm estimate adds to a calibration's document: all parameters, what is weak, residuals held out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from circlepoint.document import Document, estimate_entry, finding_entries, plain
from circlepoint.findings import Finding

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    import circlepoint
    from circlepoint.arm import Arm

_TRIPLES = {
    "bias": ("bias_x", "bias_y", "bias_z"),
    "scale": ("scale_x", "scale_y", "scale_z"),
    "misalignment": ("misalignment_yx", "misalignment_zx", "misalignment_zy"),
    "second_order": ("second_order_x", "second_order_y", "second_order_z"),
}
_ENCODER_ERRORS = ("gain", "eccentricity_cos", "eccentricity_sin")
_SURE = 4.0  # standard deviations from which an encoder's error is told
_PERCUSSION = ("percussion_distance_x", "percussion_distance_y", "percussion_distance_z")


def with_whole_arm(document: Mapping[str, Any], arm: Arm, estimate: circlepoint.WholeArmCalibration) -> Document:
    """Return the document of the lines with the fields only the whole-arm estimate knows.

    Parameters
    ----------
    document : mapping
        From `result_document`, of ``estimate.joints``.
    arm : Arm
    estimate : WholeArmCalibration
        One without parameters (no start was found) leaves the document as it is.
    """
    if not estimate.parameters:
        return dict(document)
    return {
        **document,
        "sensor": {**document["sensor"], **_sensor_entry(estimate)},
        "covariance": _covariance_entry(arm, estimate),
        "identifiability": _identifiability_entry(document, estimate),
        "fit": _fit_entry(estimate),
        "hold_out": [_hold_out_entry(arm, stretch) for stretch in estimate.stretches],
        "encoders": (encoders := _encoder_entries(arm, estimate)),
        "findings": [
            *document["findings"],
            *finding_entries([*_encoder_findings(arm, document, encoders), *_settling_findings(estimate)]),
        ],
    }


def _named(estimate: circlepoint.WholeArmCalibration) -> dict[str, int]:
    return {parameter.name: index for index, parameter in enumerate(estimate.parameters)}


def _sensor_entry(estimate: circlepoint.WholeArmCalibration) -> Document:
    index = _named(estimate)
    value = np.array([parameter.value for parameter in estimate.parameters])
    std = np.array([parameter.std for parameter in estimate.parameters])

    def triple(names: Sequence[str]) -> Document | None:
        if names[0] not in index:
            return None
        at = [index[name] for name in names]
        return estimate_entry(value[at], std[at])

    entry: Document = {name: triple(names) for name, names in _TRIPLES.items()}
    entry["percussion_distance"] = None
    channels = triple(_PERCUSSION)
    if channels is not None:
        at = [index[name] for name in _PERCUSSION]
        weight = np.linalg.solve(estimate.covariance[np.ix_(at, at)], np.ones(3))
        entry["percussion_distance"] = {
            "estimate": float(weight @ value[at] / weight.sum()),
            "std": float(weight.sum() ** -0.5),
            "channels": channels,
        }

    def single(name: str) -> Document | None:
        at = index.get(name)
        return None if at is None else estimate_entry(float(value[at]), float(std[at]))

    for name in ("clock_offset", "clock_rate"):
        entry[name] = single(name)
    if estimate.gyroscope_used:
        bias = triple(("gyroscope_bias_x", "gyroscope_bias_y", "gyroscope_bias_z"))
        delay = single("gyroscope_delay")
        entry["gyroscope"] = {"bias": bias, "matrix": plain(estimate.gyroscope_matrix), "delay": delay}
    return entry


def _covariance_entry(arm: Arm, estimate: circlepoint.WholeArmCalibration) -> Document:
    return {
        "parameters": [arm_name(arm, parameter.name) for parameter in estimate.parameters],
        "matrix": plain(estimate.covariance),
    }


def arm_name(arm: Arm, text: str) -> str:
    """Return a parameter's name with the joint under the arm's own name for it (joint1.d1 -> shoulder.d1)."""
    head, dot, tail = text.partition(".")
    if not dot or not head.startswith("joint"):
        return text
    return f"{arm.joints[int(head.removeprefix('joint')) - 1].name}.{tail}"


def _identifiability_entry(document: Mapping[str, Any], estimate: circlepoint.WholeArmCalibration) -> Document:
    condition = estimate.condition_number
    return {
        "rank": estimate.rank,
        "parameters": len(estimate.parameters),
        "condition_number": condition if math.isfinite(condition) and condition < 1e15 else None,
        "unseen": document["identifiability"]["unseen"],
    }


def _fit_entry(estimate: circlepoint.WholeArmCalibration) -> Document:
    moving = [stretch for stretch in estimate.stretches if stretch.name != "dwells"]
    samples = sum(stretch.samples for stretch in moving)
    squares = sum(stretch.samples * stretch.residual_rms**2 for stretch in moving)
    in_motion = math.sqrt(squares / samples) if moving else None
    at_rest = next((stretch.residual_rms for stretch in estimate.stretches if stretch.name == "dwells"), None)
    return {
        "samples": estimate.samples,
        "rows": estimate.rows,
        "outliers": estimate.outliers,
        **({"cutoff": estimate.cutoff} if moving else {}),
        "noise_std": in_motion,
        "static_noise_std": at_rest,
        "residual_rms": in_motion if moving else at_rest,
        "normalised_residual_rms": estimate.normalized_rms,
        "noise_inflation": estimate.noise_inflation,
        "iterations": estimate.iterations,
        "unsettled": estimate.unsettled,
        "converged": estimate.converged,
    }


def _encoder_entries(arm: Arm, estimate: circlepoint.WholeArmCalibration) -> list[Document]:
    index = _named(estimate)
    entries: list[Document] = []
    for number, joint in enumerate(arm.joints, start=1):
        errors: Document = {}
        for error in _ENCODER_ERRORS:
            at = index.get(f"joint{number}.{error}")
            parameter = None if at is None else estimate.parameters[at]
            errors[error] = None if parameter is None else estimate_entry(parameter.value, parameter.std)
        if any(error is not None for error in errors.values()):
            entries.append({"joint": joint.name, **errors})
    return entries


def _encoder_findings(arm: Arm, document: Mapping[str, Any], entries: Sequence[Document]) -> list[Finding]:
    index = {joint.name: number for number, joint in enumerate(arm.joints)}
    exports = ". DH, URDF and the other exports hold for positions corrected so" if document["complete"] else ""
    findings = []
    for entry in entries:
        joint, gain, cosine, sine = entry["joint"], *(entry[error] for error in _ENCODER_ERRORS)
        q_ref = document["reference_configuration"][index[joint]]
        if gain is not None and abs(gain["estimate"]) > _SURE * gain["std"]:
            percent, std = 1e2 * gain["estimate"], 1e2 * gain["std"]
            moves = "turns" if arm.joints[index[joint]].type == "revolute" else "slides"
            message = (
                f"{joint}: {moves} {abs(percent):.3g} % {'more' if percent > 0.0 else 'less'} than its encoder says, "
                f"standard deviation {std:.1g} %: where it reads q it is at "
                f"q {_signed(gain)} (q - q_ref), q_ref = {q_ref:.5g}{exports}"
            )
            findings.append(Finding("encoder-gain", message, joint))
        if cosine is not None and sine is not None:
            off = 1e3 * math.hypot(cosine["estimate"], sine["estimate"])
            std = 1e3 * math.hypot(cosine["std"], sine["std"]) / math.sqrt(2.0)
            if off < _SURE * std:
                continue
            message = (
                f"{joint}: once a turn its position is off what its encoder says by {off:.2g} mrad, standard "
                f"deviation {std:.1g} mrad, as if the encoder sat off its axis or what the joint carries gave way to "
                f"gravity: where it reads q it is at q {_signed(cosine)} (cos q - cos q_ref) {_signed(sine)} (sin q - "
                f"sin q_ref), q_ref = {q_ref:.5g}{exports}"
            )
            findings.append(Finding("eccentricity", message, joint))
    return findings


def _settling_findings(estimate: circlepoint.WholeArmCalibration) -> list[Finding]:
    if estimate.converged:
        return []
    return [
        Finding(
            "not-converged",
            "the estimate had not settled when it ended: a parameter was off or still moving by "
            f"{estimate.unsettled:.1g} standard deviations, and the noise it goes by may be too; the motions hardly "
            "follow the model, or they are few: record more of them, slower if the arm shakes",
        )
    ]


def _signed(entry: Document) -> str:
    value = entry["estimate"]
    return f"{'-' if value < 0.0 else '+'} {abs(value):.5f}"


def _hold_out_entry(arm: Arm, stretch: circlepoint.StretchResidual) -> Document:
    head, _, number = stretch.name.partition(" ")
    alone = head == "joint" and number.isdigit()
    return {
        "name": arm.joints[int(number) - 1].name if alone else stretch.name,
        "begin": stretch.begin,
        "end": stretch.end,
        "samples": stretch.samples,
        "residual_rms": stretch.residual_rms,
        "normalised_rms": stretch.normalized_rms,
        "held_out_samples": stretch.held_out_samples,
        "held_out_rms": _finite(stretch.held_out_rms),
        "held_out_normalised_rms": _finite(stretch.held_out_normalized_rms),
        "indispensable": stretch.indispensable,
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
