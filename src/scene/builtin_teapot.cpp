// Wong et al. 1997, figure 12.
#include "scene/builtin_parts.h"
#include "scene/teapot.h"

namespace illum {

PlannedScene utahTeapot() {
  Scene scene;
  Material glaze;
  glaze.name = "glaze";
  glaze.baseColour = {0.16f, 0.38f, 0.42f};
  glaze.roughness = 0.25f;
  scene.materials = {glaze};

  scene.meshes = {unitTeapotMesh()};

  SlabPlan slab;
  slab.toward = {0, 0.42, 1};
  slab.size = Size{256, 256};
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{96};
  plan.samplesPerPixel = 12;
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
