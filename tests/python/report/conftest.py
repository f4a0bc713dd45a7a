"""A calibration made of synthetic numbers: a seven-joint arm, its log and its tests."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from circlepoint.report import write_report

DH_ROWS = [  # a m, alpha rad, d m, theta rad
    (0.0, np.pi / 2, 0.0, 0.3),
    (0.0, -np.pi / 2, 0.0, -1.2),
    (0.03, np.pi / 2, 0.31, 0.4),
    (-0.03, -np.pi / 2, 0.0, -1.0),
    (0.0, np.pi / 2, 0.28, 0.5),
    (0.0, -np.pi / 2, 0.0, 1.1),
    (0.0, 0.0, 0.08, 0.2),
]
STD_DIRECTION = [1.23e-5, 9.6e-6, 2.2e-5, 1.4e-5, 4.7e-5, 3.1e-5, 9.1e-5]
STD_POINT = [5.1e-5, 4.4e-5, 6.3e-5, 3.9e-5, 8.8e-5, 1.2e-4, 2.04e-4]


def screw_lines():
    """Directions and nearest points of the axes in the sensor frame."""
    frames = [np.eye(4)]
    for a, alpha, d, theta in DH_ROWS:
        ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        step = np.array(
            [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1]]
        )
        frames.append(frames[-1] @ step)
    tool = np.eye(4)
    tool[:3, 3] = [0.06, -0.03, 0.04]
    T_sensor_base = np.linalg.inv(frames[-1] @ tool)
    lines = []
    for frame in frames[:-1]:
        in_sensor = T_sensor_base @ frame
        direction, point = in_sensor[:3, 2], in_sensor[:3, 3]
        lines.append((direction, point - direction * (point @ direction)))
    return lines, T_sensor_base[:3, :3] @ np.array([0.0, 0.0, 9.80665])


def make_document(names):
    lines, gravity = screw_lines()
    joints = [
        {
            "name": name,
            "type": "revolute",
            "direction_sensor": list(direction),
            "point_sensor": list(point),
            "direction_std": STD_DIRECTION[i],
            "point_std": STD_POINT[i],
            "covariance": np.diag([STD_DIRECTION[i] ** 2] * 2 + [STD_POINT[i] ** 2] * 2).tolist(),
            "reason": None,
        }
        for i, (name, (direction, point)) in enumerate(zip(names, lines, strict=True))
    ]
    rows = [
        {
            "a": a,
            "alpha": alpha,
            "d": d,
            "theta": theta,
            "std": {
                "a": 5.4e-5 * (1 + i),
                "alpha": 2.1e-5,
                "d": "free" if i == 0 else 3.7e-5 * (1 + i),
                "theta": "free" if i == 0 else 4.4e-5 / (1 + i),
            },
        }
        for i, (a, alpha, d, theta) in enumerate(DH_ROWS)
    ]
    rows[0]["d"] = rows[0]["theta"] = 0.0
    return {
        "schema": "circlepoint/calibration/1",
        "complete": True,
        "method": "whole-arm",
        "reference_configuration": [row[3] for row in DH_ROWS],
        "joints": joints,
        "gravity_sensor": list(gravity),
        "sensor": {
            "bias": {"estimate": [0.0049, -0.0021, 0.0032], "std": [3.1e-4, 2.2e-4, 4.0e-4]},
            "scale": {"estimate": [2.1e-5, -1.3e-4, 9.4e-5], "std": [1.1e-5, 1.3e-5, 1.2e-5]},
            "misalignment": {"estimate": [3e-5, -4e-5, 1e-5], "std": [1.1e-5, 1.4e-5, 1.2e-5]},
            "percussion_distance": {"estimate": [0.0182, 0.0183, 0.0181], "std": [8e-5, 7e-5, 9e-5]},
            "clock_offset": None,
            "clock_rate": None,
        },
        "dh": {
            "convention": "standard",
            "rows": rows,
            "base": np.eye(4).tolist(),
            "tool": np.eye(4).tolist(),
            "near_parallel": [],
        },
        "identifiability": {"rank": 40, "condition_number": 4.2e3, "unseen": []},
        "fit": {
            "samples": 57575,
            "noise_std": 0.0103,
            "normalised_residual_rms": 1.003,
            "iterations": 6,
            "converged": True,
        },
        "end_point": {"rms": 1.12e-4, "max": 2.31e-4},
        "findings": [
            {"level": "info", "text": "The joints that should rest yielded by up to 1.2 mrad; this is modelled."}
        ],
        "tests": [],
    }


def make_log(names, rate=100.0):
    """Seven tests one after another: twelve dwells, then a raised cosine; with their fits."""
    generator = np.random.default_rng(7)
    rest = np.array([row[3] for row in DH_ROWS])
    lines, gravity = screw_lines()
    positions, owners = [], []
    dwells, motions, tests, fits = [], [], [], []
    cursor = 0

    def add(joint, angles):
        nonlocal cursor
        block = np.tile(rest, (len(angles), 1))
        block[:, joint] = angles
        positions.append(block)
        owners.append(np.full(len(angles), joint))
        begin, cursor = cursor, cursor + len(angles)
        return SimpleNamespace(begin=begin, end=cursor)

    for joint in range(len(names)):
        own_dwells, own_motions = [], []
        stops = rest[joint] + np.linspace(-1.2, 1.2, 12)
        previous = rest[joint]
        for stop in [*stops, rest[joint]]:
            blend = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, int(0.5 * rate)))
            add(joint, previous + (stop - previous) * blend)
            samples = add(joint, np.full(int(0.6 * rate), stop))
            own_dwells.append(len(dwells))
            dwells.append(SimpleNamespace(samples=samples))
            previous = stop
        time = np.arange(int(6 * rate)) / rate
        swing = rest[joint] + 0.5 * (1 - np.cos(2 * np.pi * time / 1.5))
        samples = add(joint, swing)
        own_motions.append(len(motions))
        motions.append(SimpleNamespace(joint=joint, samples=samples, travel=1.0, peak_velocity=2.094))
        tests.append(
            SimpleNamespace(joint=joint, dwells=own_dwells, motions=own_motions, dwell_span=2.4, motion_span=1.0)
        )
        direction, point = lines[joint]

        def reading(theta, rate_of_turn=0.0, acceleration=0.0, *, z=direction, c=point, start=rest[joint]):
            along = z * (z @ gravity)
            across = gravity - along
            turn = np.atleast_1d(theta)[:, None] - start
            still = along + across * np.cos(turn) - np.cross(z, across) * np.sin(turn)
            lever = -c
            return (
                still
                + np.cross(z, lever) * np.atleast_1d(acceleration)[:, None]
                - lever * (np.atleast_1d(rate_of_turn) ** 2)[:, None]
            )

        pulse = 2 * np.pi / 1.5
        modelled = reading(swing, 0.5 * pulse * np.sin(pulse * time), 0.5 * pulse**2 * np.cos(pulse * time))
        dwell_modelled = reading(stops)
        fits.append(
            SimpleNamespace(
                joint=joint,
                joint_name=names[joint],
                time=samples.begin / rate + time,
                position=swing,
                measured=modelled + 0.011 * generator.standard_normal(modelled.shape),
                modelled=modelled,
                dwell_positions=stops,
                dwell_measured=dwell_modelled + 4e-4 * generator.standard_normal(dwell_modelled.shape),
                dwell_modelled=dwell_modelled,
                residual_rms=0.011,
                cutoff=20.0,
            )
        )
    joint_positions = np.vstack(positions)
    specific_force = np.tile(gravity, (cursor, 1)) + 0.2 * generator.standard_normal((cursor, 3))
    recording = SimpleNamespace(
        time=np.arange(cursor) / rate,
        joint_positions=joint_positions,
        specific_force=specific_force,
        sample_rate=rate,
        is_static=False,
    )
    return recording, SimpleNamespace(dwells=dwells, motions=motions, tests=tests), fits


def build_calibration(arm_name="sarcos-dextrous-arm", names=None):
    names = names or [f"joint{i + 1}" for i in range(7)]
    recording, segmentation, fits = make_log(names)
    return SimpleNamespace(
        document=make_document(names),
        arm=SimpleNamespace(name=arm_name, joints=[SimpleNamespace(name=name) for name in names]),
        fits=fits,
        recording=recording,
        segmentation=segmentation,
    )


def drop_joint(calibration, index, reason):
    """Turn a complete calibration into one without this joint's line."""
    document = calibration.document
    joint = document["joints"][index]
    for key in ("direction_sensor", "point_sensor", "direction_std", "point_std", "covariance"):
        joint[key] = None
    joint["reason"] = reason
    document["complete"] = False
    document["dh"] = None
    document["end_point"] = None
    document["identifiability"]["unseen"] = [f"direction and point of {joint['name']}"]
    document["findings"] = [{"level": "error", "text": f"{joint['name']}: {reason}"}]
    calibration.fits = [fit for fit in calibration.fits if fit.joint != index]
    calibration.segmentation.tests = [test for test in calibration.segmentation.tests if test.joint != index]


@pytest.fixture
def calibration():
    return build_calibration()


@pytest.fixture
def brief_calibration():
    """The same with one drawn test, where a test looks at something else."""
    return build_brief_calibration()


def build_brief_calibration():
    calibration = build_calibration()
    calibration.fits = calibration.fits[:1]
    return calibration


@pytest.fixture(scope="session")
def brief_report(tmp_path_factory):
    """The folder of the brief calibration's report, without a truth; to be read only."""
    directory = tmp_path_factory.mktemp("brief")
    write_report(directory, build_brief_calibration())
    return directory


@pytest.fixture
def incomplete_calibration():
    result = build_calibration()
    drop_joint(result, 4, "joint5 was never moved by itself.")
    result.fits = result.fits[-2:]
    return result


@pytest.fixture(scope="session")
def whole_report(tmp_path_factory):
    """A complete calibration, the folder its report is in, and the page."""
    calibration, directory = build_calibration(), tmp_path_factory.mktemp("report")
    write_report(directory, calibration, make_truth())
    return calibration, directory, (directory / "report.html").read_text(encoding="utf-8")


@pytest.fixture
def named_calibration():
    """Build a calibration of an arm and joints with these names."""
    return build_calibration


@pytest.fixture(name="truth")
def truth_fixture():
    return make_truth()


def make_truth():
    """The lines the synthetic estimate came from, turned and shifted a little."""
    lines, gravity = screw_lines()
    joints = []
    for i, (direction, point) in enumerate(lines):
        across = np.cross(direction, [0.3, -0.5, 0.8])
        across /= np.linalg.norm(across)
        turned = direction + 1.1e-5 * (1 + i) * across
        joints.append(
            {"direction_sensor": list(turned / np.linalg.norm(turned)), "point_sensor": list(point + 4e-5 * across)}
        )
    return {"joints": joints, "gravity_sensor": list(gravity)}
