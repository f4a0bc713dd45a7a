"""An arm of three joints, motions, and how far the whole-arm estimate is off: what its tests share."""

import numpy as np

import circlepoint as cp
from circlepoint.sensor_presets import load_sensor

UP = cp.STANDARD_GRAVITY * np.array([0.48, -0.6, 0.64])
START = np.array([0.2, -0.5, 0.9])
LINES = [([0.9, 0.1, 0.3], [0.1, 0.5, -0.3]), ([0.0, 0.2, 1.0], [-0.4, 0.1, 0.1]), ([0.2, 1.0, 0.3], [0.2, 0.0, 0.3])]
RATE = 200.0
REVOLUTE = cp.JointType.revolute


def chain_of(lines, types=None):
    types = types or [REVOLUTE] * len(lines)
    axes = [
        cp.ScrewAxis(kind, cp.make_line(np.array(direction), np.array(point)))
        for kind, (direction, point) in zip(types, lines, strict=True)
    ]
    return cp.ScrewChain(axes, START)


def sweeps_of(joints=range(3), span=2.4):
    pieces = []
    for joint in joints:
        pieces.append(cp.SteppedSweep(joint=joint, steps=12, span=span, dwell=0.6, move=0.5, return_duration=1.5))
        pieces.append(cp.RaisedCosine(joint=joint, span=span, frequency=0.5, duration=4.0))
    return pieces


def free(duration=40.0, amplitude=(1.2, 1.2, 1.2)):
    return [cp.MultiJointMotion(duration=duration, amplitude=np.array(amplitude), seed=3)]


def recorded(pieces, *, chain=None, up=UP, sensor=None, noise=0.005, seed=1, rate=RATE, **options):
    sensor = sensor or cp.draw_accelerometer(load_sensor("qa700"), seed)
    motion = cp.joint_trajectory(START, pieces, rate, 0.6)
    return cp.simulate(
        chain or chain_of(LINES), up, sensor, motion, cp.SimulationOptions(noise_std=noise, seed=seed, **options)
    )


def estimate(recording, *, sensor="qa700", segmentation=None, **options):
    chosen = cp.WholeArmOptions()
    chosen.sensor = load_sensor(sensor)
    chosen.reference_configuration = START
    for name, value in options.items():
        setattr(chosen, name, value)
    return cp.calibrate_whole_arm(recording, segmentation or cp.segment(recording), chosen)


def errors_and_std(result, chain):
    errors, std = [], []
    for mine, true in zip(result.joints.joints, chain.axes, strict=True):
        errors.append(cp.local_coordinates(mine.axis.screw.line, true.line))
        std.append(np.sqrt(np.diag(mine.axis.covariance)))
    return np.array(errors), np.array(std)


def value(result, name):
    return next(p for p in result.parameters if p.name == name)


def assert_found(result, chain, limit=1e-4):
    errors, std = errors_and_std(result, chain)
    assert np.abs(errors).max() < limit
    assert np.abs(errors / std).max() < 4.5
