// Pictures that are known beforehand.
#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/test_scenes.h"
#include "scene/shapes.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

RenderSettings settings(double radius, int samples, int bounces) {
  return {radius, samples, bounces, 0.5, 7};
}

TEST(Renderer, AMattPlaneFollowsTheCosine) {
  const Renderer renderer(planeScene(mattMaterial({1, 0.5f, 0.25f})), {});
  for (const double theta : {0.0, 0.4, 1.0, 1.5, 1.6, 3.0}) {
    const auto samples =
        renderAll(renderer, frontalView(8), {{Direction::fromAngles(theta, 0.7), 3}});
    const double expected = std::max(0.0, std::cos(theta));
    for (std::size_t p = 0; p < 64; ++p) {
      ASSERT_NEAR(samples[p], expected, 1e-5) << "theta " << theta << " pixel " << p;
      ASSERT_NEAR(samples[128 + p], 0.25 * expected, 1e-5) << "theta " << theta;
    }
  }
}

// The irradiance of a disc wholly above the horizon is that of its centre; half below the horizon
// it is, for a centre in the horizon, (r - sin r cos r) / sin^2 r (from the area of the disc's
// upper half, projected).
TEST(Renderer, AMattPlaneUnderDiscs) {
  for (const double radius : {0.02, 0.2, 0.5}) {
    const Renderer renderer(planeScene(mattMaterial({1, 1, 1})), settings(radius, 64, 0));
    for (const double theta : {0.0, 0.6, 1.0}) {
      const auto samples =
          renderAll(renderer, frontalView(8), {{Direction::fromAngles(theta, 2), 1}});
      EXPECT_NEAR(meanOf(samples, 64, 0), std::cos(theta), 2e-3)
          << "radius " << radius << " theta " << theta;
    }
    const auto samples =
        renderAll(renderer, frontalView(8), {{Direction::fromAngles(kPi / 2, 2), 1}});
    const double sine = std::sin(radius);
    const double expected = (radius - sine * std::cos(radius)) / (kPi * sine * sine);
    EXPECT_NEAR(meanOf(samples, 64, 0), expected, 0.02 * expected) << "radius " << radius;
  }
}

TEST(Renderer, AMattSphereFollowsTheCosine) {
  const Renderer renderer(sphereScene(mattMaterial({1, 1, 1})), settings(0, 16, 0));
  const int side = 64;
  for (const Vector3 towards : {Vector3{0, 0, 1}, Vector3{1, 2, 1}, Vector3{-1, 0, -0.5}}) {
    const Direction light = Direction::fromVector(towards);
    const auto samples = renderAll(renderer, frontalView(side), {{light, 0}});
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double px = (2 * x + 1.0 - side) / side, py = (side - 2 * y - 1.0) / side;
        const double rest = 1 - px * px - py * py;
        if (rest < 0.15) continue;  // the outline, where a pixel holds many normals
        const double cosine = dot({px, py, std::sqrt(rest)}, light.vector());
        // Within a pixel of the terminator part of it is dark.
        const double tolerance = std::abs(cosine) < 0.1 ? 0.02 : 0.003;
        ASSERT_NEAR(samples[static_cast<std::size_t>(y * side + x)], std::max(0.0, cosine),
                    tolerance)
            << "light z " << light.z() << " at " << x << ", " << y;
      }
    }
  }
}

// A box of height 0.4 that ends at x = -0.1, light from +x: the shadow ends 0.4 tan(theta) further.
TEST(Renderer, ABoxThrowsItsShadowToItsPlace) {
  Scene scene = planeScene(mattMaterial({1, 1, 1}));
  TriangleMesh box = boxMesh({0.3, 1, 0.4});
  transform(box, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.05, 0, 0.2}});
  scene.meshes.push_back(box);
  const Renderer renderer(scene, settings(0, 256, 0));
  const int side = 100;
  for (const double theta : {0.3, 0.7, 1.0}) {
    std::vector<float> samples(3 * side);
    const std::vector<RenderLight> light{{Direction::fromAngles(theta, 0), 0}};
    renderer.render(frontalView(side), {0, 50, side, 1}, light, samples);
    const double edge = -0.1 - 0.4 * std::tan(theta);
    for (int x = 0; x < 44; ++x) {  // left of the box
      const double left = -1 + 0.02 * x;
      const double lit = std::clamp((edge - left) / 0.02, 0.0, 1.0);
      // 256 samples in strata: one row of 16 may fall on either side.
      EXPECT_NEAR(samples[static_cast<std::size_t>(x)], lit * std::cos(theta), 0.02)
          << "theta " << theta << " column " << x << " edge " << edge;
    }
  }
}

// The part of a disc about the zenith, projected on the ground, of which directions (x, y, z) have
// x <= z tangent: counted on a grid.
double partBefore(double tangent, double radius) {
  constexpr int kSteps = 300;
  int inside = 0, before = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = std::sin(radius) * (2 * i + 1.0 - kSteps) / kSteps;
      const double y = std::sin(radius) * (2 * j + 1.0 - kSteps) / kSteps;
      if (std::hypot(x, y) > std::sin(radius)) continue;
      ++inside;
      before += x <= tangent * std::sqrt(1 - x * x - y * y) ? 1 : 0;
    }
  }
  return static_cast<double>(before) / inside;
}

TEST(Renderer, ADiscMakesAPenumbra) {
  Scene scene = planeScene(mattMaterial({1, 1, 1}));
  TriangleMesh roof = rectangleMesh(4, 4);  // at z = 0.5, from x = 0 on
  transform(roof, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {2, 0, 0.5}});
  scene.meshes.push_back(roof);
  const double radius = 0.3;
  const Renderer renderer(scene, settings(radius, 256, 0));
  std::vector<float> samples(3 * 800);
  const std::vector<RenderLight> light{{Direction(), 0}};
  renderer.render(frontalView(100), {0, 46, 100, 8}, light, samples);
  for (int x = 0; x < 50; ++x) {
    const double away = 0.99 - 0.02 * x;  // of the pixel's centre from the roof's edge
    double mean = 0;
    for (int y = 0; y < 8; ++y) {
      mean += static_cast<double>(samples[static_cast<std::size_t>(100 * y + x)]) / 8;
    }
    EXPECT_NEAR(mean, partBefore(away / 0.5, radius), 0.008) << "column " << x;
  }
}

// Under white light from everywhere a white thing is white, however light goes about.
TEST(Renderer, AConvexWhiteThingIsLostInAWhiteFurnace) {
  const auto lights = fibonacciLights(256);
  for (const int bounces : {0, 1, 3}) {
    const Renderer renderer(sphereScene(mattMaterial({1, 1, 1})), settings(0, 1, bounces));
    const auto samples = renderAll(renderer, frontalView(32), lights);
    const auto sky = underWhiteSky(samples, 32 * 32, lights.size());
    std::vector<float> coverage(32 * 32);
    renderer.trace(frontalView(32), {0, 0, 32, 32}, coverage, {});
    for (std::size_t p = 0; p < coverage.size(); ++p) {
      if (coverage[p] == 0) continue;
      // 256 points integrate a clamped cosine to about 1 %.
      ASSERT_NEAR(sky[p], 1, 0.015) << "bounces " << bounces << " pixel " << p;
    }
  }
}

// Inside a sphere every point sees every other under the same factor, 1 / area. With an opening of
// the fraction f of the sphere and albedo a, the n-th reflection of a white sky is
// a f (a (1 - f))^n everywhere.
TEST(Renderer, AnOpenSphereHasASeriesOfReflections) {
  const double albedo = 0.8, opening = 0.25;  // a cap of 60 degrees
  Scene scene;
  scene.materials.push_back(mattMaterial({0.8f, 0.8f, 0.8f}));
  scene.meshes.push_back(surfaceMesh(
      [](double u, double v) {
        const double theta = kPi / 3 + (kPi - kPi / 3) * v, phi = 2 * kPi * u;
        return Vector3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::cos(theta)};
      },
      96, 96));
  const auto lights = fibonacciLights(200);
  const int side = 8;
  double expected = 0;
  for (int bounces = 0; bounces <= 3; ++bounces) {
    expected += albedo * opening * std::pow(albedo * (1 - opening), bounces);
    const Renderer renderer(scene, settings(0.08, 64, bounces));
    std::vector<float> samples(3 * lights.size() * 64);
    // Of a picture of 16 x 16 the middle half, which looks in through the opening.
    renderer.render(frontalView(16), {4, 4, side, side}, lights, samples);
    const auto sky = underWhiteSky(samples, 64, lights.size());
    EXPECT_NEAR(meanOf(sky, 64, 0), expected, 0.015 * expected) << "bounces " << bounces;
  }
}

TEST(Renderer, NoMaterialReflectsMoreThanItGets) {
  const auto lights = fibonacciLights(400);
  for (const float metallic : {0.0f, 0.5f, 1.0f}) {
    for (const float roughness : {0.0f, 0.1f, 0.4f, 1.0f}) {
      Material material;
      material.baseColour = {1, 1, 1};
      material.metallic = metallic;
      material.roughness = roughness;
      const Renderer renderer(sphereScene(material), settings(0.1, 16, 2));
      const auto samples = renderAll(renderer, frontalView(12), lights);
      const auto sky = underWhiteSky(samples, 144, lights.size());
      double sum = 0;
      int seen = 0;
      for (std::size_t p = 0; p < 144; ++p) {
        if (sky[p] > 0) sum += static_cast<double>(sky[p]), ++seen;
      }
      // 400 discs of 0.1 have the area of the sphere but are not even: 3 %. What microfacets
      // reflect twice is lost.
      EXPECT_LE(sum / seen, 1.03) << "metallic " << metallic << " roughness " << roughness;
      EXPECT_GE(sum / seen, roughness < 0.5f || metallic == 0 ? 0.9 : 0.4)
          << "metallic " << metallic << " roughness " << roughness;
    }
  }
}

// Light from B seen along A carries as much as light from A seen along B (von Helmholtz 1867),
// summed over the picture, however it went about between.
TEST(Renderer, LightMayGoEitherWay) {
  Scene scene;
  scene.materials = {mattMaterial({0.9f, 0.6f, 0.3f}), Material{}};
  scene.materials[1].roughness = 0.7f;
  scene.materials[1].metallic = 0.5f;
  scene.meshes = {rectangleMesh(1, 1), boxMesh({0.3, 0.2, 0.5})};
  transform(scene.meshes[1], {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.1, 0.05, 0.25}});
  scene.meshes[1].material = 1;
  const Direction light = Direction::fromAngles(0.9, 0.5);
  // Turned so that the light's direction becomes the viewer's, the viewer's becomes the light's.
  const RigidTransform turn = inverse(lookAt(light.vector(), {}, {0, 1, 0}));
  Scene turned = scene;
  for (TriangleMesh& mesh : turned.meshes) {
    transform(mesh, {turn.rotation, {}});
  }
  const Direction backLight = Direction::fromVector(turn.vector({0, 0, 1}));
  const int side = 64;
  const auto total = [&](const Scene& of, Direction toLight, std::size_t channel) {
    const Renderer renderer(of, settings(0, 64, 3));
    const auto samples = renderAll(renderer, frontalView(side), {{toLight, 0}});
    std::vector<float> coverage(64 * 64);
    renderer.trace(frontalView(side), {0, 0, side, side}, coverage, {});
    double sum = 0;
    for (std::size_t p = 0; p < coverage.size(); ++p) {
      sum += static_cast<double>(coverage[p] * samples[channel * coverage.size() + p]);
    }
    return sum;
  };
  for (const std::size_t channel : {0u, 2u}) {
    const double there = total(scene, light, channel), back = total(turned, backLight, channel);
    EXPECT_NEAR(there, back, 0.01 * there) << "channel " << channel;
  }
}

// The integral over the disc of microfacets, cosine and radiance, by rings.
double highlight(double alpha, Direction light, double radius) {
  const Frame frame(float3(light.vector()));
  double sum = 0;
  constexpr int kRings = 1000, kSpokes = 200;
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSpokes; ++j) {
      const double off = radius * (i + 0.5) / kRings, phi = 2 * kPi * (j + 0.5) / kSpokes;
      const double area = std::sin(off) * (radius / kRings) * (2 * kPi / kSpokes);
      const Float3 l = frame.world(
          float3({std::sin(off) * std::cos(phi), std::sin(off) * std::sin(phi), std::cos(off)}));
      if (l.z <= 0) continue;
      sum += referenceMicrofacets(alpha, 1, 1, {0, 0, 1}, l) * static_cast<double>(l.z) * area;
    }
  }
  return sum / std::pow(std::sin(radius), 2);
}

// Points drawn on discs and directions drawn from the material share the work; together they give
// the integral, whether the highlight or the disc is the narrower one.
TEST(Renderer, AHighlightIsTheIntegralOverTheDisc) {
  for (const float roughness : {0.1f, 0.25f, 0.5f, 0.8f}) {
    Material metal;
    metal.baseColour = {1, 1, 1};
    metal.metallic = 1;
    metal.roughness = roughness;
    const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
    for (const double radius : {0.02, 0.3}) {
      const Renderer renderer(planeScene(metal), settings(radius, 256, 0));
      for (const double theta : {0.0, 0.25, 0.7}) {
        const Direction light = Direction::fromAngles(theta, 0.4);
        const double expected = highlight(alpha, light, radius);
        const auto samples = renderAll(renderer, frontalView(8), {{light, 0}});
        EXPECT_NEAR(meanOf(samples, 64, 0), expected, 0.01 * expected + 1e-4)
            << "roughness " << roughness << " radius " << radius << " theta " << theta;
      }
    }
  }
}

// A mirror shows the disc where the mirrored ray meets it, at its size and radiance.
TEST(Renderer, AMirrorShowsTheLightsDisc) {
  Scene scene;
  Material mirror;
  mirror.kind = Material::Kind::Mirror;
  mirror.baseColour = {0.9f, 0.9f, 0.9f};
  scene.materials.push_back(mirror);
  scene.meshes.push_back(rectangleMesh(4, 4));
  const double radius = 0.12;
  const Direction light = Direction::fromAngles(0.5, 2.5);
  PinholeCamera camera;
  camera.objectFromCamera = lookAt({0.3, -0.2, 1.2}, {0, 0.1, 0}, {0, 1, 0});
  camera.size = {60, 60};
  camera.focalX = camera.focalY = 40;
  camera.centre = {30, 30};
  const View view{"camera", camera};
  const Renderer renderer(scene, settings(radius, 4, 0));
  const auto samples = renderAll(renderer, view, {{light, 0}});
  int inside = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const auto angleAt = [&](double px, double py) {
        Vector3 d = rayThrough(camera, {px, py}).direction;
        d.z = -d.z;
        return angleRadians(Direction::fromVector(d), light);
      };
      const double middle = angleAt(x + 0.5, y + 0.5);
      if (std::abs(middle - radius) < 0.03) continue;  // the disc's edge passes through the pixel
      const double expected = middle < radius ? 0.9 / std::pow(std::sin(radius), 2) : 0;
      inside += middle < radius ? 1 : 0;
      ASSERT_NEAR(samples[static_cast<std::size_t>(60 * y + x)], expected, 1e-3 * expected)
          << "at " << x << ", " << y << ", " << middle << " from the disc's centre";
    }
  }
  EXPECT_GT(inside, 20);
}

TEST(Renderer, GlassWeakensShadowRaysSurfaceBySurface) {
  Scene scene = planeScene(mattMaterial({1, 1, 1}));
  Material glass;
  glass.kind = Material::Kind::Glass;
  glass.baseColour = {0.9f, 0.5f, 0};
  scene.materials.push_back(glass);
  TriangleMesh slab = boxMesh({0.5, 0.5, 0.1});
  transform(slab, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.8, 0, 1}});  // aside, so that rays see the plane
  slab.material = 1;
  scene.meshes.push_back(slab);
  const double theta = std::atan2(0.8, 1);
  const Renderer renderer(scene, settings(0, 4, 0));
  std::vector<float> samples(3);
  const std::vector<RenderLight> light{{Direction::fromAngles(theta, 0), 0}};
  renderer.render(frontalView(51), {25, 25, 1, 1}, light, samples);
  // Fresnel's reflectance at 38.66 degrees, refractive index 1.5.
  const double c = std::cos(theta), inside = std::sqrt(1 - std::pow(std::sin(theta) / 1.5, 2));
  const double across = std::pow((c - 1.5 * inside) / (c + 1.5 * inside), 2);
  const double along = std::pow((1.5 * c - inside) / (1.5 * c + inside), 2);
  const double passes = std::pow(1 - (across + along) / 2, 2);
  EXPECT_NEAR(samples[0], 0.81 * passes * c, 1e-4);
  EXPECT_NEAR(samples[1], 0.25 * passes * c, 1e-4);
  EXPECT_NEAR(samples[2], 0, 1e-6);
}

TEST(Renderer, CoverageAndMedianDepth) {
  Scene scene;
  scene.materials.push_back(mattMaterial({1, 1, 1}));
  scene.meshes = {rectangleMesh(1, 1), rectangleMesh(0.5, 1)};
  transform(scene.meshes[1], {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.25, 0, 0.4}});
  const Renderer renderer(scene, settings(0, 64, 0));
  std::vector<float> coverage(20), depth(20);
  renderer.trace(frontalView(20), {0, 10, 20, 1}, coverage, depth);
  for (std::size_t x = 0; x < 20; ++x) {
    const bool covered = x >= 5 && x < 15;
    EXPECT_EQ(coverage[x], covered ? 1 : 0) << "column " << x;
    if (covered) {
      EXPECT_NEAR(depth[x], x < 10 ? 0 : 0.4, 1e-6) << "column " << x;
    } else {
      EXPECT_EQ(depth[x], std::numeric_limits<float>::infinity()) << "column " << x;
    }
  }
  // Half a pixel.
  std::vector<float> half(1);
  renderer.trace(frontalView(10), {2, 5, 1, 1}, half, {});
  EXPECT_NEAR(half[0], 0.5, 0.02);
}

TEST(Renderer, BothSidesOfASurfaceAreSeen) {
  Scene scene = planeScene(mattMaterial({1, 1, 1}));
  for (auto& triangle : scene.meshes[0].triangles) std::swap(triangle[1], triangle[2]);
  const Renderer renderer(scene, {});
  const auto samples = renderAll(renderer, frontalView(4), {{Direction::fromAngles(0.5, 0), 0}});
  EXPECT_NEAR(samples[0], std::cos(0.5), 1e-5);
}

}  // namespace
}  // namespace illum
