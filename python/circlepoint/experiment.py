"""From an arm's description, a plan and a kind of sensor to a simulated experiment, as often repeated as one likes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.acquisition import Acquisition
from circlepoint.coupling import following
from circlepoint.nominal import nominal_chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.arm import Arm
    from circlepoint.protocol import Plan

UPRIGHT = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Setting:
    """How an arm stands, how it is built, and where the sensor sits on it.

    Attributes
    ----------
    up : tuple of float
        Direction of up in the arm's base frame; its length does not matter.
    tool : (4, 4) ndarray
        The sensor's pose in the arm's last frame.
    direction_std, point_std : float
        rad and m, of a built arm's lines about the drawn ones, in each of their local coordinates.
    compliance : float
        rad per m^2/s^2, by which each joint gives way to the weight of a unit mass at the sensor.
    gravity : float
        m/s^2.
    """

    up: tuple[float, float, float] = UPRIGHT
    tool: NDArray[np.float64] = field(default_factory=lambda: np.eye(4))
    direction_std: float = 0.0
    point_std: float = 0.0
    compliance: float = 0.0
    gravity: float = circlepoint.STANDARD_GRAVITY


@dataclass(frozen=True)
class Noise:
    """What disturbs the readings.

    Attributes
    ----------
    white : float or None
        m/s^2 per sample; None: what the sensor has itself, and with an acquisition its surroundings.
    vibration : VibrationOptions
    """

    white: float | None = None
    vibration: circlepoint.VibrationOptions = field(default_factory=circlepoint.VibrationOptions)


def with_encoders(arm: Arm, counts: float) -> Arm:
    """Return the arm with so many counts a revolution (a metre of a prismatic joint) of every joint; 0: exact."""
    return replace(arm, encoder_counts=(counts,) * len(arm.joints) if counts else None)


def make_experiment(
    arm: Arm,
    plan: Plan,
    sensor: circlepoint.AccelerometerSpecification,
    *,
    setting: Setting | None = None,
    noise: Noise | None = None,
    spread_starts: bool = False,
    trajectory: circlepoint.JointTrajectory | None = None,
) -> circlepoint.Experiment:
    """Return the experiment of running a plan on an arm with a sensor of a kind.

    Parameters
    ----------
    arm : Arm
        With nominal rows or lines.
    plan : Plan
        Of the joints that are driven; those that mimic others follow.
    sensor : AccelerometerSpecification
    setting : Setting, optional
        Default: upright, as drawn, the sensor at the last frame.
    noise : Noise, optional
        Default: the sensor's own.
    spread_starts : bool
        Start each joint anywhere within one count of its encoder.
    trajectory : JointTrajectory, optional
        The plan's, where it is at hand.

    Raises
    ------
    InvalidInput
        When the arm has no nominal parameters.
    """
    setting, noise = setting or Setting(), noise or Noise()
    rest = arm.follow(plan.rest[None])[0]
    nominal = nominal_chain(arm, rest)
    carried = circlepoint.ScrewChain(nominal.axes, rest, circlepoint.forward_kinematics(nominal, rest) @ setting.tool)
    up = np.array(setting.up)
    up *= setting.gravity / np.linalg.norm(up)
    counts = np.array([counts or 0.0 for counts in arm.encoder_counts or ()])
    compliance = np.full(len(arm.joints), setting.compliance) if setting.compliance else None
    acquisition = plan.acquisition or Acquisition()
    own_noise = sensor.noise_std if plan.acquisition is None else acquisition.noise_std(sensor)
    # Joints that mimic others start where those put them.
    steps = [0.0 if arm.joints[i].mimic else arm.encoder_step(i) or 0.0 for i in range(len(arm.joints))]
    return circlepoint.Experiment(
        chain=circlepoint.rebase(carried, rest),
        up_gravity_sensor=np.asarray(carried.home)[:3, :3].T @ up,
        sensor=sensor,
        trajectory=following(arm, plan.trajectory() if trajectory is None else trajectory),
        simulation=circlepoint.SimulationOptions(
            noise_std=own_noise if noise.white is None else noise.white,
            range=sensor.range,
            encoder_counts_per_revolution=counts,
            compliance=acquisition.compliance if compliance is None else compliance,
            vibration=noise.vibration,
            held_joints=acquisition.held_joints,
            temperature=acquisition.temperature,
            angular_velocity_noise_std=acquisition.gyroscope_noise,
            acquisition=None if plan.acquisition is None else acquisition.options(sensor),
        ),
        corrected=acquisition.corrected,
        direction_std=setting.direction_std,
        point_std=setting.point_std,
        start_spread=np.array(steps) if spread_starts else np.zeros(0),
    )


def vibration(tangential: float, orthogonal: float | None = None, **band: float) -> circlepoint.VibrationOptions:
    """Return vibration of an amplitude along the motion and a tenth of it across, as the paper's; m/s^2, Hz."""
    across = 0.1 * tangential if orthogonal is None else orthogonal
    if not all(math.isfinite(amplitude) for amplitude in (tangential, across)):
        raise circlepoint.InvalidInput(f"vibration of {tangential} and {across} m/s^2 is not finite")
    return circlepoint.VibrationOptions(tangential_amplitude=tangential, orthogonal_amplitude=across, **band)
