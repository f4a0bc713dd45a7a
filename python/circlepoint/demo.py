"""The demonstration: simulate the paper's arm, sensor and tests, calibrate from the recording, compare with the truth.

The simulated arm differs from its description by millimetres and milliradians, as built arms do; it stands on a tilted
base, its resting joints yield to gravity by milliradians, and the sensor sits on a handle at the flange.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.arm import Arm, load_arm
from circlepoint.atomic import write_atomically
from circlepoint.calibration import calibrate
from circlepoint.document import Document, write_document
from circlepoint.nominal import joint_types
from circlepoint.protocol import paper_plan
from circlepoint.recording_files import write_recording
from circlepoint.report import format_dh_table, format_joint_table, write_report
from circlepoint.sensor_presets import load_sensor
from circlepoint.truth import end_point_error, truth_at, truth_document

if TYPE_CHECKING:
    from numpy.typing import NDArray

ARM_FILE = Path(__file__).parent / "arms" / "sarcos.yaml"
SENSOR = "qa700"
SEED = 1994
LENGTH_STD = 1e-3  # m, how far an arm is built from its drawing (assumed)
ANGLE_STD = 3e-3  # rad
HANDLE = (0.10, 0.06, 0.22)  # m, sensor from flange (assumed; the paper's handle is 0.5 m long)
HANDLE_TURN = (0.4, -0.7, 1.1)  # rad, rotation vector
UP_BASE = (0.45, -0.35, 0.82)  # direction of up in the tilted base's frame; its length does not matter
YIELD = 1e-4  # rad per m^2/s^2: a joint gives way by some milliradians under the arm's weight (assumed)


def built_arm(
    arm: Arm,
    reference_configuration: NDArray[np.float64],
    seed: int,
    handle: tuple[float, float, float] = HANDLE,
) -> circlepoint.ScrewChain:
    """Return the axes of an arm built a little off its description, in the sensor frame at a reference configuration.

    Parameters
    ----------
    arm : Arm
        With nominal standard Denavit-Hartenberg rows.
    reference_configuration : (n,) ndarray
        rad.
    seed : int
        Of the deviations.
    handle : tuple of float
        m, the sensor seen from the flange.
    """
    if arm.dh is None:
        raise circlepoint.InvalidInput(f"arm {arm.name!r} has no nominal `dh` to build it from; add its rows")
    random = np.random.default_rng(seed)
    rows = []
    for row in arm.dh.rows:
        a, d = np.array([row.a, row.d]) + random.normal(0.0, LENGTH_STD, 2)
        alpha, theta = np.array([row.alpha, row.theta]) + random.normal(0.0, ANGLE_STD, 2)
        rows.append(circlepoint.DhRow(a, alpha, d, theta))
    tool = np.eye(4)
    tool[:3, :3] = circlepoint.rotation_exp(np.array(HANDLE_TURN))
    tool[:3, 3] = handle
    chain = circlepoint.StandardDhChain(rows, joint_types(arm), tool=tool)
    return circlepoint.to_screws(chain, reference_configuration, circlepoint.BaseFrame.sensor_at_reference)


def simulate_demo(arm: Arm, seed: int = SEED) -> tuple[circlepoint.Recording, Document]:
    """Return the demonstration's recording and its truth.

    Parameters
    ----------
    arm : Arm
    seed : int
        Of the arm's deviations, the sensor's errors, noise and vibration.
    """
    plan = paper_plan(arm.joint_names)
    chain = built_arm(arm, plan.rest, seed)
    specification = load_sensor(SENSOR)
    sensor = circlepoint.draw_accelerometer(specification, circlepoint.derive_seed(seed, 0))
    up_sensor = circlepoint.rotation_exp(np.array(HANDLE_TURN)).T @ np.array(UP_BASE)
    up_sensor *= circlepoint.STANDARD_GRAVITY / np.linalg.norm(up_sensor)
    options = circlepoint.SimulationOptions(
        noise_std=specification.noise_std,
        range=specification.range,
        encoder_counts_per_revolution=np.array([counts or 0.0 for counts in arm.encoder_counts or ()]),
        compliance=np.full(len(arm.joints), YIELD),
        vibration=circlepoint.VibrationOptions(tangential_amplitude=0.1, orthogonal_amplitude=0.01),
        seed=circlepoint.derive_seed(seed, 1),
    )
    recording = circlepoint.simulate(chain, up_sensor, sensor, plan.trajectory(), options)
    return recording, truth_document(arm, chain, up_sensor.tolist(), sensor, seed)


def run(out: Path) -> int:
    """Run the demonstration and write its result folder.

    Parameters
    ----------
    out : Path
        Folder for log.csv, truth.json, arm.yaml, calibration.json, report.html and the figures.

    Returns
    -------
    int
        Exit status.
    """
    arm = load_arm(ARM_FILE)
    recording, truth = simulate_demo(arm)
    print(
        f"simulated: {arm.name}, {recording.samples} samples at {recording.sample_rate:g} Hz "
        f"({recording.samples / recording.sample_rate:.0f} s), sensor {SENSOR}, seed {SEED}"
    )
    calibration = calibrate(recording, arm, sensor=load_sensor(SENSOR))
    out.mkdir(parents=True, exist_ok=True)
    write_recording(out / "log.csv", recording)
    write_atomically(out / "truth.json", (json.dumps(truth, indent=1) + "\n").encode())
    write_atomically(out / "arm.yaml", ARM_FILE.read_bytes())
    truth = truth_at(truth, calibration.joints.reference_configuration)
    write_report(out, calibration, truth)
    write_document(out / "calibration.json", calibration.document)
    print()
    print(format_joint_table(calibration.document, truth))
    print(format_dh_table(calibration.document))
    if calibration.chain is not None:
        error = end_point_error(truth, calibration.chain, arm)
        predicted = calibration.document["end_point"]["rms"]
        print(
            f"end-point over the workspace: {1e3 * error:.3f} mm rms off the truth, {1e3 * predicted:.3f} mm predicted"
        )
    print(f"written: {out}/ (open {out / 'report.html'})")
    return 0 if calibration.document["complete"] else 1
