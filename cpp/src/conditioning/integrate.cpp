#include "circlepoint/conditioning/integrate.hpp"

#include <string>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"
#include "signal_kernels.hpp"

namespace circlepoint {
namespace {

void require_samples(const Eigen::Ref<const SamplesX>& y) {
  require(y.rows() > 0, "no samples to integrate; give at least one");
}

void require_length(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x) {
  require(x.size() == y.rows(), "x has " + std::to_string(x.size()) + " abscissae, y has " + std::to_string(y.rows()) +
                                    " samples; give one abscissa a sample");
}

void require_increasing(const Eigen::Ref<const Eigen::VectorXd>& x) {
  for (Index i = 1; i < x.size(); ++i) {
    require(x[i] > x[i - 1], "x is not strictly increasing: x[" + std::to_string(i - 1) + "] = " +
                                 std::to_string(x[i - 1]) + ", x[" + std::to_string(i) + "] = " + std::to_string(x[i]) +
                                 "; sort the samples and drop repeated ones");
  }
}

SamplesX integrate(detail::SignalKernels::Integrate* kernel, const Eigen::Ref<const SamplesX>& y,
                   detail::Intervals intervals, std::optional<double> initial) {
  const Index first = initial ? 1 : 0;
  const Index channels = y.cols();
  SamplesX result = detail::unwritten_samples(y.rows() - 1 + first, channels);
  const detail::ClearedAhead ahead(result);
  if (initial) {
    result.row(0).setConstant(*initial);
  }
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(channels);
  kernel({y.data(), y.outerStride()}, {result.data() + first * channels, channels}, y.rows(), channels, intervals, sums.data(),
         initial.value_or(0.0));
  return result;
}

SamplesX trapezoid(const Eigen::Ref<const SamplesX>& y, detail::Intervals intervals, std::optional<double> initial) {
  require(!initial || *initial == 0.0,
          "initial is " + std::to_string(initial.value_or(0.0)) + "; give none, or 0 for a first row of zeros");
  return integrate(detail::signal_kernels().trapezoids, y, intervals, initial);
}

SamplesX simpson(const Eigen::Ref<const SamplesX>& y, detail::Intervals intervals, std::optional<double> initial) {
  const detail::SignalKernels& kernels = detail::signal_kernels();
  return integrate(y.rows() < 3 ? kernels.trapezoids : kernels.parabolas, y, intervals, initial);
}

}  // namespace

SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, double dx, std::optional<double> initial) {
  require_samples(y);
  return trapezoid(y, {nullptr, dx}, initial);
}

SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                              std::optional<double> initial) {
  require_samples(y);
  require_length(y, x);
  return trapezoid(y, {x.data(), 0.0}, initial);
}

SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, double dx, std::optional<double> initial) {
  require_samples(y);
  return simpson(y, {nullptr, dx}, initial);
}

SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                            std::optional<double> initial) {
  require_samples(y);
  require_length(y, x);
  if (y.rows() >= 3) {
    require_increasing(x);
  }
  return simpson(y, {x.data(), 0.0}, initial);
}

}  // namespace circlepoint
