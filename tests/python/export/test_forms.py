"""Each exported form, read by a program that knows nothing of this one, moves as the calibrated arm does."""

import csv
import json
import math

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

import circlepoint
from circlepoint.cli import main
from circlepoint.export import FORMS, export_result, write_export
from circlepoint.transforms import quaternion_xyzw, rotation_from_rpy, rpy_of_rotation

SAME_POSE = 1e-9
KINDS = ["general", "modified", "prismatic"]


def reread(export, folder, ending, asked="form"):
    path = folder / f"{asked}{ending}"
    write_export(export, folder, asked, path)
    text = path.read_text()
    return json.loads(text) if ending == ".json" else yaml.safe_load(text)


def screw_about(axis, angle, distance):
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_rotvec(angle * np.eye(3)[axis]).as_matrix()
    pose[axis, 3] = distance
    return pose


def corners(document):
    return np.array(document["base"]), np.array(document["tool"])


@pytest.mark.parametrize("ending", [".json", ".yaml"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("form", ["dh", "mdh"])
def test_the_robotics_toolbox_reads_denavit_hartenberg_rows(form, kind, ending, arms, result_folder):
    rtb = pytest.importorskip("roboticstoolbox")
    folder, built = result_folder(arms[kind])
    document = reread(export_result(folder, form), folder, ending)
    turning = rtb.RevoluteDH if form == "dh" else rtb.RevoluteMDH
    sliding = rtb.PrismaticDH if form == "dh" else rtb.PrismaticMDH
    links = []
    for row, kind_name in zip(document["rows"], document["joint_types"], strict=True):
        if kind_name == "revolute":
            links.append(turning(d=row["d"], a=row["a"], alpha=row["alpha"], offset=row["theta"]))
        else:
            links.append(sliding(theta=row["theta"], a=row["a"], alpha=row["alpha"], offset=row["d"]))
    robot = rtb.DHRobot(links)
    base, tool = corners(document)

    def pose(q):
        found = np.eye(4)
        for link, value in zip(robot.links, q, strict=True):
            found = found @ link.A(value).A
        return base @ found @ tool

    assert built.moves_as(pose, document["T_base_sensor_at_reference"]) < SAME_POSE


@pytest.mark.parametrize("kind", [*KINDS, "ur5"])
def test_hayati_rows_multiply_to_the_calibrated_arm(kind, arms, result_folder):
    folder, built = result_folder(arms[kind])
    document = reread(export_result(folder, "hayati"), folder, ".yaml")
    base, tool = corners(document)

    def pose(q):
        found = base
        for row, kind_name, value in zip(document["rows"], document["joint_types"], q, strict=True):
            turn, slide = (value, 0.0) if kind_name == "revolute" else (0.0, value)
            found = (
                found @ screw_about(2, row["theta"] + turn, row["d"] + slide) @ screw_about(0, row["alpha"], row["a"])
            )
            found = found @ screw_about(1, row["beta"], 0.0)
        return found @ tool

    assert built.moves_as(pose, document["T_base_sensor_at_reference"]) < SAME_POSE


@pytest.mark.parametrize("kind", KINDS)
def test_modern_robotics_reads_the_product_of_exponentials(kind, arms, result_folder):
    mr = pytest.importorskip("modern_robotics")
    folder, built = result_folder(arms[kind])
    document = reread(export_result(folder, "poe"), folder, ".json")
    at_zero = document["at_zero"]
    zero_screws = np.array([screw["screw"] for screw in at_zero["screws"]]).T
    screws = np.array([screw["screw"] for screw in document["screws"]]).T
    reference = np.array(document["reference_configuration"])
    home, home_at_zero = np.array(document["home"]), np.array(at_zero["home"])
    T_base_sensor = document["T_base_sensor_at_reference"]
    assert built.moves_as(lambda q: mr.FKinSpace(home, screws, q - reference), T_base_sensor) < SAME_POSE
    assert built.moves_as(lambda q: mr.FKinSpace(home_at_zero, zero_screws, q), T_base_sensor) < SAME_POSE
    for entry in document["screws"]:
        if entry["type"] == "revolute":
            assert np.cross(entry["point"], entry["direction"]) == pytest.approx(entry["screw"][3:])


@pytest.mark.parametrize("kind", [*KINDS, "ur5"])
def test_pinocchio_takes_the_joint_placements(kind, arms, result_folder):
    pin = pytest.importorskip("pinocchio")
    folder, built = result_folder(arms[kind])
    document = reread(export_result(folder, "pinocchio"), folder, ".json")
    model = pin.Model()

    def placed(entry):
        return pin.SE3(np.array(entry["rotation"]), np.array(entry["translation"]))

    for joint in document["serial_joints"]:
        kind_of_joint = getattr(pin, joint["model"])(np.array(joint["axis"]))
        model.addJoint(model.getJointId(joint["parent"]), kind_of_joint, placed(joint["placement"]), joint["name"])
    sensor = next(frame for frame in document["frames"] if frame["name"] == "sensor")
    data = model.createData()
    last = model.getJointId(sensor["parent"])

    def pose(q):
        pin.forwardKinematics(model, data, q)
        return (data.oMi[last] * placed(sensor["placement"])).homogeneous

    assert built.moves_as(pose, document["T_base_sensor_at_reference"]) < SAME_POSE


@pytest.mark.parametrize("kind", [*KINDS, "ur5"])
def test_kdl_segments_multiply_to_the_calibrated_arm(kind, arms, result_folder):
    folder, built = result_folder(arms[kind])
    document = reread(export_result(folder, "kdl"), folder, ".yaml")

    def joint_pose(joint, value):
        # KDL::Joint::pose: RotAxis turns about an axis through its origin, which stays; TransAxis adds to the origin.
        found = np.eye(4)
        if joint["type"] == "RotAxis":
            found[:3, :3] = Rotation.from_rotvec(value * np.array(joint["axis"])).as_matrix()
            found[:3, 3] = joint["origin"]
        elif joint["type"] == "TransAxis":
            found[:3, 3] = np.array(joint["origin"]) + value * np.array(joint["axis"])
        return found

    def pose(q):
        values = iter(q)
        found = np.eye(4)
        for segment in document["segments"]:
            joint, frame = segment["joint"], np.eye(4)
            frame[:3, :3] = Rotation.from_quat(segment["frame"]["quaternion_xyzw"]).as_matrix()
            frame[:3, 3] = segment["frame"]["position"]
            value = 0.0 if joint["type"] == "Fixed" else next(values)
            # KDL::Segment::pose: joint.pose(q) * f_tip with f_tip = joint.pose(0)^-1 * frame.
            found = found @ joint_pose(joint, value) @ np.linalg.inv(joint_pose(joint, 0.0)) @ frame
        return found

    assert built.moves_as(pose, document["T_base_sensor_at_reference"]) < SAME_POSE


def test_pinocchio_moves_as_the_universal_robots_yaml_says(arms, result_folder):
    pin = pytest.importorskip("pinocchio")
    folder, built = result_folder(arms["ur5"])
    export = export_result(folder, "ur")
    assert [path.name for path in write_export(export, folder, "ur")] == ["ur_kinematics.yaml"]
    content = yaml.safe_load((folder / "ur_kinematics.yaml").read_text())
    assert list(content) == ["kinematics"]
    kinematics = content["kinematics"]
    links = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"]
    assert list(kinematics) == [*links, "hash"]
    assert kinematics["hash"].startswith("circlepoint_")
    model = pin.Model()
    for index, link in enumerate(links):
        entry = kinematics[link]
        rotation = pin.rpy.rpyToMatrix(entry["roll"], entry["pitch"], entry["yaw"])
        placement = pin.SE3(rotation, np.array([entry["x"], entry["y"], entry["z"]]))
        model.addJoint(index, pin.JointModelRZ(), placement, link)
    data = model.createData()
    tip_sensor = np.array(export.document["T_tip_sensor"])

    def pose(q):
        pin.forwardKinematics(model, data, q)
        return data.oMi[6].homogeneous @ tip_sensor

    assert built.moves_as(pose, export.document["T_base_sensor_at_reference"]) < SAME_POSE


def test_an_arm_as_drawn_has_the_makers_universal_robots_yaml(arms, result_folder):
    folder, _ = result_folder(arms["ur5"], direction=0.0, place=0.0, offset=0.0)
    kinematics = export_result(folder, "ur", checksum="calib_1").document["kinematics"]
    # ur_description's ur5/default_kinematics.yaml, rounded
    assert kinematics["hash"] == "calib_1"
    expected = {
        "shoulder": (0, 0, 0.089159, 0, 0, 0),
        "upper_arm": (0, 0, 0, math.pi / 2, 0, 0),
        "forearm": (-0.425, 0, 0, 0, 0, 0),
        "wrist_1": (-0.39225, 0, 0.10915, 0, 0, 0),
        "wrist_2": (0, -0.09465, 0, math.pi / 2, 0, 0),
        "wrist_3": (0, 0.0823, 0, math.pi / 2, math.pi, math.pi),
    }
    for link, values in expected.items():
        found = list(kinematics[link].values())
        assert found[:3] == pytest.approx(values[:3], abs=1e-9)
        assert rotation_from_rpy(found[3:]) == pytest.approx(rotation_from_rpy(values[3:]), abs=1e-9)


@pytest.mark.parametrize("form", ["dh", "mdh"])
def test_near_parallel_axes_make_no_long_link_and_the_export_says_so(form, arms, result_folder, capsys):
    folder, _ = result_folder(arms["ur5"], direction=3e-4)
    assert main(["export", str(folder), "--to", form]) == 0
    printed = capsys.readouterr().out
    assert "joint2 and joint3" in printed
    assert "nearly parallel" in printed
    document = yaml.safe_load((folder / f"{form}.yaml").read_text())
    assert document["form"] == "hayati"
    assert document["asked_for"] == form
    assert [row["form"] for row in document["rows"]] == ["dh", "hayati", "hayati", "dh", "dh", "dh"]
    for row in document["rows"]:
        assert abs(row["d"]) < 0.5
        assert abs(row["a"]) < 0.5
        assert all(value == "free" or value < 1e-3 for value in row["std"].values())


def test_rows_as_drawn_are_the_drawing_and_offsets_are_stated(arms, result_folder):
    folder, built = result_folder(arms["general"], direction=0.0, place=0.0, offset=0.05)
    document = export_result(folder, "dh").document
    for row, expected in zip(document["rows"], arms["general"].rows, strict=True):
        assert (row["a"], row["alpha"], row["d"]) == pytest.approx(expected[:3], abs=1e-9)
    stated = [row["joint_offset"] for row in document["rows"]]
    assert stated == pytest.approx(list(built.offsets), abs=1e-9)
    assert list(document["joint_offsets"].values()) == pytest.approx(list(built.offsets), abs=1e-7)
    assert document["rows"][0]["std"]["theta"] == "free"
    assert document["rows"][1]["std"]["theta"] < 1e-3


def test_what_cannot_be_observed_is_listed(arms, result_folder):
    folder, _ = result_folder(arms["prismatic"])
    kept = {entry["quantity"] for entry in export_result(folder, "poe").document["kept_nominal"]}
    assert kept == {
        "base frame (base)",
        "zero of joint1",
        "zero of joint6",
        "flange relative to joint6",
        "place of the axis of joint3",
    }


def test_json_and_yaml_hold_the_same_numbers(arms, result_folder):
    folder, _ = result_folder(arms["general"])
    for form in FORMS:
        if form in {"ur", "urdf", "table"}:
            continue
        export = export_result(folder, form)
        assert reread(export, folder, ".json") == reread(export, folder, ".yaml") == export.document


def test_the_table_shows_the_change_with_its_interval(arms, result_folder, capsys):
    folder, _ = result_folder(arms["ur5"])
    assert main(["export", str(folder), "--to", "table"]) == 0
    printed = capsys.readouterr().out
    assert (folder / "table.md").read_text() in printed
    with (folder / "table.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    beta = [row for row in rows if row["parameter"] == "beta"]
    assert [row["joint"] for row in beta] == ["joint2", "joint3"]
    lengths = [row for row in rows if row["joint"] == "joint2" and row["parameter"] == "a"]
    assert float(lengths[0]["nominal"]) == pytest.approx(-425.0)
    assert lengths[0]["unit"] == "mm"
    for row in rows:
        if row["nominal"] and row["change"]:
            assert float(row["change"]) == pytest.approx(float(row["calibrated"]) - float(row["nominal"]))
    # The interval is 1.96 standard deviations: 4.5e-5 m of the worst principal direction of an axis' place.
    place = next(row for row in rows if row["parameter"] == "axis place off nominal")
    assert float(place["interval_95"]) == pytest.approx(1.96 * 1e3 * math.sqrt(2e-9), rel=1e-3)
    kept = [
        (row["joint"], row["parameter"])
        for row in rows
        if row["parameter"] in "a alpha d theta" and not row["interval_95"]
    ]
    assert kept == [("joint1", "d"), ("joint1", "theta"), *(("joint6", key) for key in ("a", "alpha", "d", "theta"))]


def test_intervals_cover_what_the_covariance_says(arms, result_folder):
    # Parameters of arms drawn from the document's covariance scatter as the stated standard deviations.
    folder, built = result_folder(arms["general"])
    export = export_result(folder, "hayati").document
    stated = np.array([[row["std"].get(key) for key in ("a", "alpha", "d", "theta")] for row in export["rows"][:-1]])
    random = np.random.default_rng(3)
    std = np.sqrt([1e-10, 2e-10, 1e-9, 2e-9])
    scatter = []
    for _ in range(300):
        axes = [
            circlepoint.ScrewAxis(axis.type, circlepoint.retract(axis.line, random.normal(0.0, 1.0, 4) * std))
            for axis in built.chain.axes
        ]
        rows = circlepoint.to_hayati(circlepoint.ScrewChain(axes, built.chain.reference_configuration)).chain.rows
        scatter.append([[row.a, row.alpha, row.d, row.theta] for row in rows[:-1]])
    spread = np.std(np.array(scatter), axis=0)
    for row in range(len(stated)):
        for column in range(4):
            if stated[row, column] != "free":
                assert spread[row, column] == pytest.approx(float(stated[row, column]), rel=0.2)


@pytest.mark.parametrize("form", FORMS)
def test_an_incomplete_result_writes_nothing_and_names_the_joints(form, arms, result_folder, capsys):
    folder, built = result_folder(arms["ur5"])
    document = built.document
    for index in (2, 4):
        document["joints"][index] |= {"direction_sensor": None, "point_sensor": None, "reason": "it never moved alone"}
    document["complete"] = False
    (folder / "calibration.json").write_text(json.dumps(document))
    before = sorted(folder.iterdir())
    assert main(["export", str(folder), "--to", form]) == 1
    message = capsys.readouterr().err
    assert "joint3: it never moved alone; joint5" in message
    assert sorted(folder.iterdir()) == before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["{folder}/none", "--to", "dh"], "calibration.json: cannot be read"),
        (["{folder}", "--to", "dh", "--out", "{folder}/a.txt"], "not written as '.txt'"),
        (["{folder}", "--to", "ur"], "not of Universal Robots' kind"),
        (["{folder}", "--to", "dh", "--arm", "{folder}/other.yaml"], "has the joints one"),
        (["{folder}", "--to", "urdf", "--arm", "{folder}/none.urdf"], "none.urdf: cannot be read"),
        (["{folder}/broken", "--to", "poe"], "is not JSON"),
        (["{folder}/foreign", "--to", "poe"], "schema is 'other'"),
    ],
)
def test_bad_input_ends_with_status_2_and_says_what(arguments, message, arms, result_folder, capsys):
    folder, _ = result_folder(arms["general"])
    (folder / "other.yaml").write_text("name: other\njoints: [{name: one, type: revolute}]\n")
    for name, content in (("broken", "{"), ("foreign", '{"schema": "other"}')):
        (folder / name).mkdir()
        (folder / name / "calibration.json").write_text(content)
    before = sorted(folder.rglob("*"))
    assert main(["export", *(word.format(folder=folder) for word in arguments)]) == 2
    assert message in capsys.readouterr().err
    assert sorted(folder.rglob("*")) == before


def test_json_goes_to_programs_and_no_file_is_written(arms, result_folder, capsys):
    folder, _ = result_folder(arms["general"])
    before = sorted(folder.iterdir())
    assert main(["export", str(folder), "--to", "poe", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["form"] == "poe"
    assert sorted(folder.iterdir()) == before


@pytest.mark.parametrize("pitch", [0.3, math.pi / 2, -math.pi / 2, math.pi / 2 - 1e-7, math.pi / 2 + 1e-9, 3.0])
def test_roll_pitch_yaw_are_exact_at_right_angles_too(pitch):
    for roll, yaw in [(0.1, -2.0), (3.1, 0.4), (0.0, 0.0)]:
        rotation = Rotation.from_euler("xyz", [roll, pitch, yaw]).as_matrix()
        assert rotation_from_rpy((roll, pitch, yaw)) == pytest.approx(rotation, abs=1e-15)
        assert rotation_from_rpy(rpy_of_rotation(rotation)) == pytest.approx(rotation, abs=1e-14)
        quaternion = quaternion_xyzw(rotation)
        assert Rotation.from_quat(quaternion).as_matrix() == pytest.approx(rotation, abs=1e-14)
    assert rpy_of_rotation(rotation_from_rpy((0.5, 0.2, -0.1)), (7.0, 0.0, 0.0)) == pytest.approx(
        (0.5 + 2 * math.pi, 0.2, -0.1)
    )
