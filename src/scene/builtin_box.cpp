// The test scene of Wong et al. 1997, figures 9 and 14: a box on a plane, for hard shadows.
#include <numbers>

#include "scene/builtin_parts.h"
#include "scene/shapes.h"

namespace illum {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

PlannedScene boxOnPlane() {
  Scene scene;
  Material plane, box;
  plane.name = "plane";
  plane.baseColour = {0.62f, 0.6f, 0.55f};
  plane.roughness = 0.5f;
  box.name = "box";
  box.baseColour = {0.7f, 0.16f, 0.07f};
  box.roughness = 0.35f;
  scene.materials = {plane, box};

  // Built lying in z = 0, seen from above; then leant back, so that the box's sides are seen too
  // and yet lights from all over the viewer's hemisphere reach the plane.
  TriangleMesh ground = rectangleMesh(6, 6);
  ground.name = "plane";
  TriangleMesh cube = boxMesh({0.9, 0.7, 0.8});
  cube.name = "box";
  cube.material = 1;
  transform(cube, rotationAbout(Direction::fromVector({0, 0, 1}), 28 * kDegree));
  transform(cube, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, -0.25, 0.4}});
  const RigidTransform leant = rotationAbout(Direction::fromVector({1, 0, 0}), -38 * kDegree);
  transform(ground, leant);
  transform(cube, leant);
  scene.meshes = {ground, cube};

  SlabPlan slab;
  slab.distance = 6;
  slab.objectFromSlab = RigidTransform{};
  slab.st = PlaneRectangle{-1.2, -1.2, 1.2, 1.2};
  slab.size = Size{256, 256};
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = PolarGrid{6, 16};
  plan.lights.radiusRadians = 0;
  plan.samplesPerPixel = 8;
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
