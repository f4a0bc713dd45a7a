#include "uniform_stream.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circlepoint/recording/timeline.hpp"

namespace circlepoint::detail {

double gaussian_sigma(double cutoff) { return std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * cutoff); }

UniformStream make_stream(const Eigen::Ref<const Eigen::VectorXd>& time, const Eigen::Ref<const SamplesX>& values,
                          double enough_rate) {
  const Timeline timeline = make_timeline(time);
  const SamplesX regular = regularise(timeline, values);
  const auto block = std::max<Index>(1, static_cast<Index>(std::floor(timeline.report.sample_rate / enough_rate)));
  UniformStream stream;
  stream.period = static_cast<double>(block) / timeline.report.sample_rate;
  Index count = 0;
  for (const IndexRange& span : timeline.spans) {
    count += span.size() / block;
  }
  stream.time.resize(count);
  stream.values.resize(count, values.cols());
  Index row = 0;
  for (const IndexRange& span : timeline.spans) {
    const Index begin = row;
    for (Index i = span.begin; i + block <= span.end; i += block, ++row) {
      stream.time(row) = timeline.time.segment(i, block).mean();
      stream.values.row(row) = regular.middleRows(i, block).colwise().mean();
    }
    if (row > begin) {
      stream.spans.push_back({begin, row});
    }
  }
  stream.start = stream.time(0);
  stream.time.array() -= stream.start;
  return stream;
}

SamplesX smooth(const UniformStream& stream, const SamplesX& values, double sigma, int order) {
  const auto half = static_cast<Index>(std::ceil(4.5 * sigma / stream.period));
  Eigen::VectorXd kernel(2 * half + 1);
  for (Index k = -half; k <= half; ++k) {
    const double t = static_cast<double>(k) * stream.period / sigma;
    const double gaussian = std::exp(-0.5 * t * t) / (sigma * std::sqrt(2.0 * std::numbers::pi)) * stream.period;
    const double factor = order == 0 ? 1.0 : order == 1 ? t / sigma : (t * t - 1.0) / (sigma * sigma);
    kernel(k + half) = factor * gaussian;  // correlated with the samples ahead: t is minus the convolution's
  }
  if (order == 0) {
    kernel /= kernel.sum();
  } else if (order == 2) {
    kernel.array() -= kernel.mean();  // a constant has no second derivative
  }
  SamplesX result(values.rows(), values.cols());
  for (const IndexRange& span : stream.spans) {
    const Index n = span.size();
    SamplesX padded(n + 2 * half, values.cols());
    for (Index i = -half; i < n + half; ++i) {
      Index k = i;
      while (k < 0 || k >= n) {
        k = k < 0 ? -k - 1 : 2 * n - 1 - k;
      }
      padded.row(i + half) = values.row(span.begin + k);
    }
    for (Index i = 0; i < n; ++i) {
      result.row(span.begin + i) = kernel.transpose() * padded.middleRows(i, 2 * half + 1);
    }
  }
  return result;
}

}  // namespace circlepoint::detail
