import csv
import gzip

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import circlepoint as cp


def log(samples=1000, rate=250.0):
    time = np.arange(samples) / rate
    return time, np.column_stack([np.sin(time), np.cos(time)]), np.tile([0.0, 0.0, 9.8], (samples, 1))


def read(path):
    with path.open() as file:
        names = next(csv.reader(file))
        values = np.loadtxt(file, delimiter=",")
    return {name: np.ascontiguousarray(values[:, k]) for k, name in enumerate(names)}


def test_a_recording_shows_its_arrays_without_copying_and_read_only():
    time, q, f = log()
    recording = cp.make_recording(time, q, f, angular_velocity=np.zeros_like(f), temperature=np.full(len(time), 21.0))
    for array in (recording.time, recording.joint_positions, recording.specific_force, recording.angular_velocity):
        assert not array.flags.owndata
        assert not array.flags.writeable
    np.testing.assert_array_equal(recording.joint_positions, q)
    np.testing.assert_array_equal(recording.temperature, 21.0)
    assert recording.joints == 2
    assert [(s.begin, s.end) for s in recording.spans] == [(0, 1000)]


def test_arrays_outlive_the_name_of_their_recording():
    time = cp.make_recording(*log()).time
    assert time[-1] == pytest.approx(999 / 250)


@pytest.mark.parametrize("wrong", ["dtype", "order"])
def test_arrays_that_would_be_copied_silently_are_refused(wrong):
    time, q, f = log()
    q = q.astype(np.float32) if wrong == "dtype" else np.asfortranarray(q)
    with pytest.raises(TypeError):
        cp.make_recording(time, q, f)


def test_a_bad_value_is_a_value_error_that_names_row_and_column():
    time, q, f = log()
    q[41, 1] = np.nan
    with pytest.raises(cp.InvalidInput, match=r"q2.*row 42.*nan") as caught:
        cp.make_recording(time, q, f)
    assert isinstance(caught.value, ValueError)


def test_interpolation_equals_scipys_not_a_knot_spline():
    random = np.random.default_rng(1)
    knots = np.cumsum(random.uniform(0.1, 1.0, 50))
    values = random.normal(size=(50, 3))
    at = np.linspace(knots[0] - 0.05, knots[-1] + 0.05, 400)
    np.testing.assert_allclose(cp.interpolate_cubic(knots, values, at), CubicSpline(knots, values)(at), atol=1e-9)


def test_millisecond_stamps_of_a_real_sensor_become_one_clock(shared_data):
    sensor = read(shared_data / "real-ur5-imu-6" / "sensor.csv")
    report = cp.analyse_timeline(sensor["t"])
    assert report.rule == cp.StampRule.regularised
    assert report.sample_rate == pytest.approx(266.270, abs=1e-3)
    assert report.resolution == 1e-3
    assert len(report.repeated) == 5  # bunches of late stamps: no sample is missing, none is surplus
    assert not report.gaps
    assert not report.surplus


def test_samples_dropped_from_a_real_sensor_are_counted(shared_data):
    time = read(shared_data / "real-ur5-imu-6" / "sensor.csv")["t"]
    dropped = np.delete(time, [500, 2000, 2001, 9000, 9001, 9002, 15000, 15001, 15002, 15003, 15004])
    report = cp.analyse_timeline(dropped)
    assert [gap.missing for gap in report.gaps] == [1, 2, 3, 5]
    assert [gap.filled for gap in report.gaps] == [True, True, True, False]


def test_bursts_of_a_real_module_clock_are_believed_and_gaps_split(shared_data):
    with gzip.open(shared_data / "real-hebi-5module" / "log.csv.gz", "rt") as file:
        names = file.readline().strip().split(",")
        time = np.loadtxt(file, delimiter=",", usecols=names.index("hwt5"))
    report = cp.analyse_timeline(time)
    assert report.rule == cp.StampRule.believed
    assert report.sample_rate == pytest.approx(100, rel=0.06)
    assert max(gap.length for gap in report.gaps if not gap.filled) == pytest.approx(0.316282)


def test_equal_ranges_are_one_key_and_no_range_equals_something_else():
    assert {cp.IndexRange(2, 5): "a"}[cp.IndexRange(2, 5)] == "a"
    assert cp.IndexRange(2, 5) != cp.IndexRange(2, 6)
    assert cp.IndexRange(2, 5) != (2, 5)


@pytest.mark.parametrize("share", [0.02, 0.08, 0.14, 0.2, 0.3])
def test_true_jitter_of_any_size_is_believed_and_reported_and_no_sample_is_called_one_too_many(share):
    period = 0.005
    for seed in range(5):
        random = np.random.default_rng(seed)
        time = np.sort(np.arange(4000) * period + share * period * random.standard_normal(4000))
        recording = cp.make_recording(time, np.sin(time)[:, None].copy(), np.ones((4000, 3)))
        assert recording.timeline.jitter_std == pytest.approx(share * period, rel=0.1)
        assert recording.sample_rate == pytest.approx(200.0, rel=1e-3)
        assert len(recording.spans) == 1
        np.testing.assert_allclose(recording.joint_positions[:, 0], np.sin(recording.time), atol=1e-5)
