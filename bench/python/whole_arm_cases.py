"""Kinds of arms and recordings over which the whole-arm estimate is measured, and the truth they are made of.

One continuous log a seed: of each joint 16 rests over 150 degrees and eq. (11), 0.5 Hz for 4 s; or 60 s of all joints
at once; at the paper's 500 Hz. Sensors are drawn from their data sheets. The arm is the demonstration's, built a little
off its drawing, where a case says no other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.demo import ARM_FILE, HANDLE, built_arm
from circlepoint.sensor_presets import load_sensor

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

SENSOR_GROUPS = ("bias", "scale", "misalignment", "percussion_distance", "second_order")
SPAN = np.radians(150.0)
TRAVEL = 0.3  # m, of a sliding joint
REST = -1.2  # rad, where every joint begins
UP = cp.STANDARD_GRAVITY * np.array([0.36, 0.48, 0.80])
# a, alpha, d: m and rad, as Universal Robots publishes them (DH parameters for calculations of kinematics and dynamics)
UR5 = (
    (0.0, np.pi / 2, 0.089159),
    (-0.425, 0.0, 0.0),
    (-0.39225, 0.0, 0.0),
    (0.0, np.pi / 2, 0.10915),
    (0.0, -np.pi / 2, 0.09465),
    (0.0, 0.0, 0.0823),
)


@cache
def demonstration_arm() -> cp.ScrewChain:
    """Return seven joints, built a little off the drawing."""
    return built_arm(load_arm(ARM_FILE), np.full(7, REST), 1)


@cache
def three_parallel_axes() -> cp.ScrewChain:
    """Return a UR5 as drawn: the axes of shoulder, elbow and first wrist joint exactly parallel."""
    rows = [cp.DhRow(a, alpha, d, 0.0) for a, alpha, d in UR5]
    tool = np.eye(4)
    tool[:3, 3] = HANDLE
    chain = cp.StandardDhChain(rows, [cp.JointType.revolute] * len(rows), tool=tool)
    return cp.to_screws(chain, np.full(len(rows), REST), cp.BaseFrame.sensor_at_reference)


@cache
def sliding_joint() -> cp.ScrewChain:
    """Return the demonstration's arm with a fourth joint that slides."""
    chain = demonstration_arm()
    axes, reference = list(chain.axes), np.array(chain.reference_configuration)
    axes[3] = cp.ScrewAxis(cp.JointType.prismatic, axes[3].line)
    reference[3] = 0.0
    return cp.ScrewChain(axes, reference)


@dataclass(frozen=True)
class Case:
    """One kind of recording."""

    name: str
    sensor: str = "qa700"
    noise: float = 0.01  # m/s^2 per sample
    vibration: float = 0.0  # m/s^2, tangential
    counts: float = 400_000.0  # a revolution; 0: exact
    free: bool = False  # all joints at once
    compliance: float = 0.0  # rad per m^2/s^2
    arm: Callable[[], cp.ScrewChain] = demonstration_arm
    upright: bool = False  # the base joint exactly along gravity
    late: float = 0.0  # s, sensor behind the encoders: whole samples
    scale: float = 0.0  # standard deviation of the sensor's scale errors, where the data sheet's do not hold
    bounded: bool = False  # compared with the Cramer-Rao bound: white noise, exact encoders


CASES = (
    Case("tests, white noise, exact encoders", counts=0.0, bounded=True),
    Case("tests, 400,000 counts, joints yield", compliance=1e-4),
    Case("tests, vibration", vibration=0.1),
    Case("tests, 4,096 counts", counts=4096.0),
    Case("tests, 1,024 counts", counts=1024.0),
    Case("tests, MEMS", sensor="mems", noise=0.02),
    Case("all joints at once", free=True, counts=0.0, bounded=True),
    Case("all at once, vibration", free=True, vibration=0.1),
    Case("all at once, 4,096 counts", free=True, counts=4096.0),
    Case("base joint exactly vertical", upright=True),
    Case("UR5, three parallel axes", arm=three_parallel_axes),
    Case("sensor 2 ms late", counts=0.0, late=0.002),
    Case("scale errors of 3 %", scale=0.03),
    Case("a sliding joint", arm=sliding_joint),
)


@dataclass(frozen=True)
class Truth:
    """What a recording is made of."""

    chain: cp.ScrewChain
    up: NDArray[np.float64]
    sensor: cp.AccelerometerModel


def truth(case: Case, seed: int) -> Truth:
    """Return one arm for all seeds, and a sensor for each."""
    chain = case.arm()
    up = cp.STANDARD_GRAVITY * np.array(chain.axes[0].line.direction) if case.upright else UP
    sensor = cp.draw_accelerometer(load_sensor(case.sensor), seed)
    if case.scale > 0.0:
        fields = {field: np.array(getattr(sensor, field)) for field in SENSOR_GROUPS}
        fields["scale"] = np.random.default_rng(seed).normal(0.0, case.scale, 3)
        sensor = cp.AccelerometerModel(**fields)
    return Truth(chain, up, sensor)


def poses(chain: cp.ScrewChain) -> NDArray[np.float64]:
    """Return 200 configurations over which the end-point is compared."""
    reach = np.array([np.pi if axis.type == cp.JointType.revolute else TRAVEL for axis in chain.axes])
    random = np.random.default_rng(0)
    return chain.reference_configuration + random.uniform(-1.0, 1.0, (200, len(reach))) * reach


def motion(case: Case, seed: int) -> cp.JointTrajectory:
    """Return eq. (11) and rests of each joint, or all joints at once; within its count every seed starts elsewhere."""
    chain = case.arm()
    start = np.array(chain.reference_configuration)
    if case.counts:
        start += np.random.default_rng(seed).uniform(0.0, max(2e-3, 2 * np.pi / case.counts), len(start))
    if case.free:
        pieces = [cp.MultiJointMotion(duration=60.0, amplitude=np.full(len(start), 1.2), seed=7)]
    else:
        pieces = []
        for joint, axis in enumerate(chain.axes):
            span = SPAN if axis.type == cp.JointType.revolute else TRAVEL
            pieces.append(cp.SteppedSweep(joint=joint, steps=16, span=span, dwell=0.8, move=0.6))
            pieces.append(cp.RaisedCosine(joint=joint, span=span, frequency=0.5, duration=4.0))
    return cp.joint_trajectory(start, pieces, 500.0, 0.6)


def simulated(case: Case, made_of: Truth, trajectory: cp.JointTrajectory, seed: int) -> cp.Recording:
    """Return the recording."""
    joints = made_of.chain.size()
    options = cp.SimulationOptions(
        noise_std=case.noise,
        encoder_counts_per_revolution=np.full(joints, case.counts),
        compliance=np.full(joints, case.compliance),
        vibration=cp.VibrationOptions(
            tangential_amplitude=case.vibration, orthogonal_amplitude=0.1 * case.vibration, frequency_max=60.0
        ),
        seed=seed,
    )
    recording = cp.simulate(made_of.chain, made_of.up, made_of.sensor, trajectory, options)
    if case.late == 0.0:
        return recording
    late = round(case.late * trajectory.sample_rate)
    return cp.make_recording(recording.time[:-late], recording.joint_positions[late:], recording.specific_force[:-late])
