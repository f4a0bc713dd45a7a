"""The whole arm: every joint tested from its end stop, the lines put together, the end-point against the truth."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import circlepoint
from circlepoint.arm import Arm, load_arm
from circlepoint.demo import built_arm
from circlepoint.reproduce.estimates import BEST, METHODS, Centre, angle_between, centre, regression, static_axis
from circlepoint.reproduce.one_joint import Array, Joint, Readings, random_unit, run_tests
from circlepoint.result_document import workspace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from circlepoint.reproduce.conditions import Conditions

ARM_FILE = Path(__file__).parent.parent / "arms" / "sarcos.yaml"
HANDLE = (
    0.25,
    0.433,
    0.0,
)  # m, sec. 3.1: 0.5 m long; across the last joint's axis, no joint nearer than 0.46 m (assumed)
STOP = -math.radians(75.0)  # rad, where every joint has its end stop (assumed): 150 degrees are spanned from there
_least_tilt = 0.5  # sine of the angle between every axis and gravity


class ArmErrors(NamedTuple):
    """How far one arm's calibration is from the truth."""

    axis: Array
    """(n,) rad, by the plane fit."""
    axis_best: Array
    """(n,) rad."""
    centre: dict[str, Array]
    """(n,) m, by method."""
    end_point: dict[str, float]
    """m, rms over the workspace, by method."""
    first_angle: tuple[float, float]
    """rad, error of the angle between the first two axes: by the plane fit, by the best method."""


@functools.cache
def sarcos() -> Arm:
    """Return the arm's description."""
    return load_arm(ARM_FILE)


def draw_arm(seed: int) -> tuple[circlepoint.ScrewChain, Array]:
    """Return an arm built a little off its drawing, on a base of random tilt, at its end stops; and up in the sensor.

    Every axis is at least 30 degrees off gravity: the plane fit sees nothing of one that is parallel to it.
    """
    stops = np.full(len(sarcos().joints), STOP)
    chain = built_arm(sarcos(), stops, seed, HANDLE)
    random = np.random.default_rng(circlepoint.derive_seed(seed, 0))
    up = random_unit(random)
    while min(np.linalg.norm(np.cross(axis.line.direction, up)) for axis in chain.axes) < _least_tilt:
        up = random_unit(random)
    return chain, circlepoint.STANDARD_GRAVITY * up


def joints_of(chain: circlepoint.ScrewChain, up: Array, sensor: circlepoint.AccelerometerModel) -> list[Joint]:
    """Return each joint as its sensor sees it at the end stops."""
    return [Joint(axis.line.direction, -axis.line.point, up, sensor) for axis in chain.axes]


def arm_trial(conditions: Conditions, seed: int, methods: Mapping[str, Centre] = METHODS) -> ArmErrors:
    """Return the errors of one arm: its joints tested one by one, by every method."""
    chain, up = draw_arm(seed)
    sensor = circlepoint.draw_accelerometer(conditions.sensor, circlepoint.derive_seed(seed, 1))
    joints = joints_of(chain, up, sensor)
    readings = [
        run_tests(joint, conditions, circlepoint.derive_seed(seed, 100 + index)) for index, joint in enumerate(joints)
    ]
    axes = [static_axis(each) for each in readings]
    best = [regression(each, conditions) for each in corrected(readings, conditions)]
    distance = conditions.sensor.percussion_distance
    levers = {
        name: [centre(method, r, a, distance).lever_sensor for r, a in zip(readings, axes, strict=True)]
        for name, method in methods.items()
    }
    directions = {name: [axis.direction for axis in axes] for name in methods}
    levers[BEST] = [model.lever for model in best]
    directions[BEST] = [model.axis for model in best]
    plane = [axis.direction for axis in axes]
    true_angle = angle_between(joints[0].axis, joints[1].axis)
    return ArmErrors(
        axis=_angles(plane, joints),
        axis_best=_angles(directions[BEST], joints),
        centre={
            name: np.array([np.linalg.norm(b - j.lever) for b, j in zip(levers[name], joints, strict=True)])
            for name in levers
        },
        end_point={name: end_point_error(directions[name], levers[name], chain) for name in levers},
        first_angle=(
            angle_between(plane[0], plane[1]) - true_angle,
            angle_between(directions[BEST][0], directions[BEST][1]) - true_angle,
        ),
    )


def corrected(readings: list[Readings], conditions: Conditions) -> list[Readings]:
    """Return the readings corrected by what the magnitude of gravity over all dwells says of the sensor."""
    poses = np.ascontiguousarray(np.concatenate([each.force for each in readings]))
    sensor = circlepoint.fit_sensor_from_gravity(poses, conditions.sensor).sensor
    return [
        each._replace(
            force=circlepoint.correct(sensor, each.force, np.zeros_like(each.force)),
            moving_force=circlepoint.correct(sensor, each.moving_force, np.zeros_like(each.moving_force)),
        )
        for each in readings
    ]


def end_point_error(directions: list[Array], levers: list[Array], truth: circlepoint.ScrewChain) -> float:
    """Return the rms distance, m, between estimated and true sensor position over the workspace."""
    axes = [
        circlepoint.ScrewAxis(type=circlepoint.JointType.revolute, line=circlepoint.make_line(direction, -lever))
        for direction, lever in zip(directions, levers, strict=True)
    ]
    estimate = circlepoint.ScrewChain(axes, truth.reference_configuration)
    configurations = workspace(sarcos(), truth.reference_configuration - STOP)
    difference = (
        circlepoint.forward_kinematics(estimate, configurations) - circlepoint.forward_kinematics(truth, configurations)
    )[:, :3, 3]
    return float(np.sqrt(np.mean(np.sum(difference**2, axis=1))))


def _angles(directions: list[Array], joints: list[Joint]) -> Array:
    return np.array([angle_between(z, joint.axis) for z, joint in zip(directions, joints, strict=True)])
