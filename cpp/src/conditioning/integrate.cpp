#include "circlepoint/conditioning/integrate.hpp"

#include <cstddef>
#include <string>

#include "circlepoint/core/error.hpp"
#include "result_memory.hpp"

namespace circlepoint {
namespace {

// The widths d_i of the intervals: a number, or differences of abscissae.
struct Uniform {
  double dx;
  double operator()(Index) const { return dx; }
};
struct Differences {
  const double* x;
  double operator()(Index i) const { return x[i + 1] - x[i]; }
};

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

// Rows of `Lanes` adjacent channels of y and of the result.
struct Columns {
  const double* y;
  Index y_step;
  double* integral;
  Index integral_step;
};

template <std::size_t Lanes, typename Width>
void sum_trapezoids(const Columns& at, Index samples, const Width& width) {
  double sum[Lanes] = {};
  for (Index i = 0; i + 1 < samples; ++i) {
    const double* left = at.y + i * at.y_step;
    const double* right = left + at.y_step;
    double* to = at.integral + i * at.integral_step;
    const double d = width(i);
    for (std::size_t c = 0; c < Lanes; ++c) {
      sum[c] += d * (right[c] + left[c]) / 2.0;
      to[c] = sum[c];
    }
  }
}

// The integral of the parabola through (near, middle, far) from near to middle is scale (w . samples).
struct ParabolaWeights {
  double scale, near, middle, far;

  double operator()(double at_near, double at_middle, double at_far) const {
    return scale * (near * at_near + middle * at_middle + far * at_far);
  }
};

ParabolaWeights parabola_weights(const Uniform& width, Index, Index) {
  return {width.dx / 3.0, 1.25, 2.0, -0.25};
}

ParabolaWeights parabola_weights(const Differences& width, Index near_interval, Index far_interval) {
  const double d_near = width(near_interval);
  const double d_far = width(far_interval);
  const double near_of_both = d_near / (d_near + d_far);
  const double product = near_of_both * (d_near / d_far);
  return {d_near / 6.0, 3.0 - near_of_both, 3.0 + product + near_of_both, -product};
}

// Adds the first (from_first) and the second interval of the parabola over samples i, i+1, i+2.
template <std::size_t Lanes, typename Width>
void add_parabola(const Columns& at, Index i, const Width& width, bool from_first, double offset, double* sum) {
  const ParabolaWeights first = parabola_weights(width, i, i + 1);
  const ParabolaWeights second = parabola_weights(width, i + 1, i);
  const double* y0 = at.y + i * at.y_step;
  const double* y1 = y0 + at.y_step;
  const double* y2 = y1 + at.y_step;
  double* to = at.integral + i * at.integral_step;
  double* to_second = to + at.integral_step;
  for (std::size_t c = 0; c < Lanes; ++c) {
    if (from_first) {
      sum[c] += first(y0[c], y1[c], y2[c]);
      to[c] = sum[c] + offset;
    }
    sum[c] += second(y2[c], y1[c], y0[c]);
    to_second[c] = sum[c] + offset;
  }
}

template <std::size_t Lanes, typename Width>
void sum_parabolas(const Columns& at, Index samples, const Width& width, double offset) {
  double sum[Lanes] = {};
  Index i = 0;
  for (; i + 2 < samples; i += 2) {
    add_parabola<Lanes>(at, i, width, true, offset, sum);
  }
  if (i + 1 < samples) {
    add_parabola<Lanes>(at, i - 1, width, false, offset, sum);
  }
}

// Calls kernel.operator()<Lanes>(columns) for all channels, as many as four at a time.
template <typename Kernel>
SamplesX integrate(const Eigen::Ref<const SamplesX>& y, std::optional<double> initial, const Kernel& kernel) {
  const Index first = initial ? 1 : 0;
  const Index channels = y.cols();
  SamplesX result = detail::unwritten_samples(y.rows() - 1 + first, channels);
  if (initial) {
    result.row(0).setConstant(*initial);
  }
  for (Index c = 0; c < channels; c += 4) {
    const Columns columns{y.data() + c, y.outerStride(), result.data() + first * channels + c, channels};
    switch (channels - c) {
      case 1: kernel.template operator()<1>(columns); break;
      case 2: kernel.template operator()<2>(columns); break;
      case 3: kernel.template operator()<3>(columns); break;
      default: kernel.template operator()<4>(columns); break;
    }
  }
  return result;
}

template <typename Width>
SamplesX trapezoid(const Eigen::Ref<const SamplesX>& y, const Width& width, std::optional<double> initial) {
  require(!initial || *initial == 0.0,
          "initial is " + std::to_string(initial.value_or(0.0)) + "; give none, or 0 for a first row of zeros");
  return integrate(y, initial, [&]<std::size_t Lanes>(const Columns& columns) {
    sum_trapezoids<Lanes>(columns, y.rows(), width);
  });
}

template <typename Width>
SamplesX simpson(const Eigen::Ref<const SamplesX>& y, const Width& width, std::optional<double> initial) {
  if (y.rows() < 3) {
    SamplesX result = integrate(y, initial, [&]<std::size_t Lanes>(const Columns& columns) {
      sum_trapezoids<Lanes>(columns, y.rows(), width);
    });
    result.bottomRows(y.rows() - 1).array() += initial.value_or(0.0);
    return result;
  }
  return integrate(y, initial, [&]<std::size_t Lanes>(const Columns& columns) {
    sum_parabolas<Lanes>(columns, y.rows(), width, initial.value_or(0.0));
  });
}

}  // namespace

SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, double dx, std::optional<double> initial) {
  require_samples(y);
  return trapezoid(y, Uniform{dx}, initial);
}

SamplesX cumulative_trapezoid(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                              std::optional<double> initial) {
  require_samples(y);
  require_length(y, x);
  return trapezoid(y, Differences{x.data()}, initial);
}

SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, double dx, std::optional<double> initial) {
  require_samples(y);
  return simpson(y, Uniform{dx}, initial);
}

SamplesX cumulative_simpson(const Eigen::Ref<const SamplesX>& y, const Eigen::Ref<const Eigen::VectorXd>& x,
                            std::optional<double> initial) {
  require_samples(y);
  require_length(y, x);
  if (y.rows() >= 3) {
    require_increasing(x);
  }
  return simpson(y, Differences{x.data()}, initial);
}

}  // namespace circlepoint
