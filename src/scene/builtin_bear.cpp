// Many objects in a pixel: the case that Wong et al. 1997, section 2, argue with. A bear like the
// furry one of Kajiya and Kay 1989 ("Rendering Fur with Three Dimensional Textures"), of hairs.
#include <cmath>
#include <vector>

#include "scene/builtin_parts.h"
#include "scene/fur.h"
#include "scene/shapes.h"

namespace illum {
namespace {

enum : int { kFur, kSkin, kFelt, kShiny };

constexpr LinearRgb kBrown{0.62f, 0.36f, 0.15f};
constexpr LinearRgb kFawn{0.90f, 0.70f, 0.44f};

FurryPart part(Vector3 centre, Vector3 radii, double hairLength, LinearRgb colour) {
  return {{{1, 0, 0, 0, 1, 0, 0, 0, 1}, centre}, radii, hairLength, colour};
}

/// The same with its y axis along `axis`.
FurryPart along(Vector3 axis, FurryPart limb) {
  const Direction y = Direction::fromVector(axis);
  const Direction x = Direction::fromVector(cross(y.vector(), {0, 0, 1}));
  const Vector3 z = cross(x.vector(), y.vector());
  limb.objectFromPart.rotation = {x.x(), y.x(), z.x, x.y(), y.y(), z.y, x.z(), y.z(), z.z};
  return limb;
}

std::vector<FurryPart> furryParts() {
  std::vector<FurryPart> parts{part({0, -0.42, 0}, {0.50, 0.58, 0.44}, 0.15, kBrown),     // body
                               part({0, 0.46, 0.06}, {0.45, 0.41, 0.39}, 0.13, kBrown),   // head
                               part({0, 0.35, 0.40}, {0.20, 0.16, 0.17}, 0.06, kFawn),    // muzzle
                               part({0, -0.40, 0.20}, {0.32, 0.40, 0.29}, 0.09, kFawn)};  // belly
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(part({0.35 * side, 0.80, 0}, {0.17, 0.17, 0.08}, 0.08, kBrown));
    parts.push_back(along({-0.55 * side, 0.62, -0.42},
                          part({0.56 * side, -0.28, 0.16}, {0.16, 0.40, 0.16}, 0.12, kBrown)));
    parts.push_back(part({0.36 * side, -0.88, 0.36}, {0.21, 0.20, 0.42}, 0.12, kBrown));
    parts.push_back(part({0.40 * side, -0.84, 0.72}, {0.19, 0.23, 0.10}, 0.08, kBrown));
  }
  return parts;
}

/// Felt of soles and ears.
std::vector<FurryPart> feltParts() {
  std::vector<FurryPart> parts;
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(part({0.40 * side, -0.85, 0.80}, {0.125, 0.155, 0.045}, 0, kFawn));
    parts.push_back(part({0.35 * side, 0.80, 0.065}, {0.10, 0.10, 0.04}, 0, kFawn));
  }
  return parts;
}

std::vector<FurryPart> shinyParts() {
  return {part({-0.165, 0.545, 0.425}, {0.058, 0.058, 0.05}, 0, {}),
          part({0.165, 0.545, 0.425}, {0.058, 0.058, 0.05}, 0, {}),
          part({0, 0.405, 0.565}, {0.082, 0.06, 0.05}, 0, {})};
}

void addMeshes(const std::vector<FurryPart>& parts, const char* name, int material, Scene& scene) {
  constexpr int kSteps = 24;
  for (const FurryPart& each : parts) {
    scene.meshes.push_back(skinMesh(each, kSteps));
    scene.meshes.back().name = name;
    scene.meshes.back().material = material;
  }
}

std::vector<Material> materials() {
  Material fur, skin, felt, shiny;
  fur.name = "fur";
  fur.kind = Material::Kind::Hair;
  fur.baseColour = {1, 1, 1};  // hairs bring their own
  fur.roughness = 0.45f;
  skin.name = "skin";
  skin.baseColour = {0.10f, 0.05f, 0.02f};
  skin.specular = 0;
  felt.name = "felt";
  felt.baseColour = {0.52f, 0.30f, 0.17f};
  felt.specular = 0;
  shiny.name = "eyes and nose";
  shiny.baseColour = {0.012f, 0.009f, 0.008f};
  shiny.roughness = 0.18f;
  return {fur, skin, felt, shiny};
}

}  // namespace

PlannedScene furryBear() {
  constexpr int kHairs = 60000;
  constexpr std::uint64_t kSeed = 1989;
  const std::vector<FurryPart> furry = furryParts(), felt = feltParts(), shiny = shinyParts();
  std::vector<FurryPart> bald = felt;
  bald.insert(bald.end(), shiny.begin(), shiny.end());

  Scene scene;
  scene.materials = materials();
  addMeshes(furry, "skin", kSkin, scene);
  addMeshes(felt, "felt", kFelt, scene);
  addMeshes(shiny, "eyes and nose", kShiny, scene);
  scene.curves = {furOn(furry, bald, kHairs, kSeed)};
  scene.curves.front().material = kFur;

  SlabPlan slab;
  slab.toward = {0, 0.12, 1};
  slab.longerSide = 224;
  CapturePlan plan;
  plan.views = {slab};
  plan.lights.lights = FibonacciGrid{48};
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
