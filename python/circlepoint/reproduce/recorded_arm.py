"""The whole arm in one continuous recording, and everything estimated from it at once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import circlepoint
from circlepoint.reproduce.arm_trial import draw_arm, end_point_error
from circlepoint.reproduce.estimates import angle_between
from circlepoint.reproduce.one_joint import Array, raised_cosine

if TYPE_CHECKING:
    from circlepoint.reproduce.conditions import Conditions

_dwell = 0.8  # s
_pause = 0.5  # s of rest between motions
_simulated_rate = 500.0  # Hz; slower converters drop samples of this


class WholeArmErrors(NamedTuple):
    """How far the whole-arm estimate of one arm is from the truth."""

    axis: Array
    """(n,) rad."""
    centre: Array
    """(n,) m, across the axis, at the point of it nearest the sensor."""
    end_point: float
    """m, rms over the workspace."""


@dataclass(frozen=True)
class RecordedArm:
    """One arm's truth and its recording."""

    chain: circlepoint.ScrewChain
    recording: circlepoint.Recording


def record_arm(conditions: Conditions, seed: int) -> RecordedArm:
    """Return the arm of `arm_trial` with the same seed, its joints tested one after the other in one log.

    Each joint rests at 16 places over the span (the paper: 150), 0.8 s each, then moves by eq. (11). As in the
    single-joint trials, a rest's mean has the noise of a pose, and samples in motion have theirs.
    """
    chain, up = draw_arm(seed)
    sensor = circlepoint.draw_accelerometer(conditions.sensor, circlepoint.derive_seed(seed, 1))
    pieces: list[circlepoint.SteppedSweep | circlepoint.RaisedCosine] = []
    for joint in range(len(chain)):
        pieces += [
            circlepoint.SteppedSweep(joint, span=conditions.span, dwell=_dwell),
            raised_cosine(conditions, joint),
        ]
    thinning = max(1, math.ceil(_simulated_rate / conditions.rate))
    trajectory = circlepoint.joint_trajectory(chain.reference_configuration, pieces, conditions.rate * thinning, _pause)
    resting = conditions.static_noise_std * math.sqrt(_dwell * conditions.rate)
    moving = math.hypot(conditions.dynamic_noise_std, conditions.cable_noise_std)
    options = circlepoint.SimulationOptions(
        noise_std=resting,
        encoder_counts_per_revolution=np.full(len(chain), conditions.encoder_counts),
        vibration=circlepoint.VibrationOptions(
            tangential_amplitude=conditions.tangential,
            orthogonal_amplitude=conditions.orthogonal,
            frequency_min=conditions.vibration_band[0],
            frequency_max=conditions.vibration_band[1],
        ),
        seed=circlepoint.derive_seed(seed, 3),
    )
    log = circlepoint.simulate(chain, up, sensor, trajectory, options)
    noise = np.random.default_rng(circlepoint.derive_seed(seed, 4)).normal(size=log.specific_force.shape)
    noise *= math.sqrt(max(moving**2 - resting**2, 0.0)) * np.any(trajectory.velocity != 0.0, axis=1)[:, None]
    kept = (log.time, log.joint_positions, log.specific_force + noise)
    recording = circlepoint.make_recording(*(np.ascontiguousarray(each[::thinning]) for each in kept))
    return RecordedArm(chain, recording)


def whole_arm_trial(conditions: Conditions, seed: int) -> WholeArmErrors:
    """Return the errors of the whole-arm estimate on one arm's recording."""
    truth, recording = (arm := record_arm(conditions, seed)).chain, arm.recording
    options = circlepoint.WholeArmOptions()
    options.sensor = conditions.sensor
    options.encoder_resolution = np.full(len(truth), 2.0 * math.pi / conditions.encoder_counts)
    options.reference_configuration = truth.reference_configuration
    options.threads = 1
    segmentation = circlepoint.segment(recording)
    estimate = circlepoint.calibrate_whole_arm(recording, segmentation, options).joints.chain()
    lines = [(axis.line, true.line) for axis, true in zip(estimate.axes, truth.axes, strict=True)]
    return WholeArmErrors(
        axis=np.array([angle_between(line.direction, true.direction) for line, true in lines]),
        centre=np.array([np.linalg.norm(np.cross(true.direction, line.point - true.point)) for line, true in lines]),
        end_point=end_point_error([line.direction for line, _ in lines], [-line.point for line, _ in lines], truth),
    )
