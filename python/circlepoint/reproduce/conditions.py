"""What a trial is made of: the paper's protocols, noise and geometry, each figure with where it comes from."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from circlepoint._core import AccelerometerSpecification
from circlepoint.sensor_presets import load_sensor

SENSOR = "qa700"
SPAN = math.radians(150.0)  # sec. 5
FREQUENCY = 0.5  # Hz, sec. 5
RATE = 500.0  # Hz, sec. 3.1 and 5
POSES = 150  # sec. 4; one degree apart, sec. 5
ENCODER_COUNTS = 400_000.0  # a revolution, sec. 3.2
ENVIRONMENT_STD = 0.5e-3  # m/s^2, static, sec. 4
AVERAGED_STD = 0.1e-3  # m/s^2, after averaging a second, sec. 5
DYNAMIC_STD = 10e-3  # m/s^2, sec. 4
TANGENTIAL, ORTHOGONAL = 0.1, 0.01  # m/s^2, amplitudes of vibration, sec. 4
WORST_ERROR = 5e-3  # m/s^2, p of sec. 4
PERCUSSION_DISTANCE = 0.0182  # m, sec. 3.1
CUTOFF = 10.0  # Hz, sec. 5
HELD_FREQUENCY = 5.0  # Hz. Assumed; the 3 s of settling are the paper's
REPEATS = 10  # sec. 4 and 5
ACQUISITION = ("sensor", "filter", "converter", "encoders")
"""Frequency response, noise by band and resolution of Table 1; the 250 Hz filter; the multiplexed converter with its
bits; encoders read at 1 kHz."""
MARGIN = 0.25  # s. Assumed; a record that starts with the motion cuts the lag of held joints off


@dataclass(frozen=True)
class Conditions:
    """What one joint's static and dynamic test are made under; by default the simulation of the paper's section 4."""

    sensor: AccelerometerSpecification = field(default_factory=lambda: load_sensor(SENSOR))
    poses: int = POSES
    static_noise_std: float = ENVIRONMENT_STD  # m/s^2, of a pose
    dynamic_noise_std: float = DYNAMIC_STD  # m/s^2, white, of a sample
    cable_noise_std: float = 0.0  # m/s^2, white, of a sample, on top
    tangential: float = TANGENTIAL  # m/s^2
    orthogonal: float = ORTHOGONAL  # m/s^2
    vibration_band: tuple[float, float] = (10.0, 60.0)  # Hz. Assumed: the paper does not say
    rate: float = RATE  # Hz
    span: float = SPAN  # rad
    frequency: float = FREQUENCY  # Hz
    periods: int = 1  # of eq. (11). Assumed: the paper does not say
    encoder_counts: float = ENCODER_COUNTS  # 0: exact
    distance: tuple[float, float] = (0.3, 0.7)  # m, sensor from axis. Assumed: the paper says less than 0.4 m, sec. 5
    acquisition: tuple[str, ...] = ()  # parts of sec. 3's chain, of `ACQUISITION`
    held_frequency: float = 0.0  # Hz, of the joints' PD loops; 0: they obey
    margin: float = 0.0  # s at rest, recorded before and after the motion
    bias_change: float = 0.0  # m/s^2, between the static and the dynamic test, in a random direction

    @property
    def duration(self) -> float:
        """Length of the dynamic test, s."""
        return self.periods / self.frequency


def only(sensor: AccelerometerSpecification, *errors: str) -> AccelerometerSpecification:
    """Return a kind of sensor with none of its individual errors but those named, as `scale_std`; d stays nominal."""
    return AccelerometerSpecification(
        percussion_distance=sensor.percussion_distance, **{error: getattr(sensor, error) for error in errors}
    )


LOW_RATE = 100.0  # Hz
CABLE_NOISE_STD = 0.1  # m/s^2, of a sample
SHORT = (0.3, 0.4)  # m, sec. 5: less than 0.4 m
"""The measured case; amounts assumed: the paper names the causes and gives no more than the distance."""


def acquired(conditions: Conditions) -> Conditions:
    """Return the conditions with the acquisition chain of section 3, joints held by PD loops, and rest around."""
    return replace(conditions, acquisition=ACQUISITION, held_frequency=HELD_FREQUENCY, margin=MARGIN)


def as_measured(conditions: Conditions) -> Conditions:
    """Return the conditions with the paper's low sampling rate and the noise its cable picked up."""
    return replace(conditions, rate=LOW_RATE, cable_noise_std=CABLE_NOISE_STD)
