"""The paper's estimators and the best one on one joint's readings; every estimate is the core's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import circlepoint
from circlepoint.reproduce.conditions import CUTOFF, Conditions

if TYPE_CHECKING:
    from collections.abc import Mapping

    from circlepoint.reproduce.one_joint import Array, Joint, Readings

BEST = "regression"
_delay_passes = 2
_settling = 2.5  # cut-off periods at each end: the record starts and ends with a step of acceleration


@dataclass(frozen=True)
class Centre:
    """One way of the paper to the centre of rotation."""

    by: str
    """`position` (method 1) or `velocity` (method 2)."""
    least_squares: bool = True
    """Method 2: least squares in place of the printed means."""
    significant_rate: float = 0.2
    """Method 2: samples slower than this share of the peak rate are left out."""
    corrections: int | None = None
    """Method 1: how often the centre of percussion is corrected for; None: to convergence."""
    cutoff: float = CUTOFF
    """Hz, sec. 5."""
    aligned: bool = False
    """The encoder is shifted by the delay that `reading_delay` finds; the paper does not."""


NOT_ZERO = 0.02
"""Share of the peak rate from which on v "is different from zero" (sec. 2.2). The paper gives no number: at this one
its errors come out (table "Method 2 as printed" of the study)."""
METHODS = {
    "position": Centre("position"),
    "velocity_means": Centre("velocity", least_squares=False, significant_rate=NOT_ZERO),
    "velocity": Centre("velocity"),
}
"""Circle through the path; mean of |v|/|w| as printed; the same by least squares."""
TWO_CORRECTIONS = Centre("position", corrections=2)


class StaticAxis(NamedTuple):
    """A static test's axis and what it says of gravity."""

    direction: Array
    """(3,) unit, in the sense of the joint's rotation."""
    gravity: circlepoint.GravityModel


class JointErrors(NamedTuple):
    """How far one joint's estimates are from the truth."""

    axis: float
    """rad, by the plane fit."""
    axis_best: float
    """rad, by the regression."""
    centre: dict[str, float]
    """m, across the axis, by method."""


def static_axis(readings: Readings) -> StaticAxis:
    """Return the axis by the plane fit on the sphere, and the gravity model of the same poses."""
    fit = circlepoint.fit_axis_direction(readings.force)
    direction = circlepoint.orient_axis(fit.direction, readings.angle, readings.force)
    return StaticAxis(direction, circlepoint.fit_gravity_model(readings.angle, readings.force))


def chart_axis(readings: Readings) -> tuple[Array, bool]:
    """Return the axis in the paper's own parameters (constraint corrected), and whether the iteration arrived."""
    fit = circlepoint.fit_axis_direction_robust(
        readings.force, loss_scale=math.inf, chart=circlepoint.AxisChart.hemisphere
    )
    return circlepoint.orient_axis(fit.direction, readings.angle, readings.force), fit.converged


def centre(method: Centre, readings: Readings, axis: StaticAxis, distance: float) -> circlepoint.CenterOfRotation:
    """Return the centre of rotation by one of the paper's methods; `distance` (m): of the centre of percussion."""
    if method.aligned:
        readings = aligned(readings, reading_delay(readings))
    options = circlepoint.CenterOptions()
    options.percussion_distance = distance
    options.cutoff = method.cutoff
    options.position_window = 0.0
    options.least_squares = method.least_squares
    options.significant_rate = method.significant_rate
    if method.corrections is not None:
        options.max_iterations = method.corrections + 1  # the first estimate is the uncorrected one
    estimate = circlepoint.center_by_position if method.by == "position" else circlepoint.center_by_velocity
    return estimate(readings.theta, readings.moving_force, readings.rate, axis.direction, axis.gravity, options)


def regression(readings: Readings, conditions: Conditions) -> circlepoint.JointModel:
    """Return the joint's model by regression on both tests, readings and regressors through the same filter.

    The delay between readings and encoder is estimated first.
    """
    known = conditions.sensor
    readings = aligned(readings, reading_delay(readings))
    still = np.zeros_like(readings.angle)
    total = circlepoint.RegressionStatistics()
    rests = circlepoint.joint_regressors(readings.angle, still, still)
    total.add(rests, readings.force, 1.0 / _variance(rests, readings.force))
    regressors, filtered = _moving_rows(readings)
    correlated = readings.rate / (2.0 * CUTOFF)  # samples a filtered white residual stays correlated over
    total.add(regressors, filtered, 1.0 / (_variance(regressors, filtered) * correlated))
    prior = circlepoint.JointModelPrior()
    prior.bias_std = max(2.0 * known.bias_std, 1e-6)
    prior.percussion_distance = known.percussion_distance
    prior.percussion_distance_std = known.percussion_distance_std
    return circlepoint.fit_joint_model(total, prior).model


def reading_delay(readings: Readings) -> float:
    """Return how far, s, the readings lag behind the encoder: what the model's own slope explains of its residual."""
    delay = 0.0
    for _ in range(_delay_passes):
        regressors, filtered = _moving_rows(aligned(readings, delay))
        predicted = _explained(regressors, filtered)
        slope = circlepoint.gradient(predicted, 1.0 / readings.rate)
        free = slope - _explained(regressors, slope)
        delay -= float(np.sum(free * (filtered - predicted)) / np.sum(free**2))
    return delay


def aligned(readings: Readings, delay: float) -> Readings:
    """Return the readings with the encoder as it was `delay` (s) earlier, when the sensor felt what was read."""
    speed = circlepoint.savgol_filter(_smooth(readings), 7, 6, deriv=1, delta=1.0 / readings.rate)
    return readings._replace(theta=readings.theta - delay * speed)


def evaluate(
    joint: Joint, readings: Readings, conditions: Conditions, methods: Mapping[str, Centre] = METHODS
) -> JointErrors:
    """Return the errors of the paper's methods and of the regression on one joint's readings."""
    axis = static_axis(readings)
    best = regression(readings, conditions)
    distance = conditions.sensor.percussion_distance
    errors = {
        name: float(np.linalg.norm(centre(method, readings, axis, distance).lever_sensor - joint.lever))
        for name, method in methods.items()
    }
    errors[BEST] = float(np.linalg.norm(best.lever - joint.lever))
    return JointErrors(angle_between(axis.direction, joint.axis), angle_between(best.axis, joint.axis), errors)


def angle_between(first: Array, second: Array) -> float:
    """Return the angle between two directions, rad; exact for small angles."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), np.dot(first, second)))


def _variance(regressors: Array, readings: Array) -> float:
    return max(float(np.mean((readings - _explained(regressors, readings)) ** 2)), 1e-18)


def _explained(regressors: Array, readings: Array) -> Array:
    return np.ascontiguousarray(regressors @ np.linalg.lstsq(regressors, readings, rcond=None)[0])


def _smooth(readings: Readings) -> Array:
    cutoff = min(3.0 * CUTOFF, 0.4 * readings.rate)
    return circlepoint.sosfiltfilt(circlepoint.butter(4, cutoff, readings.rate), readings.theta)


def _moving_rows(readings: Readings) -> tuple[Array, Array]:
    """Return the regressors (M, 5) and readings (M, 3) of the motion, low-passed, without the filter's ends."""
    low_pass = circlepoint.butter(4, CUTOFF, readings.rate)
    smooth = _smooth(readings)
    speed = circlepoint.savgol_filter(smooth, 7, 6, deriv=1, delta=1.0 / readings.rate)
    acceleration = circlepoint.savgol_filter(smooth, 7, 6, deriv=2, delta=1.0 / readings.rate)
    moving = circlepoint.joint_regressors(readings.theta, speed, acceleration)
    inner = slice(edge := int(_settling * readings.rate / CUTOFF), -edge)
    return (
        np.ascontiguousarray(circlepoint.sosfiltfilt(low_pass, moving)[inner]),
        np.ascontiguousarray(circlepoint.sosfiltfilt(low_pass, readings.moving_force)[inner]),
    )
