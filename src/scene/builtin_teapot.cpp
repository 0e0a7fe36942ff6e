// Wong et al. 1997, figure 12.
#include <numbers>

#include "scene/builtin_parts.h"
#include "scene/shapes.h"
#include "scene/teapot.h"

namespace illum {

PlannedScene utahTeapot() {
  Scene scene;
  Material glaze;
  glaze.name = "glaze";
  glaze.baseColour = {0.75f, 0.72f, 0.66f};
  glaze.roughness = 0.25f;
  scene.materials = {glaze};

  constexpr int kSteps = 24;
  constexpr double kHalfHeight = 1.575, kUnit = 0.31;  // so that it reaches from -1 to 1
  TriangleMesh teapot = teapotMesh(kSteps);
  transform(teapot, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {-0.2, -kHalfHeight, 0}});
  scale(teapot, kUnit);
  scene.meshes = {std::move(teapot)};

  SlabPlan slab;
  slab.toward = {0, 0.42, 1};
  slab.longerSide = 256;
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{96};
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
