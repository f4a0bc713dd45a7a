// Time of the signal kernels on a short test (5,000 x 3 samples) and on a long log (1,000,000 x 3).
#include <benchmark/benchmark.h>

#include <random>

#include "circlepoint/conditioning/butterworth.hpp"
#include "circlepoint/conditioning/differentiate.hpp"
#include "circlepoint/conditioning/integrate.hpp"
#include "circlepoint/conditioning/sosfilt.hpp"
#include "circlepoint/conditioning/spectrum.hpp"

namespace circlepoint {
namespace {

constexpr double sample_rate = 500.0;
constexpr Index channels = 3;

SamplesX random_samples(Index rows) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  return SamplesX::NullaryExpr(rows, channels, [&] { return normal(random); });
}

// Times kernel(samples) for as many rows as the benchmark's first argument says.
template <typename Kernel>
void time_kernel(benchmark::State& state, const Kernel& kernel) {
  const SamplesX samples = random_samples(state.range(0));
  for (auto _ : state) {
    auto result = kernel(samples);
    benchmark::DoNotOptimize(result);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// The second argument is the order of the filter.
void sosfiltfilt(benchmark::State& state) {
  const SecondOrderSections sos = butter(static_cast<int>(state.range(1)), 20.0, sample_rate);
  time_kernel(state, [&](const SamplesX& x) { return circlepoint::sosfiltfilt(sos, x); });
}

void cumulative_trapezoid(benchmark::State& state) {
  time_kernel(state, [](const SamplesX& y) { return circlepoint::cumulative_trapezoid(y, 1.0 / sample_rate, 0.0); });
}

void cumulative_simpson(benchmark::State& state) {
  time_kernel(state, [](const SamplesX& y) { return circlepoint::cumulative_simpson(y, 1.0 / sample_rate, 0.0); });
}

void gradient(benchmark::State& state) {
  time_kernel(state, [](const SamplesX& y) { return circlepoint::gradient(y, 1.0 / sample_rate); });
}

void savgol_filter(benchmark::State& state) {
  time_kernel(state, [](const SamplesX& x) { return circlepoint::savgol_filter(x, 21, 3, 1, 1.0 / sample_rate); });
}

void welch(benchmark::State& state) {
  time_kernel(state, [](const SamplesX& x) { return circlepoint::welch(x, sample_rate); });
}

BENCHMARK(sosfiltfilt)->ArgsProduct({{5'000, 1'000'000}, {2, 4, 8}})->Unit(benchmark::kMicrosecond);
BENCHMARK(cumulative_trapezoid)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(cumulative_simpson)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(gradient)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(savgol_filter)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(welch)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace circlepoint
