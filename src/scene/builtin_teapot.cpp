// Wong et al. 1997, figure 12.
#include "scene/builtin_parts.h"
#include "scene/teapot.h"

namespace illum {

PlannedScene utahTeapot() {
  Scene scene;
  Material glaze;
  glaze.name = "glaze";
  glaze.baseColour = {0.75f, 0.72f, 0.66f};
  glaze.roughness = 0.25f;
  scene.materials = {glaze};

  scene.meshes = {unitTeapotMesh()};

  SlabPlan slab;
  slab.toward = {0, 0.42, 1};
  slab.longerSide = 256;
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{96};
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
