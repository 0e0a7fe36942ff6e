// The box of Goral, Torrance, Greenberg and Battaile 1984 ("Modeling the Interaction of Light
// Between Diffuse Surfaces"): what light does after its first reflection. Lights come from outside
// here, through the open front and a skylight in the place of the lamp.
#include <numbers>

#include "scene/builtin_parts.h"
#include "scene/shapes.h"

namespace illum {
namespace {

enum : int { kWhite, kRed, kGreen };

/// A parallelogram, seen from where `right` goes right and `up` goes up.
TriangleMesh wall(const char* name, int material, Vector3 corner, Vector3 right, Vector3 up) {
  TriangleMesh mesh =
      surfaceMesh([&](double u, double v) { return corner + u * right + v * up; }, 1, 1);
  mesh.name = name;
  mesh.material = material;
  return mesh;
}

/// A block on the floor y = -1, turned about its vertical axis.
TriangleMesh block(const char* name, Vector3 size, double x, double z, double turnRadians) {
  TriangleMesh mesh = boxMesh(size);
  mesh.name = name;
  RigidTransform placed = rotationAbout(Direction::fromVector({0, 1, 0}), turnRadians);
  placed.translation = {x, -1 + size.y / 2, z};
  transform(mesh, placed);
  return mesh;
}

/// The ceiling y = 1 around a square opening, seen from below.
TriangleMesh ceiling() {
  constexpr double kHalf = 0.36;
  TriangleMesh mesh = wall("ceiling", kWhite, {-1, 1, -1}, {2, 0, 0}, {0, 0, 1 - kHalf});
  append(mesh, wall("", kWhite, {-1, 1, kHalf}, {2, 0, 0}, {0, 0, 1 - kHalf}));
  append(mesh, wall("", kWhite, {-1, 1, -kHalf}, {1 - kHalf, 0, 0}, {0, 0, 2 * kHalf}));
  append(mesh, wall("", kWhite, {kHalf, 1, -kHalf}, {1 - kHalf, 0, 0}, {0, 0, 2 * kHalf}));
  return mesh;
}

Material matt(const char* name, LinearRgb colour) {
  Material material;
  material.name = name;
  material.baseColour = colour;
  material.specular = 0;  // Lambert's law
  return material;
}

}  // namespace

PlannedScene cornellBox() {
  constexpr double kDegree = std::numbers::pi / 180;
  Scene scene;
  scene.materials = {matt("white", {0.76f, 0.75f, 0.71f}), matt("red", {0.63f, 0.06f, 0.05f}),
                     matt("green", {0.13f, 0.46f, 0.09f})};
  scene.meshes = {wall("floor", kWhite, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}),
                  wall("back", kWhite, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}),
                  wall("left", kRed, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}),
                  wall("right", kGreen, {1, -1, -1}, {0, 0, 2}, {0, 2, 0}),
                  ceiling(),
                  block("tall", {0.6, 1.2, 0.6}, -0.36, -0.35, 17 * kDegree),
                  block("short", {0.6, 0.6, 0.6}, 0.36, 0.28, -17 * kDegree)};

  // The window is the opening; view points stand before it, so that walls are seen from inside
  // only.
  SlabPlan slab;
  slab.objectFromSlab = RigidTransform{.translation = {0, 0, 1}};
  slab.distance = 2.7;
  slab.uv = PlaneRectangle{-0.9, -0.9, 0.9, 0.9};
  slab.st = PlaneRectangle{-1.02, -1.02, 1.02, 1.02};
  slab.size = Size{160, 160};
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{40};
  plan.samplesPerPixel = 48;
  plan.bounces = 2;
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
