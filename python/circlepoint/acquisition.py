"""The ``acquisition`` section of a plan: what lies between the simulated sensor and the log.

::

    acquisition:                       # what is left out is the paper's chain; `acquisition: {}` is all of it
      oversampling: 8                  # analogue instants a sample
      signal_cutoff_hz: 250            # conditioning filters, Butterworth; 0: none
      temperature_cutoff_hz: 1
      filter_order: 2
      channel_skew_us: 25              # between the converter's channels x, y, z, temperature
      converter: {bits: 16, range: 300, gain: 8}     # bits 0: no quantisation; range in m/s^2 at gain 1
      encoder_rate_hz: 1000            # 0: read at every sample
      cable: {noise: 0.01, pickup: 0.02, pickup_hz: 60}           # m/s^2; absent: none
      surroundings: 0.0005             # m/s^2 of white noise per sample; absent: none
      temperature: {start: 22, rise: 8, time_constant: 900, sensor_offset: 0, sensor_noise: 0.02}  # absent: reference
      joints: {natural_frequency_hz: 4, settling_time: 3, stiffness: 20000, mass: 1.42}      # absent: they obey
      gyroscope: {noise: 0.001}        # rad/s; absent: there is none
      corrected: true                  # by the sensor's calibration sheet

Noise by band, frequency response, range and resolution are the sensor's own (`--sensor`), and the simulated individual
has the errors its calibration sheet corrects.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.yaml_io import describe

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from circlepoint.yaml_io import Fields

_SECTION = (
    "oversampling",
    "signal_cutoff_hz",
    "temperature_cutoff_hz",
    "filter_order",
    "channel_skew_us",
    "converter",
    "encoder_rate_hz",
    "cable",
    "surroundings",
    "temperature",
    "joints",
    "gyroscope",
    "corrected",
)
_CONVERTER = ("bits", "range", "gain")
_CABLE = ("noise", "pickup", "pickup_hz")
_TEMPERATURE = ("start", "rise", "time_constant", "sensor_offset", "sensor_noise")
_JOINTS = ("natural_frequency_hz", "settling_time", "stiffness", "mass")


@dataclass(frozen=True)
class Acquisition:
    """How a simulated recording is acquired.

    Attributes
    ----------
    oversampling : int
        Analogue instants a sample.
    chain : dict
        The other arguments of `AcquisitionOptions`, but for what the sensor adds.
    surroundings : float
        m/s^2, white noise per sample.
    temperature : TemperatureProfile or None
        Of the sensor while it records.
    held_joints : HeldJoints
    compliance : (n,) ndarray
        Of the joints' loops; empty for none.
    gyroscope_noise : float or None
        rad/s per sample; None where there is no gyroscope.
    corrected : bool
        Whether readings are corrected by the sensor's calibration sheet.
    """

    oversampling: int = 1
    chain: dict[str, float | int] = field(default_factory=dict)
    surroundings: float = 0.0
    temperature: circlepoint.TemperatureProfile | None = None
    held_joints: circlepoint.HeldJoints = field(default_factory=circlepoint.HeldJoints)
    compliance: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    gyroscope_noise: float | None = None
    corrected: bool = True

    def noise_std(self, sensor: circlepoint.AccelerometerSpecification) -> float:
        """Return white noise per sample, m/s^2: the surroundings', and the sensor's where it states no bands."""
        return float(np.hypot(self.surroundings, 0.0 if sensor.noise_bands else sensor.noise_std))

    def options(self, sensor: circlepoint.AccelerometerSpecification) -> circlepoint.AcquisitionOptions:
        """Return the chain behind a sensor of a kind, which gives its noise by band, response and resolution.

        The calibration sheet is the individual's and not in it.
        """
        return circlepoint.AcquisitionOptions(
            oversampling=self.oversampling,
            noise_bands=sensor.noise_bands,
            response_bands=sensor.response_bands,
            resolution=sensor.resolution,
            signal_cutoff=self.chain["signal_cutoff"],
            temperature_cutoff=self.chain["temperature_cutoff"],
            filter_order=int(self.chain["filter_order"]),
            cable_noise_std=self.chain["cable_noise_std"],
            pickup_amplitude=self.chain["pickup_amplitude"],
            pickup_frequency=self.chain["pickup_frequency"],
            channel_skew=self.chain["channel_skew"],
            converter_bits=int(self.chain["converter_bits"]),
            converter_range=self.chain["converter_range"],
            converter_gain=self.chain["converter_gain"],
            encoder_rate=self.chain["encoder_rate"],
        )


def read_acquisition(plan: Fields, joints: int) -> Acquisition | None:
    """Return what a plan's ``acquisition`` section says; None where there is none.

    Raises
    ------
    InvalidInput
        Naming file, field and value, for an unknown or impossible field.
    """
    if "acquisition" not in plan:
        return None
    section = plan.fields("acquisition", _SECTION)
    paper = circlepoint.paper_acquisition()
    acquisition = Acquisition(
        oversampling=section.integer("oversampling", default=paper.oversampling, at_least=1),
        chain={
            "signal_cutoff": section.number("signal_cutoff_hz", default=paper.signal_cutoff, at_least=0.0),
            "temperature_cutoff": section.number(
                "temperature_cutoff_hz", default=paper.temperature_cutoff, at_least=0.0
            ),
            "filter_order": section.integer("filter_order", default=paper.filter_order, at_least=1),
            "channel_skew": 1e-6 * section.number("channel_skew_us", default=1e6 * paper.channel_skew, at_least=0.0),
            "encoder_rate": section.number("encoder_rate_hz", default=paper.encoder_rate, at_least=0.0),
            **_converter(section, paper),
            **_cable(section, paper),
        },
        surroundings=section.number("surroundings", default=0.0, at_least=0.0),
        temperature=_temperature(section),
        corrected=_yes(section, "corrected"),
    )
    if "gyroscope" in section:
        noise = section.fields("gyroscope", ("noise",)).number("noise", default=0.0, at_least=0.0)
        acquisition = replace(acquisition, gyroscope_noise=noise)
    return _held(section, acquisition, joints)


def _converter(section: Fields, paper: circlepoint.AcquisitionOptions) -> dict[str, float | int]:
    found = section.fields("converter", _CONVERTER) if "converter" in section else None
    if found is None:
        return {
            "converter_bits": paper.converter_bits,
            "converter_range": paper.converter_range,
            "converter_gain": paper.converter_gain,
        }
    return {
        "converter_bits": found.integer("bits", default=paper.converter_bits, at_least=0),
        "converter_range": found.number("range", default=paper.converter_range, above=0.0),
        "converter_gain": found.number("gain", default=paper.converter_gain, above=0.0),
    }


def _cable(section: Fields, paper: circlepoint.AcquisitionOptions) -> dict[str, float | int]:
    if "cable" not in section:
        return {"cable_noise_std": 0.0, "pickup_amplitude": 0.0, "pickup_frequency": paper.pickup_frequency}
    found = section.fields("cable", _CABLE)
    return {
        "cable_noise_std": found.number("noise", default=0.0, at_least=0.0),
        "pickup_amplitude": found.number("pickup", default=0.0, at_least=0.0),
        "pickup_frequency": found.number("pickup_hz", default=paper.pickup_frequency, at_least=0.0),
    }


def _temperature(section: Fields) -> circlepoint.TemperatureProfile | None:
    if "temperature" not in section:
        return None
    found = section.fields("temperature", _TEMPERATURE)
    default = circlepoint.TemperatureProfile()
    return circlepoint.TemperatureProfile(
        start=found.number("start", default=default.start),
        rise=found.number("rise", default=default.rise),
        time_constant=found.number("time_constant", default=default.time_constant, above=0.0),
        sensor_offset=found.number("sensor_offset", default=0.0),
        sensor_noise_std=found.number("sensor_noise", default=0.0, at_least=0.0),
    )


def _held(section: Fields, acquisition: Acquisition, joints: int) -> Acquisition:
    if "joints" not in section:
        return acquisition
    found = section.fields("joints", _JOINTS)
    if "natural_frequency_hz" in found:
        held = circlepoint.HeldJoints(
            natural_frequency=_one_a_joint(found, "natural_frequency_hz", joints, at_least=0.0),
            settling_time=found.number("settling_time", default=circlepoint.HeldJoints().settling_time, above=0.0),
        )
        acquisition = replace(acquisition, held_joints=held)
    if "stiffness" in found:
        stiffness = _one_a_joint(found, "stiffness", joints, above=0.0)
        mass = found.number("mass", at_least=0.0)
        acquisition = replace(acquisition, compliance=circlepoint.joint_compliance(stiffness, mass))
    return acquisition


def _one_a_joint(
    fields: Fields, key: str, joints: int, *, at_least: float = -np.inf, above: float = -np.inf
) -> NDArray[np.float64]:
    value = fields.value(key, "one number, or one a joint")
    if not isinstance(value, list):
        return np.full(joints, fields.number(key, at_least=at_least, above=above))
    if len(value) != joints:
        fields.fail(key, f"is {describe(value)}, must be one number, or a list of {joints}, one a joint")
    return np.array([fields.checked((key, i), entry, at_least=at_least, above=above) for i, entry in enumerate(value)])


def _yes(section: Fields, key: str) -> bool:
    value = section.values.get(key, True)
    if not isinstance(value, bool):
        section.fail(key, f"is {describe(value)}, must be true or false")
    return value
