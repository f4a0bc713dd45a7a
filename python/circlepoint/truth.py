"""Ground truth of simulated recordings: written beside them, and compared with what was estimated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.result_document import workspace

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from circlepoint.arm import Arm
    from circlepoint.document import Document


def truth_document(
    arm: Arm,
    chain: circlepoint.ScrewChain,
    gravity_sensor: list[float],
    sensor: circlepoint.AccelerometerModel,
    seed: int,
    *,
    sheet: circlepoint.AccelerometerModel | None = None,
) -> Document:
    """Return what is true of a simulated recording, under the names of ``calibration.json``; SI units.

    Parameters
    ----------
    arm : Arm
        The arm.
    chain : ScrewChain
        Its axes in the sensor frame at the reference configuration.
    gravity_sensor : list of float
        m/s^2, what an ideal sensor reads at rest there.
    sensor : AccelerometerModel
        The individual sensor, as its readings are recorded.
    seed : int
        What it was drawn with.
    sheet : AccelerometerModel, optional
        Its calibration sheet, where it has one.
    """
    extra: Document = {} if sheet is None else {"sheet": {"bias": sheet.bias.tolist(), "scale": sheet.scale.tolist()}}
    for name, model in (("sensor", sensor), ("sheet", sheet)):
        if model is not None and (model.temperature.bias.any() or model.temperature.scale.any()):
            extra[f"{name}_temperature"] = {
                "reference": model.temperature.reference,
                "bias": model.temperature.bias.tolist(),
                "scale": model.temperature.scale.tolist(),
            }
    return {
        "schema": "circlepoint/truth/1",
        "arm": arm.name,
        "seed": seed,
        "reference_configuration": chain.reference_configuration.tolist(),
        "joints": _joint_entries(arm.joint_names, chain),
        "gravity_sensor": gravity_sensor,
        "sensor": {
            name: getattr(sensor, name).tolist()
            for name in ("bias", "scale", "misalignment", "percussion_distance", "second_order")
        },
        **extra,
    }


def truth_chain(truth: Document) -> circlepoint.ScrewChain:
    """Return the true chain of a truth document (revolute and prismatic joints)."""
    axes = []
    for joint in truth["joints"]:
        prismatic = joint.get("type", "revolute") == "prismatic"
        point = joint["point_sensor"] or [0.0, 0.0, 0.0]
        line = circlepoint.make_line(np.array(joint["direction_sensor"]), np.array(point))
        kind = circlepoint.JointType.prismatic if prismatic else circlepoint.JointType.revolute
        axes.append(circlepoint.ScrewAxis(type=kind, line=line))
    return circlepoint.ScrewChain(axes, np.array(truth["reference_configuration"]))


def truth_at(truth: Document, reference_configuration: ArrayLike) -> Document:
    """Return the same truth described at another reference configuration (n,), rad or m."""
    chain = truth_chain(truth)
    reference = np.asarray(reference_configuration, dtype=float)
    rebased = circlepoint.rebase(chain, reference)
    up = circlepoint.forward_kinematics(chain, reference)[:3, :3].T @ np.array(truth["gravity_sensor"])
    names = [joint["name"] for joint in truth["joints"]]
    return {
        **truth,
        "reference_configuration": reference.tolist(),
        "joints": _joint_entries(names, rebased),
        "gravity_sensor": up.tolist(),
    }


def end_point_error(truth: Document, estimate: circlepoint.ScrewChain, arm: Arm) -> float:
    """Return the root mean square distance, m, between estimated and true sensor position over the workspace.

    Both are seen from the sensor's frame at the estimate's reference configuration.
    """
    configurations = workspace(arm, estimate.reference_configuration)
    return circlepoint.end_point_error(estimate, truth_chain(truth), configurations)


def _joint_entries(names: tuple[str, ...] | list[str], chain: circlepoint.ScrewChain) -> list[Document]:
    return [
        {
            "name": name,
            "type": axis.type.name,
            "direction_sensor": axis.line.direction.tolist(),
            "point_sensor": axis.line.point.tolist() if axis.type.name == "revolute" else None,
        }
        for name, axis in zip(names, chain.axes, strict=True)
    ]
