// A linear object's picture takes as long under one directional light as under a thousand, or under
// an environment: their weights are added before pixels are touched.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "illum/environment.h"
#include "relight/passes.h"

namespace illum {
namespace {

constexpr Size kTile{1024, 1024};
constexpr int kPlanes = 18;

struct Scene {
  LightBasis basis;
  CodingEntry coding;
  TilePlanes planes;
  std::vector<float> rgb, scratch;

  Scene() {
    BasisTable table(LightDomain::Hemisphere, 33, 3 * kPlanes + 3);
    table.fill([](Direction d, std::span<double> out) {
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = std::cos(0.3 * static_cast<double>(i)) * d.x() + 0.2 * d.z();
    });
    basis = LightBasis(table, {BasisColour::Kind::Full, {}});
    coding.step = 1.0 / 255;
    coding.offsets.assign(kPlanes, -0.5);
    for (int k = 0; k < kPlanes; ++k) coding.functions.push_back(k);
    PlaneCodes codes{kPlanes, kTile, {}};
    codes.values.resize(kPlanes * kTile.pixels());
    std::mt19937 random(1);
    for (auto& code : codes.values) code = static_cast<std::uint16_t>(random() % 256);
    planes = TilePlanes(codes, coding.bits);
    rgb.resize(3 * kTile.pixels());
  }

  void relight(benchmark::State& state, const Passes& passes) {
    for (auto _ : state) {
      passes.relight(planes, 0, rgb, scratch);
      benchmark::DoNotOptimize(rgb.data());
    }
    state.counters["megapixels"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * static_cast<double>(kTile.pixels()) / 1e6,
        benchmark::Counter::kIsRate);
  }
};

std::vector<DirectionalLight> lightsOf(int count) {
  std::vector<DirectionalLight> lights;
  for (int i = 0; i < count; ++i)
    lights.push_back({Direction::fromAngles(1.4 * (i + 0.5) / count, 2.4 * i), {1, 1, 1}});
  return lights;
}

Environment room() {
  Picture map({1024, 512}, 3);
  for (std::size_t i = 0; i < map.samples().size(); ++i)
    map.samples()[i] = static_cast<float>(i % 1021) / 1000;
  return Environment(map);
}

void directionalLights(benchmark::State& state) {
  Scene scene;
  const auto lights = lightsOf(static_cast<int>(state.range(0)));
  scene.relight(state, Passes(scene.basis, scene.coding, Response::Linear, lights));
}

void environment(benchmark::State& state) {
  Scene scene;
  const Environment map = room();
  scene.relight(state, Passes(scene.basis, scene.coding, Response::Linear, {}, std::span(&map, 1)));
}

/// What comes before: adding up lights (argument; 0: an environment of 1024 x 512).
void setUp(benchmark::State& state) {
  Scene scene;
  const auto lights = lightsOf(static_cast<int>(state.range(0)));
  const Environment map = room();
  for (auto _ : state) {
    benchmark::DoNotOptimize(Passes(scene.basis, scene.coding, Response::Linear, lights,
                                    std::span(&map, lights.empty() ? 1 : 0)));
  }
}

BENCHMARK(directionalLights)->Arg(1)->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(environment)->Unit(benchmark::kMillisecond);
BENCHMARK(setUp)->Arg(1)->Arg(1000)->Arg(0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace illum
