"""Bad input in every format: it says where, what and what to do, as it does for CSV."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
from bag_writer import KINDS, write_bag

import circlepoint
from circlepoint.arm import load_arm
from circlepoint.cli import main
from circlepoint.recording_io import read_recording

FORMS = [*KINDS, "Parquet", "RTDE"]
ROWS = 60


@pytest.fixture
def arm_file(tmp_path):
    path = tmp_path / "arm.yaml"
    path.write_text("name: two\njoints:\n  - {name: shoulder, type: revolute}\n  - {name: elbow2, type: revolute}\n")
    return path


def samples(rows=ROWS):
    t = np.arange(rows) / 100
    wave = np.sin(9 * t)
    return {"t": t, "q": np.column_stack([0.3 * wave, 0.5 + 0 * t]), "a": np.column_stack([wave, 0 * t, 9.7 + 0 * t])}


def write(form, folder, data):
    if form in KINDS:
        topics = []
        if "q" in data:
            rows = [(t, ("shoulder", "elbow2"), q) for t, q in zip(data["t"], data["q"], strict=True)]
            topics.append(("/joint_states", rows))
        if "a" in data:
            topics.append(("/imu/data", [(t, f, None) for t, f in zip(data["t"], data["a"], strict=True)]))
        topics.append(("/remarks", [(t, "fine", None) for t in data["t"]]))
        return write_bag(folder / KINDS[form], form, topics)
    named = {"timestamp": data["t"]}
    for key, stem in (("q", "actual_q_"), ("a", "actual_tool_accelerometer_")):
        if key in data:
            named |= {f"{stem}{index}": column for index, column in enumerate(data[key].T)}
    if form == "Parquet":
        pyarrow.parquet.write_table(pa.table(named), folder / "log.parquet")
        return folder / "log.parquet"
    body = [" ".join(map(repr, map(float, row))) for row in zip(*named.values(), strict=True)]
    (folder / "rtde.csv").write_text("\n".join([" ".join(named), *body]) + "\n")
    return folder / "rtde.csv"


def changed(key, change, rows=ROWS):
    def make():
        data = samples(rows)
        data[key] = change(data[key])
        return data

    return make


def at(row, value):
    def change(values):
        values = values.copy()
        values[row, ...] = value
        return values

    return change


def without(key):
    return lambda: {name: values for name, values in samples().items() if name != key}


BAD = {
    "no sensor": (without("a"), ["specific force", "missing"]),
    "no joints": (without("q"), ["joint", "missing"]),
    "NaN": (changed("a", lambda a: np.where((np.arange(ROWS) == 11)[:, None], np.nan, a)), ["{12}", "not a number"]),
    "infinite": (changed("q", at(7, np.inf)), ["{8}", "inf", "finite"]),
    "time backwards": (changed("t", at(20, 0.005)), ["{21}", "backwards"]),
    "repeated rows": (changed("t", lambda t: np.sort(np.append(t[:-1], t[20]))), ["0.2", "again"]),
    "degrees": (changed("q", lambda q: 2000 * q), ["joint 1", "degrees", "q: deg", "--columns"]),
    "g": (changed("a", lambda a: a / 9.80665), ["in g", "a: g", "--columns"]),
    "two rows": (lambda: samples(2), ["2 samples", "8"]),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", BAD)
def test_bad_log_says_where_and_what_to_do(name, form, tmp_path, arm_file, capsys):
    make, words = BAD[name]
    log = write(form, tmp_path, make())
    assert main(["check", str(log), "--arm", str(arm_file)]) == 2
    captured = capsys.readouterr()
    assert not captured.out
    assert "Traceback" not in captured.err
    for word in (str(log), *words):
        if word.startswith("{"):
            row = int(word[1:-1])
            word = f"message {row}:" if form in KINDS else f"row {row}:" if form == "Parquet" else f"line {row + 1}:"  # noqa: PLW2901
        assert word in captured.err
    if form in KINDS and name.startswith("no "):
        assert "/remarks (std_msgs/String)" in captured.err


@pytest.mark.parametrize("form", FORMS)
def test_a_gap_divides_the_recording_and_is_reported(form, tmp_path, arm_file):
    data = samples(200)
    keep = np.r_[0:90, 130:200]
    log = write(form, tmp_path, {name: values[keep] for name, values in data.items()})
    loaded = read_recording(log, load_arm(arm_file))
    assert len(loaded.recording.spans) == 2
    assert all(sum(gap.missing for gap in file.timeline.gaps) == 40 for file in loaded.files)


@pytest.mark.parametrize("kind", KINDS)
def test_a_bag_without_messages_is_refused(kind, tmp_path, arm_file):
    names = ("shoulder", "elbow2")
    path = write_bag(tmp_path / KINDS[kind], kind, [("/remarks", [(0.0, "fine", None)])])
    with pytest.raises(circlepoint.InvalidInput, match=r"no topic of type sensor_msgs/JointState.*/remarks"):
        read_recording(path, load_arm(arm_file))
    nothing = tmp_path / f"empty_{KINDS[kind]}"
    write_bag(nothing, kind, [])
    with pytest.raises(circlepoint.InvalidInput, match=r"(no topics|cannot be read)"):
        read_recording(nothing, load_arm(arm_file))
    alone = tmp_path / f"one_{KINDS[kind]}"
    write_bag(alone, kind, [("/joint_states", [(0.0, names, [0.0, 0.0])]), ("/imu", [(0.0, np.ones(3), None)])])
    with pytest.raises(circlepoint.InvalidInput, match="1 samples, at least 8"):
        read_recording(alone, load_arm(arm_file))


@pytest.mark.parametrize("kind", KINDS)
def test_a_bag_that_was_cut_off_is_refused(kind, tmp_path, arm_file):
    path = write(kind, tmp_path, samples())
    file = path if path.is_file() else next(path.glob("*.mcap"), None) or next(path.glob("*.db3"))
    whole = file.read_bytes()
    for share in (0.02, 0.3, 0.9):
        file.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(circlepoint.InvalidInput, match=r"(reindex|mcap recover)") as caught:
            read_recording(path, load_arm(arm_file))
        assert str(path) in str(caught.value)
    file.write_bytes(b"")
    with pytest.raises(circlepoint.InvalidInput, match=r"cannot be read"):
        read_recording(path, load_arm(arm_file))


@pytest.mark.parametrize("kind", ["ROS 2 sqlite3", "ROS 2 MCAP"])
def test_the_file_inside_a_bags_folder_is_read_too(kind, tmp_path, arm_file):
    path = write(kind, tmp_path, samples())
    file = next(path.glob("*.mcap"), None) or next(path.glob("*.db3"))
    arm = load_arm(arm_file)
    expected = read_recording(path, arm).recording
    np.testing.assert_array_equal(read_recording(file, arm).recording.specific_force, expected.specific_force)


def two_of_each(path, names=(("shoulder", "elbow2"), ("finger",))):
    data = samples()
    topics = [
        (f"/robot{index}/joint_states", [(t, own, q[: len(own)]) for t, q in zip(data["t"], data["q"], strict=True)])
        for index, own in enumerate(names)
    ]
    topics += [
        ("/imu", [(t, f, None) for t, f in zip(data["t"], data["a"], strict=True)]),
        ("/base/imu", [(t, (0.0, 0.0, 9.81) + 0 * f, None) for t, f in zip(data["t"], data["a"], strict=True)]),
    ]
    return write_bag(path, "ROS 1", topics)


def test_several_imus_are_listed_until_one_is_chosen(tmp_path, arm_file):
    path, arm = two_of_each(tmp_path / "log.bag"), load_arm(arm_file)
    with pytest.raises(
        circlepoint.InvalidInput, match=r"2 topics of type sensor_msgs/Imu: /base/imu, /imu;.*imu_topic"
    ):
        read_recording(path, arm)
    chosen = read_recording(path, arm, imu_topic="/imu").recording.specific_force
    np.testing.assert_allclose(chosen, samples()["a"], atol=1e-9)
    columns = tmp_path / "map.yaml"
    columns.write_text("imu_topic: /imu\njoint_topic: /robot0/joint_states\n")
    np.testing.assert_array_equal(read_recording(path, arm, columns).recording.specific_force, chosen)
    with pytest.raises(circlepoint.InvalidInput, match=r"--imu-topic /none is not a topic.*/base/imu, /imu"):
        read_recording(path, arm, imu_topic="/none")
    with pytest.raises(circlepoint.InvalidInput, match=r"--joint-topic /imu is not a topic of type"):
        read_recording(path, arm, imu_topic="/imu", joint_topic="/imu")


def test_of_several_joint_states_the_one_with_the_arms_joints_is_taken(tmp_path, arm_file):
    same = two_of_each(tmp_path / "same.bag", (("shoulder", "elbow2"), ("elbow2", "shoulder")))
    with pytest.raises(circlepoint.InvalidInput, match=r"several joint states.*/robot0.*/robot1.*--joint-topic"):
        read_recording(same, load_arm(arm_file), imu_topic="/imu")
    chosen = read_recording(same, load_arm(arm_file), imu_topic="/imu", joint_topic="/robot1/joint_states").recording
    np.testing.assert_allclose(chosen.joint_positions, samples()["q"][:, ::-1], atol=1e-9)
    other = two_of_each(tmp_path / "other.bag", (("a", "b"), ("c",)))
    with pytest.raises(
        circlepoint.InvalidInput, match=r"no joint state holds.*shoulder, elbow2.*a, b.*q: \["
    ) as caught:
        read_recording(other, load_arm(arm_file), imu_topic="/imu")
    assert "c" in str(caught.value)
    columns = tmp_path / "map.yaml"
    columns.write_text("q: [b, a]\n")
    named = read_recording(other, load_arm(arm_file), columns, imu_topic="/imu").recording
    np.testing.assert_allclose(named.joint_positions, samples()["q"][:, ::-1], atol=1e-9)


def test_without_stamps_in_the_headers_the_times_of_logging_are_taken_and_it_is_said(tmp_path, arm_file):
    data = samples()
    topics = [
        ("/joint_states", [(t, ("shoulder", "elbow2"), q) for t, q in zip(data["t"], data["q"], strict=True)]),
        ("/imu", [(t, f, None) for t, f in zip(data["t"], data["a"], strict=True)]),
    ]
    stamped = read_recording(write_bag(tmp_path / "a.bag", "ROS 1", topics), load_arm(arm_file))
    bare = read_recording(write_bag(tmp_path / "b.bag", "ROS 1", topics, stamped=False), load_arm(arm_file))
    np.testing.assert_allclose(bare.recording.time, stamped.recording.time, atol=1e-9)
    assert "stamps" in {finding.code for finding in bare.findings} - {finding.code for finding in stamped.findings}


def test_topics_are_for_bags(tmp_path, arm_file):
    log = write("Parquet", tmp_path, samples())
    with pytest.raises(circlepoint.InvalidInput, match="not a bag"):
        read_recording(log, load_arm(arm_file), imu_topic="/imu")
