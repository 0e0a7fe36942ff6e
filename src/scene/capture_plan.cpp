#include "scene/capture_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "illum/error.h"
#include "scene/slab_framing.h"

namespace illum {
namespace {

void setLongerSide(Size& size, int longerSide) {
  const double factor = static_cast<double>(longerSide) / std::max(size.width, size.height);
  size = {std::max(1, static_cast<int>(std::lround(size.width * factor))),
          std::max(1, static_cast<int>(std::lround(size.height * factor)))};
}

void apply(const CaptureOverrides& overrides, SlabPlan& slab) {
  slab.uCount = overrides.uCount.value_or(slab.uCount);
  slab.vCount = overrides.vCount.value_or(slab.vCount);
  slab.longerSide = overrides.longerSide.value_or(slab.longerSide);
  if (overrides.longerSide && slab.size) setLongerSide(*slab.size, *overrides.longerSide);
}

/// The same field of view in another number of pixels.
void setLongerSide(ViewGeometry& geometry, int longerSide) {
  if (auto* panorama = std::get_if<Panorama>(&geometry)) {
    setLongerSide(panorama->size, longerSide);
  } else if (auto* camera = std::get_if<PinholeCamera>(&geometry)) {
    const Size before = camera->size;
    setLongerSide(camera->size, longerSide);
    const double x = static_cast<double>(camera->size.width) / before.width;
    const double y = static_cast<double>(camera->size.height) / before.height;
    camera->focalX *= x, camera->focalY *= y;
    camera->centre = {camera->centre.x * x, camera->centre.y * y};
  }
}

void apply(const CaptureOverrides& overrides, ViewPlan& view) {
  if (auto* slab = std::get_if<SlabPlan>(&view)) apply(overrides, *slab);
  if (auto* turn = std::get_if<TurnPlan>(&view)) apply(overrides, turn->slab);
  if (!overrides.longerSide) return;
  const int longerSide = *overrides.longerSide;
  if (auto* photograph = std::get_if<PhotographPlan>(&view))
    setLongerSide(photograph->size, longerSide);
  if (auto* camera = std::get_if<CameraPlan>(&view)) setLongerSide(camera->size, longerSide);
  if (auto* fixed = std::get_if<FixedPlan>(&view)) setLongerSide(fixed->view.geometry, longerSide);
}

// --- views ---

void addViews(const LightSlab& slab, std::vector<View>& views) {
  for (int v = 0; v < slab.vCount; ++v) {
    for (int u = 0; u < slab.uCount; ++u)
      views.push_back({fmt::format("{}_u{:02}_v{:02}", slab.name, u, v), SlabView{slab, u, v}});
  }
}

void addViews(const SlabPlan& plan, const Scene& scene, std::vector<View>& views) {
  addViews(framedSlab(plan, scene), views);
}

void addViews(const TurnPlan& plan, const Scene& scene, std::vector<View>& views) {
  for (const LightSlab& slab : framedTurn(plan, scene)) addViews(slab, views);
}

void addViews(const PhotographPlan& plan, const Scene&, std::vector<View>& views) {
  views.push_back({plan.name, OrthographicView{plan.size}});
}

void addViews(const CameraPlan& plan, const Scene& scene, std::vector<View>& views) {
  const Bounds bounds = boundsOf(scene);
  const double radius = 0.5 * length(bounds.high - bounds.low);
  const Vector3 target = plan.target.value_or(0.5 * (bounds.low + bounds.high));
  const double halfTangent = std::tan(plan.fieldOfViewRadians / 2);
  const Vector3 ahead{0, 0, radius / std::sin(plan.fieldOfViewRadians / 2)};
  PinholeCamera camera;
  camera.objectFromCamera = lookAt(plan.eye.value_or(target + ahead), target, plan.up);
  camera.size = plan.size;
  camera.focalX = 0.5 * std::max(plan.size.width, plan.size.height) / halfTangent;
  camera.focalY = camera.focalX;
  camera.centre = {0.5 * plan.size.width, 0.5 * plan.size.height};
  views.push_back({plan.name, camera});
}

void addViews(const FixedPlan& plan, const Scene&, std::vector<View>& views) {
  views.push_back(plan.view);
}

std::vector<LightFileEntry> lightsOf(const LightPlan& plan) {
  if (const auto* grid = std::get_if<PolarGrid>(&plan.lights))
    return namedLights(polarLights(grid->thetaCount, grid->phiCount, plan.region));
  if (const auto* grid = std::get_if<FibonacciGrid>(&plan.lights))
    return namedLights(fibonacciLights(grid->count, plan.region));
  return std::get<std::vector<LightFileEntry>>(plan.lights);
}

double radiusOf(const LightPlan& plan, const std::vector<LightFileEntry>& lights) {
  if (plan.radiusRadians) return *plan.radiusRadians;
  std::vector<Direction> directions;
  for (const LightFileEntry& entry : lights) directions.push_back(entry.light.toLight);
  // Far below the limit of a disc; few lights on a sphere could come near it.
  constexpr double kLargest = std::numbers::pi / 6;
  return std::min(kLargest, spacingRadians(directions) / 2);
}

}  // namespace

void apply(const CaptureOverrides& overrides, CapturePlan& plan) {
  for (ViewPlan& view : plan.views) apply(overrides, view);
  if (overrides.lights) plan.lights.lights = FibonacciGrid{*overrides.lights};
  if (overrides.lightRadiusRadians) plan.lights.radiusRadians = overrides.lightRadiusRadians;
  plan.samplesPerPixel = overrides.samplesPerPixel.value_or(plan.samplesPerPixel);
  plan.bounces = overrides.bounces.value_or(plan.bounces);
  plan.seed = overrides.seed.value_or(plan.seed);
}

CaptureSetup captureSetup(const CapturePlan& plan, const Scene& scene) {
  const Bounds bounds = boundsOf(scene);
  if (!(bounds.low.x <= bounds.high.x))
    throw Error(Fault::Input, "expected a scene with something to see, found no meshes or hairs");
  CaptureSetup setup;
  for (const ViewPlan& view : plan.views)
    std::visit([&](const auto& v) { addViews(v, scene, setup.views); }, view);
  if (setup.views.empty()) throw Error(Fault::Input, "expected at least one view, found none");
  const bool photographed = std::ranges::any_of(setup.views, [](const View& view) {
    return std::holds_alternative<OrthographicView>(view.geometry);
  });
  if (photographed && setup.views.size() > 1)
    throw Error(Fault::Input,
                fmt::format("expected a photograph to be the only view, found {} views",
                            setup.views.size()));
  setup.lights = lightsOf(plan.lights);
  if (setup.lights.empty()) throw Error(Fault::Input, "expected at least one light, found none");
  setup.lightRadiusRadians = radiusOf(plan.lights, setup.lights);
  setup.samplesPerPixel = plan.samplesPerPixel;
  setup.bounces = plan.bounces;
  setup.filterRadius = plan.filterRadius;
  setup.seed = plan.seed;
  return setup;
}

}  // namespace illum
