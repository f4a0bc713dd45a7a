"""An arm's description, as it is written and as it is read."""

import math

import pytest

from circlepoint.arm import DhRow, load_arm


@pytest.fixture
def described(tmp_path):
    path = tmp_path / "arm.yaml"
    path.write_text(
        "name: scara\n"
        "joints:\n"
        "  - {name: pan, type: revolute, limits: [-2.9, 2.9], velocity: 3, acceleration: 1e1}\n"
        "  - {name: slide, type: prismatic}\n"
        "dh:\n"
        "  convention: modified\n"
        "  rows:\n"
        "    - {a: 0, alpha: 0.0, d: 0.5, theta: 0.0}\n"
        "    - {a: 2.5e-1, alpha: 3.14159265, d: 0.0, theta: 0.0}\n"
        "encoder: {counts_per_revolution: [4096, null]}\n"
    )
    return load_arm(path)


def test_every_field_is_read(described):
    assert described.name == "scara"
    assert described.joint_names == ("pan", "slide")
    pan, slide = described.joints
    assert pan.limits == (-2.9, 2.9)
    assert (pan.velocity, pan.acceleration) == (3.0, 10.0)
    assert (pan.unit, slide.unit) == ("rad", "m")
    assert slide.limits is None
    assert described.dh.convention == "modified"
    assert described.dh.rows[1] == DhRow(a=0.25, alpha=3.14159265, d=0.0, theta=0.0)


def test_encoder_counts_give_the_step_where_known(described):
    assert described.encoder_step(0) == pytest.approx(2 * math.pi / 4096)
    assert described.encoder_step(1) is None


def test_one_count_holds_for_every_joint_and_optional_parts_may_be_absent(tmp_path):
    path = tmp_path / "arm.yaml"
    joints = "joints: [{name: a, type: revolute}, {name: b, type: prismatic}]\n"
    path.write_text(f"name: x\n{joints}encoder: {{counts_per_revolution: 1000}}\n")
    arm = load_arm(path)
    assert arm.dh is None
    assert arm.encoder_step(1) == pytest.approx(1e-3)
    path.write_text(f"name: x\n{joints}")
    assert load_arm(path).encoder_step(0) is None


def test_the_arms_beside_the_shared_recordings_are_read(shared_data):
    arm = load_arm(shared_data / "real-ur5-imu-6" / "arm.yaml")
    assert len(arm.joints) == len(arm.dh.rows) == 6
