import csv

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import minimize_scalar

import circlepoint as cp

OFFSET, RATE = 0.35, 1.0021


def read(path):
    with path.open() as file:
        names = next(csv.reader(file))
        values = np.loadtxt(file, delimiter=",")
    return {name: np.ascontiguousarray(values[:, k]) for k, name in enumerate(names)}


def columns(table, names):
    return np.ascontiguousarray(np.column_stack([table[name] for name in names]))


def joints_of(table):
    return columns(table, [name for name in table if name.startswith("q")])


def two_logs(table):
    """One log split into two: the sensor on another clock, at another rate, in millisecond stamps, starting later."""
    force = columns(table, ["ax", "ay", "az"])
    own = OFFSET + RATE * table["t"]
    clock = np.arange(own[0] + 1.7, own[-1] - 2.3, 1 / 266.27)
    return table["t"], joints_of(table), np.round(clock, 3), np.ascontiguousarray(CubicSpline(own, force)(clock))


@pytest.mark.parametrize(
    "name", ["physics-arm6-sweeps-mems", "physics-arm7-sweeps-qa700", "physics-arm7-sweeps-coarse"]
)
def test_two_clocks_are_recovered_within_three_standard_deviations(shared_data, name):
    found = cp.align_clocks(*two_logs(read(shared_data / name / "log.csv")))
    assert found.single_joint
    assert found.converged
    assert abs(found.offset - OFFSET) < 3 * found.offset_std
    assert abs(found.rate - RATE) < 3 * found.rate_std
    assert found.reference_std < 1e-3
    assert found.rate_std < 50e-6


def test_motion_of_all_joints_at_once_is_aligned_poorly_and_says_so(shared_data):
    found = cp.align_clocks(*two_logs(read(shared_data / "physics-arm7-free-ideal" / "log.csv")))
    assert not found.single_joint
    error = found.offset - OFFSET + (found.rate - RATE) * found.reference_time
    assert abs(error) < 3 * found.reference_std
    assert any("want of single-joint" in note for note in found.notes)


def test_a_real_robots_clocks_agree_with_its_gyroscope(shared_data):
    folder = shared_data / "real-ur5-imu-6"
    joints, sensor = read(folder / "joints.csv"), read(folder / "sensor.csv")
    found = cp.align_clocks(joints["t"], joints_of(joints), sensor["t"], columns(sensor, ["ax", "ay", "az"]))
    assert found.offset == pytest.approx(0.07, abs=0.005)
    assert found.rate == pytest.approx(1.0033, abs=1e-4)
    assert found.rate_std < 50e-6

    recording = cp.make_recording(
        joints["t"],
        joints_of(joints),
        sensor["t"],
        columns(sensor, ["ax", "ay", "az"]),
        found.clock,
        angular_velocity=columns(sensor, ["gx", "gy", "gz"]),
    )
    smoothing = 0.03 * recording.sample_rate
    turning = gaussian_filter1d(recording.angular_velocity, smoothing, axis=0)
    speed = gaussian_filter1d(recording.joint_positions, smoothing, axis=0, order=1) * recording.sample_rate
    delays = []
    for test in found.tests:
        during = (recording.time > test.joint_start - 0.5) & (recording.time < test.joint_end + 0.5)
        spline = CubicSpline(recording.time, speed[:, test.joint])

        def misfit(delay, during=during, spline=spline):
            regressors = np.column_stack([spline(recording.time[during] - delay), np.ones(during.sum())])
            residual = turning[during] - regressors @ np.linalg.lstsq(regressors, turning[during], rcond=None)[0]
            return np.sum(residual**2)

        delays.append(minimize_scalar(misfit, bounds=(-0.1, 0.1), method="bounded").x)
    assert abs(np.mean(delays)) < 3 * found.reference_std
    assert np.max(np.abs(delays)) < 2e-3


def test_a_real_log_without_single_joint_motion_leaves_the_rate_open(shared_data):
    folder = shared_data / "real-ur5-imu-8"
    joints, sensor = read(folder / "joints.csv"), read(folder / "sensor.csv")
    found = cp.align_clocks(joints["t"], joints_of(joints), sensor["t"], columns(sensor, ["ax", "ay", "az"]))
    assert not found.single_joint
    assert not found.rate_determined
    # Its gyroscope and the maker's nominal kinematics give 0.13377 s and 1.00345.
    at = found.reference_time
    assert abs(found.offset + found.rate * at - (0.13377 + 1.00345 * at)) < 3 * found.reference_std
