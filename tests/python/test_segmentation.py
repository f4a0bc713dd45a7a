"""Segmentation of recordings nobody here made, and the contracts of its Python surface."""

import numpy as np
import pyarrow.csv
import pytest

import circlepoint

SWEEPS = {
    "physics-arm7-sweeps-qa700": 16,
    "physics-arm6-sweeps-mems": 16,
    "physics-arm7-sweeps-coarse": 10,
}


def read_table(path):
    table = pyarrow.csv.read_csv(path)
    return {name: table[name].to_numpy() for name in table.column_names}


def stack(table, names):
    return np.ascontiguousarray(np.column_stack([table[name] for name in names]))


def joint_names(table):
    return [name for name in table if name[0] == "q" and name[1:].isdigit()]


def read_log(folder):
    table = read_table(folder / "log.csv")
    return circlepoint.make_recording(table["t"], stack(table, joint_names(table)), stack(table, ["ax", "ay", "az"]))


def read_two_clocks(folder):
    joints, sensor = read_table(folder / "joints.csv"), read_table(folder / "sensor.csv")
    time = 0.07 + 1.0033 * joints["t"]
    force = np.column_stack([np.interp(time, sensor["t"], sensor[name]) for name in ("ax", "ay", "az")])
    return circlepoint.make_recording(joints["t"], stack(joints, joint_names(joints)), np.ascontiguousarray(force))


def duration(recording, part):
    return (part.samples.end - part.samples.begin) / recording.sample_rate


def separate(positions, least):
    """How many positions differ by at least this much."""
    return 1 + int(np.count_nonzero(np.diff(np.sort(positions)) > least))


@pytest.mark.parametrize(("name", "dwells"), SWEEPS.items())
def test_every_joint_of_a_sweep_recording_has_its_dwells_and_its_motions(shared_data, name, dwells):
    recording = read_log(shared_data / name)
    found = circlepoint.segment(recording)
    joints = found.dwells[0].joint_positions.size
    assert [test.joint for test in found.tests] == list(range(joints))
    for test in found.tests:
        assert separate([found.dwells[k].joint_positions[test.joint] for k in test.dwells], 0.1) == dwells
        assert test.dwell_span == pytest.approx(2.62, abs=0.05)
        motions = [found.motions[k] for k in test.motions]
        assert all(motion.joint == test.joint and motion.from_rest and motion.to_rest for motion in motions)
        continuous = [motion for motion in motions if duration(recording, motion) > 4.0]
        assert len(continuous) == 1
        assert continuous[0].travel == pytest.approx(2.62, abs=0.05)
        assert duration(recording, continuous[0]) == pytest.approx(6.2, abs=0.4)
        # The steps up, the return and the continuous motion.
        assert len(motions) == (dwells - 1) + 2


@pytest.mark.parametrize(("name", "std"), list(zip(SWEEPS, (1e-3, 2e-2, 1e-3), strict=True)))
def test_dwells_of_a_sweep_recording_hold_nothing_but_sensor_noise(shared_data, name, std):
    found = circlepoint.segment(read_log(shared_data / name))
    assert max(dwell.specific_force_std.max() for dwell in found.dwells) < std


@pytest.mark.parametrize("name", ["physics-arm6-free-qa700", "physics-arm7-free-ideal"])
def test_no_test_is_invented_where_all_joints_move(shared_data, name):
    found = circlepoint.segment(read_log(shared_data / name))
    assert found.motions == []
    assert found.tests == []


def test_real_arm_shows_the_joints_it_moved_alone(shared_data):
    recording = read_two_clocks(shared_data / "real-ur5-imu-6")
    found = circlepoint.segment(recording)
    assert {motion.joint for motion in found.motions} == {0, 5}
    first = [np.rad2deg(motion.travel) for motion in found.motions if motion.joint == 0]
    last = [np.rad2deg(motion.travel) for motion in found.motions if motion.joint == 5]
    np.testing.assert_allclose(first, [110.0, 50.0] * 3, atol=1.0)
    np.testing.assert_allclose(last, [156.0] * 6, atol=3.0)
    for motion in found.motions:
        assert motion.from_rest
        assert motion.to_rest == (motion.joint == 0)  # joint 6 moves on when others join it
    assert len(found.dwells) >= 18
    gravity = [np.linalg.norm(dwell.specific_force) for dwell in found.dwells]
    np.testing.assert_allclose(gravity, 9.82, atol=0.2)


def test_real_arm_that_moves_all_joints_together_has_no_tests(shared_data):
    found = circlepoint.segment(read_two_clocks(shared_data / "real-ur5-imu-8"))
    assert found.motions == []
    assert found.tests == []
    assert len(found.dwells) == 1  # before it sets off


def test_real_arm_at_25_hz_has_dwells_and_no_tests(shared_data):
    table = read_table(shared_data / "real-ur3e-rtde" / "recording.csv")
    positions = stack(table, [f"actual_q_{k}" for k in range(6)])
    force = stack(table, [f"actual_tool_accelerometer_{k}" for k in range(3)])
    found = circlepoint.segment(circlepoint.make_recording(table["timestamp"], positions, force))
    assert len(found.dwells) > 10
    assert found.motions == []
    assert found.tests == []


def test_restless_student_arm_is_never_static(shared_data):
    table = read_table(shared_data / "real-hebi-5module" / "log.csv.gz")
    raw, first = np.unique(table["t_pc"], return_index=True)
    time = np.arange(raw[0], raw[-1], 0.01)
    columns = [np.interp(time, raw, table[name][first]) for name in ("q1", "q2", "q3", "q4", "q5", "a5x", "a5y", "a5z")]
    positions, force = np.column_stack(columns[:5]), np.column_stack(columns[5:])
    found = circlepoint.segment(
        circlepoint.make_recording(time, np.ascontiguousarray(positions), np.ascontiguousarray(force))
    )
    assert found.dwells == []
    assert found.motions == []


def stepping(rate=200.0):
    time = np.arange(0.0, 10.0, 1.0 / rate)
    moving = 0.3 * np.clip(time - 2.0, 0.0, 1.0) + 0.3 * np.clip(time - 5.0, 0.0, 1.0)
    positions = np.column_stack([np.full_like(time, 0.2), moving])
    force = 9.8 * np.column_stack([np.sin(moving), np.cos(moving), np.zeros_like(time)])
    return circlepoint.make_recording(time, np.ascontiguousarray(positions), np.ascontiguousarray(force))


def test_static_intervals_are_the_dwells_of_the_segmentation():
    recording = stepping()
    intervals = [(part.begin, part.end) for part in circlepoint.static_intervals(recording)]
    dwells = [(dwell.samples.begin, dwell.samples.end) for dwell in circlepoint.segment(recording).dwells]
    assert len(dwells) == 3
    assert intervals == dwells


def test_joint_that_never_moves_rests_all_the_time():
    rests = circlepoint.joint_rests(stepping())
    assert [(part.begin, part.end) for part in rests[0]] == [(0, 2000)]
    assert len(rests[1]) == 3


def test_longer_min_dwell_leaves_shorter_ones_out():
    options = circlepoint.SegmentationOptions(min_dwell=2.5)
    assert len(circlepoint.segment(stepping(), options).dwells) == 1


def test_encoder_step_is_what_the_encoder_was_quantised_with():
    step = 2.0 * np.pi / 1024.0
    time = np.arange(0.0, 10.0, 0.002)
    assert circlepoint.encoder_step(step * np.round(0.5 * np.sin(time) / step)) == pytest.approx(step)
    assert circlepoint.encoder_step(0.5 * np.sin(time)) == 0.0
    assert circlepoint.rest_band(step) == pytest.approx(1.5 * step)


def test_results_are_read_only():
    dwell = circlepoint.segment(stepping()).dwells[0]
    with pytest.raises(ValueError, match="read-only"):
        dwell.specific_force[0] = 0.0
    with pytest.raises(AttributeError):
        dwell.samples = None


def test_option_out_of_range_is_named():
    with pytest.raises(ValueError, match="min_velocity"):
        circlepoint.segment(stepping(), circlepoint.SegmentationOptions(min_velocity=0.0))
    with pytest.raises(ValueError, match="others_ratio"):
        circlepoint.segment(stepping(), circlepoint.SegmentationOptions(others_ratio=-1.0))
