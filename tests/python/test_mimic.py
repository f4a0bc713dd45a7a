"""Arms with joints that mimic others: one encoder, two lines, and a URDF that comes back with its mimic tags."""

import json
from xml.etree import ElementTree as ET

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

import circlepoint
from circlepoint.arm import Mimic, load_arm
from circlepoint.cli import main
from circlepoint.export import calibrated_arm
from circlepoint.recording_io import read_recording
from circlepoint.truth import truth_at, truth_chain

URDF = """<?xml version="1.0"?>
<robot name="geared">
  <link name="base"/><link name="one"/><link name="two"/><link name="three"/><link name="hand"/><link name="finger"/>
  <link name="tool"/>
  <joint name="pan" type="revolute"><parent link="base"/><child link="one"/><origin xyz="0 0 0.3" rpy="0.2 0.3 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
  <joint name="lift" type="revolute"><parent link="one"/><child link="two"/><origin xyz="0.1 0 0.2" rpy="1.5 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
  <joint name="geared" type="revolute"><parent link="two"/><child link="three"/><origin xyz="0.4 0 0" rpy="0 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-6" upper="6" effort="1" velocity="4"/>
    <mimic joint="lift" multiplier="-0.5" offset="0.3"/></joint>
  <joint name="roll" type="revolute"><parent link="three"/><child link="hand"/><origin xyz="0.3 0.05 0" rpy="0 1.4 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
  <joint name="flange" type="fixed"><parent link="hand"/><child link="tool"/><origin xyz="0 0 0.1"/></joint>
  <joint name="grip" type="revolute"><parent link="hand"/><child link="finger"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""
MIMIC = '<mimic joint="lift" multiplier="-0.5" offset="0.3"/>'
PLAN = """\
rate_hz: 200
rest_deg: [10, 40, 30]
tests:
  - joint: all
    static: {span_deg: 120, steps: 8, dwell: 0.6, move: 0.5}
    dynamic: {span_deg: 100, frequency_hz: 0.5, duration: 4}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """An arm with a geared joint, its recording as an encoder a driven joint makes it, and the calibration."""
    folder = tmp_path_factory.mktemp("mimic")
    arm = simulated(folder, URDF)
    log, out = str(folder / "log.csv"), str(folder / "result")
    assert main(["calibrate", log, *arm, "--sensor", "qa700", "--out", out]) == 0
    return folder


def simulated(folder, text):
    (folder / "arm.urdf").write_text(text)
    (folder / "plan.yaml").write_text(PLAN)
    arm = ["--arm", str(folder / "arm.urdf"), "--base", "base", "--tip", "tool"]
    log = str(folder / "log.csv")
    assert main(["simulate", str(folder / "plan.yaml"), *arm, "--sensor", "qa700", "--out", log, "--seed", "3"]) == 0
    return arm


def test_a_recording_has_a_column_a_driven_joint(folder):
    header = (folder / "log.csv").read_text().partition("\n")[0].replace('"', "")
    assert header == "t,q1,q2,q3,ax,ay,az"
    arm = load_arm(folder / "arm.urdf", tip="hand")
    recording = read_recording(folder / "log.csv", arm).recording
    q = np.asarray(recording.joint_positions)
    np.testing.assert_allclose(q[:, 2], 0.3 - 0.5 * q[:, 1], atol=1e-12)
    assert arm.driven.joint_names == ("pan", "lift", "roll")
    np.testing.assert_allclose(arm.follow(arm.lead(q)), q, atol=1e-12)


def test_both_lines_of_one_encoder_are_found(folder):
    document = json.loads((folder / "result" / "calibration.json").read_text())
    assert document["mimics"] == [{"joint": "geared", "mimics": "lift", "multiplier": -0.5, "offset": 0.3}]
    truth = truth_at(json.loads((folder / "log.truth.json").read_text()), np.array(document["reference_configuration"]))
    for found, true in zip(calibrated_arm(document).chain.axes, truth_chain(truth).axes, strict=True):
        assert np.abs(circlepoint.local_coordinates(found.line, true.line)).max() < 1e-3


def test_the_urdf_comes_back_with_its_mimic_tag_and_an_independent_reader_gets_the_same_pose(folder):
    yourdfpy = pytest.importorskip("yourdfpy")
    written = folder / "result" / "arm.urdf"
    assert MIMIC in written.read_text()
    assert "tip_frame: tool\n" in (folder / "result" / "arm.urdf.yaml").read_text()
    assert "base_frame: base\n" in (folder / "result" / "arm.urdf.yaml").read_text()
    document = json.loads((folder / "result" / "calibration.json").read_text())
    export = circlepoint.export.export_result(folder / "result", "urdf")  # with base and tip as calibrated
    assert export.texts[".urdf"] == written.read_text()
    notes = export.document
    assert (notes["base_frame"], notes["tip_frame"]) == ("base", "tool")
    assert notes["mimics"] == document["mimics"]
    chain = calibrated_arm(document).chain
    model = yourdfpy.URDF.load(str(written), load_meshes=False, build_scene_graph=True)
    arm = load_arm(folder / "arm.urdf", tip="hand")
    random = np.random.default_rng(2)
    at_reference = np.array(notes["T_base_sensor_at_reference"])
    for q in random.uniform(-2, 2, (300, 3)):
        model.update_cfg(dict(zip(("pan", "lift", "roll"), q, strict=True)) | {"grip": 0.0})
        expected = at_reference @ circlepoint.forward_kinematics(chain, arm.follow(q[None])[0])
        found = model.get_transform("tool", "base") @ np.array(notes["T_tip_sensor"])
        np.testing.assert_allclose(found, expected, atol=1e-9)


def test_only_the_origins_change(folder):
    before, after = ET.fromstring(URDF), ET.parse(folder / "result" / "arm.urdf").getroot()
    for one, other in zip(before.iter(), after.iter(), strict=True):
        assert (one.tag, one.tag == "origin" or one.attrib) == (other.tag, other.tag == "origin" or other.attrib)


def test_a_parallelogram_is_named_and_not_invented(tmp_path, capsys):
    arm = simulated(tmp_path, URDF.replace(MIMIC, MIMIC.replace("-0.5", "-1")))
    out = str(tmp_path / "result")
    assert main(["calibrate", str(tmp_path / "log.csv"), *arm, "--sensor", "qa700", "--out", out]) == 1
    document = json.loads((tmp_path / "result" / "calibration.json").read_text())
    reasons = {joint["name"]: joint["reason"] for joint in document["joints"]}
    assert [name for name, reason in reasons.items() if reason] == ["lift", "geared"]
    assert "moves together with geared (mimic)" in reasons["lift"]
    assert "parallelogram" in reasons["geared"]
    assert not any("move it alone" in text for text in document["identifiability"]["unseen"])
    assert "joint2" not in " ".join(document["identifiability"]["unseen"])
    assert "lift, geared" in capsys.readouterr().err


def test_a_mimicked_joint_beside_the_arm_gives_its_column(tmp_path):
    text = URDF.replace(MIMIC, '<mimic joint="grip" multiplier="2"/>')
    (tmp_path / "arm.urdf").write_text(text)
    arm = load_arm(tmp_path / "arm.urdf", tip="hand")
    assert arm.driven.joint_names == ("pan", "lift", "grip", "roll")
    t = np.arange(100) / 100
    named = {"t": t, "lift": 0.1 * t, "roll": 0.2 * t, "grip": 0.3 * t, "pan": 0.4 * t}
    named |= {"ax": 0 * t, "ay": 0 * t + 0.1, "az": 0 * t + 9.8}
    pyarrow.csv.write_csv(pa.table(named), tmp_path / "log.csv")
    q = np.asarray(read_recording(tmp_path / "log.csv", arm).recording.joint_positions)
    np.testing.assert_allclose(q, np.outer(t, [0.4, 0.1, 0.6, 0.2]), atol=1e-12)
    np.testing.assert_allclose(arm.lead(q)[:, 2], 0.3 * t, atol=1e-12)
    del named["grip"]
    pyarrow.csv.write_csv(pa.table(named), tmp_path / "log.csv")
    with pytest.raises(circlepoint.InvalidInput, match=r"joint 3 \(grip\) is missing"):
        read_recording(tmp_path / "log.csv", arm)


def test_a_joint_may_mimic_one_that_mimics_another(tmp_path):
    roll = '<mimic joint="geared" multiplier="4" offset="1"/>'
    text = URDF.replace('rpy="0 1.4 0"/>', f'rpy="0 1.4 0"/>{roll}')
    (tmp_path / "arm.urdf").write_text(text)
    arm = load_arm(tmp_path / "arm.urdf", tip="hand")
    assert arm.driven.joint_names == ("pan", "lift")
    assert arm.joints[3].mimic == Mimic("lift", -2.0, pytest.approx(2.2))
    assert arm.coupled(1) == ("geared", "roll")


@pytest.mark.parametrize(
    ("mimic", "words"),
    [
        ('<mimic joint="elbow"/>', ["line 9", "'geared'", "'elbow'", "pan, lift, geared, roll, grip"]),
        ('<mimic joint="geared"/>', ["'geared'", "mimics itself"]),
        ('<mimic joint="lift" multiplier="0"/>', ["'geared'", "multiplier", "fixed"]),
        ('<mimic joint="lift" multiplier="much"/>', ["<mimic>", "much", "a number"]),
        ("<mimic/>", ["<mimic>", "joint"]),
    ],
)
def test_a_mimic_tag_that_will_not_do_says_where_and_why(mimic, words, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(URDF.replace(MIMIC, mimic))
    with pytest.raises(circlepoint.InvalidInput) as caught:
        load_arm(path, tip="hand")
    for word in (str(path), *words):
        assert word in str(caught.value)


def test_a_campaign_repeats_an_arm_whose_joints_mimic_others(tmp_path):
    (tmp_path / "arm.urdf").write_text(URDF)
    (tmp_path / "plan.yaml").write_text(PLAN)
    (tmp_path / "campaign.yaml").write_text(
        "arm: {file: arm.urdf, base: base, tip: tool}\nsensor: qa700\nplan: plan.yaml\nmethod: whole-arm\n"
        "noise: {white: 0.01}\ntrials: 2\nseed: 1\n"
    )
    assert main(["campaign", str(tmp_path / "campaign.yaml"), "--out", str(tmp_path / "out")]) == 0
    table = pq.read_table(next((tmp_path / "out" / "trials").rglob("*.parquet"))).to_pylist()
    assert [row["outcome"] for row in table] == ["complete"] * 2
    assert all(row["end_point"] < 5 * row["end_point_std"] for row in table)
