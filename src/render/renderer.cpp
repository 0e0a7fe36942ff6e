#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "illum/error.h"
#include "render/path_tracer.h"

namespace illum {
namespace {

void checkSettings(const RenderSettings& settings) {
  const auto require = [](bool met, const char* sentence) {
    if (!met) throw Error(Fault::Input, sentence);
  };
  require(settings.lightRadiusRadians >= 0 && settings.lightRadiusRadians < 1.5707963,
          "the lights' angular radius must be at least 0 and less than 90 degrees");
  require(settings.samplesPerPixel >= 1 && settings.samplesPerPixel <= 1 << 20,
          "samples per pixel must be from 1 to 1048576");
  require(settings.bounces >= 0 && settings.bounces <= 1000, "bounces must be from 0 to 1000");
  require(settings.filterRadius > 0 && settings.filterRadius <= 4,
          "the pixel filter's radius must be more than 0 and at most 4 pixels");
}

// Nothing at all has a ball of radius 0.
Bounds boundsToTrace(const Scene& scene) {
  const Bounds bounds = boundsOf(scene);
  return bounds.low.x <= bounds.high.x ? bounds : Bounds{};
}

// Lower of the two in the middle where the count is even.
float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Pixels that are rendered before they are stored: the samples of one light lie far from those of
// the next, so that single values would each touch a line of the cache.
constexpr int kRun = 16;

// The mean over the samples that met the scene.
void renderPixel(const RenderSettings& settings, const CameraRays& rays, int x, int y,
                 PathTracer& tracer, LightSums& sums) {
  sums.clear();
  int covered = 0;
  for (int s = 0; s < settings.samplesPerPixel; ++s) {
    const SampleSequence sequence(settings.seed, x, y, s);
    covered += tracer.trace(rays.through(x, y, sequence), sequence, sums) ? 1 : 0;
  }
  if (covered > 1) sums.scale(1 / static_cast<float>(covered));
}

// `count` pixels from `first` on, into samples[(3 * light + channel) * pixels + pixel].
void storeRun(const std::vector<LightSums>& run, std::size_t count, std::size_t pixels,
              std::size_t first, std::span<float> samples) {
  const std::size_t lights = run.front().channels[0].size();
  for (std::size_t l = 0; l < lights; ++l) {
    for (std::size_t c = 0; c < 3; ++c) {
      float* to = samples.data() + (3 * l + c) * pixels + first;
      for (std::size_t i = 0; i < count; ++i) to[i] = run[i].channels[c][l];
    }
  }
}

}  // namespace

struct Renderer::State {
  RenderSettings settings;
  SceneSurfaces surfaces;
  RayTree tree;
  Bounds bounds;

  State(const Scene& scene, const RenderSettings& how)
      : settings(how),
        surfaces(scene),
        tree(surfaces.scene(), surfaces, surfaces.filtered()),
        bounds(boundsToTrace(scene)) {}

  CameraRays raysOf(const View& view) const {
    return {view.geometry, bounds, settings.filterRadius, settings.samplesPerPixel};
  }
};

Renderer::Renderer(const Scene& scene, const RenderSettings& settings) {
  checkSettings(settings);
  state_ = std::make_unique<State>(scene, settings);
}
Renderer::~Renderer() = default;

void Renderer::render(const View& view, const Rectangle& rectangle,
                      std::span<const RenderLight> lights, std::span<float> samples) const {
  const RenderSettings& settings = state_->settings;
  const LightTable table(lights, settings.lightRadiusRadians);
  const CameraRays rays = state_->raysOf(view);
  PathTracer tracer(state_->tree, state_->surfaces, table, settings.bounces);
  std::vector<LightSums> run(kRun, LightSums(lights.size()));
  std::size_t first = 0;
  for (int y = rectangle.y; y < rectangle.bottom(); ++y) {
    for (int x = rectangle.x; x < rectangle.right(); x += kRun) {
      const int count = std::min(kRun, rectangle.right() - x);
      for (int i = 0; i < count; ++i) {
        renderPixel(settings, rays, x + i, y, tracer, run[static_cast<std::size_t>(i)]);
      }
      storeRun(run, static_cast<std::size_t>(count), rectangle.pixels(), first, samples);
      first += static_cast<std::size_t>(count);
    }
  }
}

void Renderer::trace(const View& view, const Rectangle& rectangle, std::span<float> coverage,
                     std::span<float> depth) const {
  const RenderSettings& settings = state_->settings;
  const CameraRays rays = state_->raysOf(view);
  std::vector<float> depths;
  std::size_t pixel = 0;
  for (int y = rectangle.y; y < rectangle.bottom(); ++y) {
    for (int x = rectangle.x; x < rectangle.right(); ++x, ++pixel) {
      depths.clear();
      for (int s = 0; s < settings.samplesPerPixel; ++s) {
        const SampleSequence sequence(settings.seed, x, y, s);
        const BeamRay beam = rays.through(x, y, sequence);
        const auto hit = state_->tree.nearest(beam.origin, beam.direction, 0);
        if (!hit) continue;
        const SurfacePoint point = state_->surfaces.at(*hit, beam);
        depths.push_back(static_cast<float>(depthOf(view.geometry, vector3(point.position))));
      }
      if (!coverage.empty()) {
        coverage[pixel] =
            static_cast<float>(depths.size()) / static_cast<float>(settings.samplesPerPixel);
      }
      if (depth.empty()) continue;
      depth[pixel] = depths.empty() ? std::numeric_limits<float>::infinity() : median(depths);
    }
  }
}

std::uint64_t Renderer::residentBytes() const {
  return state_->tree.bytes() + state_->surfaces.bytes();
}

}  // namespace illum
