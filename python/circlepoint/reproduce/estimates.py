"""The paper's estimators and the best one on one joint's readings; every estimate is the core's."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

import circlepoint
from circlepoint.reproduce.conditions import Conditions
from circlepoint.reproduce.one_joint import Array, Joint, Readings

METHODS = ("position", "velocity_means", "velocity", "regression")
"""Circle through the path; |v|/|w| as printed; the same by least squares; the joint regression."""
_settling = 2.5  # cut-off periods at each end: the record starts and ends with a step of acceleration


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


def centre(
    method: str, readings: Readings, axis: StaticAxis, conditions: Conditions, max_iterations: int = 20
) -> circlepoint.CenterOfRotation:
    """Return the centre of rotation by one of the paper's methods: `position`, `velocity_means` or `velocity`."""
    options = circlepoint.CenterOptions()
    options.percussion_distance = conditions.sensor.percussion_distance
    options.cutoff = conditions.cutoff
    options.position_window = 0.0
    options.least_squares = method != "velocity_means"
    options.max_iterations = max_iterations
    estimate = circlepoint.center_by_position if method == "position" else circlepoint.center_by_velocity
    return estimate(readings.theta, readings.moving_force, readings.rate, axis.direction, axis.gravity, options)


def regression(readings: Readings, conditions: Conditions) -> circlepoint.JointModel:
    """Return the joint's model by regression on both tests, readings and regressors through the same filter."""
    known = conditions.sensor
    low_pass = circlepoint.butter(4, conditions.cutoff, readings.rate)
    smooth = circlepoint.sosfiltfilt(
        circlepoint.butter(4, min(3.0 * conditions.cutoff, 0.4 * readings.rate), readings.rate), readings.theta
    )
    speed = circlepoint.savgol_filter(smooth, 7, 6, deriv=1, delta=1 / readings.rate)
    acceleration = circlepoint.savgol_filter(smooth, 7, 6, deriv=2, delta=1 / readings.rate)
    still = np.zeros_like(readings.angle)
    total = circlepoint.RegressionStatistics()
    rests = circlepoint.joint_regressors(readings.angle, still, still)
    total.add(rests, readings.force, 1.0 / _variance(rests, readings.force))
    moving = circlepoint.joint_regressors(readings.theta, speed, acceleration)
    regressors = circlepoint.sosfiltfilt(low_pass, moving)
    filtered = circlepoint.sosfiltfilt(low_pass, readings.moving_force)
    edge = int(_settling * readings.rate / conditions.cutoff)
    regressors = np.ascontiguousarray(regressors[edge:-edge])
    filtered = np.ascontiguousarray(filtered[edge:-edge])
    correlated = readings.rate / (2.0 * conditions.cutoff)  # samples a filtered white residual stays correlated over
    total.add(regressors, filtered, 1.0 / (_variance(regressors, filtered) * correlated))
    prior = circlepoint.JointModelPrior()
    prior.bias_std = max(2.0 * known.bias_std, 1e-6)
    prior.percussion_distance = known.percussion_distance
    prior.percussion_distance_std = known.percussion_distance_std
    return circlepoint.fit_joint_model(total, prior).model


def evaluate(joint: Joint, readings: Readings, conditions: Conditions) -> JointErrors:
    """Return the errors of every method on one joint's readings."""
    axis = static_axis(readings)
    best = regression(readings, conditions)
    errors = {
        method: float(np.linalg.norm(centre(method, readings, axis, conditions).lever_sensor - joint.lever))
        for method in METHODS[:-1]
    }
    errors["regression"] = float(np.linalg.norm(best.lever - joint.lever))
    return JointErrors(angle_between(axis.direction, joint.axis), angle_between(best.axis, joint.axis), errors)


def angle_between(first: Array, second: Array) -> float:
    """Return the angle between two directions, rad; exact for small angles."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), np.dot(first, second)))


def _variance(regressors: Array, readings: Array) -> float:
    coefficients = np.linalg.lstsq(regressors, readings, rcond=None)[0]
    return max(float(np.mean((readings - regressors @ coefficients) ** 2)), 1e-18)
