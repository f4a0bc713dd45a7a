"""Efficiency and honesty of the whole-arm estimate over many seeds: python bench/python/whole_arm_accuracy.py [SEEDS].

Printed for each case of whole_arm_cases.py and each group of parameters: the share of true values within their 95 %
intervals, the mean normalised square of the error (1 is honest), the end-point's error over 200 poses and what was
predicted; and, where the noise is white and the encoders exact, the root mean square error against the Cramer-Rao
bound: the inverse information of all samples at full rate, without any filter, with the true noise and the same
priors.
"""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from whole_arm_cases import CASES, SENSOR_GROUPS, UP, Case, Truth, motion, poses, simulated, truth

import circlepoint as cp
from circlepoint.sensor_presets import load_sensor

LIMIT = 1.96  # standard deviations of a 95 % interval


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
    chain = case.arm()
    types = [axis.type for axis in chain.axes]
    options = cp.WholeArmOptions()
    options.sensor = load_sensor(case.sensor)
    options.joint_types = types
    options.threads = 1
    options.reference_configuration = chain.reference_configuration
    if case.scale > 0.0:
        options.scale = cp.ParameterTreatment(std=case.scale)
    if case.counts > 0.0:
        unit = [2 * np.pi if kind == cp.JointType.revolute else 1.0 for kind in types]  # a turn, a metre
        options.encoder_resolution = np.array(unit) / case.counts
    segmentation = cp.segment(recording, cp.SegmentationOptions(joint_types=types))
    return cp.calibrate_whole_arm(recording, segmentation, options)


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
    true_values["clock_offset"] = case.late
    local = {
        f"joint{joint + 1}.{name}": error
        for joint, (mine, theirs) in enumerate(zip(chain.axes, made_of.chain.axes, strict=True))
        for name, error in zip(("d1", "d2", "p1", "p2"), cp.local_coordinates(mine.line, theirs.line), strict=True)
    }
    errors = [local[p.name] if p.name in local else p.value - true_values.get(p.name, 0.0) for p in result.parameters]
    configurations = poses(made_of.chain)
    predicted = cp.end_point_std(result, configurations)
    return Trial(
        [p.name for p in result.parameters],
        np.array(errors),
        np.array([p.std for p in result.parameters]),
        cp.end_point_error(chain, made_of.chain, configurations),
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


def earlier(trajectory: cp.JointTrajectory, by: float) -> cp.JointTrajectory:
    """Return the motion as it was a moment before."""
    jerk = np.gradient(np.asarray(trajectory.acceleration), 1.0 / trajectory.sample_rate, axis=0)
    return cp.JointTrajectory(
        trajectory.time,
        trajectory.position - by * trajectory.velocity,
        trajectory.velocity - by * trajectory.acceleration,
        trajectory.acceleration - by * jerk,
        trajectory.sample_rate,
    )


def cramer_rao(case: Case, trajectory: cp.JointTrajectory, names: list[str], seed: int = 0) -> np.ndarray:
    """Return the bound's covariance: all samples, white noise of known size, exact encoders, the same priors."""
    made_of = truth(case, seed)
    clean = replace(case, noise=0.0)

    def readings(of: Truth, shifted: cp.JointTrajectory = trajectory) -> np.ndarray:
        return np.asarray(simulated(clean, of, shifted, 0).specific_force).ravel()

    step = 1e-6
    jacobian = np.empty((readings(made_of).size, len(names)))
    for column, name in enumerate(names):
        if name == "clock_offset":
            sides = [earlier(trajectory, sign * step) for sign in (1.0, -1.0)]
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
    if case.bounded:
        made_of = truth(case, 0).chain
        covariance = cramer_rao(case, motion(case, 0), names)
        bound = np.sqrt(np.diag(covariance))
        lines = [column for column, name in enumerate(names) if name.startswith("joint")]
        least = cp.end_point_std(made_of, covariance[np.ix_(lines, lines)], poses(made_of))
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
