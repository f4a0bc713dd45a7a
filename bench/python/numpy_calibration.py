"""Calibrations as a careful user would write them with NumPy and SciPy: of one joint, and of a whole arm.

Both see what ours sees (a Recording) and the same model; neither estimates its noise, finds tests, holds stretches out
or names what the data do not show, which ours do.
"""

from dataclasses import dataclass

import numpy as np
import scipy.optimize
import scipy.signal

import circlepoint as cp

GRAVITY_STD = 2e-5  # m/s^2, of the magnitude


def low_passed(values: np.ndarray, rate: float, cutoff: float) -> np.ndarray:
    """Zero-phase, order 4."""
    return scipy.signal.sosfiltfilt(scipy.signal.butter(4, cutoff, fs=rate, output="sos"), values, axis=0)


# One joint


def single_joint(recording: cp.Recording, joint: int, cutoff: float) -> cp.Line:
    """Return the axis in the sensor frame, of a recording in which this joint alone moves.

    Five regressors, all passed through the same low-pass as the readings; then z, the lever, gravity and bias by
    least_squares on the regression's coefficients, weighted by their information.
    """
    rate = recording.sample_rate
    angle = np.asarray(recording.joint_positions)[:, joint] - np.asarray(recording.joint_positions)[0, joint]
    angle = low_passed(angle, rate, 2 * cutoff)
    speed = np.gradient(angle, 1 / rate)
    regressors = np.column_stack(
        [np.ones_like(angle), np.cos(angle), np.sin(angle), np.gradient(speed, 1 / rate), speed**2]
    )
    x = low_passed(regressors, rate, cutoff)
    y = low_passed(np.asarray(recording.specific_force), rate, cutoff)
    information = x.T @ x
    factor = np.linalg.cholesky(information).T
    target = np.linalg.solve(information, x.T @ y)
    constant, cosine, sine, _, centripetal = target

    def model(p: np.ndarray) -> np.ndarray:
        z = p[:3] / np.linalg.norm(p[:3])
        across, lever = p[3:6] - z * (z @ p[3:6]), p[6:9] - z * (z @ p[6:9])
        return np.array([p[9:12], across, -np.cross(z, across), np.cross(z, lever), -lever - p[12] * (1 - z**2)])

    def residuals(p: np.ndarray) -> np.ndarray:
        gauge = [p[:3] @ p[:3] - 1, p[:3] @ p[3:6], p[:3] @ p[6:9]]
        return np.concatenate([(factor @ (model(p) - target)).ravel(), gauge, [p[12] / 0.05]])

    axis = np.cross(sine, cosine)
    axis /= np.linalg.norm(axis)
    start = np.concatenate([axis, cosine, -centripetal, constant, [0.0]])
    solution = scipy.optimize.least_squares(residuals, start, x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12).x
    return cp.make_line(solution[:3] / np.linalg.norm(solution[:3]), -solution[6:9])


# The whole arm


@dataclass
class Motion:
    """Joint positions and their derivatives, (m, n)."""

    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    jerk: np.ndarray

    def delayed(self, delay: float) -> "Motion":
        """Return what the joints did before."""
        return Motion(
            self.position - delay * self.velocity,
            self.velocity - delay * self.acceleration,
            self.acceleration - delay * self.jerk,
            self.jerk,
        )


def thinned(recording: cp.Recording, cutoff: float, step: int) -> tuple[Motion, np.ndarray]:
    """Return every step-th sample of joints and readings, both low-passed."""
    rate = recording.sample_rate
    position = low_passed(np.asarray(recording.joint_positions), rate, cutoff)
    velocity = np.gradient(position, 1 / rate, axis=0)
    acceleration = np.gradient(velocity, 1 / rate, axis=0)
    jerk = np.gradient(acceleration, 1 / rate, axis=0)
    readings = low_passed(np.asarray(recording.specific_force), rate, cutoff)
    kept = slice(step // 2, None, step)
    return Motion(*(np.ascontiguousarray(a[kept].T) for a in (position, velocity, acceleration, jerk))), readings[kept]


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of (3, m) arrays or vectors (3,); np.cross spends most of its time elsewhere."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def sensor_kinematics(lines: list[cp.Line], reference: np.ndarray, motion: Motion) -> tuple[np.ndarray, ...]:
    """Return rotation (3, 3, m) sensor to base; angular velocity, acceleration of the sensor's origin (3, m), in base.

    The base frame is the sensor frame at the reference configuration; product of exponentials from base to tip.
    """
    m = motion.position.shape[1]
    rotation = np.repeat(np.eye(3)[:, :, None], m, axis=2)
    origin, spin, spin_rate, shift, shift_rate = (np.zeros((3, m)) for _ in range(5))
    for joint, line in enumerate(lines):
        axis, point = np.asarray(line.direction), np.asarray(line.point)
        z = np.einsum("ijm,j->im", rotation, axis)
        c = origin + np.einsum("ijm,j->im", rotation, point)
        moment = cross(c, z)
        speed, rate = motion.velocity[joint], motion.acceleration[joint]
        # Rate of the joint's twist, carried by the links before it.
        z_rate = cross(spin, z)
        moment_rate = cross(spin, moment) + cross(shift, z)
        spin_rate += z * rate + z_rate * speed
        shift_rate += moment * rate + moment_rate * speed
        spin = spin + z * speed
        shift = shift + moment * speed
        angle = motion.position[joint] - reference[joint]
        turn = rotation_about(axis, angle)
        origin = origin + np.einsum("ijm,jm->im", rotation, point[:, None] - np.einsum("ijm,j->im", turn, point))
        rotation = np.einsum("ijm,jkm->ikm", rotation, turn)
    acceleration = shift_rate + cross(spin_rate, origin) + cross(spin, shift + cross(spin, origin))
    return rotation, spin, acceleration


def rotation_about(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rodrigues' formula, (3, 3, m)."""
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3)[:, :, None] + k[:, :, None] * np.sin(angle) + (k @ k)[:, :, None] * (1 - np.cos(angle))


@dataclass
class WholeArm:
    """The answer."""

    lines: list[cp.Line]
    sensor: np.ndarray  # bias, scale, misalignment, percussion distance, (4, 3)
    delay: float
    std: np.ndarray
    rows: int
    evaluations: int


def whole_arm(recording: cp.Recording, nominal: cp.ScrewChain, sensor: cp.AccelerometerSpecification,
              cutoff: float = 10.0, step: int | None = None) -> WholeArm:  # fmt: skip
    """Estimate every line, gravity, bias, scale, misalignment, percussion distance and delay by least_squares.

    Start values are nominal. The Jacobian is by forward differences, one evaluation of all samples a column, and only
    where they change something: a sensor's columns need no kinematics.
    """
    motion, readings = thinned(recording, cutoff, step or int(recording.sample_rate / (2 * cutoff)))
    reference = np.asarray(nominal.reference_configuration)
    joints = len(nominal.axes)
    noise = 0.01 * np.sqrt(2 * cutoff / recording.sample_rate)
    spread = min(sensor.percussion_distance_std, 1e-3)
    prior_std = np.repeat([sensor.bias_std, sensor.scale_std, sensor.misalignment_std, spread], 3)
    magnitude = cp.STANDARD_GRAVITY
    start_lines = [axis.line for axis in nominal.axes]

    def kinematics(p: np.ndarray) -> tuple[np.ndarray, ...]:
        lines = [cp.retract(line, p[4 * i : 4 * i + 4]) for i, line in enumerate(start_lines)]
        return sensor_kinematics(lines, reference, motion.delayed(p[-1]))

    def reading(p: np.ndarray, moved: tuple[np.ndarray, ...]) -> np.ndarray:
        rotation, spin, acceleration = moved
        gravity = p[4 * joints : 4 * joints + 3]
        bias, scale, misalignment, distance = p[4 * joints + 3 : -1].reshape(4, 3)
        force = np.einsum("jim,jm->im", rotation, acceleration + gravity[:, None])
        local = np.einsum("jim,jm->im", rotation, spin)
        force -= distance[:, None] * (np.sum(local**2, axis=0) - local**2)
        force[2] += misalignment[1] * force[0] + misalignment[2] * force[1]
        force[1] += misalignment[0] * force[0]
        return (1 + scale)[:, None] * force + bias[:, None]

    def priors(p: np.ndarray) -> np.ndarray:
        gravity = p[4 * joints : 4 * joints + 3]
        mean = p[-4:-1].mean()
        errors = p[4 * joints + 3 : -1].copy()
        errors[-3:] -= mean
        return np.concatenate(
            [
                errors / prior_std,
                [
                    mean / sensor.percussion_distance_std,
                    (np.linalg.norm(gravity) - magnitude) / GRAVITY_STD,
                    p[-1] / 0.005,
                ],
            ]
        )

    evaluations = 0

    def residuals(p: np.ndarray) -> np.ndarray:
        nonlocal evaluations
        evaluations += 1
        return np.concatenate([((reading(p, kinematics(p)) - readings.T) / noise).ravel(), priors(p)])

    def jacobian(p: np.ndarray) -> np.ndarray:
        moved = kinematics(p)
        at = np.concatenate([(reading(p, moved) / noise).ravel(), priors(p)])
        columns = np.empty((at.size, p.size), order="F")
        for k in range(p.size):
            step_size = 1e-7
            q = p.copy()
            q[k] += step_size
            geometry = k < 4 * joints or k == p.size - 1
            there = np.concatenate([(reading(q, kinematics(q) if geometry else moved) / noise).ravel(), priors(q)])
            columns[:, k] = (there - at) / step_size
        return columns

    start = np.zeros(4 * joints + 3 + 12 + 1)
    # Gravity as the first still samples have it, in the base frame.
    rotation = sensor_kinematics(start_lines, reference, motion)[0]
    start[4 * joints : 4 * joints + 3] = np.einsum("ijm,jm->im", rotation, readings.T)[:, :20].mean(axis=1)
    solution = scipy.optimize.least_squares(
        residuals, start, jacobian, method="trf", x_scale="jac", xtol=1e-10, ftol=1e-10
    )
    p = solution.x
    std = np.sqrt(np.diag(np.linalg.inv(solution.jac.T @ solution.jac)))
    lines = [cp.retract(line, p[4 * i : 4 * i + 4]) for i, line in enumerate(start_lines)]
    return WholeArm(lines, p[4 * joints + 3 : -1].reshape(4, 3), p[-1], std, readings.shape[0], evaluations)
