"""A calibration's numbers under the names of ``calibration.json``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.coupling import mimic_entries, said_of
from circlepoint.dh_rows import row_parameters, row_std
from circlepoint.document import (
    SCHEMA_NAME,
    Document,
    dh_row_entry,
    estimate_entry,
    finding_entries,
    generator_entry,
    joint_entry,
    missing_joint_entry,
    plain,
)
from circlepoint.findings import Finding
from circlepoint.nominal import nominal_chain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from circlepoint.arm import Arm
    from circlepoint.dh_rows import DhConversion

LINE_COORDINATES = ("d1", "d2", "p1", "p2")
WORKSPACE_CONFIGURATIONS = 200
LARGEST_CONDITION = 1e15
"""Beyond it a condition number says no more than that the matrix is singular."""
LARGEST_ACCELERATION_ERROR = 0.01
"""By which the acceleration read of a prismatic joint may differ from its encoder's before it is worth a word."""


def result_document(
    arm: Arm,
    *,
    method: str,
    gravity: float,
    segmentation: circlepoint.Segmentation,
    joints: circlepoint.JointCalibration,
    chain: circlepoint.ScrewChain | None,
    dh: DhConversion | None,
    whole_arm: circlepoint.WholeArmCalibration | None = None,
) -> Document:
    """Return the document of a calibration; every field is described in the schema.

    Parameters
    ----------
    arm : Arm
    method : str
    gravity : float
        m/s^2, taken as known.
    segmentation : Segmentation
    joints : JointCalibration
    chain : ScrewChain or None
    dh : StandardDhConversion, ModifiedDhConversion, HayatiConversion or None
    whole_arm : WholeArmCalibration, optional
        Whose lines these are: its encoders' corrections are then in the end-point's standard deviation.
    """
    estimated = [estimate.joint for estimate in joints.joints if estimate.axis is not None]
    return {
        "schema": SCHEMA_NAME,
        "generator": generator_entry(),
        "arm": arm.name,
        "method": method,
        "complete": joints.complete(),
        "reference_configuration": plain(joints.reference_configuration),
        "joints": _joint_entries(arm, segmentation, joints),
        "gravity_magnitude": gravity,
        "gravity_sensor": plain(joints.up_gravity_sensor) if estimated else None,
        "sensor": _sensor_entry(method, joints),
        "dh": _dh_entry(arm, chain, dh, joints),
        "covariance": _covariance_entry(arm, joints, estimated),
        "identifiability": _identifiability_entry(arm, joints),
        "fit": _fit_entry(joints),
        "end_point": _end_point_entry(arm, chain, joints, whole_arm),
        "findings": finding_entries(_acceleration_findings(arm, method, joints)),
        **({"mimics": mimics} if (mimics := mimic_entries(arm)) else {}),
    }


def _joint_entries(
    arm: Arm, segmentation: circlepoint.Segmentation, joints: circlepoint.JointCalibration
) -> list[Document]:
    entries = []
    nominal = _nominal_entries(arm, joints)
    for joint, estimate in zip(arm.joints, joints.joints, strict=True):
        fit = joints.fits[estimate.fit] if estimate.fit >= 0 else None
        tests = [
            _test_entry(test, fit if fit is not None and fit.test == index else None)
            for index, test in enumerate(segmentation.tests)
            if test.joint == estimate.joint
        ]
        if estimate.axis is None:
            entries.append(
                missing_joint_entry(
                    joint.name, joint.type, said_of(arm, estimate.reason, estimate.joint), tests, estimate.vague
                )
            )
            continue
        line = estimate.axis.screw.line
        entries.append(
            joint_entry(
                joint.name,
                joint.type,
                direction=line.direction,
                point=line.point,
                direction_std=estimate.axis.direction_std(),
                point_std=estimate.axis.point_std(),
                covariance=estimate.axis.covariance,
                basis=circlepoint.tangent_basis(line.direction).T,
                tests=tests,
                nominal=nominal.get(estimate.joint),
            )
        )
    return entries


def _nominal_entries(arm: Arm, joints: circlepoint.JointCalibration) -> dict[int, Document]:
    """Return where the arm's description puts the estimated lines, its frame fitted to them; two lines at least."""
    found = {e.joint: e.axis.screw.line for e in joints.joints if e.axis is not None}
    if not arm.has_nominal or len(found) < 2:
        return {}
    chain = nominal_chain(arm, joints.reference_configuration)
    lines = {joint: chain.axes[joint].line for joint in found}
    types = [chain.axes[joint].type for joint in found]
    placement = circlepoint.align_lines(list(found.values()), list(lines.values()), types=types)
    entries = {}
    for joint, line in found.items():
        placed = circlepoint.transform(placement, lines[joint])
        difference = circlepoint.local_coordinates(line, placed)
        slides = chain.axes[joint].type == circlepoint.JointType.prismatic
        entries[joint] = {
            "direction_sensor": placed.direction,
            "point_sensor": None if slides else placed.point,
            "direction_difference": float(np.hypot(*difference[:2])),
            "point_difference": None if slides else float(np.hypot(*difference[2:])),
        }
    return entries


def _test_entry(test: circlepoint.JointTest, fit: circlepoint.TestFit | None) -> Document:
    entry: Document = {
        "configuration": test.configuration,
        "dwells": len(test.dwells),
        "dwell_span": test.dwell_span,
        "motions": len(test.motions),
        "motion_span": test.motion_span,
        "used": fit is not None,
    }
    if fit is not None:
        entry |= {
            "samples": fit.samples,
            "cutoff": fit.cutoff,
            "static_noise_std": fit.static_noise_std,
            "dynamic_noise_std": fit.dynamic_noise_std,
            "gravity_share": fit.gravity_share,
            "condition_number": _condition(fit.condition_number),
            "correlation_factor": fit.correlation_factor,
            "converged": fit.converged,
            "iterations": fit.iterations,
        }
        if fit.type == circlepoint.JointType.prismatic:
            entry |= {
                "acceleration_rms": fit.acceleration_rms,
                "acceleration_scale": fit.acceleration_scale,
                "acceleration_scale_std": fit.acceleration_scale_std,
            }
    return entry


def _acceleration_findings(arm: Arm, method: str, joints: circlepoint.JointCalibration) -> list[Finding]:
    """Compare the acceleration the sensor read with that of a prismatic joint's encoder: only the direction uses it."""
    findings = []
    for fit in joints.fits:
        error = fit.acceleration_scale - 1.0
        tolerance = max(LARGEST_ACCELERATION_ERROR, 5.0 * fit.acceleration_scale_std)
        if method == "joint" and fit.type == circlepoint.JointType.prismatic and abs(error) > tolerance:
            name = arm.joints[fit.joint].name
            findings.append(
                Finding(
                    "acceleration-scale",
                    f"{name}: the sensor reads {100 * error:+.1f} % off the acceleration its encoder tells (standard "
                    f"deviation {100 * fit.acceleration_scale_std:.1f} %): its counts per metre, the sensor's scale "
                    "factor or the clocks are off. Its direction does not depend on it; lengths along it do",
                    name,
                )
            )
    return findings


def _condition(value: float) -> float | None:
    return value if 0.0 < value < LARGEST_CONDITION else None


def _sensor_entry(method: str, joints: circlepoint.JointCalibration) -> Document:
    entry: Document = dict.fromkeys(
        ("bias", "scale", "misalignment", "second_order", "percussion_distance", "clock_offset", "clock_rate")
    )
    if method in ("joint", "whole-arm"):
        std = np.sqrt(np.diag(joints.sensor.covariance))
        sensor = joints.sensor.sensor
        entry["bias"] = estimate_entry(sensor.bias, std[:3])
        entry["scale"] = estimate_entry(sensor.scale, std[3:6])
        entry["misalignment"] = estimate_entry(sensor.misalignment, std[6:9])
        entry["second_order"] = estimate_entry(sensor.second_order, std[9:])
        entry["percussion_distance"] = _percussion_entry(joints)
    return entry


def _percussion_entry(joints: circlepoint.JointCalibration) -> Document:
    """Return the channels' common distance, weighted by their information, and each channel's own."""
    std = joints.percussion_distance_std
    if not std.all():  # known beforehand
        return {
            "estimate": float(np.mean(joints.percussion_distance)),
            "std": 0.0,
            "channels": estimate_entry(joints.percussion_distance, std),
        }
    weight = std**-2.0
    return {
        "estimate": float(np.sum(weight * joints.percussion_distance) / np.sum(weight)),
        "std": float(np.sum(weight) ** -0.5),
        "channels": estimate_entry(joints.percussion_distance, joints.percussion_distance_std),
    }


def _dh_entry(
    arm: Arm, chain: circlepoint.ScrewChain | None, dh: DhConversion | None, joints: circlepoint.JointCalibration
) -> Document | None:
    if chain is None or dh is None:
        return None
    hayati = isinstance(dh, circlepoint.HayatiConversion)
    names = row_parameters(dh)
    stds = row_std(chain, dh, joints.covariance)
    rows = [
        dh_row_entry({name: getattr(row, name) for name in names}, std, free)
        for row, std, free in zip(dh.chain.rows, stds, np.asarray(dh.free, dtype=bool).tolist(), strict=True)
    ]
    if isinstance(dh, circlepoint.HayatiConversion):
        for entry, row in zip(rows, dh.chain.rows, strict=True):
            entry["form"] = row.form.name
        pairs = [index for index, row in enumerate(dh.chain.rows) if row.form == circlepoint.RowForm.hayati]
    else:
        pairs = [pair.first for pair in dh.near_parallel]
    modified = isinstance(dh.chain, circlepoint.ModifiedDhChain)
    return {
        "convention": "hayati" if hayati else "modified" if modified else "standard",
        "rows": rows,
        "base": plain(dh.chain.base),
        "tool": plain(dh.chain.tool),
        "near_parallel": [[arm.joints[first].name, arm.joints[first + 1].name] for first in pairs],
    }


def _covariance_entry(arm: Arm, joints: circlepoint.JointCalibration, estimated: Sequence[int]) -> Document | None:
    if not estimated:
        return None
    keep = [4 * joint + k for joint in estimated for k in range(4)]
    return {
        "parameters": [f"{arm.joints[joint].name}.{name}" for joint in estimated for name in LINE_COORDINATES],
        "matrix": plain(joints.covariance[np.ix_(keep, keep)]),
    }


def _identifiability_entry(arm: Arm, joints: circlepoint.JointCalibration) -> Document:
    conditions = [fit.condition_number for fit in joints.fits if fit.condition_number > 0.0]
    missing = [
        f"{joint.name} line: {said_of(arm, estimate.reason, estimate.joint)}"
        for joint, estimate in zip(arm.joints, joints.joints, strict=True)
        if estimate.axis is None
    ]
    return {
        "rank": sum(fit.rank for fit in joints.fits),
        "parameters": sum(fit.parameters for fit in joints.fits),
        "condition_number": _condition(max(conditions)) if conditions else None,
        "unseen": [*(said_of(arm, combination) for combination in joints.unseen), *missing],
    }


def _fit_entry(joints: circlepoint.JointCalibration) -> Document:
    fits = joints.fits
    return {
        "samples": sum(fit.samples for fit in fits),
        "noise_std": _rms([fit.dynamic_noise_std for fit in fits]),
        "static_noise_std": _rms([fit.static_noise_std for fit in fits]),
        "residual_rms": _rms([fit.dynamic_noise_std for fit in fits]),
        "normalised_residual_rms": _rms(
            [fit.static_noise_std / fit.dwell_noise_std for fit in fits if fit.dwell_noise_std > 0.0]
        ),
        "iterations": joints.passes,
        "converged": joints.converged and all(fit.converged for fit in fits),
    }


def _rms(values: Sequence[float]) -> float | None:
    return float(np.sqrt(np.mean(np.square(values)))) if values else None


def _end_point_entry(
    arm: Arm,
    chain: circlepoint.ScrewChain | None,
    joints: circlepoint.JointCalibration,
    whole_arm: circlepoint.WholeArmCalibration | None,
) -> Document | None:
    if chain is None:
        return None
    poses = workspace(arm, joints.reference_configuration)
    std = (
        circlepoint.end_point_std(chain, joints.covariance, poses)
        if whole_arm is None
        else circlepoint.end_point_std(whole_arm, poses)
    )
    return {
        "rms": float(np.sqrt(np.mean(np.square(std)))),
        "max": float(np.max(std)),
        "configurations": len(std),
    }


def workspace(arm: Arm, reference_configuration: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return configurations (P, n) that sample the arm's joint ranges, always the same ones.

    A revolute joint without limits ranges half a turn either way of the reference, a prismatic one 0.1 m.
    """
    driven = arm.driven.joints
    middles = arm.lead(np.asarray(reference_configuration)[None])[0]
    uniform = np.random.default_rng(0).uniform(size=(WORKSPACE_CONFIGURATIONS, len(driven)))
    low, high = np.empty(len(driven)), np.empty(len(driven))
    for index, (joint, middle) in enumerate(zip(driven, middles, strict=True)):
        reach = np.pi if joint.revolute else 0.1
        low[index], high[index] = joint.limits or (middle - reach, middle + reach)
    return np.ascontiguousarray(arm.follow(low + uniform * (high - low)))
