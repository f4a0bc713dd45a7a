"""One physical recording through every format: the same calibration, whatever it was written as."""

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest
from bag_writer import KINDS, write_bag, write_recording_bag

import circlepoint
from circlepoint.arm import load_arm
from circlepoint.demo import built_arm
from circlepoint.protocol import load_plan
from circlepoint.recording_io import read_recording

ARM = """\
name: three
joints: [{name: pan, type: revolute}, {name: lift, type: revolute}, {name: roll, type: revolute}]
dh:
  convention: standard
  rows:
    - {a: 0.0, alpha: 1.5708, d: 0.3, theta: 0.0}
    - {a: 0.4, alpha: 1.2, d: 0.1, theta: 0.2}
    - {a: 0.1, alpha: 0.4, d: 0.2, theta: -0.3}
"""
PLAN = """\
rate_hz: 250
rest_deg: [10, 40, 30]
tests:
  - joint: all
    static: {span_deg: 120, steps: 6, dwell: 0.8, move: 0.6}
    dynamic: {span_deg: 100, frequency_hz: 0.5, duration: 4}
"""
MIXED = [2, 0, 1]  # order of the joints in a message


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("arm") / "arm.yaml"
    path.write_text(ARM)
    return load_arm(path)


@pytest.fixture(scope="module")
def physical(arm, tmp_path_factory):
    """What happened: one simulated recording on a tilted base."""
    path = tmp_path_factory.mktemp("plan") / "plan.yaml"
    path.write_text(PLAN)
    plan = load_plan(path, arm.joint_names, [joint.type for joint in arm.joints])
    chain = built_arm(arm, plan.rest, 3)
    up = np.array([3.0, 4.0, 8.5])
    options = circlepoint.SimulationOptions(noise_std=0.003, seed=5)
    sensor = circlepoint.draw_accelerometer(circlepoint.AccelerometerSpecification(bias_std=0.01, scale_std=1e-3), 7)
    recording = circlepoint.simulate(chain, up, sensor, plan.trajectory(), options)
    whole_nanoseconds = np.round(recording.time, 9)
    return circlepoint.make_recording(whole_nanoseconds, recording.joint_positions, recording.specific_force)


def columns_of(recording, time, joints, force):
    named = {time: np.round(recording.time, 9)}
    named |= {name: recording.joint_positions[:, index] for index, name in enumerate(joints)}
    return named | {name: recording.specific_force[:, index] for index, name in enumerate(force)}


def write(form, folder, recording):
    table = pa.table(columns_of(recording, "t", ["q1", "q2", "q3"], ["ax", "ay", "az"]))
    if form == "CSV":
        pyarrow.csv.write_csv(table, folder / "log.csv")
        return folder / "log.csv"
    if form == "Parquet":
        pyarrow.parquet.write_table(table, folder / "log.parquet")
        return folder / "log.parquet"
    if form == "RTDE":
        names = columns_of(
            recording,
            "timestamp",
            [f"actual_q_{index}" for index in range(3)],
            [f"actual_tool_accelerometer_{index}" for index in range(3)],
        )
        commanded = {f"target_q_{index}": np.zeros(recording.samples) for index in range(3)}
        lines = [" ".join([*commanded, *names])]
        rows = zip(*commanded.values(), *names.values(), strict=True)
        lines += [" ".join(repr(float(value)) for value in row) for row in rows]
        (folder / "rtde.csv").write_text("\n".join(lines) + "\n")
        return folder / "rtde.csv"
    order = [("pan", "lift", "roll")[index] for index in MIXED]
    return write_recording_bag(
        folder / KINDS[form],
        form,
        order,
        time=recording.time,
        positions=recording.joint_positions[:, MIXED],
        force=recording.specific_force,
    )


def require_close(one, other, where="", relative=1e-9):
    if isinstance(one, dict):
        assert one.keys() == other.keys(), where
        for key in one:
            require_close(one[key], other[key], f"{where}.{key}", relative)
    elif isinstance(one, list):
        assert len(one) == len(other), where
        if one and all(isinstance(value, int | float) for value in one):
            scale = max(np.abs(one).max(), 1e-6)
            np.testing.assert_allclose(other, one, rtol=0, atol=relative * scale, err_msg=where)
        else:
            for index, value in enumerate(one):
                require_close(value, other[index], f"{where}[{index}]", relative)
    elif isinstance(one, float):
        assert other == pytest.approx(one, rel=relative, abs=1e-12), where
    else:
        assert one == other, where


@pytest.fixture(scope="module")
def reference(arm, physical, tmp_path_factory):
    path = write("CSV", tmp_path_factory.mktemp("reference"), physical)
    return circlepoint.calibrate(read_recording(path, arm).recording, arm).document


@pytest.mark.parametrize("form", ["Parquet", *KINDS, "RTDE"])
def test_every_format_gives_the_same_calibration(form, arm, physical, reference, tmp_path):
    loaded = read_recording(write(form, tmp_path, physical), arm)
    assert not loaded.clock_alignments
    document = circlepoint.calibrate(loaded.recording, arm).document
    assert document["complete"]
    for field in ("joints", "gravity_sensor", "sensor", "dh", "end_point", "covariance", "fit"):
        require_close(reference[field], document[field], field)


@pytest.mark.parametrize("form", ["mapping", "groups", "structured array", "pyarrow", "two tables", "named index"])
def test_columns_in_memory_give_the_same_calibration(form, arm, physical, reference):
    named = columns_of(physical, "t", ["pan", "lift", "roll"], ["accel_x", "accel_y", "accel_z"])
    if form == "groups":
        named = {"t": physical.time, "q": physical.joint_positions, "a": physical.specific_force}
    tables = [named]
    if form == "structured array":
        array = np.empty(physical.samples, dtype=[(name, float) for name in named])
        for name, values in named.items():
            array[name] = values
        tables = [array]
    elif form == "pyarrow":
        tables = [pa.table(named)]
    elif form == "named index":
        tables = [Frame(named)]
    elif form == "two tables":
        tables = [{k: named[k] for k in list(named)[:4]}, {k: named[k] for k in ("t", *list(named)[4:])}]
    loaded = circlepoint.recording_from_arrays(*tables, arm=arm)
    if form == "two tables":
        (clock,) = loaded.clock_alignments
        assert abs(clock.offset) < 1e-3
        assert abs(clock.rate - 1) < 1e-4
        return
    document = circlepoint.calibrate(loaded.recording, arm).document
    require_close(reference["joints"], document["joints"])


class Frame:
    """As much of a DataFrame as is used: columns, items, a named index; also a column of text and one of objects."""

    class _Index:
        name = "t"

        def __init__(self, values):
            self.values = values

        def __array__(self, dtype=None, copy=None):
            return np.array(self.values, dtype=dtype, copy=copy)

    def __init__(self, named):
        self._named = {name: values.astype(object) for name, values in named.items() if name != "t"}
        self._named["remark"] = np.full(named["t"].size, "fine", dtype=object)
        self.index = self._Index((named["t"] * 1e9).round().astype(np.int64).view("datetime64[ns]"))

    @property
    def columns(self):
        return list(self._named)

    def __getitem__(self, name):
        return self._named[name]


def test_arrays_that_are_no_recording_are_refused(arm):
    with pytest.raises(circlepoint.InvalidInput, match="by name"):
        circlepoint.recording_from_arrays(np.zeros((9, 3)), arm=arm)
    with pytest.raises(circlepoint.InvalidInput, match=r"differ in length.*t 9.*q1 8"):
        circlepoint.recording_from_arrays({"t": np.arange(9.0), "q": np.zeros((8, 3))}, arm=arm)
    with pytest.raises(circlepoint.InvalidInput, match="no table"):
        circlepoint.recording_from_arrays(arm=arm)
    broken = {"t": np.arange(20) / 100, "q": np.zeros((20, 3)), "a": np.full((20, 3), 5.6)}
    broken["a"][7, 1] = np.nan
    with pytest.raises(circlepoint.InvalidInput, match=r"table, row 8: column `ay`"):
        circlepoint.recording_from_arrays(broken, arm=arm)


def two_rates(physical):
    """Joint states at 50 Hz, the sensor at 250 Hz, with a start of its own and dropped samples."""
    joints = np.arange(0, physical.samples, 5)
    joints = np.delete(joints, [40, 41, 300])
    sensor = np.delete(np.arange(13, physical.samples), [700, 1500, 1501])
    return joints, sensor


@pytest.mark.parametrize("kind", KINDS)
def test_two_rates_in_one_bag_are_one_recording(kind, arm, physical, tmp_path):
    joints, sensor = two_rates(physical)
    path = tmp_path / KINDS[kind]
    topics = [
        ("/joint_states", [(physical.time[i], arm.joint_names, physical.joint_positions[i]) for i in joints]),
        ("/imu/data", [(physical.time[i], physical.specific_force[i], None) for i in sensor]),
    ]
    loaded = read_recording(write_bag(path, kind, topics), arm)
    assert [file.part for file in loaded.files] == ["topic /joint_states", "topic /imu/data"]
    assert loaded.recording.sample_rate == pytest.approx(250.0, rel=1e-6)
    assert any(finding.code == "clock" for finding in loaded.findings)
    found = circlepoint.calibrate(loaded.recording, arm)
    assert found.document["complete"]
    truth = nominal_lines_apart(found, physical, arm)
    assert truth < 2e-3


def nominal_lines_apart(found, physical, arm):
    whole = circlepoint.calibrate(physical, arm, reference_configuration=found.joints.reference_configuration)
    apart = [
        np.linalg.norm(one.axis.screw.line.direction - other.axis.screw.line.direction)
        for one, other in zip(found.joints.joints, whole.joints.joints, strict=True)
    ]
    return max(apart)


def test_two_rates_in_the_rows_of_one_table_are_as_in_a_bag(arm, physical, tmp_path):
    joints, sensor = two_rates(physical)
    rows = [(physical.time[i], *physical.joint_positions[i], "", "", "") for i in joints]
    rows += [(physical.time[i], "", "", "", *physical.specific_force[i]) for i in sensor]
    path = tmp_path / "log.csv"
    lines = [",".join(map(str, row)) for row in sorted(rows, key=lambda row: row[0])]
    path.write_text("\n".join(["t,q1,q2,q3,ax,ay,az", *lines]) + "\n")
    loaded = read_recording(path, arm)
    assert [file.samples for file in loaded.files] == [joints.size, sensor.size]
    assert loaded.recording.sample_rate == pytest.approx(250.0, rel=1e-6)


def test_a_sensors_own_time_column_is_a_second_clock(arm, physical, tmp_path):
    named = columns_of(physical, "t", ["q1", "q2", "q3"], ["ax", "ay", "az"])
    pyarrow.csv.write_csv(pa.table(named | {"hwt": 0.35 + 1.0021 * physical.time}), tmp_path / "log.csv")
    (clock,) = read_recording(tmp_path / "log.csv", arm).clock_alignments
    assert clock.offset == pytest.approx(0.35, abs=2e-3)
    assert clock.rate == pytest.approx(1.0021, abs=1e-4)


def test_stamps_of_one_bag_that_the_motions_contradict_become_two_clocks(arm, physical, tmp_path):
    topics = [
        (
            "/joint_states",
            [(t, arm.joint_names, q) for t, q in zip(physical.time, physical.joint_positions, strict=True)],
        ),
        ("/imu/data", [(t + 0.08, f, None) for t, f in zip(physical.time, physical.specific_force, strict=True)]),
    ]
    loaded = read_recording(write_bag(tmp_path / "log.bag", "ROS 1", topics), arm)
    (clock,) = loaded.clock_alignments
    assert clock.offset + (clock.rate - 1) * clock.reference_time == pytest.approx(0.08, abs=2e-3)
    assert "taken as two clocks" in " ".join(finding.message for finding in loaded.findings)


@pytest.mark.parametrize(
    "names",
    [
        ("/joint_states/position[0]", "/imu/linear_acceleration/x"),
        ("position.pan", "linear_acceleration.x"),
        ("field.position0", "field.linear_acceleration.x"),
        ("pan/position [deg]", "acc_x (g)"),
        ("joint_1_deg", "imu_ax_g"),
        ("Joint 1", "Accelerometer X [m/s^2]"),
    ],
)
def test_names_with_prefixes_and_units_are_recognised(names, arm, physical, tmp_path):
    joints = [names[0].replace("pan", joint) if "pan" in names[0] else names[0] for joint in arm.joint_names]
    digit = next((character for character in names[0] if character.isdigit()), "")
    if digit:
        joints = [names[0].replace(digit, str(int(digit) + index)) for index in range(3)]
    end = "X" if "X" in names[1] else "x"
    at = names[1].rindex(end)
    force = [names[1][:at] + (axis.upper() if end == "X" else axis) + names[1][at + 1 :] for axis in "xyz"]
    if "imu_ax" in names[1]:
        force = [f"imu_a{axis}_g" for axis in "xyz"]
    named = columns_of(physical, "timestamp (ms)", joints, force)
    named["timestamp (ms)"] = 1e3 * named["timestamp (ms)"]
    for name in joints:
        named[name] = np.degrees(named[name]) if "deg" in name else named[name]
    for name in force:
        named[name] = named[name] / 9.80665 if "g" in name.split("_")[-1] or "(g)" in name else named[name]
    pyarrow.csv.write_csv(pa.table(named), tmp_path / "log.csv")
    recording = read_recording(tmp_path / "log.csv", arm).recording
    np.testing.assert_allclose(recording.joint_positions, physical.joint_positions, atol=1e-9)
    np.testing.assert_allclose(recording.specific_force, physical.specific_force, atol=1e-8)
