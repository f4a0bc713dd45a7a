"""Butterworth design and recursive filters agree with SciPy and obey the laws of zero-phase filters."""

import itertools
import sys
import threading

import numpy as np
import pytest
import scipy.signal
from hypothesis import given, settings
from hypothesis import strategies as st

import circlepoint as cp

SAMPLE_RATE = 500.0
DESIGN_TOLERANCE = 1e-12
FILTER_TOLERANCE = 1e-10

ORDERS = range(1, 9)
BANDS = [
    ("lowpass", 20.0),
    ("lowpass", 200.0),
    ("highpass", 5.0),
    ("bandpass", (5.0, 40.0)),
    ("bandstop", (45.0, 55.0)),
]
SHAPES = [(100,), (1000,), (100, 1), (333, 2), (1000, 3), (257, 4), (100, 8), (150, 11)]


def random_signal(shape, seed=0):
    return np.cumsum(np.random.default_rng(seed).normal(size=shape), axis=0)


def assert_agrees(ours, reference, tolerance=FILTER_TOLERANCE):
    assert ours.shape == reference.shape
    assert np.abs(ours - reference).max() <= tolerance * np.abs(reference).max()


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(("btype", "cutoff"), BANDS)
def test_butterworth_sections_equal_scipy(order, btype, cutoff):
    reference = scipy.signal.butter(order, cutoff, btype, fs=SAMPLE_RATE, output="sos")
    np.testing.assert_allclose(cp.butter(order, cutoff, SAMPLE_RATE, btype), reference, rtol=0, atol=DESIGN_TOLERANCE)


@given(
    order=st.integers(1, 10),
    btype=st.sampled_from(["lowpass", "highpass", "bandpass", "bandstop"]),
    lower=st.floats(0.03, 0.4),
    width=st.floats(0.03, 0.5),
)
@settings(deadline=None, max_examples=200)
def test_butterworth_gain_at_each_cutoff_is_half_power(order, btype, lower, width):
    cutoffs = [lower] if btype in ("lowpass", "highpass") else [lower, lower + width]
    sos = cp.butter(order, cutoffs[0] if len(cutoffs) == 1 else tuple(cutoffs), 2.0, btype)
    _, response = scipy.signal.freqz_sos(sos, cutoffs, fs=2.0)
    np.testing.assert_allclose(np.abs(response) ** 2, 0.5, rtol=1e-6)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("shape", SHAPES)
def test_sosfilt_equals_scipy_to_the_last_bit(order, shape):
    x = random_signal(shape)
    for btype, cutoff in BANDS:
        sos = cp.butter(order, cutoff, SAMPLE_RATE, btype)
        np.testing.assert_array_equal(cp.sosfilt(sos, x), scipy.signal.sosfilt(sos, x, axis=0))


@pytest.mark.parametrize("order", ORDERS)
def test_sosfilt_zi_equals_scipy(order):
    for btype, cutoff in BANDS:
        sos = cp.butter(order, cutoff, SAMPLE_RATE, btype)
        reference = scipy.signal.sosfilt_zi(sos)
        np.testing.assert_allclose(cp.sosfilt_zi(sos), reference, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("shape", SHAPES)
def test_sosfiltfilt_agrees_with_scipy(order, shape):
    x = random_signal(shape)
    for (btype, cutoff), padtype in itertools.product(BANDS, ["odd", "even", "constant", None]):
        sos = cp.butter(order, cutoff, SAMPLE_RATE, btype)
        reference = scipy.signal.sosfiltfilt(sos, x, axis=0, padtype=padtype)
        assert_agrees(cp.sosfiltfilt(sos, x, padtype), reference)


@pytest.mark.parametrize("padlen", [0, 1, 7, 99])
def test_sosfiltfilt_with_given_padlen_agrees_with_scipy(padlen):
    x = random_signal((100, 3))
    sos = cp.butter(4, 20.0, SAMPLE_RATE)
    assert_agrees(cp.sosfiltfilt(sos, x, padlen=padlen), scipy.signal.sosfiltfilt(sos, x, axis=0, padlen=padlen))


@pytest.mark.parametrize(
    ("order", "cutoff", "btype"), [(1, 9.0, "lowpass"), (4, 9.0, "highpass"), (3, (5, 40), "bandpass")]
)
def test_default_padlen_is_scipys_on_the_shortest_signal_it_takes(order, cutoff, btype):
    sos = cp.butter(order, cutoff, SAMPLE_RATE, btype)
    missing = min((sos[:, 2] == 0).sum(), (sos[:, 5] == 0).sum())
    padlen = 3 * (2 * len(sos) + 1 - missing)
    shortest = random_signal((padlen + 1,))
    assert_agrees(cp.sosfiltfilt(sos, shortest), scipy.signal.sosfiltfilt(sos, shortest))
    with pytest.raises(cp.InvalidInput, match=f"has {padlen} samples, the extension at each end {padlen}"):
        cp.sosfiltfilt(sos, shortest[1:].copy())


def test_channels_are_filtered_independently():
    x = random_signal((500, 7))
    sos = cp.butter(5, 20.0, SAMPLE_RATE)
    together = cp.sosfiltfilt(sos, x)
    for channel in range(x.shape[1]):
        np.testing.assert_array_equal(together[:, channel], cp.sosfiltfilt(sos, x[:, channel].copy()))


def test_filtering_is_linear_and_leaves_its_argument_alone():
    x, y = random_signal((400, 3), 1), random_signal((400, 3), 2)
    before = x.copy()
    sos = cp.butter(4, 20.0, SAMPLE_RATE)
    assert_agrees(cp.sosfiltfilt(sos, 2.0 * x - 3.0 * y), 2.0 * cp.sosfiltfilt(sos, x) - 3.0 * cp.sosfiltfilt(sos, y))
    np.testing.assert_array_equal(x, before)


def test_result_owns_its_memory_and_is_writable():
    y = cp.sosfilt(cp.butter(2, 20.0, SAMPLE_RATE), random_signal((10, 3)))
    assert y.flags.c_contiguous
    y[0] = 1.0


@pytest.mark.parametrize(
    "wrong",
    [
        np.zeros((100, 3), order="F"),
        np.zeros((100, 6))[:, ::2],
        np.zeros(200)[::2],
        np.zeros((100, 3), dtype=np.float32),
        np.zeros(100, dtype=int),
        np.zeros((100, 3, 2)),
        [0.0] * 100,
    ],
    ids=["fortran", "strided columns", "strided", "float32", "int", "three axes", "list"],
)
@pytest.mark.parametrize("name", ["sosfilt", "sosfiltfilt"])
def test_other_layouts_and_dtypes_are_refused_not_copied(name, wrong):
    with pytest.raises(TypeError, match="incompatible function arguments"):
        getattr(cp, name)(cp.butter(2, 20.0, SAMPLE_RATE), wrong)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0, 20.0, 500.0), "order is 0"),
        ((2, 300.0, 500.0), r"300.*Hz is outside \(0, 250.*Nyquist"),
        ((2, 250.0, 500.0), "outside"),
        ((2, 0.0, 500.0), "outside"),
        ((2, float("nan"), 500.0), "outside"),
        ((2, 20.0, 0.0), "sample rate is 0"),
        ((2, 20.0, 500.0, "bandpass"), "two cut-off frequencies"),
        ((2, (5.0, 20.0), 500.0, "lowpass"), "one cut-off frequency"),
        ((2, (20.0, 5.0), 500.0, "bandpass"), "give the lower one first"),
        ((2, (20.0, 260.0), 500.0, "bandstop"), "260.*Nyquist"),
        ((2, 20.0, 500.0, "low"), "btype is 'low'; give one of 'lowpass', 'highpass'"),
    ],
)
def test_butter_refuses_impossible_designs(arguments, message):
    with pytest.raises(cp.InvalidInput, match=message):
        cp.butter(*arguments)


@pytest.mark.parametrize(
    ("sos", "options", "message"),
    [
        ([[1.0, 0, 0, 2.0, 0, 0]], {}, "row 0 has a0 = 2"),
        (np.zeros((0, 6)), {}, "no sections"),
        ([[1.0, 0, 0, 1.0, -1.0, 0]], {}, "pole at z = 1"),
        ([[1.0, 0, 0, 1.0, 0, 0]], {"padlen": -1}, "padlen is -1"),
        ([[1.0, 0, 0, 1.0, 0, 0]], {"padlen": 50}, "50 samples"),
        ([[1.0, 0, 0, 1.0, 0, 0]], {"padtype": "periodic"}, "padtype is 'periodic'"),
    ],
)
def test_sosfiltfilt_refuses_what_it_cannot_filter(sos, options, message):
    with pytest.raises(cp.InvalidInput, match=message):
        cp.sosfiltfilt(sos, np.zeros(50), **options)


def test_an_empty_signal_is_refused_without_padding_too():
    with pytest.raises(cp.InvalidInput, match="has 0 samples"):
        cp.sosfiltfilt(cp.butter(2, 20.0, SAMPLE_RATE), np.zeros((0, 3)), padtype=None)


@pytest.mark.parametrize("filtered", ["sosfiltfilt", "savgol_filter", "cumulative_trapezoid"])
def test_results_above_32_megabytes_are_those_of_their_pieces(filtered):
    """Their memory is cleared by a thread of its own while they are written."""
    call = {
        "sosfiltfilt": lambda x: cp.sosfiltfilt(cp.butter(4, 20.0, SAMPLE_RATE), x),
        "savgol_filter": lambda x: cp.savgol_filter(x, 21, 3),
        "cumulative_trapezoid": lambda x: cp.cumulative_trapezoid(x, dx=1.0, initial=0.0),
    }[filtered]
    x = np.random.default_rng(0).normal(size=(1_500_000, 3))
    whole = call(x)
    for begin in (0, 700_000, 1_480_000):
        piece = call(x[begin : begin + 20_000])
        inner = slice(2000, 18_000)
        ours = whole[begin : begin + 20_000][inner]
        start = ours[0] - piece[inner][0] if filtered == "cumulative_trapezoid" else 0.0
        np.testing.assert_allclose(ours, piece[inner] + start, rtol=0, atol=1e-9)


def test_another_python_thread_runs_while_a_signal_is_filtered():
    sos, x = cp.butter(4, 20.0, SAMPLE_RATE), np.zeros((500_000, 3))
    go, ran = threading.Event(), threading.Event()
    other = threading.Thread(target=lambda: (go.wait(), ran.set()))
    interval = sys.getswitchinterval()
    other.start()
    try:
        sys.setswitchinterval(1000.0)  # only a call that lets go of the interpreter lock lets the other thread run
        go.set()
        for _ in range(50):
            cp.sosfiltfilt(sos, x)
            if ran.is_set():
                break
        ran_meanwhile = ran.is_set()
    finally:
        sys.setswitchinterval(interval)
    other.join()
    assert ran_meanwhile
