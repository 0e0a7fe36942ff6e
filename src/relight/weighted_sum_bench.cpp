// What relighting costs against what the machine could do, both measured in the same run and on the
// same threads. A sum of planes is bound
//   by memory: the time that reading all codes and writing the picture takes, with nothing done;
//   by arithmetic: the time that its multiplications and additions take, with nothing read.
// `of_bound` is the larger of the two times over the time of the sum. Times are the threads' own,
// as the kernel accounts for them: waiting for memory counts, other programs' turns do not.

#include "relight/weighted_sum.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <ctime>
#include <functional>
#include <random>
#include <thread>
#include <vector>

#include "relight/bound_kernels.h"

namespace illum {
namespace {

// So many that no cache holds a tile's codes, nor the picture.
constexpr std::size_t kCodeBytes = std::size_t{64} << 20;
constexpr int kWidth = 1024;
constexpr int kMostThreads = 2;
// The least of so many times counts: other programs only ever add to one.
constexpr int kRepetitions = 15;

enum class Kind { Byte, Word, Half };

// A tile for each thread, with weights that are, or are not, multiples of three colours.
struct Scene {
  std::vector<TilePlanes> tiles;
  CodingEntry coding;
  FoldedWeights weights;
  std::vector<std::vector<float>> pictures;

  Scene(int planes, Kind kind, bool separable) {
    coding.bits = kind == Kind::Byte ? 8 : 16;
    coding.curve = kind == Kind::Half ? Curve::Half : Curve::Linear;
    coding.step = kind == Kind::Half ? 1 : std::ldexp(1.0, -coding.bits);
    std::mt19937 random(1);
    const std::size_t rowBytes =
        static_cast<std::size_t>(planes) * kWidth * (kind == Kind::Byte ? 1 : 2);
    const Size tile{kWidth, static_cast<int>(kCodeBytes / rowBytes)};
    PlaneCodes codes{planes, tile, {}};
    codes.values.resize(static_cast<std::size_t>(planes) * tile.pixels());
    for (auto& code : codes.values)
      code = static_cast<std::uint16_t>(random() % (kind == Kind::Byte ? 256 : 0x3c00));
    std::vector<double> basis;
    for (int k = 0; k < planes; ++k) {
      coding.functions.push_back(k);
      coding.offsets.push_back(kind == Kind::Half ? 0 : -0.5);
      for (int c = 0; c < 3; ++c)
        basis.push_back(0.01 * (k + 1) * (1 + (separable ? (k % 3 + c) % 3 : (k + c) % 5)));
    }
    basis.insert(basis.end(), {0, 0, 0});
    weights = foldWeights(basis, coding);
    for (int t = 0; t < kMostThreads; ++t) {
      tiles.emplace_back(codes, coding.bits);
      pictures.emplace_back(3 * tile.pixels());
    }
  }

  std::size_t pixels() const { return tiles[0].tile().pixels(); }
  std::size_t codeBytes() const { return tiles[0].memoryBytes(); }
  const void* codes(std::size_t t) const {
    return tiles[t].inBytes() ? static_cast<const void*>(tiles[t].bytes()) : tiles[t].words();
  }
  // Of all multiplications and additions, the least that the sum takes.
  std::size_t operations() const {
    return coding.functions.size() * (weights.isSeparable ? 1 : 3) * pixels();
  }
};

double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Seconds that `work(thread)` takes on `threads` threads, the slowest one's.
double secondsOn(int threads, const std::function<void(std::size_t)>& work) {
  std::barrier together(threads);
  std::vector<double> seconds(static_cast<std::size_t>(threads));
  std::vector<std::thread> team;
  for (std::size_t t = 0; t < seconds.size(); ++t)
    team.emplace_back([&, t] {
      together.arrive_and_wait();
      const double start = threadSeconds();
      work(t);
      seconds[t] = threadSeconds() - start;
    });
  for (std::thread& thread : team) thread.join();
  return *std::max_element(seconds.begin(), seconds.end());
}

void sumOfPlanes(benchmark::State& state, Kind kind, bool separable) {
  Scene scene(static_cast<int>(state.range(0)), kind, separable);
  const auto threads = static_cast<int>(state.range(1));
  double memory = 1e9, arithmetic = 1e9, sum = 1e9;
  const auto summing = [&](std::size_t t) {
    weightedSum(scene.tiles[t], scene.coding, scene.weights, 0, scene.pictures[t]);
  };
  for (auto _ : state) {
    for (int i = 0; i < kRepetitions; ++i) {
      memory = std::min(memory, secondsOn(threads, [&](std::size_t t) {
                          benchmark::DoNotOptimize(
                              readAndWrite(scene.codes(t), scene.codeBytes(), scene.pictures[t]));
                        }));
      arithmetic = std::min(arithmetic, secondsOn(threads, [&](std::size_t) {
                              benchmark::DoNotOptimize(multiplyAndAdd(scene.operations()));
                            }));
      sum = std::min(sum, secondsOn(threads, summing));
    }
    state.SetIterationTime(sum);
  }
  const double megapixels = static_cast<double>(scene.pixels()) * threads / 1e6;
  state.counters["megapixels/s"] = megapixels / sum;
  state.counters["GB/s"] = 1e-9 * static_cast<double>(scene.codeBytes()) * threads / sum;
  state.counters["of_memory"] = memory / sum;
  state.counters["of_arithmetic"] = arithmetic / sum;
  state.counters["of_bound"] = std::max(memory, arithmetic) / sum;
}

/// From display-referred planes to linear light: the step that superposition of lights repeats.
void displayResponse(benchmark::State& state) {
  constexpr std::size_t kPixels = 1 << 18;
  std::vector<float> rgb(3 * kPixels);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(i % 1021) / 1000;
    state.ResumeTiming();
    applyResponse(Response::Display, rgb);
    benchmark::DoNotOptimize(rgb.data());
  }
  state.counters["megapixels/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(kPixels) / 1e6,
      benchmark::Counter::kIsRate);
}

void allCases(benchmark::internal::Benchmark* bench) {
  for (const int planes : {9, 16, 25, 64})
    for (int threads = 1; threads <= kMostThreads; ++threads) bench->Args({planes, threads});
  bench->ArgNames({"planes", "threads"})->UseManualTime()->Iterations(1);
  bench->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(sumOfPlanes, bytes_full, Kind::Byte, false)->Apply(allCases);
BENCHMARK_CAPTURE(sumOfPlanes, bytes_separable, Kind::Byte, true)->Apply(allCases);
BENCHMARK_CAPTURE(sumOfPlanes, words_full, Kind::Word, false)->Apply(allCases);
BENCHMARK_CAPTURE(sumOfPlanes, words_separable, Kind::Word, true)->Apply(allCases);
BENCHMARK_CAPTURE(sumOfPlanes, halves_full, Kind::Half, false)->Apply(allCases);
BENCHMARK_CAPTURE(sumOfPlanes, halves_separable, Kind::Half, true)->Apply(allCases);
BENCHMARK(displayResponse)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace illum
