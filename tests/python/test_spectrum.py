"""Welch's spectrum agrees with SciPy and with Parseval's theorem."""

import numpy as np
import pytest
import scipy.signal

import circlepoint as cp


def random_samples(shape):
    return np.random.default_rng(0).normal(size=shape) + 3.0


@pytest.mark.parametrize("shape", [(64,), (1000,), (1000, 1), (777, 3), (5000, 2)])
@pytest.mark.parametrize("window", ["hann", "boxcar"])
@pytest.mark.parametrize("segments", [{}, {"nperseg": 64}, {"nperseg": 63}, {"nperseg": 50, "noverlap": 13}])
@pytest.mark.parametrize("scaling", ["density", "spectrum"])
@pytest.mark.parametrize("detrend", ["constant", None])
def test_welch_agrees_with_scipy(shape, window, segments, scaling, detrend):
    x = random_samples(shape)
    reference = {"nperseg": min(256, shape[0]), **segments}
    expected = scipy.signal.welch(x, 500.0, window, axis=0, scaling=scaling, detrend=detrend or False, **reference)
    frequencies, power = cp.welch(x, 500.0, window, detrend=detrend, scaling=scaling, **segments)
    np.testing.assert_allclose(frequencies, expected[0], rtol=1e-14)
    assert power.shape == expected[1].shape
    assert np.abs(power - expected[1]).max() <= 1e-12 * expected[1].max()


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((np.zeros(0), 500.0), {}, "no samples"),
        ((np.zeros(100), 0.0), {}, "sample rate is 0"),
        ((np.zeros(100), 500.0), {"nperseg": 101}, "nperseg is 101, the signal has 100"),
        ((np.zeros(100), 500.0), {"nperseg": 0}, "nperseg is 0"),
        ((np.zeros(100), 500.0), {"nperseg": 10, "noverlap": 10}, "noverlap is 10, nperseg 10"),
        ((np.zeros(100), 500.0), {"noverlap": -1}, "noverlap is -1"),
        ((np.zeros(100), 500.0), {"window": "kaiser"}, "window is 'kaiser'"),
        ((np.zeros(100), 500.0), {"detrend": "linear"}, "detrend is 'linear'"),
        ((np.zeros(100), 500.0), {"scaling": "dB"}, "scaling is 'dB'"),
    ],
)
def test_welch_refuses_what_it_cannot_analyse(arguments, options, message):
    with pytest.raises(cp.InvalidInput, match=message):
        cp.welch(*arguments, **options)
