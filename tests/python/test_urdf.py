"""Arms from URDFs: the axes are where an independent reader puts them, and what is no serial arm is refused."""

import importlib.metadata

import mujoco
import numpy as np
import pytest
from lxml import etree

import circlepoint
from circlepoint.arm import load_arm
from circlepoint.nominal import nominal_chain
from circlepoint.urdf import read_urdf

PUBLIC = {
    "UR5": ("example-robot-data", "ur_description/urdf/ur5_robot.urdf", "world", "tool0", 6),
    "Panda": ("example-robot-data", "panda_description/urdf/panda.urdf", "panda_link0", "panda_hand", 7),
    "iiwa": ("rtb-data", "kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820.urdf", "base_link", "tool0", 7),
}


def public_urdf(name):
    """The file of a robot that a package of the test group carries; the test is skipped without it."""
    package, ending, base, tip, joints = PUBLIC[name]
    try:
        files = importlib.metadata.files(package) or []
    except importlib.metadata.PackageNotFoundError:
        pytest.skip(f"{package} is not installed (pip install --group test)")
    path = next(file.locate() for file in files if str(file).endswith(ending))
    return path, base, tip, joints


def in_mujoco(path):
    """The same file in a physics engine: no meshes, nothing fused."""
    robot = etree.parse(path).getroot()
    for element in robot.xpath("//visual | //collision | //transmission | //gazebo"):
        element.getparent().remove(element)
    extension = etree.SubElement(etree.SubElement(robot, "mujoco"), "compiler")
    for name, value in (("fusestatic", "false"), ("boundmass", "0.1"), ("boundinertia", "0.1")):
        extension.set(name, value)
    model = mujoco.MjModel.from_xml_string(etree.tostring(robot).decode())
    return model, mujoco.MjData(model)


def body_pose(data, name):
    pose = np.eye(4)
    pose[:3, :3] = data.body(name).xmat.reshape(3, 3)
    pose[:3, 3] = data.body(name).xpos
    return pose


@pytest.mark.parametrize("name", PUBLIC)
def test_forward_kinematics_of_public_robots_agrees_with_a_physics_engine(name):
    path, base, tip, joints = public_urdf(name)
    arm = load_arm(path, base=base, tip=tip)
    assert len(arm.joints) == joints
    assert all(joint.limits and joint.velocity for joint in arm.joints)
    model, data = in_mujoco(path)
    random = np.random.default_rng(1)
    chain = nominal_chain(arm, random.normal(size=joints))
    for q in random.uniform(-2, 2, (20, joints)):
        for joint, value in zip(arm.joint_names, q, strict=True):
            data.joint(joint).qpos[0] = value
        mujoco.mj_kinematics(model, data)
        origin = np.eye(4) if base == "world" else body_pose(data, base) if base in names(model) else np.eye(4)
        expected = np.linalg.solve(origin, body_pose(data, tip))
        np.testing.assert_allclose(circlepoint.forward_kinematics(chain, q), expected, atol=1e-9)


def names(model):
    return [model.body(index).name for index in range(model.nbody)]


TWO = """<?xml version="1.0"?>
<robot name="two">
  <!-- a comment -->
  <link name="foot"/> <link name="lower"/> <link name="column"/> <link name="upper"/> <link name="hand"/>
  <joint name="bolt" type="fixed">
    <parent link="foot"/> <child link="lower"/> <origin xyz="0 0 0.1" rpy="0 0 1.5707963267948966"/>
  </joint>
  <joint name="lift" type="prismatic">
    <parent link="lower"/> <child link="column"/> <origin xyz="0.2 0 0"/> <axis xyz="0 0 2"/>
    <limit lower="-0.1" upper="0.4" effort="1" velocity="0.5"/>
  </joint>
  <joint name="turn" type="continuous">
    <parent link="column"/> <child link="upper"/> <origin xyz="0 0.3 0" rpy="1.5707963267948966 0 0"/>
    <axis xyz="0 1 0"/>
  </joint>
  <joint name="weld" type="fixed"> <parent link="upper"/> <child link="hand"/> <origin xyz="0 0 0.5"/> </joint>
</robot>
"""


def written(tmp_path, text=TWO):
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    return path


def test_fixed_joints_are_folded_and_names_types_limits_kept(tmp_path):
    arm = load_arm(written(tmp_path))
    assert arm.name == "two"
    assert arm.joint_names == ("lift", "turn")
    lift, turn = arm.joints
    assert (lift.type, lift.limits, lift.velocity) == ("prismatic", (-0.1, 0.4), 0.5)
    assert (turn.type, turn.limits) == ("revolute", None)
    np.testing.assert_allclose(arm.lines.rows[0].direction, [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(arm.lines.rows[1].direction, [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(arm.lines.rows[1].point, [-0.3, 0.2, 0.1], atol=1e-12)


def test_base_and_tip_choose_a_part(tmp_path):
    path = written(tmp_path)
    arm = read_urdf(path, base="column")
    assert arm.joint_names == ("turn",)
    np.testing.assert_allclose(arm.lines.rows[0].point, [0, 0.3, 0], atol=1e-12)
    assert read_urdf(path, tip="column").joint_names == ("lift",)


BAD = {
    "entities": (
        TWO.replace("<robot", '<!DOCTYPE robot [<!ENTITY a "0 0 1">]>\n<robot', 1),
        {},
        ["document type", "entities", "remove"],
    ),
    "external entity": (
        TWO.replace("<robot", '<!DOCTYPE robot [<!ENTITY a SYSTEM "file:///etc/hostname">]>\n<robot', 1).replace(
            "0 0 2", "&a;"
        ),
        {},
        ["entit"],
    ),
    "external DTD": (TWO.replace("<robot", '<!DOCTYPE robot SYSTEM "arm.dtd">\n<robot', 1), {}, ["document type"]),
    "inclusion": (
        TWO.replace("<!-- a comment -->", '<i:include xmlns:i="http://www.w3.org/2001/XInclude" href="b.xml"/>'),
        {},
        ["line 3", "another file"],
    ),
    "xacro element": (
        TWO.replace("<!-- a comment -->", '<x:include xmlns:x="http://www.ros.org/wiki/xacro" filename="b"/>'),
        {},
        ["line 3", "xacro", "arm.urdf"],
    ),
    "xacro value": (TWO.replace("0 0 0.1", "0 0 ${height}"), {}, ["line 6", "${height}", "xacro"]),
    "not XML": ("<robot", {}, ["not XML"]),
    "not a robot": ("<model/>", {}, ["<model>", "<robot>"]),
    "loop": (TWO.replace('<child link="hand"/>', '<child link="column"/>'), {}, ["'weld'", "column", "loop"]),
    "unknown parent": (TWO.replace('parent link="upper"', 'parent link="arm"'), {}, ["'weld'", "'arm'", "hand"]),
    "no parent": (TWO.replace('<parent link="upper"/>', ""), {}, ["'weld'", "<parent", "name the link"]),
    "zero axis": (TWO.replace("0 0 2", "0 0 0"), {}, ["line 9", "'lift'", "<axis>", "0 0 0"]),
    "text": (TWO.replace("0 0.3 0", "0 O.3 0"), {}, ["line 13", "'turn'", "<origin>", "0 O.3 0", "3 numbers"]),
    "not finite": (TWO.replace("0 0.3 0", "0 nan 0"), {}, ["'turn'", "nan", "finite"]),
    "two numbers": (TWO.replace("0 0.3 0", "0 1"), {}, ["'turn'", "3 numbers"]),
    "millimetres": (TWO.replace("0 0.3 0", "0 300 0"), {}, ["'turn'", "millimetres"]),
    "degrees": (TWO.replace('rpy="1.5707963267948966 0 0"', 'rpy="90 0 0"'), {}, ["'turn'", "degrees"]),
    "limits": (TWO.replace('lower="-0.1"', 'lower="0.9"'), {}, ["line 10", "'lift'", "0.9", "not below"]),
    "planar": (TWO.replace("continuous", "planar"), {}, ["'turn'", "'planar'", "--tip"]),
    "several ends": (TWO.replace('<link name="foot"/>', '<link name="foot"/><link name="box"/>'), {}, ["box", "--tip"]),
    "unknown tip": (TWO, {"tip": "finger"}, ["--tip", "'finger'", "hand"]),
    "base above tip": (TWO, {"base": "upper", "tip": "lower"}, ["'upper'", "--base", "lower, foot"]),
    "nothing moves": (TWO, {"base": "upper"}, ["no joint moves", "upper", "hand"]),
    "joint twice": (TWO.replace('name="weld"', 'name="turn"'), {}, ["two joints", "'turn'"]),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_urdf_says_where_and_what_to_do(name, tmp_path):
    text, chosen, words = BAD[name]
    path = written(tmp_path, text)
    with pytest.raises(circlepoint.InvalidInput) as caught:
        load_arm(path, **chosen)
    for word in (str(path), *words):
        assert word in str(caught.value)


def test_a_mimic_joint_beside_the_arm_does_not_matter(tmp_path):
    finger = (
        '<link name="finger"/><joint name="grip" type="revolute"><parent link="hand"/><child link="finger"/>'
        '<mimic joint="turn"/></joint></robot>'
    )
    assert load_arm(written(tmp_path, TWO.replace("</robot>", finger)), tip="hand").joint_names == ("lift", "turn")


def test_base_and_tip_of_an_arm_yaml_are_refused(tmp_path):
    path = tmp_path / "arm.yaml"
    path.write_text("name: a\njoints: [{name: a, type: revolute}]\n")
    with pytest.raises(circlepoint.InvalidInput, match="not a URDF"):
        load_arm(path, tip="tool0")


def test_lines_of_an_arm_yaml_are_the_same_chain_as_its_parameters(tmp_path):
    joints = "name: a\njoints: [{name: a, type: revolute}, {name: b, type: prismatic}, {name: c, type: revolute}]\n"
    parameters, lines = tmp_path / "dh.yaml", tmp_path / "lines.yaml"
    rows = [(0.2, 0.7, 0.1, 0.3), (0.1, -1.2, 0.3, 0.4), (0.3, 0.5, -0.2, -0.9)]
    text = "".join(f"    - {{a: {a}, alpha: {b}, d: {d}, theta: {t}}}\n" for a, b, d, t in rows)
    parameters.write_text(f"{joints}dh:\n  convention: standard\n  rows:\n{text}")
    reference = np.array([0.3, 0.1, -0.4])
    chain = nominal_chain(load_arm(parameters), reference)
    text = "".join(
        f"    - {{direction: {(2 * axis.line.direction).tolist()}, point: {axis.line.point.tolist()}}}\n"
        for axis in chain.axes
    )
    lines.write_text(f"{joints}lines:\n  reference_configuration: {reference.tolist()}\n  rows:\n{text}")
    elsewhere = np.array([-0.5, 0.2, 1.1])
    expected = nominal_chain(load_arm(parameters), elsewhere)
    for axis, other in zip(nominal_chain(load_arm(lines), elsewhere).axes, expected.axes, strict=True):
        np.testing.assert_allclose(axis.line.direction, other.line.direction, atol=1e-12)
        if axis.type == circlepoint.JointType.revolute:
            np.testing.assert_allclose(axis.line.point, other.line.point, atol=1e-12)
