// How much of the time of rendering is Embree's: shadow rays a second against a bare loop over the
// same rays, and time by number of lights. One thread; processor time, which others disturb least.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/path_tracer.h"
#include "render/renderer.h"
#include "scene/builtin.h"

namespace illum {
namespace {

// The middle view of a built-in scene, a patch of it as `build` reads it.
struct Bench {
  SceneCapture capture;
  View view;
  Rectangle patch;

  explicit Bench(const char* name)
      : capture(builtinScene(name)), view(capture.setup.views[capture.setup.views.size() / 2]) {
    const Size size = sizeOf(view.geometry);
    patch = {size.width / 2 - 32, size.height / 2 - 8, 64, 16};
  }
  RenderSettings settings(double radius) const {
    RenderSettings settings;
    settings.lightRadiusRadians = radius;
    return settings;
  }
};

// Evenly over the sphere.
std::vector<RenderLight> lights(int count) {
  std::vector<RenderLight> out;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    out.push_back(
        {Direction::fromAngles(std::acos(z), std::remainder(2.399963 * i, 2 * std::numbers::pi)),
         i});
  }
  return out;
}

// Keeps every shadow ray before it is traced.
class RecordingTree final : public RayTree {
 public:
  using RayTree::RayTree;
  void shadows(std::span<ShadowRay> rays, std::span<OpticalDepth> depths) const override {
    recorded.insert(recorded.end(), rays.begin(), rays.end());
    batches.push_back(rays.size());
    RayTree::shadows(rays, depths);
  }
  mutable std::vector<ShadowRay> recorded;
  mutable std::vector<std::size_t> batches;
};

// The same paths as Renderer::render.
void record(const Bench& bench, const RenderSettings& settings, int count,
            const SceneSurfaces& surfaces, const RecordingTree& tree) {
  const LightTable table(lights(count), settings.lightRadiusRadians);
  const CameraRays rays(bench.view.geometry, boundsOf(bench.capture.scene), settings.filterRadius,
                        settings.samplesPerPixel);
  PathTracer tracer(tree, surfaces, table, settings.bounces);
  LightSums sums(static_cast<std::size_t>(count));
  for (int y = bench.patch.y; y < bench.patch.bottom(); ++y) {
    for (int x = bench.patch.x; x < bench.patch.right(); ++x) {
      for (int s = 0; s < settings.samplesPerPixel; ++s) {
        const SampleSequence sequence(settings.seed, x, y, s);
        tracer.trace(rays.through(x, y, sequence), sequence, sums);
      }
    }
  }
}

void bareEmbree(benchmark::State& state, const char* name, double radius) {
  const Bench bench(name);
  const SceneSurfaces surfaces(bench.capture.scene);
  const RecordingTree tree(surfaces.scene(), surfaces, surfaces.filtered());
  record(bench, bench.settings(radius), static_cast<int>(state.range(0)), surfaces, tree);
  std::array<OpticalDepth, kBatch> depths{};
  std::vector<ShadowRay> rays;
  for (auto _ : state) {
    state.PauseTiming();
    rays = tree.recorded;
    state.ResumeTiming();
    std::size_t first = 0;
    for (const std::size_t count : tree.batches) {
      tree.RayTree::shadows({rays.data() + first, count}, depths);
      first += count;
    }
  }
  state.counters["shadowRays"] = static_cast<double>(tree.recorded.size());
  state.counters["perSecond"] = benchmark::Counter(static_cast<double>(tree.recorded.size()),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void renderer(benchmark::State& state, const char* name, double radius) {
  const Bench bench(name);
  const Renderer renderer(bench.capture.scene, bench.settings(radius));
  const auto directions = lights(static_cast<int>(state.range(0)));
  std::vector<float> samples(3 * directions.size() * bench.patch.pixels());
  for (auto _ : state) {
    renderer.render(bench.view, bench.patch, directions, samples);
    benchmark::DoNotOptimize(samples.data());
  }
  const SceneSurfaces surfaces(bench.capture.scene);
  const RecordingTree tree(surfaces.scene(), surfaces, surfaces.filtered());
  record(bench, bench.settings(radius), static_cast<int>(state.range(0)), surfaces, tree);
  state.counters["perSecond"] = benchmark::Counter(static_cast<double>(tree.recorded.size()),
                                                   benchmark::Counter::kIsIterationInvariantRate);
  state.counters["lights"] = benchmark::Counter(
      static_cast<double>(directions.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(bareEmbree, box, "box", 0.05)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(renderer, box, "box", 0.05)
    ->Arg(1)
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bareEmbree, teapot, "teapot", 0.05)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(renderer, teapot, "teapot", 0.05)
    ->Arg(1)
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(renderer, teapotSharp, "teapot", 0.0)->Arg(256)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace illum
