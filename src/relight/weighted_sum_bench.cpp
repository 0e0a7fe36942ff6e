// What relighting costs on one core, against reading the same codes from memory and doing nothing
// with them: `of_reading` is the share of that limit which is reached.

#include "relight/weighted_sum.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstring>
#include <random>
#include <vector>

namespace illum {
namespace {

constexpr Size kTile{1024, 1024};

struct Scene {
  PlaneCodes codes;
  CodingEntry coding;
  FoldedWeights weights;
  std::vector<float> rgb;

  Scene(int planes, Curve curve) {
    codes = {planes, kTile, {}};
    codes.values.resize(static_cast<std::size_t>(planes) * kTile.pixels());
    std::mt19937 random(1);
    for (auto& code : codes.values) code = static_cast<std::uint16_t>(random() % 256);
    coding.curve = curve;
    coding.step = 1.0 / 255;
    coding.offsets.assign(static_cast<std::size_t>(planes), -0.5);
    weights.perPlane.assign(static_cast<std::size_t>(planes), {0.01f, 0.02f, 0.03f});
    rgb.resize(3 * kTile.pixels());
  }
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Reads every code and adds them up in words, which no memory is too fast for.
std::uint64_t readAll(const std::vector<std::uint16_t>& values) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 4 <= values.size(); i += 4) {
    std::uint64_t word;
    std::memcpy(&word, &values[i], sizeof word);
    sum += word;
  }
  return sum;
}

void countPixels(benchmark::State& state) {
  state.counters["megapixels"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(kTile.pixels()) / 1e6,
      benchmark::Counter::kIsRate);
}

void sumOfPlanes(benchmark::State& state, Curve curve) {
  Scene scene(static_cast<int>(state.range(0)), curve);
  double reading = 0, summing = 0;
  for (auto _ : state) {
    auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(readAll(scene.codes.values));
    reading += secondsSince(start);
    start = std::chrono::steady_clock::now();
    weightedSum(scene.codes, scene.coding, scene.weights, 0, scene.rgb);
    benchmark::DoNotOptimize(scene.rgb.data());
    const double seconds = secondsSince(start);
    summing += seconds;
    state.SetIterationTime(seconds);
  }
  countPixels(state);
  state.counters["of_reading"] = reading / summing;
}

/// From display-referred planes to linear light: the step that superposition of lights repeats.
void displayResponse(benchmark::State& state) {
  std::vector<float> rgb(3 * kTile.pixels());
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(i % 1021) / 1000;
    state.ResumeTiming();
    applyResponse(Response::Display, rgb);
    benchmark::DoNotOptimize(rgb.data());
  }
  countPixels(state);
}

BENCHMARK_CAPTURE(sumOfPlanes, linear, Curve::Linear)
    ->Arg(9)
    ->Arg(18)
    ->Arg(27)
    ->Arg(48)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sumOfPlanes, signedSqrt, Curve::SignedSqrt)
    ->Arg(27)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(displayResponse)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace illum
