"""What is in a log: its clock, its sensor, the tests of each joint, and what is still to be recorded.

Nothing is estimated; `format_check` puts it all on one screen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint._core import STANDARD_GRAVITY
from circlepoint.findings import Finding
from circlepoint.motion_content import (
    SHORT_TRAVEL,
    GravityMotion,
    JointMotion,
    JointStatus,
    gravity_motion,
    joint_motions,
    judge_gravity,
    judge_motion,
)
from circlepoint.nominal import joint_types

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from circlepoint.arm import Arm, Joint
    from circlepoint.recording_io import LoadedRecording

MIN_DWELLS = 4
"""Rests a joint's direction is well seen with."""
MIN_DWELL_SPAN = 0.5
"""rad: the range those rests should cover."""
MIN_SLIDING_ACCELERATION = 0.2
"""m/s^2: the peak acceleration a sliding joint's motion should have; it alone shows the direction."""
GRAVITY_TOLERANCE = 0.05
"""Relative deviation of what the sensor reads at rest that is worth a word."""
MIN_GRAVITY_SHARE = 0.1
"""Part of gravity across the axis, below which the rests say little about its direction."""


@dataclass(frozen=True)
class JointCheck:
    """What was recorded of one joint, lengths of travel in rad or m.

    Attributes
    ----------
    joint : Joint
        The joint.
    tests : int
        Configurations of the other joints in which it was tested.
    dwells, motions : int
        Rests and motions of this joint alone, in all tests.
    dwell_span, motion_span : float
        Range of its rests in one test, largest travel of a motion.
    motion_time : float
        s, of all motions.
    strokes : int
        Passages from end to end, of all motions: how often each was repeated.
    frequency : float or None
        Hz of the longest motion; None for a single stroke.
    encoder_step : float or None
        Smallest step seen; None where it never moved.
    gravity_share : float or None
        Part of gravity across the axis, from the rests; None where they cannot tell.
    status : str
        By its own tests, as the methods joint by joint need them: ``"good"``, ``"weak"`` (can be calibrated, badly) or
        ``"missing"`` (cannot).
    advice : str
        What to record next for these; empty when nothing is needed.
    motion : JointMotion
        How it moved at all.
    whole_arm, whole_arm_advice : str
        The same for the estimate of the whole arm, which takes any motion.
    """

    joint: Joint
    tests: int
    dwells: int
    dwell_span: float
    motions: int
    motion_span: float
    motion_time: float
    strokes: int
    frequency: float | None
    encoder_step: float | None
    gravity_share: float | None
    status: JointStatus
    advice: str
    motion: JointMotion
    whole_arm: JointStatus
    whole_arm_advice: str


@dataclass(frozen=True)
class LogCheck:
    """What is in a log.

    Attributes
    ----------
    loaded : LoadedRecording
        The recording, its files and clocks.
    joints : tuple of JointCheck
        Base to tip.
    rests : int
        Rests of the whole arm.
    rest_magnitude, rest_magnitude_std : float or None
        m/s^2; magnitude of the specific force over the rests: mean and standard deviation.
    rest_noise : float or None
        m/s^2; standard deviation of samples within a rest, the median over rests and channels; None without samples.
    largest_force : float
        m/s^2; largest absolute reading of a channel.
    gravity : float
        m/s^2; what the magnitude should be.
    gravity_motion : GravityMotion or None
        How far gravity turned in the sensor's frame; None where there is too little to say.
    gravity_status, gravity_advice : str
        Whether that is enough, and what to record.
    findings : tuple of Finding
        What is suspicious.
    """

    loaded: LoadedRecording
    joints: tuple[JointCheck, ...]
    rests: int
    rest_magnitude: float | None
    rest_magnitude_std: float | None
    rest_noise: float | None
    largest_force: float
    gravity: float
    gravity_motion: GravityMotion | None
    gravity_status: JointStatus
    gravity_advice: str
    findings: tuple[Finding, ...]

    @property
    def ready(self) -> bool:
        """Whether the whole arm can be estimated, as far as its motion tells."""
        return self.gravity_status != "missing" and all(joint.whole_arm != "missing" for joint in self.joints)

    @property
    def ready_alone(self) -> bool:
        """Whether every joint can be calibrated by tests of its own."""
        return all(joint.status != "missing" for joint in self.joints)


def check_recording(loaded: LoadedRecording, arm: Arm, *, gravity: float = STANDARD_GRAVITY) -> LogCheck:
    """Look at a recording of an arm.

    Parameters
    ----------
    loaded : LoadedRecording
        From `read_recording`.
    arm : Arm
        The arm that was recorded.
    gravity : float, optional
        m/s^2, local gravity.

    Returns
    -------
    LogCheck
        Rates, rests, tests per joint and what is missing.
    """
    options = circlepoint.SegmentationOptions(joint_types=joint_types(arm))
    segmentation = circlepoint.segment(loaded.recording, options)
    forces = np.array([dwell.specific_force for dwell in segmentation.dwells]).reshape(-1, 3)
    noise = np.array([dwell.specific_force_std for dwell in segmentation.dwells])
    magnitudes = np.linalg.norm(forces, axis=1)
    magnitude = float(magnitudes.mean()) if magnitudes.size else None
    turned = gravity_motion(loaded.recording)
    status, advice = judge_gravity(turned)
    return LogCheck(
        loaded=loaded,
        joints=tuple(
            _check_joint(loaded, segmentation, arm, index, motion=motion, gravity=gravity)
            for index, motion in enumerate(joint_motions(loaded.recording))
        ),
        rests=len(segmentation.dwells),
        rest_magnitude=magnitude,
        rest_magnitude_std=float(magnitudes.std()) if magnitudes.size else None,
        rest_noise=float(np.median(noise)) if noise.size and not loaded.recording.is_static else None,
        largest_force=float(np.abs(loaded.recording.specific_force).max()),
        gravity=gravity,
        gravity_motion=turned,
        gravity_status=status,
        gravity_advice=advice,
        findings=(*loaded.findings, *_gravity_findings(magnitude, gravity)),
    )


def _gravity_findings(magnitude: float | None, gravity: float) -> list[Finding]:
    if magnitude is None or abs(magnitude / gravity - 1) < GRAVITY_TOLERANCE:
        return []
    return [
        Finding(
            "gravity",
            f"at rest the sensor reads {magnitude:.4g} m/s^2 where gravity is {gravity:.6g}: its scale factor is "
            f"{100 * (magnitude / gravity - 1):+.1f} % off, or the local gravity is another (--gravity)",
        )
    ]


def _check_joint(
    loaded: LoadedRecording,
    segmentation: circlepoint.Segmentation,
    arm: Arm,
    index: int,
    *,
    motion: JointMotion,
    gravity: float,
) -> JointCheck:
    joint = arm.joints[index]
    coupled = arm.coupled(index)
    together = all(arm.joint_names[other] in coupled for other in motion.in_step)
    whole_arm, whole_arm_advice = judge_motion(joint, motion, together=together)
    if any(index in file.beyond for file in loaded.files):
        whole_arm, whole_arm_advice = "missing", "it does not move the sensor: put one beyond it"
    tests = [test for test in segmentation.tests if test.joint == index]
    motions = [segmentation.motions[i] for test in tests for i in test.motions]
    dwell_span = max((test.dwell_span for test in tests), default=0.0)
    motion_span = max((test.motion_span for test in tests), default=0.0)
    dwells = max((len(test.dwells) for test in tests), default=0)
    share = _gravity_share(segmentation, tests, index, gravity) if joint.revolute else None
    if joint.revolute:
        status, advice = _judge(
            joint, dwells=dwells, dwell_span=dwell_span, motions=len(motions), motion_span=motion_span, share=share
        )
    else:
        status, advice = _judge_sliding(joint, motions)
    if coupled and status == "missing":
        advice = f"{', '.join(coupled)} and it move together (mimic): only calibrate --method whole-arm takes them"
    return JointCheck(
        joint=joint,
        tests=len(tests),
        dwells=sum(len(test.dwells) for test in tests),
        dwell_span=dwell_span,
        motions=len(motions),
        motion_span=motion_span,
        motion_time=sum(motion.samples.size for motion in motions) / loaded.recording.sample_rate,
        strokes=sum(_crossings(loaded.recording, motion).size for motion in motions),
        frequency=_frequency(loaded.recording, motions),
        encoder_step=loaded.encoder_steps[index],
        gravity_share=share,
        status=status,
        advice=advice,
        motion=motion,
        whole_arm=whole_arm,
        whole_arm_advice=whole_arm_advice,
    )


def _judge(
    joint: Joint, *, dwells: int, dwell_span: float, motions: int, motion_span: float, share: float | None
) -> tuple[JointStatus, str]:
    """Return the verdict on one joint, and what to record next."""
    rests_over, strokes_over = 3 * MIN_DWELL_SPAN, 3 * SHORT_TRAVEL[joint.type]
    rests = f"let it rest at {MIN_DWELLS} or more positions over {_travel(joint, rests_over)} or more, 1 s each"
    strokes = f"move it alone to and fro over {_travel(joint, strokes_over)} or more, briskly, for 5 s or more"
    if motions == 0 and dwells < 2:
        return "missing", f"no test of it alone: with the others still, {rests}; then {strokes}"
    if motions == 0:
        return "missing", f"rests only, and they do not show where the axis is: {strokes}"
    if motion_span < SHORT_TRAVEL[joint.type]:
        return "weak", f"its motions are short ({_travel(joint, motion_span)}): {strokes}"
    if dwells < MIN_DWELLS or dwell_span < MIN_DWELL_SPAN:
        return "weak", f"few rests ({dwells} over {_travel(joint, dwell_span)}): {rests}"
    if share is not None and share < MIN_GRAVITY_SHARE:
        return "weak", (
            f"gravity is along its axis (only {share:.2g} g across): rests hardly show its direction, so more and "
            f"brisker motions, and a "
            "precise sensor, matter here"
        )
    return "good", ""


def _judge_sliding(joint: Joint, motions: Sequence[circlepoint.SingleJointMotion]) -> tuple[JointStatus, str]:
    """Return the verdict on one prismatic joint: rests show nothing of it, its acceleration shows all."""
    strokes_over = 3 * SHORT_TRAVEL[joint.type]
    strokes = f"move it alone to and fro over {_travel(joint, strokes_over)} or more, briskly (0.5 Hz), for 5 s or more"
    if not motions:
        return "missing", f"no motion of it alone: with the others still, {strokes}"
    span = max(motion.travel for motion in motions)
    if span < SHORT_TRAVEL[joint.type]:
        return "weak", f"its motions are short ({_travel(joint, span)}): {strokes}"
    # Of a sinusoid of this speed and travel.
    acceleration = max(2 * motion.peak_velocity**2 / motion.travel for motion in motions)
    if acceleration < MIN_SLIDING_ACCELERATION:
        return "weak", f"its motions are slow (about {acceleration:.2g} m/s^2): {strokes}"
    return "good", ""


def _gravity_share(
    segmentation: circlepoint.Segmentation, tests: Sequence[circlepoint.JointTest], index: int, gravity: float
) -> float | None:
    """Part of gravity across the axis: how far the reading moves when the joint turns by the rests' span."""
    shares = []
    for test in tests:
        dwells = sorted(
            (segmentation.dwells[i] for i in test.dwells), key=lambda dwell: float(dwell.joint_positions[index])
        )
        for dwell in dwells[1:]:
            turn = abs(math.sin((dwell.joint_positions[index] - dwells[0].joint_positions[index]) / 2))
            if turn > 0.1:
                chord = float(np.linalg.norm(dwell.specific_force - dwells[0].specific_force))
                shares.append(chord / (2 * gravity * turn))
    return min(float(np.median(shares)), 1.0) if shares else None


def _frequency(recording: circlepoint.Recording, motions: Sequence[circlepoint.SingleJointMotion]) -> float | None:
    """Frequency of the longest motion by its turning points; None for a single stroke."""
    if not motions:
        return None
    crossings = _crossings(recording, max(motions, key=lambda candidate: candidate.samples.size))
    if crossings.size < 2:
        return None
    elapsed = recording.time[crossings[-1]] - recording.time[crossings[0]]
    return float((crossings.size - 1) / (2 * elapsed))


def _crossings(recording: circlepoint.Recording, motion: circlepoint.SingleJointMotion) -> NDArray[np.intp]:
    """Return the samples where a motion has passed its middle: one a stroke."""
    begin, end = motion.samples.begin, motion.samples.end
    position = recording.joint_positions[begin:end, motion.joint]
    middle = (position.max() + position.min()) / 2
    band = 0.1 * (position.max() - position.min())
    side = np.where(position > middle + band, 1, np.where(position < middle - band, -1, 0))
    known = np.flatnonzero(side)
    crossings: NDArray[np.intp] = begin + known[1:][np.diff(side[known]) != 0]
    return crossings


def _travel(joint: Joint, value: float) -> str:
    return f"{math.degrees(value):.0f} deg" if joint.revolute else f"{1000 * value:.0f} mm"
