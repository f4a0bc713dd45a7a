#pragma once
// From what the sensor gives out to the numbers in the log: cable, conditioning unit, multiplexed converter.
//
// The trajectory is given at the analogue rate, `oversampling` times the rate of the recording: what happens between
// two samples is simulated there, and every `oversampling`-th instant t_i = i oversampling / rate is recorded. In order,
// per channel k (x, y, z), (M18) to (M21) of docs/method:
//
//   sensor        frequency response, noise by band, clipping at the range, resolution
//   conditioning  causal Butterworth low-pass (it delays, as the real one does), in the steady state of its first input
//   cable         pick-up, a sine of one phase a channel, and white noise, both as they appear at the converter
//   converter     channel k is sampled at t_i + k channel_skew, clipped at +-range / gain and rounded to
//                 2 range / gain / 2^bits
//   program       readings corrected by the sensor's calibration sheet at the recorded temperature, where asked for
//
// The internal thermometer is the fourth channel. Encoders are read by a processor of their own at `encoder_rate`, whose
// ticks have a phase drawn with the seed: each sample holds the last reading before it. Between analogue instants signals
// are interpolated by cubics, which is exact to 1e-5 of a component at an eighth of the analogue rate's half.
//
// Every source of noise has its own random stream: switching one on does not change another.

#include <optional>
#include <vector>

#include "circlepoint/core/types.hpp"
#include "circlepoint/sensor/accelerometer.hpp"

namespace circlepoint {

/// Of the sensor while it records: start + rise (1 - exp(-t / time_constant)), and how its thermometer sees that.
struct TemperatureProfile {
  double start = 25.0;           ///< degrees Celsius
  double rise = 0.0;             ///< degrees Celsius
  double time_constant = 600.0;  ///< s
  double sensor_offset = 0.0;    ///< degrees Celsius, of the thermometer
  double sensor_noise_std = 0.0; ///< degrees Celsius, of the thermometer, white per sample

  /// True temperature after `time` seconds, degrees Celsius.
  [[nodiscard]] double at(double time) const;
};

struct AcquisitionOptions {
  Index oversampling = 1;                      ///< analogue instants a sample
  std::vector<NoiseBand> noise_bands{};        ///< of the sensor
  std::vector<ResponseBand> response_bands{};  ///< of the sensor; each channel's response is drawn within them
  double resolution = 0.0;                     ///< m/s^2, of the sensor; 0: any change shows
  double signal_cutoff = 0.0;                  ///< Hz, -3 dB of the signal filter; 0: none
  double temperature_cutoff = 0.0;             ///< Hz, of the temperature filter; 0: none
  int filter_order = 2;                        ///< of both
  double cable_noise_std = 0.0;                ///< m/s^2, white, per sample
  double pickup_amplitude = 0.0;               ///< m/s^2
  double pickup_frequency = 60.0;              ///< Hz, of the mains
  double channel_skew = 0.0;                   ///< s between channels x, y, z, temperature
  int converter_bits = 0;                      ///< 0: no quantisation
  double converter_range = 300.0;              ///< m/s^2, full scale is +-this at gain 1
  double converter_gain = 1.0;                 ///< of the programmable amplifier
  double encoder_rate = 0.0;                   ///< Hz, at which encoders are read; 0: at every sample
  std::optional<AccelerometerModel> sheet{};   ///< what readings are corrected by; none: they stay raw
};

/// The chain of Canepa, Hollerbach, Boelen 1994, sec. 3: 250 Hz and 1 Hz filters, a DT5741-PGH converter going round its
/// channels at 40 kHz, encoders at 1 kHz; assumed: 16 bits over +-300 m/s^2 at gain 8, filters of second order, analogue
/// instants at 8 times the sample rate.
AcquisitionOptions paper_acquisition();

}  // namespace circlepoint
