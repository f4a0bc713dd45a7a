"""What the whole-arm estimate makes of recordings nobody here made: python bench/python/whole_arm_recordings.py FOLDER.

FOLDER holds one folder a recording: log.csv, or joints.csv and sensor.csv, arm.yaml and, where it is known, truth.json;
of those in UNDESCRIBED only the number of joints is known, and their sensor is also supposed to be of the MEMS class.
Of still poses of several sensors each sensor is taken for itself, supposed to be of the MEMS class.
Against a truth: the largest error of an axis and of a line, the end-point's over 200 poses and what was predicted. Else
the lengths that are not zero nominally, beside the nominal ones, which are not used; and what is not given, and why. At
the end the time the estimate takes for a simulated arm of seven joints, by samples.
"""

from __future__ import annotations

import json
import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np
from whole_arm_cases import UP, demonstration_arm, poses

import circlepoint as cp
from circlepoint.arm import Arm, Joint, load_arm
from circlepoint.calibration import Calibration, calibrate
from circlepoint.recording_io import read_recording
from circlepoint.report.text import as_far_as_seen, missing_joints
from circlepoint.sensor_presets import load_sensor
from circlepoint.truth import truth_chain

SENSORS = {"qa700": "qa700", "mems": "mems", "ideal": "ideal", "coarse": "qa700"}  # by the last word of a folder's name
LOGS = (("log.csv",), ("joints.csv", "sensor.csv"))
UNDESCRIBED = {  # file and joints
    "real-hebi-5module": ("log.csv.gz", 4),
    "real-ur3e-rtde": ("recording.csv", 6),
}


def against_truth(result: Calibration, folder: Path) -> None:
    """Print the errors."""
    truth = cp.rebase(
        truth_chain(json.loads((folder / "truth.json").read_text())), result.joints.reference_configuration
    )
    chain = result.joints.chain()
    errors = np.array(
        [cp.local_coordinates(mine.line, theirs.line) for mine, theirs in zip(chain.axes, truth.axes, strict=True)]
    )
    configurations = poses(chain)
    predicted = cp.end_point_std(result.whole_arm, configurations)
    covariance = np.asarray(result.joints.covariance)  # zero where a sliding joint has no point
    estimated = np.count_nonzero(np.diag(covariance))
    squares = errors.ravel() @ np.linalg.pinv(covariance, hermitian=True) @ errors.ravel() / estimated
    print(
        f"  axes within {1e3 * np.linalg.norm(errors[:, :2], axis=1).max():.3f} mrad, lines within "
        f"{1e3 * np.linalg.norm(errors[:, 2:], axis=1).max():.3f} mm, end-point "
        f"{1e3 * cp.end_point_error(chain, truth, configurations):.3f} mm rms (predicted "
        f"{1e3 * np.sqrt(np.mean(predicted**2)):.3f}); normalised squares {squares:.2f}"
    )


def against_nominal(result: Calibration, arm: Arm) -> None:
    """Print lengths beside the nominal ones, encoders that are off, and reasons."""
    rows = (result.document["dh"] or {}).get("rows") or []
    for joint, row, nominal in zip(arm.joints, rows, arm.dh.rows if arm.dh else (), strict=False):
        for key in ("a", "d"):
            std = row["std"].get(key)
            if getattr(nominal, key) and isinstance(std, float):
                estimate = f"{joint.name} {key} {1e3 * row[key]:8.1f} ± {1e3 * std:.1f} mm"
                print(f"  {estimate}   nominal {1e3 * getattr(nominal, key):.2f}")
    for entry in result.document.get("encoders", []):
        errors = [f"{name} {e['estimate']:.5f} ± {e['std']:.5f}" for name, e in entry.items() if isinstance(e, dict)]
        print(f"  encoder of {entry['joint']}: {', '.join(errors)}")
    for reason, joints in missing_joints(result.document).items():
        print(f"  {', '.join(joints)}: {reason}")
    for joint in result.document["joints"]:
        if seen := as_far_as_seen(joint):
            print(f"  {joint['name']}, {seen}")


def described(folder: Path) -> tuple[Arm, list[Path]] | None:
    """Return a recording's arm and files; None where a folder holds none."""
    if folder.name in UNDESCRIBED:
        file, count = UNDESCRIBED[folder.name]
        joints = tuple(Joint(f"joint{number}", "revolute") for number in range(1, count + 1))
        return Arm(folder.name, joints), [folder / file]
    names = next((names for names in LOGS if all((folder / name).is_file() for name in names)), None)
    if names is None or not (folder / "arm.yaml").is_file():
        return None
    return load_arm(folder / "arm.yaml"), [folder / name for name in names]


def still_poses(folder: Path) -> None:
    """Print, sensor by sensor, the angles between neighbouring axes, beside the right angles that the maker states."""
    rows = np.loadtxt(folder / "static.csv", delimiter=",", skiprows=1)  # pose, q1 .. q7, imu, ax, ay, az
    print(f"{folder.name}: {len(set(rows[:, 0]))} still poses, sensors of the class mems")
    for sensor in range(1, 7):
        joints = min(sensor + 1, 6)  # those that move it
        mine = rows[rows[:, 8] == sensor]
        table = cp.make_static_recording(mine[:, 1 : 1 + joints].copy(), mine[:, 9:].copy())
        arm = Arm(folder.name, tuple(Joint(f"joint{number}", "revolute") for number in range(1, joints + 1)))
        result = calibrate(table, arm, sensor=load_sensor("mems"))
        told = [estimate.vague for estimate in result.joints.joints]
        angles = [
            f"{np.degrees(np.arccos(a.screw.line.direction @ b.screw.line.direction)):.1f} ± "
            f"{np.degrees(np.hypot(a.direction_std(), b.direction_std())):.1f}"
            for a, b in pairwise(told)
            if a is not None and b is not None
        ]
        missing = ", ".join(f"joint{i + 1}" for i, line in enumerate(told) if line is None)
        print(
            f"  sensor {sensor}, {joints} joints: neighbours at {', '.join(angles) or 'no angle told'} deg; "
            f"residual {1e3 * result.document['fit']['static_noise_std']:.1f} mm/s²; not told: {missing or 'none'}"
        )


def recording(folder: Path) -> None:
    """Print one recording's result."""
    if (folder / "static.csv").is_file():
        still_poses(folder)
        return
    found = described(folder)
    if found is None:
        print(f"{folder.name}: no arm.yaml with {' or '.join(' + '.join(log) for log in LOGS)}")
        return
    arm, files = found
    preset = SENSORS.get(folder.name.rsplit("-", 1)[-1])
    print(f"{folder.name}: sensor {preset or 'not specified'}")
    try:
        log = read_recording(files, arm)
        result = calibrate(log.recording, arm, sensor=None if preset is None else load_sensor(preset))
        if (folder / "truth.json").is_file() and result.chain is not None:
            against_truth(result, folder)
            return
        against_nominal(result, arm)
        if log.recording.angular_velocity is not None:
            print("  without its gyroscope:")
            alone = cp.make_recording(log.recording.time, log.recording.joint_positions, log.recording.specific_force)
            against_nominal(calibrate(alone, arm), arm)
        if folder.name in UNDESCRIBED:
            print("  supposing its sensor is of the class mems:")
            supposed = calibrate(log.recording, arm, sensor=load_sensor("mems"))
            against_nominal(supposed, arm)
            fit = supposed.document["fit"]
            at_rest = fit["static_noise_std"]
            rests = "no rests" if at_rest is None else f"{1e3 * at_rest:.0f} at rest"
            print(f"  residual {1e3 * fit['noise_std']:.0f} mm/s² in motion, {rests}")
    except cp.Error as error:
        print(f"  {error}")


def growth() -> None:
    """Print the time of the estimate by samples: 7 joints, all moving, at 250 Hz."""
    chain = demonstration_arm()
    for samples in (100_000, 200_000, 400_000, 800_000, 1_600_000):
        motion = [cp.MultiJointMotion(duration=samples / 250.0, amplitude=np.full(7, 1.2), seed=7)]
        made = cp.simulate(
            chain,
            UP,
            cp.draw_accelerometer(load_sensor("qa700"), 0),
            cp.joint_trajectory(chain.reference_configuration, motion, 250.0, 0.6),
            cp.SimulationOptions(noise_std=0.01, seed=0),
        )
        options = cp.WholeArmOptions()
        options.sensor = load_sensor("qa700")
        begin = time.perf_counter()
        cp.calibrate_whole_arm(made, cp.segment(made), options)
        seconds = time.perf_counter() - begin
        print(
            f"  {made.samples:>9,} samples {seconds:6.2f} s, {1e6 * seconds / made.samples:.2f} µs a sample", flush=True
        )


def main() -> int:
    """Print all recordings of a folder, then the growth."""
    if len(sys.argv) > 1:
        for folder in sorted(path for path in Path(sys.argv[1]).iterdir() if path.is_dir()):
            recording(folder)
    else:
        print("give a folder of recordings to see what the estimate makes of them")
    print("time by samples, 7 joints")
    growth()
    return 0


if __name__ == "__main__":
    sys.exit(main())
