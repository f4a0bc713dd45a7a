"""Recordings in files: what is read is what was written, under any names, units and formats that say the same."""

import gzip

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
from arm_files import arm_of

import circlepoint
from circlepoint.arm import load_arm
from circlepoint.recording_io import read_recording

RATE = 100.0


@pytest.fixture
def arm(tmp_path):
    return arm_of(tmp_path, pan="revolute", slide="prismatic")


@pytest.fixture
def samples():
    t = np.arange(400) / RATE
    return {
        "t": t,
        "q1": np.round(0.8 * np.sin(2 * t), 6),
        "q2": np.round(0.1 * np.cos(t), 6),
        "ax": np.round(np.sin(t), 6),
        "ay": np.round(np.cos(t), 6),
        "az": np.full_like(t, 9.7) + np.round(0.01 * np.sin(7 * t), 6),
    }


def csv_text(columns, delimiter=",", decimal="."):
    body = [delimiter.join(columns)]
    body += [
        delimiter.join(f"{x:.9f}".replace(".", decimal) for x in row) for row in zip(*columns.values(), strict=True)
    ]
    return "\n".join(body) + "\n"


def require_same(recording, samples):
    np.testing.assert_allclose(recording.time, samples["t"], atol=1e-9)
    np.testing.assert_allclose(recording.joint_positions, np.column_stack([samples["q1"], samples["q2"]]), atol=1e-9)
    force = np.column_stack([samples["ax"], samples["ay"], samples["az"]])
    np.testing.assert_allclose(recording.specific_force, force, atol=1e-8)
    assert recording.sample_rate == pytest.approx(RATE)


@pytest.mark.parametrize(
    "form", ["csv", "gzip", "semicolon and decimal comma", "tab", "parquet", "byte order mark", "CRLF"]
)
def test_every_form_of_file_gives_the_same_recording(form, tmp_path, arm, samples):
    path = tmp_path / "log.csv"
    text = csv_text(samples)
    if form == "parquet":
        path = tmp_path / "log.parquet"
        pyarrow.parquet.write_table(pa.table(samples), path)
    elif form == "gzip":
        path = tmp_path / "log.csv.gz"
        path.write_bytes(gzip.compress(text.encode()))
    elif form == "semicolon and decimal comma":
        path.write_text(csv_text(samples, ";", ","))
    elif form == "tab":
        path.write_text(csv_text(samples, "\t"))
    elif form == "byte order mark":
        path.write_text(text, encoding="utf-8-sig")
    elif form == "CRLF":
        path.write_bytes(text.replace("\n", "\r\n").encode())
    else:
        path.write_text(text)
    loaded = read_recording(path, arm)
    require_same(loaded.recording, samples)
    assert not loaded.findings
    assert not loaded.clock_alignments


@pytest.mark.parametrize(
    "names",
    [
        ("time", "q_1", "q_2", "accel_x", "accel_y", "accel_z"),
        ("timestamp", "actual_q_0", "actual_q_1", *(f"actual_tool_accelerometer_{i}" for i in range(3))),
        ("Time", "pan", "slide", "AX", "AY", "AZ"),
        ("t", "q0", "q1", "linear_acceleration.x", "linear_acceleration.y", "linear_acceleration.z"),
    ],
)
def test_common_names_are_recognised(names, tmp_path, arm, samples):
    path = tmp_path / "log.csv"
    path.write_text(csv_text(dict(zip(names, samples.values(), strict=True))))
    require_same(read_recording(path, arm).recording, samples)


def test_a_column_map_gives_names_and_units(tmp_path, arm, samples):
    written = {
        "stamp": 1e3 * samples["t"],
        "a joint": np.degrees(samples["q1"]),
        "b joint": 1e3 * samples["q2"],
        "u": samples["ax"] / 9.80665,
        "v": samples["ay"] / 9.80665,
        "w": samples["az"] / 9.80665,
    }
    path = tmp_path / "log.csv"
    path.write_text(csv_text(written))
    columns = tmp_path / "map.yaml"
    columns.write_text("t: stamp\nq: [a joint, b joint]\na: [u, v, w]\nunits: {t: ms, q: deg, q2: mm, a: g}\n")
    require_same(read_recording(path, arm, columns).recording, samples)


def test_several_files_are_one_recording_with_a_span_each(tmp_path, arm, samples):
    paths = [tmp_path / "one.csv", tmp_path / "two.csv"]
    for path in paths:
        path.write_text(csv_text(samples))
    recording = read_recording(paths, arm).recording
    assert recording.samples == 2 * samples["t"].size
    assert len(recording.spans) == 2
    assert np.all(np.diff(recording.time) > 0)


def test_positions_wrapped_into_one_turn_are_made_continuous_and_reported(tmp_path, arm, samples):
    turning = 3 * samples["t"]
    wrapped = {**samples, "q1": np.mod(turning + np.pi, 2 * np.pi) - np.pi}
    path = tmp_path / "log.csv"
    path.write_text(csv_text(wrapped))
    loaded = read_recording(path, arm)
    np.testing.assert_allclose(loaded.recording.joint_positions[:, 0], turning, atol=1e-8)
    assert [finding.code for finding in loaded.findings] == ["wrapped"]


def test_clipping_is_found_where_the_sensor_moves_and_not_at_rest(tmp_path, arm, samples):
    clipped = {**samples, "ax": np.clip(samples["ax"], -0.9, 0.9)}
    path = tmp_path / "log.csv"
    path.write_text(csv_text(clipped))
    findings = read_recording(path, arm).findings
    assert [finding.code for finding in findings] == ["clipping"]
    assert "`ax` is stuck at 0.9" in findings[0].message
    resting = {
        **samples,
        "ax": np.repeat(0.5, 400),
        "ay": np.where(np.arange(400) < 200, 0.25, 0.5),
        "az": np.full(400, 9.7),
    }
    path.write_text(csv_text(resting))
    assert "clipping" not in [finding.code for finding in read_recording(path, arm).findings]


def test_large_positions_are_taken_when_the_unit_is_stated(tmp_path, arm, samples):
    path = tmp_path / "log.csv"
    path.write_text(csv_text({**samples, "q1": samples["q1"] + 100.0}))
    with pytest.raises(circlepoint.InvalidInput, match="degrees"):
        read_recording(path, arm)
    columns = tmp_path / "map.yaml"
    columns.write_text("units: {q1: rad}\n")
    recording = read_recording(path, arm, columns).recording
    np.testing.assert_allclose(recording.joint_positions[:, 0], samples["q1"] + 100.0, atol=1e-9)


def test_the_smallest_step_is_the_encoders(tmp_path, arm, samples):
    step = 2 * np.pi / 4096
    path = tmp_path / "log.csv"
    path.write_text(csv_text({**samples, "q1": np.round(samples["q1"] / step) * step}))
    assert read_recording(path, arm).encoder_steps[0] == pytest.approx(step, rel=1e-4)


def test_a_real_robots_two_clocks_are_aligned(shared_data):
    folder = shared_data / "real-ur5-imu-6"
    loaded = read_recording([folder / "joints.csv", folder / "sensor.csv"], load_arm(folder / "arm.yaml"))
    (clock,) = loaded.clock_alignments
    assert clock.rate == pytest.approx(1.0033, abs=1e-3)
    assert loaded.recording.joints == 6
    assert loaded.recording.angular_velocity is not None


def test_a_real_robots_own_names_are_recognised(shared_data, tmp_path):
    arm = tmp_path / "arm.yaml"
    joints = "".join(f"  - {{name: joint{i + 1}, type: revolute}}\n" for i in range(6))
    arm.write_text(f"name: ur3e\njoints:\n{joints}")
    loaded = read_recording(shared_data / "real-ur3e-rtde" / "recording.csv", load_arm(arm))
    assert loaded.recording.joints == 6
    assert loaded.recording.sample_rate == pytest.approx(25.0, rel=1e-3)
    assert "sample-rate" in [finding.code for finding in loaded.findings]


def test_a_wrist_that_made_whole_turns_is_not_taken_for_degrees(tmp_path, samples):
    path = tmp_path / "arm.yaml"
    joints = "joints:\n  - {name: pan, type: revolute, limits: [-6.3, 6.3]}\n  - {name: slide, type: prismatic}\n"
    path.write_text(f"name: two\n{joints}")
    log = tmp_path / "log.csv"
    log.write_text(csv_text({**samples, "q1": samples["q1"] + 4 * np.pi}))
    assert [finding.code for finding in read_recording(log, load_arm(path)).findings] == ["limits"]
    log.write_text(csv_text({**samples, "q1": 57.3 * samples["q1"]}))
    with pytest.raises(circlepoint.InvalidInput, match="degrees"):
        read_recording(log, load_arm(path))


def test_what_the_columns_were_taken_for_is_told_with_the_reason(tmp_path, arm, samples):
    names = ("t [ms]", "pan", "slide", "ax", "ay", "az")
    written = dict(zip(names, samples.values(), strict=True))
    written["t [ms]"] = 1e3 * written["t [ms]"]
    path = tmp_path / "log.csv"
    path.write_text(csv_text({**written, "pan": np.degrees(written["pan"])}))
    columns = tmp_path / "map.yaml"
    columns.write_text("units: {q1: deg}\n")
    (file,) = read_recording(path, arm, columns).files
    told = {each.name: (each.columns, each.unit, each.reason) for each in file.quantities}
    assert told["time"] == (("t [ms]",), "ms", "written in the column's name")
    assert told["joints"][:2] == (("pan", "slide"), "deg, SI")
    assert told["joints"][2] == "stated in the column map"
    assert "gravity" in told["specific force"][2]


def test_two_sensors_are_not_chosen_between(tmp_path, arm, samples):
    both = {**dict(list(samples.items())[:3])}
    for place in ("base", "flange"):
        both |= {f"{place}_a{axis}": samples[f"a{axis}"] for axis in "xyz"}
    path = tmp_path / "log.csv"
    path.write_text(csv_text(both))
    with pytest.raises(circlepoint.InvalidInput, match=r"several accelerometers.*base, flange.*--columns"):
        read_recording(path, arm)
    columns = tmp_path / "map.yaml"
    columns.write_text("a: [flange_ax, flange_ay, flange_az]\n")
    require_same(read_recording(path, arm, columns).recording, samples)


def test_commanded_positions_are_not_taken_for_measured_ones(tmp_path, arm, samples):
    names = ("t", "target_q_0", "target_q_1", "ax", "ay", "az")
    path = tmp_path / "log.csv"
    path.write_text(csv_text(dict(zip(names, samples.values(), strict=True))))
    with pytest.raises(circlepoint.InvalidInput, match="joint position columns"):
        read_recording(path, arm)


def test_time_of_day_in_parquet_is_seconds(tmp_path, arm, samples):
    stamps = (1_700_000_000 + samples["t"]) * 1e9
    table = pa.table({**samples, "t": pa.array(stamps.round().astype(np.int64), pa.timestamp("ns"))})
    pyarrow.parquet.write_table(table, tmp_path / "log.parquet")
    recording = read_recording(tmp_path / "log.parquet", arm).recording
    assert recording.sample_rate == pytest.approx(RATE, rel=1e-6)


def modules(count, rows=200):
    t = np.arange(rows) / 100
    named = {"t_pc": t + 0.01}
    for k in range(1, count + 1):
        named |= {f"hwt{k}": t, f"q{k}": 0.1 * k * t}
        named |= {f"a{k}{axis}": 0 * t + 0.1 * k + 9.7 * (axis == "z") for axis in "xyz"}
        named |= {f"w{k}{axis}": 0 * t + 0.01 * k for axis in "xyz"}
    return named


@pytest.mark.parametrize(("joints", "sensor", "beyond"), [(4, 5, ()), (2, 3, ()), (5, 5, (4,))])
def test_an_arm_of_modules_is_read_by_its_names(joints, sensor, beyond, tmp_path):
    named = modules(5)
    (tmp_path / "log.csv").write_text(
        "\n".join([",".join(named), *(",".join(map(str, row)) for row in zip(*named.values(), strict=True))]) + "\n"
    )
    loaded = read_recording(
        tmp_path / "log.csv", arm_of(tmp_path, **dict.fromkeys([f"joint{k + 1}" for k in range(joints)], "revolute"))
    )
    assert not loaded.clock_alignments
    quantities = {quantity.name: quantity.columns for quantity in loaded.files[0].quantities}
    assert quantities["time"] == (f"hwt{sensor}",)
    assert quantities["joints"] == tuple(f"q{k + 1}" for k in range(joints))
    assert quantities["specific force"] == tuple(f"a{sensor}{axis}" for axis in "xyz")
    assert quantities["gyroscope"] == tuple(f"w{sensor}{axis}" for axis in "xyz")
    assert loaded.files[0].beyond == beyond
    np.testing.assert_allclose(np.asarray(loaded.recording.specific_force)[:, 0], 0.1 * sensor)
    assert any(f"module {sensor} was taken" in finding.message for finding in loaded.findings)


def test_a_real_arm_of_modules_needs_no_column_map(shared_data, tmp_path):
    loaded = read_recording(
        shared_data / "real-hebi-5module" / "log.csv.gz",
        arm_of(tmp_path, a="revolute", b="revolute", c="revolute", d="revolute"),
    )
    assert loaded.files[0].samples == 1508
    assert np.abs(np.asarray(loaded.recording.specific_force)).max() < 30
