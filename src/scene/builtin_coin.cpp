// The case of a single view: a coin under a moving light, as in reflectance transformation imaging.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/builtin_parts.h"
#include "scene/coin.h"
#include "scene/shapes.h"

namespace illum {
namespace {

constexpr int kSide = 640;  // of heights and textures; the photograph has 512 pixels

/// A disc's point by a square's, concentric squares going to circles (Shirley and Chiu 1997).
std::array<double, 2> discFromSquare(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  constexpr double kQuarter = std::numbers::pi / 4;
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = wide ? kQuarter * b / a : 2 * kQuarter - kQuarter * a / b;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

TriangleMesh faceMesh(const HeightMap& heights) {
  TriangleMesh mesh = surfaceMesh(
      [](double u, double v) {
        const auto [x, y] = discFromSquare(u, v);
        return Vector3{kCoinRadius * x, kCoinRadius * y, 0};
      },
      kSide - 80, kSide - 80);
  mesh.name = "face";
  const double h = heights.spacing();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double x = mesh.positions[i][0], y = mesh.positions[i][1];
    mesh.positions[i][2] = static_cast<float>(heights.value(x, y));
    const Vector3 normal{(heights.value(x - h, y) - heights.value(x + h, y)) / (2 * h),
                         (heights.value(x, y - h) - heights.value(x, y + h)) / (2 * h), 1};
    mesh.normals[i] = floatsOf((1 / length(normal)) * normal);
    mesh.texcoords[i] = {static_cast<float>(0.5 * (x + 1)), static_cast<float>(0.5 * (y + 1))};
  }
  return mesh;
}

TriangleMesh edgeMesh(const HeightMap& heights) {
  TriangleMesh mesh = surfaceMesh(
      [&](double u, double v) {
        const double x = kCoinRadius * std::cos(2 * std::numbers::pi * u);
        const double y = kCoinRadius * std::sin(2 * std::numbers::pi * u);
        return Vector3{x, y, v * heights.value(x, y)};
      },
      720, 2);
  mesh.name = "edge";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.texcoords[i] = {0.5f * (mesh.positions[i][0] + 1), 0.5f * (mesh.positions[i][1] + 1)};
  }
  return mesh;
}

float mixed(double a, double b, double share) {
  return static_cast<float>(std::lerp(a, b, share));
}

/// Bright and smooth where hands have polished it, dark and dull where dirt stays.
void paint(const HeightMap& heights, Scene& scene) {
  const HeightMap near = heights.blurred(kSide / 110), far = heights.blurred(kSide / 36);
  Texture colour{"coin: colour", Picture({kSide, kSide}, 3)};
  Texture surface{"coin: roughness", Picture({kSide, kSide}, 3)};
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = heights.coordinate(column), y = heights.coordinate(row);
      const double above =
          heights.at(column, row) - 0.6 * near.at(column, row) - 0.4 * far.at(column, row);
      const double mottled = 0.5 * valueNoise(x, y, 6, 11) + 0.5 * valueNoise(x, y, 23, 12);
      const double polish = std::clamp(0.55 + 75 * above + 0.18 * mottled, 0.0, 1.0);
      const int textureRow = kSide - 1 - row;  // rows start at the top
      colour.texels.at(column, textureRow, 0) = mixed(0.17, 0.93, polish);
      colour.texels.at(column, textureRow, 1) = mixed(0.135, 0.86, polish);
      colour.texels.at(column, textureRow, 2) = mixed(0.10, 0.74, polish);
      const double grain = 0.05 * valueNoise(x, y, 150, 13);
      surface.texels.at(column, textureRow, 1) =
          mixed(0.66, 0.42, polish) + static_cast<float>(grain);
      surface.texels.at(column, textureRow, 2) = mixed(0.65, 1, polish);
    }
  }
  scene.textures = {std::move(colour), std::move(surface)};
}

}  // namespace

PlannedScene wornCoin() {
  const HeightMap heights = coinHeights(kSide);
  Scene scene;
  paint(heights, scene);
  Material silver, slate;
  silver.name = "silver";
  silver.baseColour = {1, 1, 1};
  silver.metallic = 1;
  silver.baseColourTexture = 0;
  silver.metallicRoughnessTexture = 1;
  slate.name = "slate";
  slate.baseColour = {0.045f, 0.05f, 0.055f};
  slate.roughness = 0.7f;
  scene.materials = {silver, slate};
  TriangleMesh table = rectangleMesh(2.2, 2.2);
  table.name = "table";
  table.material = 1;
  scene.meshes = {faceMesh(heights), edgeMesh(heights), table};

  CapturePlan plan;
  plan.views = {PhotographPlan{"coin", {512, 512}}};
  plan.lights.lights = FibonacciGrid{96};
  plan.samplesPerPixel = 8;
  return {std::move(scene), std::move(plan)};
}

}  // namespace illum
