#include "signal_casters.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/conditioning/sosfilt.hpp"

namespace circlepoint::bindings {
namespace {

using py::literals::operator""_a;
using Abscissae = Eigen::Ref<const Eigen::VectorXd>;

constexpr auto butter_doc =
    R"(Butterworth filter as second-order sections, as ``scipy.signal.butter(..., output='sos')``.

Parameters
----------
order : int
    Order of the prototype; a band filter has twice as many poles.
cutoff : float or (float, float)
    Half-power frequency, or the lower and the upper one of a band, Hz.
sample_rate : float
    Hz.
btype : {'lowpass', 'highpass', 'bandpass', 'bandstop'}

Returns
-------
numpy.ndarray, shape (sections, 6)
    Rows b0, b1, b2, 1, a1, a2.

Raises
------
InvalidInput
    If the order is below 1, a cut-off is not between 0 and half the sample rate, the number of cut-offs does not fit
    `btype`, or `btype` is unknown.

References
----------
S. Butterworth, On the theory of filter amplifiers, Experimental Wireless 7 (1930).
)";

constexpr auto sosfilt_doc =
    R"(Filter along axis 0 by a cascade of second-order sections, from rest, as ``scipy.signal.sosfilt``.

Parameters
----------
sos : array_like, shape (sections, 6)
    Rows b0, b1, b2, 1, a1, a2.
x : numpy.ndarray, shape (n,) or (n, k)
    Signal in any unit; C-contiguous float64, never copied.

Returns
-------
numpy.ndarray, shape of `x`
    In the unit of `x`; equal to SciPy's to the last bit.

Raises
------
TypeError
    If `x` is not a C-contiguous float64 array with one or two axes.
InvalidInput
    If `sos` is empty or a row has a0 other than 1.

References
----------
A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, section 6.3 (transposed direct form II).
)";

constexpr auto sosfilt_zi_doc =
    R"(States in which a cascade answers a unit step with its final value at once.

Parameters
----------
sos : array_like, shape (sections, 6)
    Rows b0, b1, b2, 1, a1, a2.

Returns
-------
numpy.ndarray, shape (sections, 2)

Raises
------
InvalidInput
    If `sos` is empty, a row has a0 other than 1, or a section has a pole at z = 1.

References
----------
``scipy.signal.sosfilt_zi``.
)";

constexpr auto sosfiltfilt_doc =
    R"(Zero-phase filter along axis 0: forwards and backwards, as ``scipy.signal.sosfiltfilt``.

Parameters
----------
sos : array_like, shape (sections, 6)
    Rows b0, b1, b2, 1, a1, a2.
x : numpy.ndarray, shape (n,) or (n, k)
    Signal in any unit; C-contiguous float64, never copied.
padtype : {'odd', 'even', 'constant', 'none'} or None
    How the signal is continued beyond its ends: by its point reflection, its mirror image, its end value, or not.
padlen : int, optional
    Samples added at each end, fewer than n; by default three times the number of taps.

Returns
-------
numpy.ndarray, shape of `x`
    In the unit of `x`.

Raises
------
TypeError
    If `x` is not a C-contiguous float64 array with one or two axes.
InvalidInput
    If `x` has `padlen` samples or fewer, `padlen` is negative, `padtype` is unknown, or `sos` is as in `sosfilt_zi`.

References
----------
F. Gustafsson, Determining the initial states in forward-backward filtering, IEEE Trans. Signal Processing 44 (1996).
)";

constexpr auto trapezoid_doc =
    R"(Cumulative integral along axis 0 by the trapezoid rule, as ``scipy.integrate.cumulative_trapezoid``.

Parameters
----------
y : numpy.ndarray, shape (n,) or (n, k)
    Integrand; C-contiguous float64, never copied.
x : numpy.ndarray, shape (n,)
    Abscissae, in the other form spacing `dx`.
dx : float
    Spacing of equally spaced samples.
initial : {None, 0}
    0 puts a zero first, so that the result has as many rows as `y`.

Returns
-------
numpy.ndarray, shape (n - 1,) or (n - 1, k), or with `initial` that of `y`
    In the unit of `y` times that of `x`.

Raises
------
TypeError
    If `y` or `x` is not a C-contiguous float64 array.
InvalidInput
    If there are no samples, `x` has another length, or `initial` is another number.

References
----------
Newton-Cotes formula of degree 1.
)";

constexpr auto simpson_doc =
    R"(Cumulative integral along axis 0 by Simpson's rule, as ``scipy.integrate.cumulative_simpson``.

Parameters
----------
y : numpy.ndarray, shape (n,) or (n, k)
    Integrand; C-contiguous float64, never copied.
x : numpy.ndarray, shape (n,)
    Abscissae, strictly increasing; in the other form spacing `dx`.
dx : float
    Spacing of equally spaced samples.
initial : float, optional
    Put first and added to every value, so that the result has as many rows as `y`.

Returns
-------
numpy.ndarray, shape (n - 1,) or (n - 1, k), or with `initial` that of `y`
    In the unit of `y` times that of `x`.

Raises
------
TypeError
    If `y` or `x` is not a C-contiguous float64 array.
InvalidInput
    If there are no samples, or `x` has another length or is not strictly increasing.

References
----------
K. V. Cartwright, Simpson's rule cumulative integration with MS Excel and irregularly-spaced data, J. of Mathematical
Sciences and Mathematics Education 12 (2017), equations 8 and 10.
)";

constexpr auto gradient_doc =
    R"(First derivative along axis 0 by central differences, as ``numpy.gradient``.

Parameters
----------
y : numpy.ndarray, shape (n,) or (n, k)
    Equally spaced samples; C-contiguous float64, never copied.
dx : float
    Spacing.
edge_order : {1, 2}
    Order of the one-sided differences at the ends.

Returns
-------
numpy.ndarray, shape of `y`
    In the unit of `y` over that of `dx`.

Raises
------
TypeError
    If `y` is not a C-contiguous float64 array with one or two axes.
InvalidInput
    If there are fewer than edge_order + 1 samples, `edge_order` is neither 1 nor 2, or `dx` is zero or not finite.

References
----------
B. Fornberg, Generation of finite difference formulas on arbitrarily spaced grids, Math. Comp. 51 (1988).
)";

constexpr auto savgol_doc =
    R"(Savitzky-Golay smoothing or derivative along axis 0, as ``scipy.signal.savgol_filter(mode='interp')``.

Parameters
----------
x : numpy.ndarray, shape (n,) or (n, k)
    Equally spaced samples; C-contiguous float64, never copied.
window_length : int
    Samples a window; odd, at most n.
polyorder : int
    Order of the polynomial fitted to each window, less than `window_length`.
deriv : int
    Order of the derivative; 0 smooths.
delta : float
    Spacing.

Returns
-------
numpy.ndarray, shape of `x`
    In the unit of `x` over that of `delta` to the power `deriv`.

Raises
------
TypeError
    If `x` is not a C-contiguous float64 array with one or two axes.
InvalidInput
    If `window_length` is even or exceeds n, `polyorder` is not less than it, `deriv` is negative, or `delta` is zero or
    not finite.

References
----------
A. Savitzky, M. J. E. Golay, Smoothing and differentiation of data by simplified least squares procedures, Analytical
Chemistry 36 (1964).
)";

constexpr auto welch_doc =
    R"(Power spectral density along axis 0 by Welch's method, as ``scipy.signal.welch``.

Parameters
----------
x : numpy.ndarray, shape (n,) or (n, k)
    Equally spaced samples; C-contiguous float64, never copied.
sample_rate : float
    Hz.
window : {'hann', 'boxcar'}
nperseg : int, optional
    Samples a segment, at most n; by default 256, or n when that is less.
noverlap : int, optional
    Samples shared by neighbouring segments; by default half a segment.
detrend : {'constant', 'none'} or None
    Whether each segment's mean is taken off.
scaling : {'density', 'spectrum'}
    Unit of `x` squared per Hz, or unit of `x` squared.

Returns
-------
frequencies : numpy.ndarray, shape (f,)
    Hz, from 0 to half the sample rate.
power : numpy.ndarray, shape (f,) or (f, k)

Raises
------
TypeError
    If `x` is not a C-contiguous float64 array with one or two axes.
InvalidInput
    If `x` is empty, a segment is longer than `x`, the overlap is not less than a segment, the sample rate is not
    positive, or the name of an option is unknown.

References
----------
P. D. Welch, The use of the fast Fourier transform for the estimation of power spectra, IEEE Trans. Audio and
Electroacoustics 15 (1967).
)";

}  // namespace

void bind_filters(py::module_& m) {
  m.def("butter", py::overload_cast<int, double, double, BandType>(&butter), "order"_a, "cutoff"_a, "sample_rate"_a,
        "btype"_a = BandType::lowpass, release_gil(), butter_doc);
  m.def("butter", py::overload_cast<int, const std::array<double, 2>&, double, BandType>(&butter), "order"_a,
        "cutoff"_a, "sample_rate"_a, "btype"_a, release_gil(), "The same with the two cut-off frequencies of a band.");
  m.def("sosfilt", [](const Eigen::Ref<const SecondOrderSections>& sos, const Signal& x) {
          return x.like(sosfilt(sos, x.samples)); },
        "sos"_a, "x"_a.noconvert(), release_gil(), sosfilt_doc);
  m.def("sosfilt_zi", &sosfilt_zi, "sos"_a, release_gil(), sosfilt_zi_doc);
  m.def("sosfiltfilt", [](const Eigen::Ref<const SecondOrderSections>& sos, const Signal& x, PadType padtype,
                          std::optional<Index> padlen) {
          return x.like(sosfiltfilt(sos, x.samples, padtype, padlen)); },
        "sos"_a, "x"_a.noconvert(), "padtype"_a = PadType::odd, "padlen"_a = py::none(), release_gil(),
        sosfiltfilt_doc);

  m.def("cumulative_trapezoid", [](const Signal& y, const Abscissae& x, std::optional<double> initial) {
          return y.like(cumulative_trapezoid(y.samples, x, initial)); },
        "y"_a.noconvert(), "x"_a.noconvert(), py::kw_only(), "initial"_a = py::none(), release_gil(), trapezoid_doc);
  m.def("cumulative_trapezoid", [](const Signal& y, double dx, std::optional<double> initial) {
          return y.like(cumulative_trapezoid(y.samples, dx, initial)); },
        "y"_a.noconvert(), py::kw_only(), "dx"_a = 1.0, "initial"_a = py::none(), release_gil(),
        "The same for equally spaced samples.");
  m.def("cumulative_simpson", [](const Signal& y, const Abscissae& x, std::optional<double> initial) {
          return y.like(cumulative_simpson(y.samples, x, initial)); },
        "y"_a.noconvert(), py::kw_only(), "x"_a.noconvert(), "initial"_a = py::none(), release_gil(), simpson_doc);
  m.def("cumulative_simpson", [](const Signal& y, double dx, std::optional<double> initial) {
          return y.like(cumulative_simpson(y.samples, dx, initial)); },
        "y"_a.noconvert(), py::kw_only(), "dx"_a = 1.0, "initial"_a = py::none(), release_gil(),
        "The same for equally spaced samples.");

  m.def("gradient", [](const Signal& y, double dx, int edge_order) {
          return y.like(gradient(y.samples, dx, edge_order)); },
        "y"_a.noconvert(), "dx"_a = 1.0, py::kw_only(), "edge_order"_a = 1, release_gil(), gradient_doc);
  m.def("savgol_filter", [](const Signal& x, Index window_length, int polyorder, int deriv, double delta) {
          return x.like(savgol_filter(x.samples, window_length, polyorder, deriv, delta)); },
        "x"_a.noconvert(), "window_length"_a, "polyorder"_a, "deriv"_a = 0, "delta"_a = 1.0, release_gil(),
        savgol_doc);
  m.def("welch", [](const Signal& x, double sample_rate, Window window, std::optional<Index> nperseg,
                    std::optional<Index> noverlap, Detrend detrend, SpectrumScaling scaling) {
          PowerSpectrum spectrum = welch(x.samples, sample_rate, {window, nperseg, noverlap, detrend, scaling});
          return std::pair(std::move(spectrum.frequencies), x.like(std::move(spectrum.power))); },
        "x"_a.noconvert(), "sample_rate"_a, "window"_a = Window::hann, "nperseg"_a = py::none(),
        "noverlap"_a = py::none(), "detrend"_a = Detrend::constant, "scaling"_a = SpectrumScaling::density,
        release_gil(), welch_doc);
}

}  // namespace circlepoint::bindings
