"""Efficiency and honesty of the whole-arm estimate over many seeds: python bench/python/whole_arm_accuracy.py [SEEDS].

The arm is the demonstration's, built a little off its drawing. One continuous log a seed: of each joint 16 rests over
150 degrees and eq. (11), 0.5 Hz for 4 s; or 60 s of all joints at once; at the paper's 500 Hz. Sensors are drawn from
their data sheets. Printed for each case and group of parameters: the share of true values within their 95 %
intervals, the mean normalised square of the error (1 is honest), the end-point's error over 200 poses and what was
predicted; and, where the noise is white and the encoders exact, the root mean square error against the Cramer-Rao
bound: the inverse information of all samples at full rate, without any filter, with the true noise and the same
priors.
"""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

import numpy as np

import circlepoint as cp
from circlepoint.arm import load_arm
from circlepoint.demo import ARM_FILE, built_arm
from circlepoint.sensor_presets import load_sensor

START = np.full(7, -1.2)
UP = cp.STANDARD_GRAVITY * np.array([0.36, 0.48, 0.80])
SPAN = np.radians(150.0)
POSES = START + np.random.default_rng(0).uniform(-np.pi, np.pi, (200, 7))
SENSOR_GROUPS = ("bias", "scale", "misalignment", "percussion_distance", "second_order")
LIMIT = 1.96  # standard deviations of a 95 % interval


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


CASES = (
    Case("tests, white noise, exact encoders", counts=0.0),
    Case("tests, 400,000 counts, joints yield", compliance=1e-4),
    Case("tests, vibration", vibration=0.1),
    Case("tests, 4,096 counts", counts=4096.0),
    Case("tests, MEMS", sensor="mems", noise=0.02),
    Case("all joints at once", free=True, counts=0.0),
    Case("all at once, vibration", free=True, vibration=0.1),
)


def motion(case: Case, seed: int) -> cp.JointTrajectory:
    """Return eq. (11) and rests of each joint, or all joints at once; within its count every seed starts elsewhere."""
    start = START + (np.random.default_rng(seed).uniform(0.0, 2e-3, 7) if case.counts else 0.0)
    if case.free:
        pieces = [cp.MultiJointMotion(duration=60.0, amplitude=np.full(7, 1.2), seed=7)]
    else:
        pieces = []
        for joint in range(7):
            pieces.append(cp.SteppedSweep(joint=joint, steps=16, span=SPAN, dwell=0.8, move=0.6))
            pieces.append(cp.RaisedCosine(joint=joint, span=SPAN, frequency=0.5, duration=4.0))
    return cp.joint_trajectory(start, pieces, 500.0, 0.6)


@dataclass(frozen=True)
class Truth:
    """What a recording is made of."""

    chain: cp.ScrewChain
    up: np.ndarray
    sensor: cp.AccelerometerModel


def truth(case: Case, seed: int) -> Truth:
    """Return one arm for all seeds, and a sensor for each."""
    return Truth(built_arm(load_arm(ARM_FILE), START, 1), UP, cp.draw_accelerometer(load_sensor(case.sensor), seed))


def simulated(case: Case, made_of: Truth, trajectory: cp.JointTrajectory, seed: int) -> cp.Recording:
    """Return the recording."""
    options = cp.SimulationOptions(
        noise_std=case.noise,
        encoder_counts_per_revolution=np.full(7, case.counts),
        compliance=np.full(7, case.compliance),
        vibration=cp.VibrationOptions(
            tangential_amplitude=case.vibration, orthogonal_amplitude=0.1 * case.vibration, frequency_max=60.0
        ),
        seed=seed,
    )
    return cp.simulate(made_of.chain, made_of.up, made_of.sensor, trajectory, options)


@dataclass(frozen=True)
class Trial:
    """Errors and standard deviations by name of parameter, and of the end-point."""

    names: list[str]
    errors: np.ndarray
    std: np.ndarray
    end_point: float  # m, rms over the poses
    predicted: float


def estimate(case: Case, recording: cp.Recording) -> cp.WholeArmCalibration:
    """Return the whole-arm estimate at the configuration the truth is given at."""
    options = cp.WholeArmOptions()
    options.sensor = load_sensor(case.sensor)
    options.threads = 1
    options.reference_configuration = START
    if case.counts > 0.0:
        options.encoder_resolution = np.full(7, 2 * np.pi / case.counts)
    return cp.calibrate_whole_arm(recording, cp.segment(recording), options)


def trial(case: Case, seed: int) -> Trial:
    """Simulate, estimate, compare."""
    made_of = truth(case, seed)
    result = estimate(case, simulated(case, made_of, motion(case, seed), seed))
    chain = result.joints.chain()
    true_values = {f"gravity_{axis}": value for axis, value in zip("xyz", made_of.up, strict=True)}
    for name in SENSOR_GROUPS:
        suffixes = ("yx", "zx", "zy") if name == "misalignment" else "xyz"
        for suffix, value in zip(suffixes, getattr(made_of.sensor, name), strict=True):
            true_values[f"{name}_{suffix}"] = value
    true_values["clock_offset"] = 0.0
    local = {
        f"joint{joint + 1}.{name}": error
        for joint, (mine, theirs) in enumerate(zip(chain.axes, made_of.chain.axes, strict=True))
        for name, error in zip(("d1", "d2", "p1", "p2"), cp.local_coordinates(mine.line, theirs.line), strict=True)
    }
    errors = [local[p.name] if p.name in local else p.value - true_values[p.name] for p in result.parameters]
    predicted = cp.end_point_std(chain, result.joints.covariance, POSES)
    return Trial(
        [p.name for p in result.parameters],
        np.array(errors),
        np.array([p.std for p in result.parameters]),
        cp.end_point_error(chain, made_of.chain, POSES),
        float(np.sqrt(np.mean(predicted**2))),
    )


def group(name: str) -> str:
    """Return what a parameter belongs to."""
    head, dot, tail = name.partition(".")
    if dot:
        return "directions" if tail.startswith("d") else "points"
    return head.rpartition("_")[0] if not head.startswith("clock") else head


def nudged(made_of: Truth, name: str, step: float) -> Truth:
    """Return the truth with one parameter moved."""
    head, _, tail = name.partition(".")
    if tail:
        joint, column = int(head.removeprefix("joint")) - 1, ("d1", "d2", "p1", "p2").index(tail)
        axes = list(made_of.chain.axes)
        line = cp.retract(axes[joint].line, step * np.eye(4)[column])
        axes[joint] = cp.ScrewAxis(axes[joint].type, line)
        return Truth(cp.ScrewChain(axes, made_of.chain.reference_configuration), made_of.up, made_of.sensor)
    kind, _, suffix = name.rpartition("_")
    index = ("yx", "zx", "zy").index(suffix) if kind == "misalignment" else "xyz".index(suffix)
    if kind == "gravity":
        return Truth(made_of.chain, made_of.up + step * np.eye(3)[index], made_of.sensor)
    fields = {field: np.array(getattr(made_of.sensor, field)) for field in SENSOR_GROUPS}
    fields[kind][index] += step
    return Truth(made_of.chain, made_of.up, cp.AccelerometerModel(**fields))


def cramer_rao(case: Case, trajectory: cp.JointTrajectory, names: list[str], seed: int = 0) -> np.ndarray:
    """Return the bound's covariance: all samples, white noise of known size, exact encoders, the same priors."""
    made_of = truth(case, seed)
    clean = Case(case.name, case.sensor, 0.0, 0.0, 0.0, case.free)

    def readings(of: Truth, shifted: cp.JointTrajectory = trajectory) -> np.ndarray:
        return np.asarray(simulated(clean, of, shifted, 0).specific_force).ravel()

    step = 1e-6
    jacobian = np.empty((readings(made_of).size, len(names)))
    for column, name in enumerate(names):
        if name == "clock_offset":
            acceleration = np.asarray(trajectory.acceleration)
            jerk = np.gradient(acceleration, 1.0 / trajectory.sample_rate, axis=0)
            sides = []
            for sign in (1.0, -1.0):
                late = -sign * step
                sides.append(
                    cp.JointTrajectory(
                        trajectory.time,
                        trajectory.position + late * trajectory.velocity,
                        trajectory.velocity + late * trajectory.acceleration,
                        acceleration + late * jerk,
                        trajectory.sample_rate,
                    )
                )
            jacobian[:, column] = (readings(made_of, sides[0]) - readings(made_of, sides[1])) / (2 * step)
            continue
        above, below = (readings(nudged(made_of, name, sign * step)) for sign in (1.0, -1.0))
        jacobian[:, column] = (above - below) / (2 * step)
    information = jacobian.T @ jacobian / case.noise**2
    specification = load_sensor(case.sensor)
    for column, name in enumerate(names):
        kind = group(name)
        std = {"clock_offset": 0.005}.get(kind, getattr(specification, f"{kind}_std", 0.0))
        if kind == "percussion_distance":
            continue
        if std > 0.0:
            information[column, column] += std**-2.0
    at = [column for column, name in enumerate(names) if group(name) == "percussion_distance"]
    if at:
        spread = specification.percussion_distance_std
        prior = spread**2 * np.ones((3, 3)) + min(spread, 1e-3) ** 2 * np.eye(3)
        information[np.ix_(at, at)] += np.linalg.inv(prior)
    gravity = [names.index(f"gravity_{axis}") for axis in "xyz"]
    up = UP / np.linalg.norm(UP)
    information[np.ix_(gravity, gravity)] += np.outer(up, up) / 2e-5**2
    return np.linalg.inv(information)


def run(case: Case, seeds: int) -> None:
    """Print one case."""
    with ThreadPoolExecutor() as pool:
        trials = list(pool.map(partial(trial, case), range(seeds)))
    names = trials[0].names
    errors, std = np.array([t.errors for t in trials]), np.array([t.std for t in trials])
    normalised = errors / std
    end_point = 1e3 * np.sqrt(np.mean([t.end_point**2 for t in trials]))
    predicted = 1e3 * np.sqrt(np.mean([t.predicted**2 for t in trials]))
    title = f"{case.name}: {seeds} seeds; end-point {end_point:.4f} mm rms, predicted {predicted:.4f}"
    bound = None
    if case.vibration == 0.0 and case.counts == 0.0:
        covariance = cramer_rao(case, motion(case, 0), names)
        bound = np.sqrt(np.diag(covariance))
        lines = [column for column, name in enumerate(names) if name.startswith("joint")]
        least = cp.end_point_std(truth(case, 0).chain, covariance[np.ix_(lines, lines)], POSES)
        title += f", {end_point / (1e3 * np.sqrt(np.mean(least**2))):.3f} of the bound"
    print(title)
    print(
        f"  {'group':<22}{'inside 95 %':>12}{'square':>9}{'rms':>12}{'std':>12}"
        + (f"{'rms / bound':>13}" if bound is not None else "")
    )
    for kind in dict.fromkeys(map(group, names)):
        at = [column for column, name in enumerate(names) if group(name) == kind]
        inside = 100.0 * np.mean(np.abs(normalised[:, at]) < LIMIT)
        square = np.mean(normalised[:, at] ** 2)
        rms, mean_std = (np.sqrt(np.mean(figures[:, at] ** 2)) for figures in (errors, std))
        line = f"  {kind:<22}{inside:>10.1f} %{square:>9.2f}{rms:>12.3g}{mean_std:>12.3g}"
        if bound is not None:
            ratio = np.sqrt(np.mean((errors[:, at] / bound[at]) ** 2))
            line += f"{ratio:>13.3f}"
        print(line, flush=True)


def main() -> int:
    """Run every case, or those whose names contain the second argument."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    wanted = sys.argv[2] if len(sys.argv) > 2 else ""
    for case in CASES:
        if wanted in case.name:
            run(case, seeds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
