// Wong et al. 1997, figure 13, is a bust under coloured lights; this one is ours.
#include "scene/builtin_parts.h"
#include "scene/bust.h"
#include "scene/isosurface.h"

namespace illum {

PlannedScene sculptedBust() {
  constexpr double kCell = 0.018;
  Scene scene;
  Material marble;
  marble.name = "marble";
  marble.baseColour = {0.82f, 0.80f, 0.75f};
  marble.roughness = 0.45f;
  scene.materials = {marble};
  scene.meshes = {isosurface(bustDistance(), {{-1.5, -3.4, -1.5}, {1.5, 1.4, 1.2}}, kCell)};
  scene.meshes.front().name = "bust";

  SlabPlan slab;
  slab.toward = {0.1, 0.08, 1};
  slab.longerSide = 256;
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{64};
  plan.samplesPerPixel = 12;  // interreflection in marble shows noise
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
