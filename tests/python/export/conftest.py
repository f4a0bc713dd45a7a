"""Calibrated arms whose every axis is a little off the nominal one, and the robots' own files of other packages."""

from __future__ import annotations

import json
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import circlepoint
from circlepoint.document import SCHEMA_NAME, joint_entry
from circlepoint.export.nominal_frames import frames_of_urdf
from circlepoint.urdf_xml import parse_urdf

ROBOTS = {
    "ur5": ("example-robot-data", "ur_description/urdf/ur5_robot.urdf", "base_link", "tool0"),
    "panda": ("example-robot-data", "panda_description/urdf/panda.urdf", "panda_link0", "panda_hand_tcp"),
    "iiwa": ("rtb-data", "lbr_iiwa_14_r820.urdf", "base_link", "tool0"),
}
JOINTS = {
    "ur5": [f"{part}_joint" for part in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")],
    "panda": [f"panda_joint{i + 1}" for i in range(7)],
    "iiwa": [f"joint_a{i + 1}" for i in range(7)],
}
UR5_ROWS = [
    (0.0, np.pi / 2, 0.089159, 0.0),
    (-0.425, 0.0, 0.0, 0.0),
    (-0.39225, 0.0, 0.0, 0.0),
    (0.0, np.pi / 2, 0.10915, 0.0),
    (0.0, -np.pi / 2, 0.09465, 0.0),
    (0.0, 0.0, 0.0823, 0.0),
]


@dataclass(frozen=True)
class Built:
    """A built arm: its calibration document, and the pose of its sensor relative to that at the reference."""

    document: dict
    chain: circlepoint.ScrewChain
    names: list[str]
    offsets: np.ndarray

    def moves_as(self, pose_of, T_base_sensor_at_reference, n=1000, span=3.0):
        """Largest difference of `pose_of(q)` from the calibrated forward kinematics over n configurations."""
        q = np.random.default_rng(5).uniform(-span, span, (n, len(self.names)))
        expected = np.asarray(T_base_sensor_at_reference) @ circlepoint.forward_kinematics(self.chain, q)
        return max(float(np.max(np.abs(pose_of(row) - pose))) for row, pose in zip(q, expected, strict=True))


def build(nominal, names, *, seed=1, direction=1e-3, place=1e-3, offset=0.02, reference=None):
    """Build an arm off its nominal chain (a function of the reference), with a sensor somewhere on its end."""
    random = np.random.default_rng(seed)
    n = len(names)
    reference = random.uniform(-1.5, 1.5, n) if reference is None else np.asarray(reference, dtype=float)
    offsets = random.normal(0.0, 1.0, n) * offset
    offsets[[0, -1]] = 0.0
    drawn = nominal(reference + offsets)
    mount = np.eye(4)
    mount[:3, :3] = circlepoint.rotation_exp(random.normal(0.0, 1.0, 3))
    mount[:3, 3] = random.normal(0.0, 0.05, 3)
    T_sensor_base = np.linalg.inv(np.asarray(drawn.home) @ mount)
    axes = []
    for axis in drawn.axes:
        local = random.normal(0.0, 1.0, 4) * [direction, direction, place, place]
        line = circlepoint.transform(T_sensor_base, axis.line)
        axes.append(circlepoint.ScrewAxis(axis.type, circlepoint.retract(line, local)))
    chain = circlepoint.ScrewChain(axes, reference)
    return Built(document_of(chain, names), chain, list(names), offsets)


def document_of(chain, names, name="built-arm"):
    joints = []
    for joint, axis in zip(names, chain.axes, strict=True):
        revolute = axis.type == circlepoint.JointType.revolute
        covariance = np.diag([1e-10, 2e-10, 1e-9 * revolute, 2e-9 * revolute])
        joints.append(
            joint_entry(
                joint,
                axis.type.name,
                direction=axis.line.direction,
                point=axis.line.point,
                direction_std=1.5e-5,
                point_std=4.5e-5,
                covariance=covariance,
                basis=circlepoint.tangent_basis(axis.line.direction).T,
            )
        )
    return {
        "schema": SCHEMA_NAME,
        "arm": name,
        "complete": True,
        "reference_configuration": np.asarray(chain.reference_configuration).tolist(),
        "joints": joints,
        "covariance": None,
        "dh": {"convention": "standard"},
    }


def dh_arm(rows, convention="standard", types=None):
    """Nominal chain as a function of the reference, and the arm.yaml text it is written as."""
    kinds = types or ["revolute"] * len(rows)
    names = [f"joint{i + 1}" for i in range(len(rows))]
    kind = circlepoint.StandardDhChain if convention == "standard" else circlepoint.ModifiedDhChain
    chain = kind([circlepoint.DhRow(*row) for row in rows], [circlepoint.JointType[name] for name in kinds])
    lines = ["name: built-arm", "joints:"]
    lines += [f"  - {{name: {name}, type: {kind_name}}}" for name, kind_name in zip(names, kinds, strict=True)]
    lines += ["dh:", f"  convention: {convention}", "  rows:"]
    lines += [f"    - {{a: {a!r}, alpha: {alpha!r}, d: {d!r}, theta: {theta!r}}}" for a, alpha, d, theta in rows]

    def nominal(reference):
        return circlepoint.to_screws(chain, np.ascontiguousarray(reference), circlepoint.BaseFrame.chain_base)

    return SimpleNamespace(nominal=nominal, names=names, yaml="\n".join(lines) + "\n", rows=rows)


@pytest.fixture(scope="session")
def robot_file():
    """The text of a robot's URDF as its maker's package has it, with base, tip and joints."""

    def find(robot):
        package, ending, base, tip = ROBOTS[robot]
        try:
            files = metadata.files(package) or []
        except metadata.PackageNotFoundError:
            pytest.skip(f"{package} is not installed")
        path = next(Path(file.locate()) for file in files if str(file).endswith(ending))
        text = path.read_bytes().decode()
        return SimpleNamespace(path=path, text=text, base=base, tip=tip, joints=JOINTS[robot])

    return find


@pytest.fixture(scope="session")
def built_robot(robot_file):
    """A robot's file and the calibration of a built individual."""

    def make(robot, **options):
        file = robot_file(robot)
        frames = frames_of_urdf(parse_urdf(file.text).chain_of(file.joints, file.base, file.tip), robot)
        return file, build(frames.chain, file.joints, **options)

    return make


@pytest.fixture(scope="session")
def built_urdf():
    """The calibration of a built individual of a URDF's arm."""

    def make(text, joints, **options):
        return build(frames_of_urdf(parse_urdf(text).chain_of(joints), "URDF").chain, joints, **options)

    return make


@pytest.fixture
def result_folder(tmp_path):
    """Writes a result folder of a built arm, its arm.yaml beside."""

    def make(arm, **options):
        built = build(arm.nominal, arm.names, **options)
        folder = tmp_path / "result"
        folder.mkdir(exist_ok=True)
        (folder / "calibration.json").write_text(json.dumps(built.document))
        (folder / "arm.yaml").write_text(arm.yaml)
        return folder, built

    return make


@pytest.fixture(scope="session")
def arms():
    """Nominal arms: general, of Universal Robots' kind, with a prismatic joint, in the modified convention."""
    random = np.random.default_rng(11)
    general = [
        (random.uniform(-0.3, 0.3), (1, -1)[i % 2] * np.pi / 2, random.uniform(-0.3, 0.3), random.uniform(-1, 1))
        for i in range(7)
    ]
    sliding = [*general[:2], (0.05, np.pi / 2, 0.3, 0.2), *general[3:6]]
    types = ["revolute", "revolute", "prismatic", "revolute", "revolute", "revolute"]
    return {
        "general": dh_arm(general),
        "modified": dh_arm(general, "modified"),
        "ur5": dh_arm(UR5_ROWS),
        "prismatic": dh_arm(sliding, types=types),
    }
