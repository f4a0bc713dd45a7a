"""A table of still poses: the directions of axes, and a clear word on what it cannot show."""

import csv
import itertools
import json

import jsonschema
import numpy as np
import pytest
from whole_arm_support import LINES, START, UP, chain_of

import circlepoint as cp
from circlepoint.arm import Arm, Joint
from circlepoint.calibration import calibrate
from circlepoint.cli import main
from circlepoint.document import load_schema
from circlepoint.recording_files import write_recording
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor

NOISE = 0.01
PRISMATIC = cp.JointType.prismatic


def poses_of(chain, seed, *, count=25, noise=NOISE, up=UP):
    """What a sensor of the MEMS class reads at rest in random poses."""
    q = START + np.random.default_rng(seed).uniform(-1.2, 1.2, (count, len(chain.axes)))
    sensor = cp.draw_accelerometer(load_sensor("mems"), seed)
    made = cp.simulate(chain, up, sensor, cp.static_poses(q), cp.SimulationOptions(noise_std=noise, seed=seed))
    return np.array(made.joint_positions), np.array(made.specific_force)


def arm_of(types=("revolute",) * 3):
    return Arm("still", tuple(Joint(f"joint{i + 1}", kind) for i, kind in enumerate(types)))


def vague_of(chain, seed, **options):
    recording = cp.make_static_recording(*poses_of(chain, seed, **options))
    return calibrate(recording, arm_of(), sensor=load_sensor("mems"), reference_configuration=START)


def write_table(path, q, force, name="pose"):
    rows = [[name, "q1", "q2", "q3", "ax", "ay", "az"]]
    rows += [[i, *map(repr, row)] for i, row in enumerate(np.column_stack([q, force]).tolist(), start=1)]
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)


def write_arm(path):
    joints = "".join(f"  - {{name: joint{i}, type: revolute}}\n" for i in (1, 2, 3))
    path.write_text(f"name: still\njoints:\n{joints}")


def test_directions_are_found_as_well_as_stated_and_no_line_is_given():
    chain = chain_of(LINES)
    squares = []
    for seed in range(30):
        result = vague_of(chain, seed)
        assert result.chain is None
        for estimate, true in zip(result.joints.joints, chain.axes, strict=True):
            assert estimate.axis is None
            assert "directions and no distances" in estimate.reason
            assert estimate.vague.direction_std() < 0.01
            there = cp.make_line(np.array(true.line.direction), np.array(estimate.vague.screw.line.point))
            error = cp.local_coordinates(estimate.vague.screw.line, there)[:2]
            squares.append(error @ np.linalg.solve(estimate.vague.covariance[:2, :2], error) / 2)
    assert 0.75 < np.mean(squares) < 1.35  # of 180: 1 +- 0.11, and the noise is found in few equations


@pytest.mark.parametrize("joints", [3, 6])
def test_the_true_arm_is_found_among_several_that_fit_in_part(joints):
    squares = []
    for seed in range(25):  # with three random starts that agree, two of 25 ended at another arm
        random = np.random.default_rng(1000 + seed)
        axes = []
        for _ in range(joints):
            direction = random.normal(size=3)
            line = cp.make_line(direction / np.linalg.norm(direction), 0.3 * random.normal(size=3))
            axes.append(cp.ScrewAxis(type=cp.JointType.revolute, line=line))
        chain = cp.ScrewChain(axes, random.uniform(-1.0, 1.0, joints))
        q = chain.reference_configuration + random.uniform(-1.2, 1.2, (25, joints))
        sensor = cp.draw_accelerometer(load_sensor("mems"), seed)
        simulation = cp.SimulationOptions(noise_std=NOISE, seed=seed)
        made = cp.simulate(chain, UP, sensor, cp.static_poses(q), simulation)
        table = cp.make_static_recording(np.array(made.joint_positions), np.array(made.specific_force))
        options = {"sensor": load_sensor("mems"), "reference_configuration": chain.reference_configuration}
        result = calibrate(table, arm_of(("revolute",) * joints), **options)
        for estimate, true in zip(result.joints.joints, chain.axes, strict=True):
            there = cp.make_line(np.array(true.line.direction), np.array(estimate.vague.screw.line.point))
            error = cp.local_coordinates(estimate.vague.screw.line, there)[:2]
            squares.append(error @ np.linalg.solve(estimate.vague.covariance[:2, :2], error) / 2)
    assert max(squares) < 12.0
    assert 0.75 < np.mean(squares) < 1.4


def test_more_poses_show_more():
    chain = chain_of(LINES)
    few, many = (
        np.median([e.vague.direction_std() for e in vague_of(chain, 1, count=count, noise=0.05).joints.joints])
        for count in (20, 320)
    )
    assert many < 0.5 * few


def test_an_axis_along_gravity_is_not_told():
    up = np.array(chain_of(LINES).axes[0].line.direction) * cp.STANDARD_GRAVITY
    first, *others = vague_of(chain_of(LINES), 3, up=up).joints.joints
    assert first.vague is None  # either way round fits as well
    assert "along gravity" in first.reason
    assert all(estimate.vague is not None for estimate in others)


def test_a_joint_that_stands_still_in_all_poses_is_named():
    q = START + np.random.default_rng(1).uniform(-1.2, 1.2, (25, 3)) * [1, 0, 1]
    force = np.array(cp.simulate(chain_of(LINES), UP, cp.AccelerometerModel(), cp.static_poses(q)).specific_force)
    result = calibrate(cp.make_static_recording(q, force), arm_of(), sensor=load_sensor("mems"))
    assert [estimate.vague is None for estimate in result.joints.joints] == [False, True, False]
    assert "never moves" in result.joints.joints[1].reason


def test_rests_show_nothing_of_a_joint_that_slides():
    types = [cp.JointType.revolute, PRISMATIC, cp.JointType.revolute]
    q, force = poses_of(chain_of(LINES, types), 5)
    arm = arm_of(("revolute", "prismatic", "revolute"))
    result = calibrate(cp.make_static_recording(q, force), arm, sensor=load_sensor("mems"))
    assert "rests show nothing of a joint that slides" in result.joints.joints[1].reason
    assert result.joints.joints[1].vague is None
    assert result.joints.joints[0].vague is not None


def test_of_an_unknown_sensor_only_what_the_data_show_is_told():
    q, force = poses_of(chain_of(LINES), 6, count=60)
    known, unknown = (
        calibrate(cp.make_static_recording(q, force), arm_of(), sensor=sensor).joints.joints
        for sensor in (load_sensor("mems"), None)
    )
    for one, other in zip(known, unknown, strict=True):
        assert other.vague is None or other.vague.direction_std() >= 0.95 * one.vague.direction_std()


@pytest.mark.parametrize("method", ["joint", "position", "velocity"])
def test_other_methods_say_what_to_record(method):
    recording = cp.make_static_recording(*poses_of(chain_of(LINES), 7))
    result = calibrate(recording, arm_of(), method=method)
    assert all(estimate.reason for estimate in result.joints.joints)


def test_a_table_is_read_calibrated_and_checked(tmp_path, capsys):
    q, force = poses_of(chain_of(LINES), 8)
    write_table(tmp_path / "poses.csv", q, force)
    write_arm(tmp_path / "arm.yaml")
    files = [str(tmp_path / "poses.csv"), "--arm", str(tmp_path / "arm.yaml")]
    loaded = read_recording(tmp_path / "poses.csv", arm_of())
    assert loaded.recording.is_static
    assert loaded.encoder_steps == (None,) * 3
    np.testing.assert_array_equal(loaded.recording.specific_force, force)
    assert main(["calibrate", *files, "--sensor", "mems", "--out", str(tmp_path / "result")]) == 1
    out = capsys.readouterr().out
    assert "directions and no distances" in out
    assert "as far as it is seen: direction" in out
    document = json.loads((tmp_path / "result" / "calibration.json").read_text())
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    assert document["complete"] is False
    assert document["recording"]["static"] is True
    assert document["fit"]["noise_std"] is None
    for joint in document["joints"]:
        assert joint["vague"]["point_sensor"] is None
        assert joint["vague"]["direction_std"] < 0.01
    assert "25 still poses" in (tmp_path / "result" / "report.html").read_text()
    assert main(["check", *files]) == 1
    out = capsys.readouterr().out
    assert "25 still poses, 3 joints" in out
    assert "still poses show its direction and not its place" in out


@pytest.mark.parametrize("name", ["poses.csv", "poses.csv.gz", "poses.parquet"])
def test_a_table_written_is_the_table_read(tmp_path, name):
    made = cp.make_static_recording(*poses_of(chain_of(LINES), 8))
    write_recording(tmp_path / name, made)
    read = read_recording(tmp_path / name, arm_of()).recording
    assert read.is_static
    np.testing.assert_array_equal(read.joint_positions, made.joint_positions)
    np.testing.assert_array_equal(read.specific_force, made.specific_force)


def test_several_tables_are_one_and_logs_are_kept_apart(tmp_path):
    q, force = poses_of(chain_of(LINES), 9)
    write_table(tmp_path / "a.csv", q[:12], force[:12])
    write_table(tmp_path / "b.csv", q[12:], force[12:], name="pose_id")
    both = read_recording([tmp_path / "a.csv", tmp_path / "b.csv"], arm_of()).recording
    assert both.is_static
    np.testing.assert_array_equal(both.joint_positions, q)
    log = cp.make_recording(np.arange(25) * 1.0, q, force)
    with pytest.raises(cp.InvalidInput, match=r"recording 2 is a table of still poses, the first is a log: calibrate"):
        cp.concatenate([log, both])


def test_a_time_beside_the_pose_makes_it_a_log(tmp_path):
    q, force = poses_of(chain_of(LINES), 2, count=100)
    rows = np.column_stack([np.arange(100) / 100, np.repeat(np.arange(10), 10), q, force])
    np.savetxt(tmp_path / "log.csv", rows, delimiter=",", header="t,pose,q1,q2,q3,ax,ay,az", comments="")
    assert not read_recording(tmp_path / "log.csv", arm_of()).recording.is_static


def test_a_pose_that_comes_twice_and_too_few_poses_are_refused(tmp_path):
    q, force = poses_of(chain_of(LINES), 4, count=6)
    write_table(tmp_path / "poses.csv", q, force)
    text = (tmp_path / "poses.csv").read_text().replace("\n4,", "\n2,")
    (tmp_path / "twice.csv").write_text(text)
    with pytest.raises(cp.InvalidInput, match=r"twice.csv, line 5: column `pose` is 2 again: keep one row a pose"):
        read_recording(tmp_path / "twice.csv", arm_of())
    write_table(tmp_path / "few.csv", q[:2], force[:2])
    with pytest.raises(cp.InvalidInput, match=r"few.csv: has 2 still poses, at least 3 are needed"):
        read_recording(tmp_path / "few.csv", arm_of())
    with pytest.raises(cp.InvalidInput, match="there are 2 still poses, at least 3"):
        cp.make_static_recording(q[:2], force[:2])


def test_a_table_that_is_half_of_one_has_a_sensor_clock_or_a_hole_says_so(tmp_path):
    q, force = poses_of(chain_of(LINES), 4)
    write_table(tmp_path / "poses.csv", q, force)
    rows = [line.split(",") for line in (tmp_path / "poses.csv").read_text().splitlines()]
    (tmp_path / "joints.csv").write_text("\n".join(",".join(row[:4]) for row in rows))
    with pytest.raises(cp.InvalidInput, match=r"time column is missing.*holds joints and sensor in the same rows"):
        read_recording(tmp_path / "joints.csv", arm_of())
    (tmp_path / "clock.csv").write_text(
        "\n".join(",".join(["t_sensor" if i == 0 else str(i), *row]) for i, row in enumerate(rows))
    )
    with pytest.raises(cp.InvalidInput, match="time column is missing"):
        read_recording(tmp_path / "clock.csv", arm_of())
    rows[4][2] = ""
    (tmp_path / "hole.csv").write_text("\n".join(",".join(row) for row in rows))
    with pytest.raises(
        cp.InvalidInput, match=r"hole.csv, line 5: column `q2` is empty or not a number; remove the row$"
    ):
        read_recording(tmp_path / "hole.csv", arm_of())


def test_what_poses_cannot_do_is_refused():
    table = cp.make_static_recording(*poses_of(chain_of(LINES), 1))
    for name in ("clock_offset", "clock_rate", "percussion_distance"):
        with pytest.raises(cp.InvalidInput, match=f"{name}: still poses show nothing of it"):
            calibrate(table, arm_of(), treatments={name: cp.ParameterTreatment()})
    assert "cutoff" not in calibrate(table, arm_of()).document["fit"]


def test_too_few_poses_are_refused_with_how_many_are_enough():
    with pytest.raises(
        cp.NotIdentifiable, match=r"7 still poses are too few to tell the directions of 3 joints; record 8"
    ):
        cp.calibrate_whole_arm(*whole_arm_of(7))
    squares = []
    for seed in range(20):
        result = vague_of(chain_of(LINES), seed, count=8)
        for estimate, true in zip(result.joints.joints, chain_of(LINES).axes, strict=True):
            cosine = abs(estimate.vague.screw.line.direction @ true.line.direction)
            squares.append((np.arccos(min(1.0, cosine)) / estimate.vague.direction_std()) ** 2 / 2)
    assert np.median(squares) < 1.5
    assert max(squares) < 25.0


def whole_arm_of(count):
    recording = cp.make_static_recording(*poses_of(chain_of(LINES), 1, count=count))
    return recording, cp.segment(recording), cp.WholeArmOptions()


def test_poses_that_no_arm_explains_tell_nothing():
    q, force = poses_of(chain_of(LINES), 1, count=40)
    wrong = np.random.default_rng(1).permutation(q)  # rows of another file
    result = calibrate(cp.make_static_recording(wrong, force), arm_of(), sensor=load_sensor("mems"))
    for estimate in result.joints.joints:
        assert estimate.vague is None
        assert "check the columns, their signs" in estimate.reason


def test_of_sliding_joints_alone_rests_show_nothing():
    types = ("prismatic",) * 3
    q, force = poses_of(chain_of(LINES, [PRISMATIC] * 3), 1)
    recording = cp.make_static_recording(q, force)
    options = cp.WholeArmOptions()
    options.joint_types = [PRISMATIC] * len(types)
    with pytest.raises(cp.NotIdentifiable, match="only sliding joints move"):
        cp.calibrate_whole_arm(recording, cp.segment(recording), options)


@pytest.mark.parametrize("imu", [2, 3, 4, 5, 6])
def test_neighbouring_axes_of_a_real_arm_are_at_right_angles_as_its_maker_says(shared_data, imu):
    rows = np.loadtxt(shared_data / "real-franka-static" / "static.csv", delimiter=",", skiprows=1)
    rows = rows[rows[:, 8] == imu]
    joints = min(imu + 1, 6)  # sensor k sits on link k + 1, the last on link 6
    recording = cp.make_static_recording(rows[:, 1 : 1 + joints].copy(), rows[:, 9:12].copy())
    result = calibrate(recording, arm_of(("revolute",) * joints), sensor=load_sensor("mems"))
    told = [estimate.vague for estimate in result.joints.joints]
    pairs = [(a, b) for a, b in itertools.pairwise(told) if a is not None and b is not None]
    assert pairs
    for a, b in pairs:
        cosine = a.screw.line.direction @ b.screw.line.direction
        assert abs(cosine) < 3.5 * np.hypot(a.direction_std(), b.direction_std())
