"""The main job: from a recording to a calibrated arm, every intermediate kept."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

import circlepoint
from circlepoint.dh_rows import to_rows
from circlepoint.nominal import joint_types, nominal_dh_chain
from circlepoint.result_document import result_document
from circlepoint.sensor_presets import load_sensor
from circlepoint.treatments import require_visible, set_treatments, treatment_entries
from circlepoint.whole_arm_document import with_whole_arm

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    from circlepoint.arm import Arm
    from circlepoint.dh_rows import DhConversion
    from circlepoint.document import Document

Method = Literal["whole-arm", "joint", "position", "velocity"]

UNSPECIFIED_SENSOR = "generic"
"""Preset taken when nothing is said of the sensor; the dwells then set how wide its figures are."""

CLOCK_OFFSET_STD = 0.05
"""s; what the alignment of two clocks by the arm's activity may be off."""
CLOCK_RATE_STD = 1e-3


@dataclass(frozen=True)
class NamedFit:
    """One joint test's fit under its joint's name; signals in s, rad or m, and m/s^2 (see `circlepoint.TestFit`)."""

    joint_name: str
    result: circlepoint.TestFit

    @property
    def joint(self) -> int:
        """Joint, from 0."""
        return self.result.joint

    @property
    def time(self) -> NDArray[np.float64]:
        """(M,) s."""
        return self.result.time

    @property
    def position(self) -> NDArray[np.float64]:
        """(M,) rad or m."""
        return self.result.position

    @property
    def measured(self) -> NDArray[np.float64]:
        """(M, 3) m/s^2, filtered, corrected for sensor errors and yielding joints."""
        return self.result.measured

    @property
    def modelled(self) -> NDArray[np.float64]:
        """(M, 3) m/s^2, through the same filter."""
        return self.result.modelled

    @property
    def dwell_positions(self) -> NDArray[np.float64]:
        """(K,) rad or m."""
        return self.result.dwell_positions

    @property
    def dwell_measured(self) -> NDArray[np.float64]:
        """(K, 3) m/s^2."""
        return self.result.dwell_measured

    @property
    def dwell_modelled(self) -> NDArray[np.float64]:
        """(K, 3) m/s^2."""
        return self.result.dwell_modelled

    @property
    def residual_rms(self) -> float:
        """m/s^2, of the filtered samples about the model."""
        return self.result.dynamic_noise_std

    @property
    def cutoff(self) -> float:
        """Hz."""
        return self.result.cutoff


@dataclass(frozen=True)
class Calibration:
    """A calibrated arm and everything it was made from.

    Attributes
    ----------
    arm : Arm
        The description it was asked for.
    recording : Recording
        What was recorded.
    segmentation : Segmentation
        The dwells, motions and tests found in it.
    joints : JointCalibration
        Every joint's axis, or the reason there is none.
    whole_arm : WholeArmCalibration or None
        The estimate of everything at once, where that was the method.
    chain : ScrewChain or None
        All axes, base frame = sensor frame at the reference configuration; None while a joint is missing.
    dh : StandardDhConversion, ModifiedDhConversion, HayatiConversion or None
        The same chain in the arm's Denavit-Hartenberg convention; where axes are nearly parallel to their neighbours,
        with a Hayati row before each such axis.
    fits : tuple of NamedFit
        Each test's signals and model.
    document : dict
        The content of ``calibration.json``.
    """

    arm: Arm
    recording: circlepoint.Recording
    segmentation: circlepoint.Segmentation
    joints: circlepoint.JointCalibration
    whole_arm: circlepoint.WholeArmCalibration | None
    chain: circlepoint.ScrewChain | None
    dh: DhConversion | None
    fits: tuple[NamedFit, ...]
    document: Document


def calibrate(
    recording: circlepoint.Recording,
    arm: Arm,
    *,
    method: Method = "whole-arm",
    sensor: circlepoint.AccelerometerSpecification | None = None,
    gravity: float = circlepoint.STANDARD_GRAVITY,
    reference_configuration: ArrayLike | None = None,
    treatments: Mapping[str, circlepoint.ParameterTreatment] | None = None,
) -> Calibration:
    """Calibrate an arm from one recording.

    Parameters
    ----------
    recording : Recording
        Joint positions and specific force on one clock.
    arm : Arm
        Joints, and what is known nominally.
    method : {"whole-arm", "joint", "position", "velocity"}
        One maximum-likelihood estimate of everything from any motion, regression joint by joint, or one of the two
        methods of Canepa, Hollerbach and Boelen (1994).
    sensor : AccelerometerSpecification, optional
        What is known of the sensor. Without it a wide range of kinds is allowed for, and the readings at rest say how
        wide.
    gravity : float
        Local magnitude, m/s^2.
    reference_configuration : array_like, shape (n,), optional
        rad or m; where the lines are given. Default: the dwell that serves most joints.
    treatments : mapping of str to ParameterTreatment, optional
        Of the whole-arm estimate's parameters, by group (`circlepoint.treatments.PARAMETER_GROUPS`): fixed, free, or
        free with a prior. Default: as the sensor's data sheet says and the data can see.

    Returns
    -------
    Calibration

    Raises
    ------
    InvalidInput
        For a recording that does not fit the arm, or options out of range.
    """
    if treatments and method != "whole-arm":
        raise circlepoint.InvalidInput(
            f"treatments of {', '.join(treatments)} are for the method whole-arm, asked for is {method}; leave them out"
        )
    require_visible(recording, treatments or {})
    segmentation = circlepoint.segment(recording, circlepoint.SegmentationOptions(joint_types=joint_types(arm)))
    whole_arm = None
    if method == "whole-arm":
        options = whole_arm_options(
            arm, sensor, gravity, reference_configuration, two_clocks=recording.joint_timeline is not None
        )
        set_treatments(options, treatments or {})
        whole_arm = circlepoint.calibrate_whole_arm(recording, segmentation, options)
        joints = whole_arm.joints
    else:
        joints = circlepoint.calibrate_joints(
            recording, segmentation, joint_options(arm, method, sensor, gravity, reference_configuration)
        )
    chain = joints.chain() if joints.complete() else None
    dh = None if chain is None else to_rows(chain, nominal_dh_chain(arm))
    document = result_document(
        arm,
        method=method,
        gravity=gravity,
        segmentation=segmentation,
        joints=joints,
        chain=chain,
        dh=dh,
        whole_arm=whole_arm,
    )
    if whole_arm is not None:
        document = with_whole_arm(document, arm, whole_arm)
    if treatments:
        document["treatments"] = treatment_entries(treatments)
    return Calibration(
        arm=arm,
        recording=recording,
        segmentation=segmentation,
        joints=joints,
        whole_arm=whole_arm,
        chain=chain,
        dh=dh,
        fits=tuple(NamedFit(arm.joints[fit.joint].name, fit) for fit in joints.fits),
        document=document,
    )


def joint_options(
    arm: Arm,
    method: Method,
    sensor: circlepoint.AccelerometerSpecification | None,
    gravity: float,
    reference_configuration: ArrayLike | None,
) -> circlepoint.JointCalibrationOptions:
    """Return the options of a method that goes joint by joint; arguments as those of `calibrate`."""
    options = circlepoint.JointCalibrationOptions()
    options.method = circlepoint.CalibrationMethod[method]
    options.sensor = load_sensor(UNSPECIFIED_SENSOR) if sensor is None else sensor
    options.adapt_sensor_prior = sensor is None
    options.gravity = gravity
    options.joint_types = joint_types(arm)
    _set_encoders(options, arm, reference_configuration)
    return options


def whole_arm_options(
    arm: Arm,
    sensor: circlepoint.AccelerometerSpecification | None,
    gravity: float,
    reference_configuration: ArrayLike | None,
    *,
    two_clocks: bool = False,
) -> circlepoint.WholeArmOptions:
    """Return the options of the whole-arm estimate; arguments as those of `calibrate`."""
    options = circlepoint.WholeArmOptions()
    options.sensor = load_sensor(UNSPECIFIED_SENSOR) if sensor is None else sensor
    options.sensor_is_known = sensor is not None
    options.gravity_magnitude = gravity
    options.joint_types = joint_types(arm)
    if two_clocks:
        # Two clocks: their alignment by the arm's activity is a start, the model of the motion finds them better.
        options.clock_offset = circlepoint.ParameterTreatment(std=CLOCK_OFFSET_STD)
        options.clock_rate = circlepoint.ParameterTreatment(std=CLOCK_RATE_STD)
    _set_encoders(options, arm, reference_configuration)
    return options


def _set_encoders(
    options: circlepoint.JointCalibrationOptions | circlepoint.WholeArmOptions,
    arm: Arm,
    reference_configuration: ArrayLike | None,
) -> None:
    steps: Sequence[float | None] = [arm.encoder_step(joint) for joint in range(len(arm.joints))]
    if all(step is not None for step in steps):
        options.encoder_resolution = np.array(steps, dtype=float)
    if reference_configuration is not None:
        options.reference_configuration = np.asarray(reference_configuration, dtype=float)
