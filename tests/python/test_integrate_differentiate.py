"""Cumulative integrals and derivatives agree with SciPy and NumPy and invert each other."""

import numpy as np
import pytest
import scipy.integrate
import scipy.signal
from hypothesis import given, settings
from hypothesis import strategies as st

import circlepoint as cp

INTEGRAL_TOLERANCE = 1e-12
DERIVATIVE_TOLERANCE = 1e-12
SHAPES = [(1,), (2,), (3,), (4,), (100,), (2, 3), (3, 1), (4, 2), (5, 4), (101, 3), (100, 6), (64, 9)]
INTEGRALS = [
    (cp.cumulative_trapezoid, scipy.integrate.cumulative_trapezoid),
    (cp.cumulative_simpson, scipy.integrate.cumulative_simpson),
]


def random_samples(shape, seed=0):
    return np.random.default_rng(seed).normal(size=shape)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("ours", "reference"), INTEGRALS)
@pytest.mark.parametrize("initial", [None, 0.0])
def test_integrals_agree_with_scipy(shape, ours, reference, initial):
    y = random_samples(shape)
    x = np.cumsum(np.random.default_rng(1).uniform(0.01, 1.0, size=shape[0]))
    expected = reference(y, dx=0.1, axis=0, initial=initial)
    np.testing.assert_allclose(ours(y, dx=0.1, initial=initial), expected, rtol=0, atol=INTEGRAL_TOLERANCE)
    expected = reference(y, x=x, axis=0, initial=initial)
    np.testing.assert_allclose(ours(y, x=x, initial=initial), expected, rtol=0, atol=INTEGRAL_TOLERANCE)


@pytest.mark.parametrize("shape", SHAPES)
def test_simpson_adds_any_initial_value(shape):
    y = random_samples(shape)
    expected = scipy.integrate.cumulative_simpson(y, dx=0.1, axis=0, initial=2.5)
    np.testing.assert_allclose(cp.cumulative_simpson(y, dx=0.1, initial=2.5), expected, rtol=0, atol=INTEGRAL_TOLERANCE)


@given(
    steps=st.lists(st.floats(0.01, 10.0), min_size=2, max_size=40),
    coefficients=st.tuples(*[st.floats(-10.0, 10.0)] * 3),
)
@settings(deadline=None, max_examples=200)
def test_simpson_is_exact_for_parabolas_at_any_abscissae(steps, coefficients):
    x = np.cumsum([0.0, *steps])
    parabola = np.polynomial.Polynomial(coefficients)
    integral = parabola.integ()(x)
    scale = 1.0 + np.abs(coefficients) @ [x[-1], x[-1] ** 2, x[-1] ** 3]
    assert np.abs(cp.cumulative_simpson(parabola(x), x=x, initial=0.0) - integral).max() <= 1e-10 * scale


@pytest.mark.parametrize("edge_order", [1, 2])
@pytest.mark.parametrize("shape", [(3,), (4, 2), (100, 3), (1000,)])
def test_gradient_agrees_with_numpy(shape, edge_order):
    y = random_samples(shape)
    expected = np.gradient(y, 0.01, axis=0, edge_order=edge_order)
    np.testing.assert_allclose(
        cp.gradient(y, 0.01, edge_order=edge_order), expected, rtol=DERIVATIVE_TOLERANCE, atol=1e-10
    )


def test_gradient_of_two_samples_is_their_slope():
    np.testing.assert_array_equal(cp.gradient(np.array([1.0, 4.0]), 0.5), [6.0, 6.0])


@pytest.mark.parametrize("shape", [(101,), (101, 1), (500, 3), (120, 5)])
@pytest.mark.parametrize(("window", "polyorder"), [(1, 0), (5, 2), (5, 4), (21, 3), (51, 4), (101, 2)])
@pytest.mark.parametrize("deriv", [0, 1, 2, 3])
def test_savgol_agrees_with_scipy(shape, window, polyorder, deriv):
    x = random_samples(shape)
    expected = scipy.signal.savgol_filter(x, window, polyorder, deriv=deriv, delta=0.01, axis=0)
    ours = cp.savgol_filter(x, window, polyorder, deriv, 0.01)
    assert ours.shape == expected.shape
    assert np.abs(ours - expected).max() <= 1e-9 * np.abs(expected).max()


@given(coefficients=st.tuples(*[st.floats(-10.0, 10.0)] * 5), deriv=st.integers(0, 3))
@settings(deadline=None, max_examples=100)
def test_savgol_is_exact_for_polynomials_of_its_order_up_to_the_ends(coefficients, deriv):
    x = np.linspace(-1.0, 1.0, 201)
    quartic = np.polynomial.Polynomial(coefficients)
    exact = quartic.deriv(deriv)(x) if deriv else quartic(x)
    assert np.abs(cp.savgol_filter(quartic(x), 31, 4, deriv, x[1] - x[0]) - exact).max() < 1e-5


@pytest.mark.parametrize(
    ("function", "arguments", "options", "message"),
    [
        ("cumulative_trapezoid", (np.zeros(0),), {}, "no samples"),
        ("cumulative_trapezoid", (np.zeros(3), np.zeros(2)), {}, "x has 2 abscissae, y has 3"),
        ("cumulative_trapezoid", (np.zeros(3),), {"initial": 1.0}, "initial is 1"),
        ("cumulative_simpson", (np.zeros((0, 3)),), {}, "no samples"),
        ("cumulative_simpson", (np.zeros(3),), {"x": np.zeros(4)}, "x has 4 abscissae, y has 3"),
        ("cumulative_simpson", (np.zeros(3),), {"x": np.array([0.0, 1.0, 1.0])}, r"x\[1\] = 1.*x\[2\] = 1"),
        ("gradient", (np.zeros(5),), {"edge_order": 3}, "edge_order is 3"),
        ("gradient", (np.zeros(5), 0.0), {}, "dx is 0"),
        ("gradient", (np.zeros(1),), {}, "2 samples or more, there are 1"),
        ("gradient", (np.zeros(2),), {"edge_order": 2}, "3 samples or more, there are 2"),
        ("savgol_filter", (np.zeros(9), 4, 2), {}, "window_length is 4; give an odd"),
        ("savgol_filter", (np.zeros(9), 11, 2), {}, "window_length is 11, the signal has 9"),
        ("savgol_filter", (np.zeros(9), 5, 5), {}, "polyorder is 5"),
        ("savgol_filter", (np.zeros(9), 5, 2, -1), {}, "deriv is -1"),
        ("savgol_filter", (np.zeros(9), 5, 2, 1, 0.0), {}, "delta is 0"),
    ],
)
def test_errors_name_the_value_and_the_way_out(function, arguments, options, message):
    with pytest.raises(cp.InvalidInput, match=message):
        getattr(cp, function)(*arguments, **options)


@pytest.mark.parametrize("function", ["cumulative_trapezoid", "cumulative_simpson", "gradient"])
def test_other_layouts_are_refused_not_copied(function):
    with pytest.raises(TypeError, match="incompatible function arguments"):
        getattr(cp, function)(np.zeros((10, 3), order="F"))
    with pytest.raises(TypeError, match="incompatible function arguments"):
        getattr(cp, function)(np.zeros(10, dtype=np.float32))


def test_strided_abscissae_are_refused_not_copied():
    with pytest.raises(TypeError, match="incompatible function arguments"):
        cp.cumulative_trapezoid(np.zeros(10), np.arange(20.0)[::2])
