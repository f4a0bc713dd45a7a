"""Every path of the kernels gives the same bits, and those agree with SciPy and NumPy."""

import os
import subprocess
import sys

import numpy as np
import pytest
import scipy.integrate
import scipy.signal

import circlepoint as cp

PATHS = cp.available_instruction_sets()
CHANNELS = range(1, 20)


@pytest.fixture(params=PATHS, ids=lambda path: path.name)
def path(request):
    before = cp.instruction_set()
    cp.use_instruction_set(request.param)
    yield request.param
    cp.use_instruction_set(before)


def with_path(path, call):
    before = cp.instruction_set()
    cp.use_instruction_set(path)
    try:
        return call()
    finally:
        cp.use_instruction_set(before)


def random_samples(*shape):
    return np.random.default_rng(sum(shape)).normal(size=shape)


def kernels(x):
    at = np.cumsum(np.random.default_rng(1).uniform(0.1, 1.0, len(x)))
    calls = [lambda f=f, s=s: f(s, x) for f in (cp.sosfilt, cp.sosfiltfilt) for s in map(lowpass, range(1, 10))]
    calls += [lambda f=f: f(x, dx=0.1, initial=0) for f in (cp.cumulative_trapezoid, cp.cumulative_simpson)]
    calls += [lambda f=f: f(x, x=at) for f in (cp.cumulative_trapezoid, cp.cumulative_simpson)]
    return [*calls, *(lambda d=d: cp.savgol_filter(x, 11, 3, d) for d in (0, 1))]


def lowpass(order):
    return cp.butter(order, 20.0, 500.0)


def statistics_inputs(n, scale=3.0):
    random = np.random.default_rng(n)
    return (*(scale * random.normal(size=(3, n))), random.normal(size=(n, 3)))


def parts(statistics):
    return [statistics.information, statistics.score, statistics.squares, statistics.count]


@pytest.mark.parametrize("channels", CHANNELS)
def test_paths_give_the_same_bits_for_signals(channels):
    for call in kernels(random_samples(301, channels)):
        results = [with_path(path, call) for path in PATHS]
        for result in results:
            np.testing.assert_array_equal(result, results[0])


@pytest.mark.parametrize("n", [0, 1, 2, 3, 5, 255, 256, 257, 1003])
def test_paths_give_the_same_bits_for_statistics(n):
    inputs = statistics_inputs(n)
    results = [parts(with_path(path, lambda: cp.joint_statistics(*inputs))) for path in PATHS]
    for result in results:
        for part, first in zip(result, results[0], strict=True):
            np.testing.assert_array_equal(part, first)


@pytest.mark.parametrize("channels", CHANNELS)
@pytest.mark.usefixtures("path")
def test_filters_and_integrals_agree_with_scipy_on_every_path(channels):
    x = random_samples(500, channels)
    sos = lowpass(4)
    np.testing.assert_array_equal(cp.sosfilt(sos, x), scipy.signal.sosfilt(sos, x, axis=0))
    np.testing.assert_allclose(cp.sosfiltfilt(sos, x), scipy.signal.sosfiltfilt(sos, x, axis=0), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(
        cp.cumulative_trapezoid(x, dx=0.1, initial=0),
        scipy.integrate.cumulative_trapezoid(x, dx=0.1, axis=0, initial=0),
    )
    np.testing.assert_allclose(
        cp.cumulative_simpson(x, dx=0.1), scipy.integrate.cumulative_simpson(x, dx=0.1, axis=0), rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(
        cp.savgol_filter(x, 21, 3), scipy.signal.savgol_filter(x, 21, 3, axis=0), rtol=0, atol=1e-12
    )


@pytest.mark.parametrize(("btype", "cutoff"), [("lowpass", 20.0), ("lowpass", 2.0), ("highpass", 5.0)])
@pytest.mark.parametrize("rows", [100_000, 131_072, 200_003])
@pytest.mark.usefixtures("path")
def test_a_signal_filtered_block_by_block_agrees_with_scipy(rows, btype, cutoff):
    x = 1.0 + np.cumsum(random_samples(rows, 3), axis=0) / 100
    sos = cp.butter(4, cutoff, 500.0, btype)
    reference = scipy.signal.sosfiltfilt(sos, x, axis=0)
    assert np.abs(cp.sosfiltfilt(sos, x) - reference).max() <= 1e-9 * np.abs(x).max()
    for padtype in ["even", "constant", None]:
        reference = scipy.signal.sosfiltfilt(sos, x, axis=0, padtype=padtype)
        assert np.abs(cp.sosfiltfilt(sos, x, padtype) - reference).max() <= 1e-9 * np.abs(x).max()


@pytest.mark.parametrize("order", [1, 4, 5, 9])
@pytest.mark.parametrize("channels", [1, 2, 3, 5, 7, 8, 10, 11])
@pytest.mark.usefixtures("path")
def test_both_halves_of_a_signal_filtered_side_by_side_agree_with_scipy(order, channels):
    sos = cp.butter(order, 100.0, 500.0)
    for rows in [4_000, 4_001]:
        x = random_samples(rows, channels)
        reference = scipy.signal.sosfiltfilt(sos, x, axis=0)
        np.testing.assert_allclose(cp.sosfiltfilt(sos, x), reference, rtol=0, atol=1e-12)


@pytest.mark.parametrize("channels", [1, 3, 10, 11])
def test_paths_give_the_same_bits_for_long_signals(channels):
    x = random_samples(50_001, channels)
    results = [with_path(path, lambda: cp.sosfiltfilt(lowpass(5), x)) for path in PATHS]
    for result in results:
        np.testing.assert_array_equal(result, results[0])


@pytest.mark.parametrize("rows", [200, 5_000])
@pytest.mark.usefixtures("path")
def test_sections_that_begin_with_a_delay_agree_with_scipy(rows):
    sos = lowpass(4)
    sos[0, :3] = [0.0, 0.3, 0.1]
    sos[1, :3] = [1e-6, 0.0, 0.5]
    x = random_samples(rows, 3)
    np.testing.assert_allclose(cp.sosfiltfilt(sos, x), scipy.signal.sosfiltfilt(sos, x, axis=0), rtol=0, atol=1e-10)


def test_channels_of_a_long_signal_are_filtered_independently():
    x = random_samples(100_000, 5)
    together = cp.sosfiltfilt(lowpass(4), x)
    for channel in range(5):
        np.testing.assert_array_equal(together[:, channel], cp.sosfiltfilt(lowpass(4), x[:, channel].copy()))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("rows", [1_000, 100_000])
@pytest.mark.usefixtures("path")
def test_a_value_that_is_not_finite_spoils_its_channel_and_no_other_as_in_scipy(rows, bad):
    x = random_samples(rows, 3)
    x[rows // 2, 1] = bad
    y = cp.sosfiltfilt(lowpass(4), x)
    with np.errstate(invalid="ignore"):
        reference = scipy.signal.sosfiltfilt(lowpass(4), x, axis=0)
    np.testing.assert_array_equal(np.isnan(y), np.isnan(reference))
    np.testing.assert_allclose(y[:, [0, 2]], reference[:, [0, 2]], rtol=0, atol=1e-9)


@pytest.mark.parametrize("scale", [1.0, 1e4, 1e7])
@pytest.mark.parametrize("n", [1, 4, 300, 5001])
@pytest.mark.usefixtures("path")
def test_joint_statistics_equal_the_sums_of_numpy(n, scale):
    angle, rate, acceleration, readings = statistics_inputs(n)
    angle = scale * angle
    rotation = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    x = np.column_stack([np.ones(n), np.cos(angle), np.sin(angle), acceleration, rate**2])
    y = readings @ rotation.T
    statistics = cp.joint_statistics(angle, rate, acceleration, readings, rotation)
    np.testing.assert_allclose(statistics.information, x.T @ x, rtol=0, atol=1e-13 * (x**2).sum())
    np.testing.assert_allclose(statistics.score, x.T @ y, rtol=0, atol=1e-13 * np.sqrt((x**2).sum() * (y**2).sum()))
    np.testing.assert_allclose(statistics.squares, (y**2).sum(axis=0), rtol=1e-12)
    assert statistics.count == n


@pytest.mark.usefixtures("path")
def test_statistics_of_regressors_equal_the_fused_ones():
    angle, rate, acceleration, readings = statistics_inputs(777)
    added = cp.RegressionStatistics()
    added.add(cp.joint_regressors(angle, rate, acceleration), readings)
    fused = cp.joint_statistics(angle, rate, acceleration, readings)
    for ours, reference in zip(parts(added), parts(fused), strict=True):
        np.testing.assert_allclose(ours, reference, rtol=0, atol=1e-11)


@pytest.mark.usefixtures("path")
def test_one_sample_shows_cosine_and_sine_to_the_last_digits():
    for angle in [0.0, 1e-9, 0.7, np.pi / 4, np.pi / 2, 2.0, np.pi, -2.5, 22.0, 355.0, 99_999.0, 1e9]:
        statistics = cp.joint_statistics(np.array([angle]), np.zeros(1), np.zeros(1), np.zeros((1, 3)))
        expected = [1.0, np.cos(angle), np.sin(angle), 0.0, 0.0]
        np.testing.assert_allclose(statistics.information[0], expected, rtol=4e-16, atol=1e-18)


@pytest.mark.usefixtures("path")
def test_a_nan_among_the_angles_is_not_lost():
    angle, rate, acceleration, readings = statistics_inputs(300)
    angle[100] = np.nan
    assert np.isnan(cp.joint_statistics(angle, rate, acceleration, readings).information[1, 1])


def test_joint_statistics_of_unequal_lengths_are_refused():
    angle, rate, acceleration, readings = statistics_inputs(10)
    with pytest.raises(cp.InvalidInput, match="10, 9 and 10 samples"):
        cp.joint_statistics(angle, rate[1:].copy(), acceleration, readings)
    with pytest.raises(cp.InvalidInput, match="10 angles and 9 readings"):
        cp.joint_statistics(angle, rate, acceleration, readings[1:].copy())


def run_with(setting):
    code = "import circlepoint as cp; print(cp.instruction_set().name)"
    environment = {**os.environ, "CIRCLEPOINT_INSTRUCTION_SET": setting}
    return subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)


def test_the_environment_chooses_the_path():
    for path in PATHS:
        assert run_with(path.name).stdout.strip() == path.name
    wrong = run_with("mmx")
    assert wrong.returncode != 0
    assert "CIRCLEPOINT_INSTRUCTION_SET is 'mmx'; give one of baseline" in wrong.stderr


def test_a_path_the_processor_does_not_have_is_refused():
    missing = [path for path in cp.InstructionSet if path not in PATHS]
    for path in missing:
        with pytest.raises(cp.InvalidInput, match=f"'{path.name}', which this processor does not have"):
            cp.use_instruction_set(path)
    assert PATHS[0] == cp.InstructionSet.baseline
