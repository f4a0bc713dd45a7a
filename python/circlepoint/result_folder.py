"""The main job from files to a result folder: what ``circlepoint calibrate`` does, and a fleet log by log."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import circlepoint
from circlepoint.calibration import Calibration, calibrate
from circlepoint.document import with_description, with_reading, write_document
from circlepoint.export import write_description
from circlepoint.recording_io import read_recording

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from circlepoint.arm import Arm
    from circlepoint.calibration import Method


@dataclass(frozen=True)
class CalibrationJob:
    """What is to be calibrated, from which files, how.

    Attributes
    ----------
    logs : tuple of Path
        The files of one recording.
    arm_file : Path
        The arm's description.
    base, tip : str, optional
        Links of a URDF.
    columns : Path, optional
        Names and units of the logs' columns.
    method : {"whole-arm", "joint", "position", "velocity"}
    sensor : AccelerometerSpecification, optional
    gravity : float
        m/s^2.
    reference_configuration : sequence of float, optional
        rad or m.
    treatments : mapping of str to ParameterTreatment
        As those of `calibrate`.
    joint_topic, imu_topic : str, optional
        Of a bag.
    """

    logs: tuple[Path, ...]
    arm_file: Path
    base: str | None = None
    tip: str | None = None
    columns: Path | None = None
    method: Method = "whole-arm"
    sensor: circlepoint.AccelerometerSpecification | None = None
    gravity: float = circlepoint.STANDARD_GRAVITY
    reference_configuration: Sequence[float] | None = None
    treatments: Mapping[str, circlepoint.ParameterTreatment] = field(default_factory=dict)
    joint_topic: str | None = None
    imu_topic: str | None = None


def calibrate_into(
    folder: Path, job: CalibrationJob, arm: Arm, begin: Callable[[str], None] = lambda _: None
) -> Calibration:
    """Read the logs, calibrate, and write calibration.json, report.html, its figures and the arm's description.

    Parameters
    ----------
    folder : Path
        The result folder; made if it is not there.
    job : CalibrationJob
    arm : Arm
        As read from the job's description.
    begin : callable
        Called with the name of each of three steps as it begins.

    Returns
    -------
    Calibration

    Raises
    ------
    Error
        As `read_recording` and `calibrate`; nothing is written then.
    """
    begin("reading")
    loaded = read_recording(
        list(job.logs),
        arm,
        job.columns,
        gravity=job.gravity,
        joint_topic=job.joint_topic,
        imu_topic=job.imu_topic,
    )
    begin("estimating")
    calibration = calibrate(
        loaded.recording,
        arm,
        method=job.method,
        sensor=job.sensor,
        gravity=job.gravity,
        reference_configuration=job.reference_configuration,
        treatments=job.treatments,
    )
    document = with_description(with_reading(calibration.document, loaded), job.arm_file, job.base, job.tip)
    calibration = replace(calibration, document=document)
    begin("writing")
    from circlepoint.report import write_report  # noqa: PLC0415  (matplotlib is slow to load)

    folder.mkdir(parents=True, exist_ok=True)
    write_report(folder, calibration)
    write_document(folder / "calibration.json", calibration.document)
    write_description(folder, job.arm_file, calibration.document, base=job.base, tip=job.tip)
    return calibration
