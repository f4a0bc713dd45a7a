"""A robot's own URDF goes in and comes out changed only where meant; other programs read the calibrated arm from it."""

import difflib
import json
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import circlepoint
from circlepoint.export import (
    calibrated_arm,
    export_result,
    write_calibrated_urdf,
    write_description,
    write_export,
)
from circlepoint.export.urdf import export_urdf

SAME_POSE = 1e-9
REAL = ["ur5", "panda", "iiwa"]

SMALL = """<?xml version="1.0"?>
<!-- by hand -->
<robot name="small">
  <link name="world"/><link name="base"/>
  <link name="one"><visual><origin xyz="1 2 3"/><geometry><mesh filename="package://a/b.stl"/></geometry></visual></link>
  <link name="two"/><link name="three"/><link name="tool"/>
  <joint name="stand" type="fixed"><parent link="world"/><child link="base"/></joint>
  <joint name="a" type="continuous">
    <parent link="base"/> <!-- no origin -->
    <child link="one"/>
    <axis xyz="0 0 2"/>
  </joint>
  <joint name="b" type="revolute">
    <origin   rpy = '0.1 0 0'
       xyz='0.2 0 0' />
    <parent link="one"/><child link="two"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="c" type="prismatic"><origin xyz="0 0 .3"/><parent link="two"/><child link="three"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="grip" type="fixed"><origin xyz="0 0 0.1" rpy="0 0 1"/><parent link="three"/><child link="tool"/></joint>
  <transmission name="t"><joint name="a"><origin xyz="9 9 9"/></joint></transmission>
</robot>
"""


def pinocchio_pose(text, tip, joints):
    pin = pytest.importorskip("pinocchio")
    model = pin.buildModelFromXML(text)
    data = model.createData()
    frame = model.getFrameId(tip)
    neutral = pin.neutral(model)

    def pose(q):
        full = neutral.copy()
        for name, value in zip(joints, q, strict=True):
            joint = model.joints[model.getJointId(name)]
            full[joint.idx_q : joint.idx_q + joint.nq] = value if joint.nq == 1 else (np.cos(value), np.sin(value))
        pin.framesForwardKinematics(model, data, full)
        return data.oMf[frame].homogeneous

    return pose


def pinocchio_base(text, base):
    pin = pytest.importorskip("pinocchio")
    model = pin.buildModelFromXML(text)
    data = model.createData()
    pin.framesForwardKinematics(model, data, pin.neutral(model))
    return data.oMf[model.getFrameId(base)].homogeneous


@pytest.mark.parametrize("robot", REAL)
def test_pinocchio_reads_the_calibrated_arm_from_a_real_urdf(robot, built_robot):
    file, built = built_robot(robot)
    export = export_urdf(calibrated_arm(built.document), file.text, base=file.base, tip=file.tip)
    text, notes = export.texts[".urdf"], export.document
    T_base_world = np.linalg.inv(pinocchio_base(text, file.base))
    pose = pinocchio_pose(text, file.tip, file.joints)
    sensor = np.array(notes["T_tip_sensor"])
    assert built.moves_as(lambda q: T_base_world @ pose(q) @ sensor, notes["T_base_sensor_at_reference"]) < SAME_POSE


@pytest.mark.parametrize("robot", REAL)
def test_yourdfpy_reads_the_calibrated_arm_from_a_real_urdf(robot, built_robot, tmp_path):
    yourdfpy = pytest.importorskip("yourdfpy")
    file, built = built_robot(robot)
    export = export_urdf(calibrated_arm(built.document), file.text, base=file.base, tip=file.tip)
    path = tmp_path / "arm.urdf"
    path.write_text(export.texts[".urdf"])
    model = yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=True)
    rest = dict.fromkeys(model.actuated_joint_names, 0.0)
    sensor = np.array(export.document["T_tip_sensor"])

    def pose(q):
        model.update_cfg(rest | dict(zip(file.joints, q, strict=True)))
        return model.get_transform(file.tip, file.base) @ sensor

    assert built.moves_as(pose, export.document["T_base_sensor_at_reference"], n=1000) < SAME_POSE


@pytest.mark.parametrize("robot", REAL)
def test_only_the_origins_of_the_chains_joints_change(robot, built_robot):
    file, built = built_robot(robot)
    text = write_calibrated_urdf(file.text, built.document, file.base, file.tip)
    changed = [
        line
        for line in difflib.ndiff(file.text.splitlines(keepends=True), text.splitlines(keepends=True))
        if line[0] in "+-"
    ]
    assert len(changed) == 2 * len(file.joints)
    assert all("<origin" in line for line in changed)
    hidden = re.compile(r'(<origin\b[^>]*?)\b(xyz|rpy)="[^"]*"([^>]*?)\b(xyz|rpy)="[^"]*"')
    assert hidden.sub(r"\1\2\3\4", text) == hidden.sub(r"\1\2\3\4", file.text)
    before, after = (list(ET.fromstring(source).iter()) for source in (file.text, text))
    parents = {child: parent for parent in after for child in parent}
    different = [
        parents[new].get("name")
        for old, new in zip(before, after, strict=True)
        if (old.tag, old.attrib, old.text, old.tail) != (new.tag, new.attrib, new.text, new.tail)
    ]
    assert different == file.joints


@pytest.mark.parametrize("robot", REAL)
def test_origins_move_no_further_than_the_arm_is_off_its_drawing(robot, built_robot):
    file, built = built_robot(robot, offset=0.0, direction=1e-3, place=1e-3)
    moved = export_urdf(calibrated_arm(built.document), file.text, base=file.base, tip=file.tip).document[
        "joints_moved"
    ]
    assert max(entry["distance"] for entry in moved.values()) < 2e-2
    assert max(entry["angle"] for entry in moved.values()) < 2e-2


@pytest.mark.parametrize("robot", REAL)
def test_an_arm_built_as_drawn_keeps_its_file_byte_for_byte(robot, built_robot):
    file, built = built_robot(robot, offset=0.0, direction=0.0, place=0.0)
    assert write_calibrated_urdf(file.text, built.document, file.base, file.tip) == file.text


def test_the_zeros_of_encoders_are_found_and_go_into_the_origins(built_robot):
    file, built = built_robot("panda", direction=0.0, place=0.0, offset=0.1)
    export = export_urdf(calibrated_arm(built.document), file.text, base=file.base, tip=file.tip)
    offsets = np.array(list(export.document["joint_offsets"].values()))
    assert np.max(np.abs(offsets - built.offsets)) < 1e-6
    angles = np.array([entry["angle"] for entry in export.document["joints_moved"].values()])
    assert angles == pytest.approx(np.abs(built.offsets), abs=1e-6)
    assert max(entry["distance"] for entry in export.document["joints_moved"].values()) < 1e-6


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_odd_but_legal_text_survives(newline, built_urdf):
    joints = ["a", "b", "c"]
    text = "\ufeff" + SMALL.replace("\n", newline)
    built = built_urdf(text, joints)
    export = export_urdf(calibrated_arm(built.document), text, base="world", tip="tool")
    found = export.texts[".urdf"]
    assert found.startswith("\ufeff<?xml")
    assert found.count("\r\n") == text.count("\r\n") + (newline == "\r\n")
    assert found.count("<origin") == text.count("<origin") + 1
    for kept in (
        "<!-- by hand -->",
        "<!-- no origin -->",
        '<origin xyz="1 2 3"/>',
        '<origin xyz="9 9 9"/>',
        "package://a/b.stl",
    ):
        assert kept in found
    sensor = np.array(export.document["T_tip_sensor"])
    pose = pinocchio_pose(found.removeprefix("\ufeff"), "tool", joints)
    assert built.moves_as(lambda q: pose(q) @ sensor, export.document["T_base_sensor_at_reference"]) < SAME_POSE


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<!-- by hand -->", '<!DOCTYPE robot [<!ENTITY x "1">]>', "has a document type"),
        ('<link name="two"/>', '<xacro:arm name="x"/><link name="two"/>', "run `xacro`"),
        ("xyz='0.2 0 0'", "xyz='0.2 0'", "line 15: joint 'b' <origin>: xyz=\"0.2 0\" must be 3 numbers"),
        ('<axis xyz="0 1 0"/>', '<axis xyz="0 0 0"/>', "has no direction"),
        ('type="continuous"', 'type="floating"', "joint 'a': is of type 'floating'"),
        ('<joint name="b" type="revolute">', '<joint name="b2" type="revolute">', "has no joint 'b'"),
        ('<joint name="b" type="revolute">', '<joint name="a" type="revolute">', "two joints are named 'a'"),
        ("</robot>", "", "is not XML"),
    ],
)
def test_a_urdf_that_will_not_do_is_refused_with_the_reason(old, new, message, built_urdf):
    built = built_urdf(SMALL, ["a", "b", "c"])
    with pytest.raises(circlepoint.InvalidInput, match=re.escape(message)):
        write_calibrated_urdf(SMALL.replace(old, new), built.document, "world", "tool")


@pytest.mark.parametrize(
    ("base", "tip", "message"),
    [
        ("nowhere", None, "--base 'nowhere' is not a link"),
        ("tool", "base", "link 'tool' (--base) is not on the way"),
        ("one", "tool", "from 'one' to 'tool' the joints b, c move"),
    ],
)
def test_links_that_do_not_bound_the_calibrated_joints_are_refused(base, tip, message, built_urdf):
    built = built_urdf(SMALL, ["a", "b", "c"])
    with pytest.raises(circlepoint.InvalidInput, match=re.escape(message)):
        write_calibrated_urdf(SMALL, built.document, base, tip)


def test_the_urdf_of_another_arm_is_refused(built_robot):
    file, built = built_robot("iiwa", offset=1.0)
    with pytest.raises(circlepoint.InvalidInput, match="does not describe the calibrated arm"):
        write_calibrated_urdf(file.text, built.document, file.base, file.tip)


@pytest.mark.parametrize("kind", ["general", "modified", "prismatic"])
def test_without_a_urdf_a_minimal_one_carries_the_arm(kind, arms, result_folder):
    folder, built = result_folder(arms[kind])
    export = export_result(folder, "urdf")
    written = write_export(export, folder, "urdf")
    assert [path.name for path in written] == ["arm.urdf.yaml", "arm.urdf"]
    pose = pinocchio_pose((folder / "arm.urdf").read_text(), "sensor", built.names)
    assert built.moves_as(pose, export.document["T_base_sensor_at_reference"]) < SAME_POSE


def test_without_any_nominal_arm_the_base_is_the_sensor_at_the_reference(arms, result_folder):
    folder, built = result_folder(arms["general"])
    (folder / "arm.yaml").unlink()
    export = export_result(folder, "urdf")
    assert export.document["base_frame"] == "sensor_at_reference"
    assert np.array(export.document["T_base_sensor_at_reference"]) == pytest.approx(np.eye(4))
    pose = pinocchio_pose(export.texts[".urdf"], "sensor", built.names)
    assert built.moves_as(pose, np.eye(4)) < SAME_POSE


def test_the_command_finds_the_nominal_urdf_kept_in_the_result(built_robot, tmp_path, capsys):
    from circlepoint.cli import main

    file, built = built_robot("ur5")
    (tmp_path / "calibration.json").write_text(json.dumps(built.document))
    (tmp_path / "nominal.urdf").write_bytes(file.text.encode())
    assert main(["export", str(tmp_path), "--to", "urdf", "--base", file.base, "--tip", file.tip]) == 0
    printed = capsys.readouterr().out
    assert "6 joint origins changed, nothing else" in printed
    assert "kept nominal: base frame (base_link)" in printed
    expected = write_calibrated_urdf(file.text, built.document, file.base, file.tip)
    assert (tmp_path / "arm.urdf").read_bytes().decode() == expected


@pytest.mark.parametrize("name", ["arm.urdf", "arm.URDF", "arm.xml", "arm.urdf.xacro", "description.txt"])
def test_every_file_that_holds_a_urdf_is_kept_and_comes_back_as_one(name, built_robot, tmp_path):
    file, built = built_robot("ur5")
    came = tmp_path / name
    came.write_bytes(file.text.encode())
    folder = tmp_path / "result"
    folder.mkdir()
    written = write_description(folder, came, built.document, base=file.base, tip=file.tip)
    assert [path.name for path in written] == ["nominal.urdf", "arm.urdf.yaml", "arm.urdf"]
    assert (folder / "arm.urdf").read_bytes().decode() == write_calibrated_urdf(
        file.text, built.document, file.base, file.tip
    )
    exported = export_result(write_result(folder, built), "urdf", arm=came, base=file.base, tip=file.tip)
    assert exported.texts[".urdf"] == (folder / "arm.urdf").read_text()


def write_result(folder, built):
    (folder / "calibration.json").write_text(json.dumps(built.document))
    return folder


def test_the_tip_the_arm_was_calibrated_with_is_that_of_the_urdf_written(built_robot, tmp_path):
    file, built = built_robot("panda")
    (tmp_path / "arm.urdf").write_bytes(file.text.encode())
    notes = []
    for tip in ("panda_hand", "panda_hand_tcp"):
        (tmp_path / tip).mkdir()
        write_description(tmp_path / tip, tmp_path / "arm.urdf", built.document, base=file.base, tip=tip)
        notes.append((tmp_path / tip / "arm.urdf.yaml").read_text())
    assert "tip_frame: panda_hand\n" in notes[0]
    assert "tip_frame: panda_hand_tcp\n" in notes[1]
