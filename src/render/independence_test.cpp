// A value depends on nothing but scene, settings, view, pixel and light.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

#include "render/test_scenes.h"
#include "scene/shapes.h"

namespace illum {
namespace {

// Everything that could make rays depend on each other: discs, highlights, glass, mirrors, hair.
Scene motley() {
  Scene scene;
  Material glossy, glass, mirror, hair;
  glossy.roughness = 0.3f;
  glass.kind = Material::Kind::Glass;
  glass.baseColour = {0.9f, 0.8f, 0.7f};
  mirror.kind = Material::Kind::Mirror;
  mirror.baseColour = {0.8f, 0.8f, 0.9f};
  hair.kind = Material::Kind::Hair;
  scene.materials = {glossy, glass, mirror, hair};
  scene.meshes = {rectangleMesh(3, 3), sphereMesh(0.3, {-0.4, 0.3, 0.4}, 1),
                  sphereMesh(0.3, {0.4, 0.3, 0.3}, 2), boxMesh({0.3, 0.3, 0.5})};
  CurveSet curves;
  curves.material = 3;
  for (int i = 0; i < 60; ++i) {
    curves.firstPoints.push_back(static_cast<std::uint32_t>(curves.points.size()));
    const auto x = static_cast<float>(0.01 * i - 0.3);
    for (int k = 0; k < 5; ++k) {
      const auto t = static_cast<float>(k);
      curves.points.push_back({x + 0.02f * t * t, -0.9f + 0.1f * t, 0.1f + 0.05f * t, 0.01f});
    }
  }
  scene.curves.push_back(curves);
  return scene;
}

const RenderSettings kSettings{0.05, 3, 2, 0.75, 42};

TEST(Independence, OfTheOtherLights) {
  const Renderer renderer(motley(), kSettings);
  const auto lights = fibonacciLights(150);
  const View view = frontalView(24);
  const auto all = renderAll(renderer, view, lights);
  std::vector<RenderLight> some;
  for (std::size_t l = 1; l < lights.size(); l += 3) some.push_back(lights[l]);
  some.push_back(lights[0]);
  const auto few = renderAll(renderer, view, some);
  const std::size_t each = 3 * 24 * 24;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const auto l = static_cast<std::size_t>(some[k].id);
    for (std::size_t i = 0; i < each; ++i) {
      ASSERT_EQ(all[l * each + i], few[k * each + i]) << "light " << l << " value " << i;
    }
  }
  // Each alone.
  for (const std::size_t l : {0u, 63u, 64u, 149u}) {
    const auto alone = renderAll(renderer, view, {lights[l]});
    for (std::size_t i = 0; i < each; ++i) {
      ASSERT_EQ(all[l * each + i], alone[i]) << "light " << l << " value " << i;
    }
  }
}

TEST(Independence, OfRectanglesAndThreads) {
  const Renderer renderer(motley(), kSettings);
  const auto lights = fibonacciLights(40);
  const View view = frontalView(40);
  const auto all = renderAll(renderer, view, lights);
  std::vector<float> coverage(40 * 40), depth(40 * 40);
  renderer.trace(view, {0, 0, 40, 40}, coverage, depth);
  // Patches of a size that fits nothing, all at once.
  constexpr int kSide = 7;
  tbb::parallel_for(0, 36, [&](int i) {
    const int x = i % 6 * kSide, y = i / 6 * kSide;
    const Rectangle patch{x, y, std::min(kSide, 40 - x), std::min(kSide, 40 - y)};
    std::vector<float> samples(3 * lights.size() * patch.pixels()), cover(patch.pixels()),
        far(patch.pixels());
    renderer.render(view, patch, lights, samples);
    renderer.trace(view, patch, cover, far);
    for (std::size_t p = 0; p < patch.pixels(); ++p) {
      const auto at = static_cast<std::size_t>(40 * (y + static_cast<int>(p) / patch.width) + x +
                                               static_cast<int>(p) % patch.width);
      EXPECT_EQ(cover[p], coverage[at]);
      EXPECT_EQ(far[p], depth[at]);
      for (std::size_t plane = 0; plane < 3 * lights.size(); ++plane) {
        ASSERT_EQ(samples[plane * patch.pixels() + p], all[plane * 1600 + at])
            << "plane " << plane << " pixel " << at;
      }
    }
  });
}

TEST(Independence, OfTheRenderer) {
  const auto lights = fibonacciLights(3);
  const auto once = renderAll(Renderer(motley(), kSettings), frontalView(16), lights);
  const auto again = renderAll(Renderer(motley(), kSettings), frontalView(16), lights);
  EXPECT_EQ(once, again);
  RenderSettings other = kSettings;
  other.seed = 43;
  EXPECT_NE(once, renderAll(Renderer(motley(), other), frontalView(16), lights));
}

// The scene, its lights and the camera turned as one.
TEST(Independence, OfTheFrame) {
  const Scene scene = motley();
  PinholeCamera camera;
  camera.objectFromCamera = lookAt({0.4, -1, 3}, {}, {0, 1, 0});
  camera.size = {32, 32};
  camera.focalX = camera.focalY = 40;
  camera.centre = {16, 16};
  RigidTransform turn = rotationAbout(Direction::fromVector({1, 2, -0.5}), 1.1);
  turn.translation = {0.3, -0.2, 0.5};
  Scene turned = scene;
  for (TriangleMesh& mesh : turned.meshes) transform(mesh, turn);
  for (auto& p : turned.curves[0].points) {
    const Vector3 moved = turn.point({p[0], p[1], p[2]});
    p = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z),
         p[3]};
  }
  PinholeCamera turnedCamera = camera;
  turnedCamera.objectFromCamera = turn * camera.objectFromCamera;
  RenderSettings settings = kSettings;
  settings.samplesPerPixel = 64;
  const Direction light = Direction::fromAngles(0.6, 1.2);
  const auto before = renderAll(Renderer(scene, settings), {"c", camera}, {{light, 0}});
  const auto after =
      renderAll(Renderer(turned, settings), {"c", turnedCamera}, {{turn.direction(light), 0}});
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    // Where glass and mirrors show the disc itself single values are of the order of 100.
    const double a = std::min(2.0f, before[i]), b = std::min(2.0f, after[i]);
    difference += (a - b) * (a - b);
    sum += a * a;
  }
  // The same but for noise: other points of the disc are drawn.
  EXPECT_LT(std::sqrt(difference / sum), 0.05);
}

}  // namespace
}  // namespace illum
