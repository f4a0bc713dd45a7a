"""One joint with its static and its dynamic test, simulated: what every statistic of the study is made of."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

import circlepoint

if TYPE_CHECKING:
    from circlepoint.reproduce.conditions import Conditions

Array = NDArray[np.float64]
_least_tilt = 0.5  # sine of the angle between axis and gravity: a plane fit needs the axis well off it
_simulated_rate = 500.0  # Hz; slower converters drop samples of this, so that what they alias is there to alias


class Joint(NamedTuple):
    """The truth: a joint seen from its sensor at angle zero."""

    axis: Array
    """(3,) unit, sensor frame."""
    lever: Array
    """(3,) m, from the axis to the sensor, orthogonal to it."""
    up_sensor: Array
    """(3,) m/s^2."""
    sensor: circlepoint.AccelerometerModel

    def chain(self) -> circlepoint.ScrewChain:
        """Return the joint as a chain of one, zero at the reference configuration."""
        line = circlepoint.make_line(self.axis, -self.lever)
        screw = circlepoint.ScrewAxis(type=circlepoint.JointType.revolute, line=line)
        return circlepoint.ScrewChain([screw], np.zeros(1))


class Readings(NamedTuple):
    """What was recorded of a joint: the means of the dwells, and the motion."""

    angle: Array
    """(N,) rad."""
    force: Array
    """(N, 3) m/s^2."""
    theta: Array
    """(M,) rad."""
    moving_force: Array
    """(M, 3) m/s^2."""
    rate: float
    """Hz, of the motion."""


def random_unit(random: np.random.Generator) -> Array:
    """Return a direction uniform on the sphere, (3,)."""
    vector = random.normal(size=3)
    return vector / float(np.linalg.norm(vector))


def draw_joint(conditions: Conditions, seed: int) -> Joint:
    """Return a joint of random direction and distance, and a sensor of the kind asked for."""
    random = np.random.default_rng(seed)
    axis = random_unit(random)
    up = random_unit(random)
    while np.linalg.norm(np.cross(axis, up)) < _least_tilt:
        up = random_unit(random)
    lever = np.cross(axis, random_unit(random))
    lever *= random.uniform(*conditions.distance) / np.linalg.norm(lever)
    sensor = circlepoint.draw_accelerometer(conditions.sensor, circlepoint.derive_seed(seed, 2))
    return Joint(axis, lever, circlepoint.STANDARD_GRAVITY * up, sensor)


def static_test(joint: Joint, conditions: Conditions, seed: int) -> tuple[Array, Array]:
    """Return the angles (N,) and mean readings (N, 3) of the dwells."""
    poses = circlepoint.static_poses(np.linspace(0.0, conditions.span, conditions.poses)[:, None])
    options = circlepoint.SimulationOptions(
        noise_std=conditions.static_noise_std,
        encoder_counts_per_revolution=np.array([conditions.encoder_counts]),
        seed=circlepoint.derive_seed(seed, 0),
    )
    log = circlepoint.simulate(joint.chain(), joint.up_sensor, joint.sensor, poses, options)
    return np.ascontiguousarray(log.joint_positions[:, 0]), log.specific_force


def dynamic_test(joint: Joint, conditions: Conditions, seed: int) -> tuple[Array, Array]:
    """Return the encoder (M,) and the readings (M, 3) of eq. (11)."""
    thinning = max(1, math.ceil(_simulated_rate / conditions.rate))
    rate = conditions.rate * thinning
    chain = _acquisition(conditions) if conditions.acquisition else None
    analogue = rate * (chain.oversampling if chain else 1)
    motion = circlepoint.joint_trajectory(np.zeros(1), [raised_cosine(conditions)], analogue, conditions.margin)
    options = circlepoint.SimulationOptions(
        noise_std=math.hypot(conditions.dynamic_noise_std, conditions.cable_noise_std),
        encoder_counts_per_revolution=np.array([conditions.encoder_counts]),
        vibration=circlepoint.VibrationOptions(
            tangential_amplitude=conditions.tangential,
            orthogonal_amplitude=conditions.orthogonal,
            frequency_min=conditions.vibration_band[0],
            frequency_max=conditions.vibration_band[1],
        ),
        held_joints=circlepoint.HeldJoints(natural_frequency=np.array([conditions.held_frequency])),
        acquisition=chain,
        seed=circlepoint.derive_seed(seed, 1),
    )
    log = circlepoint.simulate(joint.chain(), joint.up_sensor, joint.sensor, motion, options)
    force = log.specific_force
    if conditions.bias_change > 0.0:
        change = random_unit(np.random.default_rng(circlepoint.derive_seed(seed, 3)))
        force = force + conditions.bias_change * change
    moving = slice(0, -1, thinning)  # the last instant is the first of rest
    return np.ascontiguousarray(log.joint_positions[moving, 0]), np.ascontiguousarray(force[moving])


def _acquisition(conditions: Conditions) -> circlepoint.AcquisitionOptions:
    """Return the parts asked for of section 3's chain behind this sensor; its readings are corrected already."""
    whole = circlepoint.paper_acquisition()
    chain = circlepoint.AcquisitionOptions(oversampling=whole.oversampling)
    if "sensor" in conditions.acquisition:
        chain.noise_bands = conditions.sensor.noise_bands
        chain.response_bands = conditions.sensor.response_bands
        chain.resolution = conditions.sensor.resolution
    if "filter" in conditions.acquisition:
        chain.signal_cutoff, chain.filter_order = whole.signal_cutoff, whole.filter_order
    if "converter" in conditions.acquisition:
        chain.channel_skew = whole.channel_skew
        chain.converter_bits = whole.converter_bits
        chain.converter_range, chain.converter_gain = whole.converter_range, whole.converter_gain
    if "encoders" in conditions.acquisition:
        chain.encoder_rate = whole.encoder_rate
    return chain


def raised_cosine(conditions: Conditions, joint: int = 0) -> circlepoint.RaisedCosine:
    """Return the dynamic test's motion, eq. (11)."""
    return circlepoint.RaisedCosine(
        joint=joint, span=conditions.span, frequency=conditions.frequency, duration=conditions.duration
    )


def run_tests(joint: Joint, conditions: Conditions, seed: int) -> Readings:
    """Return both tests of a joint."""
    return Readings(*static_test(joint, conditions, seed), *dynamic_test(joint, conditions, seed), conditions.rate)


def without_errors(conditions: Conditions) -> Conditions:
    """Return the same tests without noise, vibration and quantisation."""
    return replace(
        conditions,
        static_noise_std=0.0,
        dynamic_noise_std=0.0,
        cable_noise_std=0.0,
        tangential=0.0,
        orthogonal=0.0,
        encoder_counts=0.0,
        bias_change=0.0,
    )
