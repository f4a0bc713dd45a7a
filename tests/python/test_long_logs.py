"""Logs longer than memory: thinned out while they are read, by means that neither delay nor cross a gap."""

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest
from arm_files import arm_of
from bag_writer import write_recording_bag

import circlepoint
from circlepoint import arrays, bags, log_table, long_logs, scratch, tables
from circlepoint.recording_io import read_recording

RATE = 1000.0
ROWS = 20_000
FACTOR = 8


@pytest.fixture
def arm(tmp_path):
    return arm_of(tmp_path, pan="revolute", slide="prismatic")


@pytest.fixture(autouse=True)
def small_limits(monkeypatch):
    """Long logs are short here, and pieces end at odd places."""
    for module in (arrays, bags, log_table, long_logs, scratch, tables):
        for name, value in (("MANY_ROWS", 5000), ("PIECE_ROWS", 777)):
            if hasattr(module, name):
                monkeypatch.setattr(module, name, value)
    monkeypatch.setattr(scratch, "IN_MEMORY", 100_000)
    monkeypatch.setattr(long_logs, "KEPT", ROWS // FACTOR)
    monkeypatch.setattr(tables, "_BLOCK_BYTES", 40_000)


def motion(t):
    """Slow motion of both joints, and readings that go with it."""
    q = np.column_stack([0.8 * np.sin(2 * t), 0.1 * np.cos(t)])
    a = np.column_stack([np.sin(5 * t), np.cos(4 * t), 9.7 + 0.2 * np.sin(3 * t)])
    return q, a


def columns(t, q, a, scale=1.0):
    return {"t": t, "q1": q[:, 0], "q2": q[:, 1], **{f"a{x}": a[:, i] / scale for i, x in enumerate("xyz")}}


def write(folder, form, named):
    path = folder / f"log.{form}"
    if form == "db3":
        return write_recording_bag(
            folder / "log",
            "ROS 2 sqlite3",
            ["pan", "slide"],
            time=named["t"],
            positions=np.column_stack([named["q1"], named["q2"]]),
            force=np.column_stack([named["ax"], named["ay"], named["az"]]),
        )
    table = pa.table(named)
    if form == "csv":
        pyarrow.csv.write_csv(table, path)
    else:
        pyarrow.parquet.write_table(table, path, row_group_size=3000)
    return path


def require_motion(recording, tolerance):
    q, a = motion(recording.time)
    np.testing.assert_allclose(recording.joint_positions, q, atol=tolerance)
    np.testing.assert_allclose(recording.specific_force, a, atol=10 * tolerance)


@pytest.mark.parametrize("form", ["csv", "parquet", "db3"])
def test_what_remains_is_the_motion_without_delay(form, arm, tmp_path):
    t = np.arange(ROWS) / RATE
    loaded = read_recording(write(tmp_path, form, columns(t, *motion(t))), arm)
    assert not loaded.clock_alignments
    assert loaded.recording.sample_rate == pytest.approx(RATE / FACTOR)
    assert loaded.recording.samples == pytest.approx(ROWS / FACTOR - 32, abs=2)
    assert loaded.files[0].timeline.sample_rate == pytest.approx(RATE)
    assert "thinned" in [finding.code for finding in loaded.findings]
    require_motion(loaded.recording, 1e-7)


def test_noise_is_averaged_and_what_is_fast_does_not_fold_back(arm, tmp_path):
    t = np.arange(ROWS) / RATE
    q, a = motion(t)
    noise = np.random.default_rng(1).normal(0, 0.05, a.shape)
    near_a_multiple_of_the_kept_rate = 0.5 * np.sin(2 * np.pi * (2 * RATE / FACTOR + 1) * t)
    loaded = read_recording(write(tmp_path, "parquet", columns(t, q, a + noise)), arm)
    off = loaded.recording.specific_force - motion(loaded.recording.time)[1]
    assert off.std() == pytest.approx(0.05 * np.sqrt(0.8 / FACTOR), rel=0.15)
    hum = a + near_a_multiple_of_the_kept_rate[:, None]
    loaded = read_recording(write(tmp_path, "parquet", columns(t, q, hum)), arm)
    assert np.abs(loaded.recording.specific_force - motion(loaded.recording.time)[1]).max() < 1e-3


def test_dropped_rows_rounded_and_jittered_stamps_keep_their_time(arm, tmp_path):
    random = np.random.default_rng(2)
    t = np.delete(np.arange(ROWS), random.choice(ROWS - 2, 400, replace=False) + 1) / RATE
    require_motion(read_recording(write(tmp_path, "parquet", columns(t, *motion(t))), arm).recording, 2e-5)
    t = np.arange(ROWS) / RATE + random.uniform(-3e-4, 3e-4, ROWS)
    require_motion(read_recording(write(tmp_path, "parquet", columns(t, *motion(t))), arm).recording, 1e-4)
    t = np.arange(ROWS) / 400.7
    rounded = np.round(t, 3)
    recording = read_recording(write(tmp_path, "parquet", columns(rounded, *motion(t))), arm).recording
    require_motion(recording, 5e-5)


def test_no_mean_crosses_a_gap(arm, tmp_path):
    t = np.arange(ROWS) / RATE
    t[ROWS // 2 :] += 0.7313
    q, a = motion(t)
    a[ROWS // 2 :] += 3.0
    recording = read_recording(write(tmp_path, "csv", columns(t, q, a)), arm).recording
    assert len(recording.spans) == 2
    _, expected = motion(recording.time)
    expected[recording.time > t[ROWS // 2] - 0.1] += 3.0
    np.testing.assert_allclose(recording.specific_force, expected, atol=1e-4)


def test_joint_positions_stay_what_the_encoders_gave(arm, tmp_path):
    step = 2 * np.pi / 4096
    t = np.arange(ROWS) / RATE
    q, a = motion(t)
    loaded = read_recording(write(tmp_path, "parquet", columns(t, np.round(q / step) * step, a)), arm)
    assert loaded.encoder_steps[0] == pytest.approx(step, rel=1e-6)


def test_no_room_for_a_long_bag_says_what_to_do(arm, tmp_path, monkeypatch):
    t = np.arange(4000) / RATE
    path = write(tmp_path, "db3", columns(t, *motion(t)))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "nowhere"))
    with pytest.raises(circlepoint.InvalidInput, match=r"nowhere: cannot hold.*TMPDIR"):
        read_recording(path, arm)


@pytest.mark.parametrize("form", ["mapping", "pyarrow"])
def test_long_arrays_in_memory_are_thinned_out_as_files_are(form, arm, tmp_path):
    t = np.arange(ROWS) / RATE
    named = columns(t, *motion(t))
    expected = read_recording(write(tmp_path, "parquet", named), arm).recording
    table = pa.table(named) if form == "pyarrow" else {"t": t, "q": motion(t)[0], "a": motion(t)[1].astype(">f8")}
    found = circlepoint.recording_from_arrays(table, arm=arm).recording
    np.testing.assert_array_equal(found.time, expected.time)
    np.testing.assert_array_equal(found.joint_positions, expected.joint_positions)
    np.testing.assert_array_equal(found.specific_force, expected.specific_force)


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_bad_values_are_found_wherever_they_are(form, arm, tmp_path):
    t = np.arange(ROWS) / RATE
    q, a = motion(t)
    a[12_345, 1] = np.nan
    place = {"csv": "line 12347", "parquet": "row 12346"}[form]
    with pytest.raises(circlepoint.InvalidInput, match=rf"{place}: column `ay` is empty"):
        read_recording(write(tmp_path, form, columns(t, q, a)), arm)
    backwards = t.copy()
    backwards[15_000] = 1.0
    with pytest.raises(circlepoint.InvalidInput, match="backwards"):
        read_recording(write(tmp_path, form, columns(backwards, q, motion(t)[1])), arm)


@pytest.mark.parametrize("written", ["rows between rows", "a clock of its own"])
def test_long_logs_of_two_rates_are_thinned_out_apart(written, arm, tmp_path):
    t = np.arange(ROWS) / RATE
    q, a = motion(t)
    named = columns(t, q, a)
    if written == "rows between rows":
        joints, sensor = np.arange(ROWS) % 2 == 0, np.arange(ROWS) % 2 == 1
        for name in ("q1", "q2"):
            named[name] = np.where(joints, named[name], np.nan)
        for name in ("ax", "ay", "az"):
            named[name] = np.where(sensor, named[name], np.nan)
    else:  # a pendulum that swings faster and faster
        swing = 0.9 * np.sin(0.5 * t + 0.1 * t**2)
        named = columns(
            t, np.column_stack([swing, 0 * t]), 9.8 * np.column_stack([np.sin(swing), np.cos(swing), 0 * t])
        )
        named["t_sensor"] = t + 0.25
    loaded = read_recording(write(tmp_path, "csv", named), arm)
    assert [file.joints for file in loaded.files] == [True, False]
    assert [finding.code for finding in loaded.findings].count("thinned") == 2
    if written == "rows between rows":
        require_motion(loaded.recording, 1e-4)
    else:
        (clock,) = loaded.clock_alignments
        assert clock.offset == pytest.approx(0.25, abs=0.01)


def test_a_bad_value_in_one_of_two_rates_is_found_where_it_is(arm, tmp_path):
    t = np.arange(ROWS) / RATE
    named = columns(t, *motion(t))
    odd = np.arange(ROWS) % 2 == 1
    for name in ("q1", "q2"):
        named[name] = np.where(odd, np.nan, named[name])
    for name in ("ax", "ay", "az"):
        named[name] = np.where(odd, named[name], np.nan)
    named["ay"][12_345] = np.nan
    with pytest.raises(circlepoint.InvalidInput, match=r"line 12347: column `ay` is empty"):
        read_recording(write(tmp_path, "csv", named), arm)


def test_clipping_is_found_in_the_raw_samples_and_units_hold(arm, tmp_path):
    t = np.arange(ROWS) / RATE
    q, a = motion(t)
    a[:, 0] = np.clip(a[:, 0], -2, 0.95)
    named = columns(t, q, a, scale=9.80665)
    path = write(tmp_path, "parquet", {"t [ms]": 1e3 * named.pop("t"), **named})
    (tmp_path / "map.yaml").write_text("units: {a: g}\n")
    loaded = read_recording(path, arm, tmp_path / "map.yaml")
    (clipping,) = [finding.message for finding in loaded.findings if finding.code == "clipping"]
    assert "`ax` is stuck at 0.95 m/s^2" in clipping
    count = int(clipping.split(" in ")[1].split()[0])
    assert 0.7 < count / (a[:, 0] == 0.95).sum() <= 1  # runs cut short by the end of a piece are not counted
    assert loaded.recording.sample_rate == pytest.approx(RATE / FACTOR)


def test_the_rate_is_not_reduced_below_what_the_method_needs():
    assert long_logs.thinning_factor(10**9, 250.0) == 5
    assert long_logs.thinning_factor(10**9, 60.0) == 1
    assert long_logs.thinning_factor(ROWS, RATE) == FACTOR
