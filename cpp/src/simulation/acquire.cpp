#include "acquire.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

void require_not_negative(double value, const char* name) {
  require(std::isfinite(value) && value >= 0.0, std::string("acquisition: ") + name + " is " + std::to_string(value) +
                                                    "; give zero or a positive number");
}

// Causal filter of unit gain at rest, started in the steady state of its first input.
SamplesX filter_from_rest(const Eigen::Ref<const SecondOrderSections>& sections, const SamplesX& signal) {
  const Eigen::RowVectorXd first = signal.row(0);
  SamplesX filtered = sosfilt(sections, signal.rowwise() - first);
  filtered.rowwise() += first;
  return filtered;
}

void respond(Samples3& reading, const AcquisitionOptions& options, double rate, std::uint64_t seed) {
  double top = 0.0;
  for (const ResponseBand& band : options.response_bands) {
    top = std::max(top, band.high);
  }
  for (Index k = 0; k < 3; ++k) {
    const auto channel = static_cast<std::uint64_t>(k);
    const SecondOrderResponse response = draw_response(options.response_bands, derive_seed(seed, channel));
    const SecondOrderSections section = response_section(response, rate, std::min(top, 0.4 * rate));
    reading.col(k) = filter_from_rest(section, SamplesX(reading.col(k))).col(0);
  }
}

// The cubic through the four instants around position `at` (in instants from the first).
double between(const Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>>& signal, double at) {
  const double whole = std::floor(at);
  const double x = at - whole;
  const auto i = static_cast<Index>(whole);
  if (x == 0.0) {
    return signal[i];
  }
  const Index first = std::clamp<Index>(i - 1, 0, signal.size() - 4);
  const double u = at - static_cast<double>(first);  // nodes at 0, 1, 2, 3
  const double a = u, b = u - 1.0, c = u - 2.0, d = u - 3.0;
  return -b * c * d / 6.0 * signal[first] + a * c * d / 2.0 * signal[first + 1] - a * b * d / 2.0 * signal[first + 2] +
         a * b * c / 6.0 * signal[first + 3];
}

Eigen::VectorXd sample_channel(const Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>>& signal, Index samples,
                               Index oversampling, double delay) {
  Eigen::VectorXd sampled(samples);
  for (Index i = 0; i < samples; ++i) {
    sampled[i] = between(signal, static_cast<double>(i * oversampling) + delay);
  }
  return sampled;
}

void convert(Samples3& reading, const AcquisitionOptions& options) {
  if (options.converter_bits == 0) {
    return;
  }
  const double range = options.converter_range / options.converter_gain;
  const double count = std::ldexp(2.0 * range, -options.converter_bits);
  reading = ((reading.array() / count).round() * count).cwiseMax(-range).cwiseMin(range - count);
}

// Position at the last reading of the encoders before each sample.
SamplesX read_encoders(const AnalogueSignals& signals, const AcquisitionOptions& options, Index samples,
                       std::uint64_t seed) {
  SamplesX positions(samples, signals.position.cols());
  const double phase = RandomSource(seed).uniform();
  for (Index i = 0; i < samples; ++i) {
    const Index now = i * options.oversampling;
    if (options.encoder_rate == 0.0) {
      positions.row(i) = signals.position.row(now);
      continue;
    }
    const double start = signals.time[0];
    const double since = signals.time[now] - start;
    const double tick = (std::floor(since * options.encoder_rate - phase) + phase) / options.encoder_rate;
    const double at = std::max(tick, 0.0) * signals.rate;
    const Index before = std::min(static_cast<Index>(std::floor(at)), now);
    const double x = at - static_cast<double>(before);
    const Index after = std::min(before + 1, signals.time.size() - 1);
    // Cubic Hermite: positions and rates at both instants are known.
    const double y = 1.0 - x;
    positions.row(i) = y * y * (1.0 + 2.0 * x) * signals.position.row(before) +
                       x * x * (1.0 + 2.0 * y) * signals.position.row(after) +
                       (x * y * y * signals.velocity.row(before) - x * x * y * signals.velocity.row(after)) / signals.rate;
  }
  return positions;
}

Eigen::VectorXd read_temperature(const AnalogueSignals& signals, const AcquisitionOptions& options,
                                 const TemperatureProfile& thermometer, Index samples, std::uint64_t seed) {
  SamplesX temperature = signals.temperature;
  if (options.temperature_cutoff > 0.0) {
    temperature = filter_from_rest(butter(options.filter_order, options.temperature_cutoff, signals.rate), temperature);
  }
  Eigen::VectorXd sampled =
      sample_channel(temperature.col(0), samples, options.oversampling, 3.0 * options.channel_skew * signals.rate);
  RandomSource random(seed);
  for (Index i = 0; i < samples; ++i) {
    sampled[i] += thermometer.sensor_offset + thermometer.sensor_noise_std * random.normal();
  }
  return sampled;
}

}  // namespace

double TemperatureProfile::at(double time) const { return start + rise * (1.0 - std::exp(-time / time_constant)); }

AcquisitionOptions paper_acquisition() {
  return {.oversampling = 8,
          .signal_cutoff = 250.0,
          .temperature_cutoff = 1.0,
          .channel_skew = 25e-6,
          .converter_bits = 16,
          .converter_gain = 8.0,
          .encoder_rate = 1000.0};
}

void validate(const AcquisitionOptions& options, Index instants, double rate) {
  require(options.oversampling >= 1,
          "acquisition: oversampling is " + std::to_string(options.oversampling) + "; give at least 1");
  require_not_negative(options.resolution, "resolution");
  require_not_negative(options.signal_cutoff, "signal_cutoff");
  require_not_negative(options.temperature_cutoff, "temperature_cutoff");
  require_not_negative(options.cable_noise_std, "cable_noise_std");
  require_not_negative(options.pickup_amplitude, "pickup_amplitude");
  require_not_negative(options.pickup_frequency, "pickup_frequency");
  require_not_negative(options.channel_skew, "channel_skew");
  require_not_negative(options.encoder_rate, "encoder_rate");
  for (const double cutoff : {options.signal_cutoff, options.temperature_cutoff}) {
    require(cutoff < 0.5 * rate, "acquisition: a filter of " + std::to_string(cutoff) +
                                     " Hz cannot be simulated at an analogue rate of " + std::to_string(rate) +
                                     " Hz; give the trajectory at a higher rate and raise oversampling");
  }
  require(options.channel_skew == 0.0 || instants >= 4,
          "acquisition: a channel skew needs 4 analogue instants, there are " + std::to_string(instants));
  const double period = static_cast<double>(options.oversampling) / rate;
  require(3.0 * options.channel_skew < period, "acquisition: four channels " + std::to_string(options.channel_skew) +
                                                   " s apart do not fit into a sampling period of " +
                                                   std::to_string(period) + " s");
  require(options.converter_bits >= 0 && options.converter_bits <= 48,
          "acquisition: converter_bits is " + std::to_string(options.converter_bits) + "; give 0 (none) to 48");
  require(options.converter_range > 0.0 && options.converter_gain > 0.0,
          "acquisition: converter_range " + std::to_string(options.converter_range) + " m/s^2 and converter_gain " +
              std::to_string(options.converter_gain) + " must be positive");
}

Recording acquire(const AnalogueSignals& signals, const AcquisitionOptions& options,
                  const TemperatureProfile& thermometer, double range, double noise_std, std::uint64_t seed) {
  const Index instants = signals.time.size();
  const Index samples = (instants - 1) / options.oversampling + 1;

  Samples3 reading = signals.reading;
  if (!options.response_bands.empty()) {
    respond(reading, options, signals.rate, derive_seed(seed, response_stream));
  }
  if (!options.noise_bands.empty()) {
    reading += band_noise(options.noise_bands, instants, signals.rate, derive_seed(seed, sensor_noise_stream));
  }
  if (range > 0.0) {
    reading = reading.cwiseMax(-range).cwiseMin(range);
  }
  if (options.resolution > 0.0) {
    reading = (reading.array() / options.resolution).round() * options.resolution;
  }
  if (options.signal_cutoff > 0.0) {
    reading = filter_from_rest(butter(options.filter_order, options.signal_cutoff, signals.rate), SamplesX(reading));
  }

  Recording recording;
  recording.sample_rate = signals.rate / static_cast<double>(options.oversampling);
  recording.spans = {{0, samples}};
  recording.time = signals.time(Eigen::seqN(0, samples, options.oversampling));
  recording.joint_positions = read_encoders(signals, options, samples, derive_seed(seed, encoder_stream));
  recording.specific_force.resize(samples, 3);
  RandomSource surroundings(derive_seed(seed, noise_stream));
  RandomSource cable(derive_seed(seed, cable_stream));
  RandomSource pickup(derive_seed(seed, pickup_stream));
  const Eigen::Vector3d phase(pickup.uniform(0.0, two_pi), pickup.uniform(0.0, two_pi), pickup.uniform(0.0, two_pi));
  for (Index k = 0; k < 3; ++k) {
    const double delay = static_cast<double>(k) * options.channel_skew;
    recording.specific_force.col(k) = sample_channel(reading.col(k), samples, options.oversampling, delay * signals.rate);
    const double rate = two_pi * options.pickup_frequency;
    recording.specific_force.col(k).array() +=
        options.pickup_amplitude * (rate * (recording.time.array() + delay) + phase[k]).sin();
  }
  for (Index i = 0; i < samples; ++i) {
    for (Index k = 0; k < 3; ++k) {
      recording.specific_force(i, k) += noise_std * surroundings.normal() + options.cable_noise_std * cable.normal();
    }
  }
  convert(recording.specific_force, options);

  if (signals.temperature.size() > 0) {
    recording.temperature =
        read_temperature(signals, options, thermometer, samples, derive_seed(seed, thermometer_stream));
  }
  if (options.sheet) {
    const Samples3 at_rest = Samples3::Zero(samples, 3);
    recording.specific_force =
        recording.temperature ? correct(*options.sheet, recording.specific_force, at_rest, *recording.temperature)
                              : correct(*options.sheet, recording.specific_force, at_rest);
  }
  return recording;
}

}  // namespace circlepoint
