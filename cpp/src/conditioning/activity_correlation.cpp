#include "activity_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace circlepoint::detail {
namespace {

constexpr double grid_period = 0.02;  // s
constexpr double smoothing = 0.08;    // s

Activity on_grid(const UniformStream& stream, const Eigen::VectorXd& speed) {
  Activity activity{grid_period, Eigen::VectorXd::Zero(static_cast<Index>(stream.duration() / grid_period) + 1)};
  Eigen::VectorXd covered = Eigen::VectorXd::Zero(activity.values.size());
  for (const IndexRange& span : stream.spans) {
    for (Index i = span.begin; i + 1 < span.end; ++i) {
      const double from = stream.time(i), to = stream.time(i + 1);
      for (auto k = static_cast<Index>(std::ceil(from / grid_period)); static_cast<double>(k) * grid_period < to; ++k) {
        if (k < activity.values.size()) {
          const double t = (static_cast<double>(k) * grid_period - from) / (to - from);
          activity.values(k) = std::sqrt((1.0 - t) * speed(i) + t * speed(i + 1));
          covered(k) = 1.0;
        }
      }
    }
  }
  const double mean = activity.values.sum() / std::max(1.0, covered.sum());
  activity.values -= mean * covered;
  return activity;
}

Activity averaged(const Activity& activity, Index block) {
  const Index count = std::max<Index>(1, activity.values.size() / block);
  Activity result{activity.period * static_cast<double>(block), Eigen::VectorXd::Zero(count)};
  for (Index k = 0; k < count; ++k) {
    const Index begin = k * block;
    result.values(k) = activity.values.segment(begin, std::min(block, activity.values.size() - begin)).mean();
  }
  return result;
}

double value_at(const Activity& activity, double time) {
  const double x = time / activity.period;
  const double k = std::floor(x);
  if (k < 0.0 || k + 1.0 >= static_cast<double>(activity.values.size())) {
    return 0.0;
  }
  const auto i = static_cast<Index>(k);
  return activity.values(i) + (x - k) * (activity.values(i + 1) - activity.values(i));
}

// Sum over the joint grid of the product of the activities; centres of the blocks, hence the half period.
double overlap_product(const Activity& joints, const Activity& sensor, const RelativeClock& clock) {
  double sum = 0.0;
  const double half = 0.5 * (sensor.period - grid_period);
  for (Index k = 0; k < joints.values.size(); ++k) {
    const double u = joints.period * static_cast<double>(k) + 0.5 * (joints.period - grid_period);
    sum += joints.values(k) * value_at(sensor, clock.sensor(u) - half);
  }
  return sum;
}

}  // namespace

Activity joint_activity(const UniformStream& joints) {
  return on_grid(joints, smooth(joints, joints.values, smoothing, 1).rowwise().norm());
}

Activity sensor_activity(const UniformStream& sensor) {
  return on_grid(sensor, smooth(sensor, sensor.values, smoothing, 1).rowwise().norm());
}

CoarseAlignment correlate(const Activity& joints, const Activity& sensor, double max_rate_deviation) {
  const double longest = grid_period * static_cast<double>(std::max(joints.values.size(), sensor.values.size()));
  const double span = grid_period * static_cast<double>(joints.values.size());
  Index block = std::max<Index>(5, static_cast<Index>(longest / (8192.0 * grid_period)));
  const Activity coarse_joints = averaged(joints, block);
  const Activity coarse_sensor = averaged(sensor, block);
  const Index n = coarse_joints.values.size();

  // Every offset at once by FFT, for each rate; the step of the rates moves the far end by one period.
  Index size = 1;
  while (size < coarse_sensor.values.size() + 2 * n) {
    size *= 2;
  }
  Eigen::FFT<double> fft;
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(size);
  padded.head(coarse_sensor.values.size()) = coarse_sensor.values;
  Eigen::VectorXcd sensor_spectrum, spectrum;
  fft.fwd(sensor_spectrum, padded);
  const double rate_step = std::min(max_rate_deviation, coarse_joints.period / span);
  const auto steps = static_cast<Index>(std::ceil(max_rate_deviation / rate_step));
  double best = -1.0;
  RelativeClock clock;
  for (Index r = -steps; r <= steps; ++r) {
    const double rate = 1.0 + std::clamp(static_cast<double>(r) * rate_step, -max_rate_deviation, max_rate_deviation);
    padded.setZero();
    for (Index k = 0; k < std::min(size / 2, static_cast<Index>(static_cast<double>(n) * rate)); ++k) {
      padded(k) = value_at(coarse_joints, static_cast<double>(k) * coarse_joints.period / rate);
    }
    fft.fwd(spectrum, padded);
    spectrum = sensor_spectrum.cwiseProduct(spectrum.conjugate()).eval();
    Eigen::VectorXd correlation;
    fft.inv(correlation, spectrum);
    Index lag = 0;
    const double value = correlation.maxCoeff(&lag);
    if (value > best) {
      best = value;
      clock = {static_cast<double>(lag > size - n - 1 ? lag - size : lag) * coarse_joints.period, rate};
    }
  }

  // Refined around the best, at twice the resolution each time: by the sensor time of the joints' middle, and the rate.
  const double middle = 0.5 * span;
  double step = coarse_joints.period;
  while (true) {
    const Activity a = averaged(joints, block), b = averaged(sensor, block);
    const double centre = clock.sensor(middle);
    const double rate_centre = clock.rate;
    double reached = -1.0;
    for (int i = -4; i <= 4; ++i) {
      for (int k = -4; k <= 4; ++k) {
        const double rate = rate_centre + 0.5 * k * step / span;
        if (std::abs(rate - 1.0) > max_rate_deviation) {
          continue;
        }
        const RelativeClock candidate{centre + 0.5 * i * step - rate * middle, rate};
        const double value = overlap_product(a, b, candidate);
        if (value > reached) {
          reached = value;
          clock = candidate;
        }
      }
    }
    if (block == 1) {
      break;
    }
    block = std::max<Index>(1, block / 2);
    step *= 0.5;
  }
  double product = 0.0, joint_square = 0.0, sensor_square = 0.0;
  for (Index k = 0; k < joints.values.size(); ++k) {
    const double b = value_at(sensor, clock.sensor(grid_period * static_cast<double>(k)));
    if (b != 0.0) {
      product += joints.values(k) * b;
      joint_square += joints.values(k) * joints.values(k);
      sensor_square += b * b;
    }
  }
  const double scale = std::sqrt(joint_square * sensor_square);
  return {clock, scale > 0.0 ? product / scale : 0.0};
}

WindowDelay window_delay(const Activity& joints, const Activity& sensor, const RelativeClock& clock, double begin,
    double end,
                         double range) {
  const auto first = std::max<Index>(0, static_cast<Index>(std::ceil(begin / grid_period)));
  const auto last = std::min<Index>(joints.values.size() - 1, static_cast<Index>(end / grid_period));
  const Index count = last - first + 1;
  WindowDelay result;
  if (count < 8) {
    return result;
  }
  const Eigen::VectorXd a = joints.values.segment(first, count).array() - joints.values.segment(first, count).mean();
  const auto steps = static_cast<Index>(range / grid_period);
  Eigen::VectorXd correlation(2 * steps + 1), b(count);
  for (Index s = -steps; s <= steps; ++s) {
    for (Index k = 0; k < count; ++k) {
      b(k) = value_at(sensor, clock.sensor(grid_period * static_cast<double>(first + k + s)));
    }
    b.array() -= b.mean();
    const double scale = a.norm() * b.norm();
    correlation(s + steps) = scale > 0.0 ? a.dot(b) / scale : 0.0;
  }
  Index peak = 0;
  result.correlation = correlation.maxCoeff(&peak);
  if (peak == 0 || peak == 2 * steps) {
    result.correlation = 0.0;  // at the edge of the range: not a peak
    return result;
  }
  const double curvature = 2.0 * correlation(peak) - correlation(peak - 1) - correlation(peak + 1);
  const double slope = 0.5 * (correlation(peak + 1) - correlation(peak - 1));
  const double fraction = curvature > 0.0 ? std::clamp(slope / curvature, -1.0, 1.0) : 0.0;
  result.delay = grid_period * (static_cast<double>(peak - steps) + fraction);
  result.width = grid_period * std::sqrt(std::max(result.correlation, 0.0) / std::max(curvature, 1e-12));
  return result;
}

}  // namespace circlepoint::detail
