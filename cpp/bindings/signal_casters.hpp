#pragma once
// How signals and the names of options cross between Python and the core.
//
// A Signal is a C-contiguous float64 array of shape (n,) or (n, k), taken by reference: any other dtype or layout is
// refused (TypeError), never copied silently. A SignalLike goes back as an array of the rank its argument had.
// Enumerations of options are strings in Python, as in SciPy; `none` is also None.

#include <pybind11/numpy.h>

#include <array>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/spectrum.hpp"
#include "circlepoint/core/error.hpp"

namespace circlepoint::bindings {

struct SignalLike {
  SamplesX values;
  bool one_dimensional = false;
};

struct Signal {
  Eigen::Map<const SamplesX> samples{nullptr, 0, 0};
  bool one_dimensional = false;

  [[nodiscard]] SignalLike like(SamplesX&& values) const { return {std::move(values), one_dimensional}; }
};

template <typename Enum>
struct OptionNames;

template <>
struct OptionNames<BandType> {
  static constexpr auto argument = "btype";
  static constexpr auto type = py::detail::const_name("typing.Literal['lowpass', 'highpass', 'bandpass', 'bandstop']");
  static constexpr std::array<const char*, 4> names{"lowpass", "highpass", "bandpass", "bandstop"};
};
template <>
struct OptionNames<PadType> {
  static constexpr auto argument = "padtype";
  static constexpr auto type = py::detail::const_name("typing.Literal['odd', 'even', 'constant', 'none'] | None");
  static constexpr std::array<const char*, 4> names{"odd", "even", "constant", "none"};
};
template <>
struct OptionNames<Window> {
  static constexpr auto argument = "window";
  static constexpr auto type = py::detail::const_name("typing.Literal['hann', 'boxcar']");
  static constexpr std::array<const char*, 2> names{"hann", "boxcar"};
};
template <>
struct OptionNames<Detrend> {
  static constexpr auto argument = "detrend";
  static constexpr auto type = py::detail::const_name("typing.Literal['constant', 'none'] | None");
  static constexpr std::array<const char*, 2> names{"constant", "none"};
};
template <>
struct OptionNames<SpectrumScaling> {
  static constexpr auto argument = "scaling";
  static constexpr auto type = py::detail::const_name("typing.Literal['density', 'spectrum']");
  static constexpr std::array<const char*, 2> names{"density", "spectrum"};
};

}  // namespace circlepoint::bindings

namespace pybind11::detail {

template <>
struct type_caster<circlepoint::bindings::Signal> {
  static constexpr auto name = const_name(
      "typing.Annotated[numpy.typing.NDArray[numpy.float64], \"[n] or [n, k]\", \"flags.c_contiguous\"]");

  bool load(handle source, bool) {
    if (!array_t<double, array::c_style>::check_(source)) {
      return false;
    }
    array_ = reinterpret_borrow<array>(source);
    if (array_.ndim() != 1 && array_.ndim() != 2) {
      return false;
    }
    const Eigen::Index channels = array_.ndim() == 2 ? array_.shape(1) : 1;
    value_.one_dimensional = array_.ndim() == 1;
    new (&value_.samples) Eigen::Map<const circlepoint::SamplesX>(static_cast<const double*>(array_.data()),
                                                                  array_.shape(0), channels);
    return true;
  }

  template <typename>
  using cast_op_type = const circlepoint::bindings::Signal&;
  operator const circlepoint::bindings::Signal&() { return value_; }

 private:
  array array_;
  circlepoint::bindings::Signal value_;
};

template <>
struct type_caster<circlepoint::bindings::SignalLike> {
  static constexpr auto name = const_name("numpy.typing.NDArray[numpy.float64]");

  static handle cast(circlepoint::bindings::SignalLike&& signal, return_value_policy, handle) {
    auto* owned = new circlepoint::SamplesX(std::move(signal.values));
    const capsule owner(owned, [](void* memory) { delete static_cast<circlepoint::SamplesX*>(memory); });
    return signal.one_dimensional ? array_t<double>({owned->rows()}, owned->data(), owner).release()
                                  : array_t<double>({owned->rows(), owned->cols()}, owned->data(), owner).release();
  }
};

template <typename Enum>
struct option_caster {
  using Names = circlepoint::bindings::OptionNames<Enum>;
  PYBIND11_TYPE_CASTER(Enum, Names::type);

  bool load(handle source, bool) {
    if (!source.is_none() && !isinstance<str>(source)) {
      return false;
    }
    const std::string given = source.is_none() ? "none" : source.cast<std::string>();
    std::string known;
    for (std::size_t i = 0; i < Names::names.size(); ++i) {
      if (given == Names::names[i]) {
        value = static_cast<Enum>(i);
        return true;
      }
      known += (i == 0 ? "'" : ", '") + std::string(Names::names[i]) + "'";
    }
    throw circlepoint::InvalidInput(std::string(Names::argument) + " is '" + given + "'; give one of " + known);
  }

  static handle cast(Enum option, return_value_policy, handle) {
    return str(Names::names[static_cast<std::size_t>(option)]).release();
  }
};

template <>
struct type_caster<circlepoint::BandType> : option_caster<circlepoint::BandType> {};
template <>
struct type_caster<circlepoint::PadType> : option_caster<circlepoint::PadType> {};
template <>
struct type_caster<circlepoint::Window> : option_caster<circlepoint::Window> {};
template <>
struct type_caster<circlepoint::Detrend> : option_caster<circlepoint::Detrend> {};
template <>
struct type_caster<circlepoint::SpectrumScaling> : option_caster<circlepoint::SpectrumScaling> {};

}  // namespace pybind11::detail
