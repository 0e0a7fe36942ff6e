// What is wrong with a scene is told; what is merely odd is rendered without harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "illum/error.h"
#include "render/rendered_capture.h"
#include "render/test_scenes.h"
#include "scene/shapes.h"

namespace illum {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::string faultOf(const Scene& scene, const RenderSettings& settings = {}) {
  try {
    const Renderer renderer(scene, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "";
}

Scene named() {
  Scene scene = planeScene(mattMaterial({1, 1, 1}));
  scene.meshes[0].name = "floor";
  return scene;
}

TEST(HostileScene, NumbersThatAreNone) {
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    Scene scene = named();
    scene.meshes[0].positions[1][2] = bad;
    EXPECT_THAT(faultOf(scene), HasSubstr("mesh \"floor\""));
    scene = named();
    scene.meshes[0].normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {bad, 0, 1}};
    EXPECT_THAT(faultOf(scene), HasSubstr("finite"));
    scene = named();
    scene.meshes[0].texcoords[2][0] = bad;
    EXPECT_THAT(faultOf(scene), HasSubstr("finite"));
    scene = named();
    scene.materials[0].baseColour.g = bad;
    EXPECT_THAT(faultOf(scene), HasSubstr("material"));
    scene = named();
    scene.curves.push_back({"fur", 0, {{0, 0, 0, bad}}, {0}, {}});
    EXPECT_THAT(faultOf(scene), HasSubstr("curves \"fur\""));
  }
}

TEST(HostileScene, IndicesThatLeadNowhere) {
  Scene scene = named();
  scene.meshes[0].triangles[0][2] = 4;
  EXPECT_THAT(faultOf(scene), HasSubstr("vertices below 4, found number 4"));
  scene = named();
  scene.meshes[0].material = 1;
  EXPECT_THAT(faultOf(scene), HasSubstr("materials, found number 1"));
  scene = named();
  scene.meshes[0].colours.resize(3);
  EXPECT_THAT(faultOf(scene), HasSubstr("as many"));
  scene = named();
  scene.materials[0].normalTexture = 0;
  EXPECT_THAT(faultOf(scene), HasSubstr("textures, found number 0"));
  scene = named();
  scene.textures.emplace_back();
  EXPECT_THAT(faultOf(scene), HasSubstr("no texels"));
  scene = named();
  scene.curves.push_back({"fur", 0, {{0, 0, 0, 1}}, {0, 5}, {}});
  EXPECT_THAT(faultOf(scene), HasSubstr("one behind the other"));
  scene = named();
  scene.curves.push_back({"fur", 0, {{0, 0, 0, -1}}, {0}, {}});
  EXPECT_THAT(faultOf(scene), HasSubstr("not negative"));
  scene = named();
  scene.materials[0].ior = 0.5f;
  EXPECT_THAT(faultOf(scene), HasSubstr("refractive index"));
}

TEST(HostileScene, SettingsOutOfRange) {
  const auto fault = [](auto change) {
    RenderSettings settings;
    change(settings);
    return faultOf(named(), settings);
  };
  EXPECT_THAT(fault([](auto& s) { s.lightRadiusRadians = 1.6; }), HasSubstr("radius"));
  EXPECT_THAT(fault([](auto& s) { s.lightRadiusRadians = -0.1; }), HasSubstr("radius"));
  EXPECT_THAT(fault([](auto& s) { s.lightRadiusRadians = std::nan(""); }), HasSubstr("radius"));
  EXPECT_THAT(fault([](auto& s) { s.samplesPerPixel = 0; }), HasSubstr("samples"));
  EXPECT_THAT(fault([](auto& s) { s.bounces = -1; }), HasSubstr("bounces"));
  EXPECT_THAT(fault([](auto& s) { s.filterRadius = 0; }), HasSubstr("filter"));
  EXPECT_THAT(fault([](auto& s) { s.filterRadius = std::nan(""); }), HasSubstr("filter"));
}

TEST(HostileScene, NothingIsSeenOfNothing) {
  for (const bool meshWithoutTriangles : {false, true}) {
    Scene scene;
    if (meshWithoutTriangles) {
      scene = named();
      scene.meshes[0].triangles.clear();
    }
    const Renderer renderer(scene, {});
    std::vector<float> samples(3 * 16, kNan), coverage(16, kNan), depth(16, kNan);
    renderer.render(frontalView(4), {0, 0, 4, 4}, std::vector<RenderLight>{{Direction(), 0}},
                    samples);
    renderer.trace(frontalView(4), {0, 0, 4, 4}, coverage, depth);
    EXPECT_THAT(samples, testing::Each(0.0f));
    EXPECT_THAT(coverage, testing::Each(0.0f));
    EXPECT_THAT(depth, testing::Each(kInfinity));
  }
}

// Slivers, points for triangles, normals without a direction or against the surface, texture
// coordinates without extent or far off, all extremes of all materials.
Scene odd() {
  Scene scene;
  Texture grey{"grey", Picture({3, 2}, 1)}, flat{"flat", Picture({1, 1}, 3)};
  for (float& texel : grey.texels.samples()) texel = 0.5f;
  scene.textures = {grey, flat};  // a normal map of zeros
  for (const auto kind : {Material::Kind::Surface, Material::Kind::Mirror, Material::Kind::Glass,
                          Material::Kind::Hair}) {
    for (const float extreme : {0.0f, 1.0f}) {
      Material material;
      material.kind = kind;
      material.baseColour = {extreme, 1 - extreme, 40};
      material.metallic = 5 * extreme;
      material.roughness = 1 - extreme;
      material.specular = extreme;
      material.ior = 1 + extreme;
      material.baseColourTexture = 0;
      material.metallicRoughnessTexture = 0;
      material.normalTexture = 1;
      material.alphaCutoff = 0.5f * extreme;
      scene.materials.push_back(material);
    }
  }
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    TriangleMesh mesh = sphereMesh(
        0.2,
        {0.25 * static_cast<double>(m % 4) - 0.4, m < 4 ? -0.3 : 0.3, 0.1 * static_cast<double>(m)},
        static_cast<int>(m));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      if (v % 5 == 0) mesh.normals[v] = {0, 0, 0};
      if (v % 7 == 0) mesh.normals[v] = {-mesh.normals[v][0], 1, 0};
      if (v % 3 == 0) mesh.texcoords[v] = {1e30f, -1e30f};
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 11) {
      mesh.triangles[t][1] = mesh.triangles[t][0];
    }
    scene.meshes.push_back(mesh);
  }
  scene.meshes.push_back(rectangleMesh(2, 1e-7));
  CurveSet curves;
  curves.material = 6;
  curves.points = {{0, 0, 1, 0},     {0, 0, 1, 0}, {0, 0, 1, 0},    {0, 0, 1, 0},
                   {-1, 0, 1, 0.1f}, {0, 0, 1, 0}, {1, 0, 1, 0.1f}, {2, 1, 1, 0.2f}};
  curves.firstPoints = {0, 4, 7, 8};
  scene.curves.push_back(curves);
  return scene;
}

TEST(HostileScene, OddThingsGiveNumbers) {
  const auto lights = fibonacciLights(70);
  for (const double radius : {0.0, 0.1}) {
    const Renderer renderer(odd(), {radius, 4, 3, 0.75, 1});
    const auto samples = renderAll(renderer, frontalView(32), lights);
    for (const float sample : samples) {
      ASSERT_TRUE(std::isfinite(sample) && sample >= 0) << sample << " radius " << radius;
    }
    std::vector<float> coverage(32 * 32), depth(32 * 32);
    renderer.trace(frontalView(32), {0, 0, 32, 32}, coverage, depth);
    for (std::size_t p = 0; p < coverage.size(); ++p) {
      ASSERT_EQ(coverage[p] > 0, std::isfinite(depth[p])) << "pixel " << p;
    }
  }
}

TEST(RenderedCapture, IsTheRenderer) {
  SceneCapture scene{planeScene(mattMaterial({1, 0.5f, 0.2f})), {}};
  scene.setup.views = {frontalView(6), {"wide", OrthographicView{{8, 4}}}};
  for (const RenderLight& light : fibonacciLights(5)) {
    scene.setup.lights.push_back({"light", {light.toLight}});
  }
  const auto capture = renderedCapture(scene);
  EXPECT_EQ(capture->groups(), 2);
  EXPECT_TRUE(capture->isRendered() && capture->hasMask() && capture->hasDepth());
  EXPECT_GE(capture->bandRows(), 6);
  std::vector<float> samples(3 * 2 * 4), mask(4), depth(4);
  capture->read(1, {2, 1, 2, 2}, std::vector<int>{1, 4}, samples);
  const double cosine = scene.setup.lights[1].light.toLight.z();
  EXPECT_NEAR(samples[0], std::max(0.0, cosine), 1e-5);
  EXPECT_NEAR(samples[4], std::max(0.0, 0.5 * cosine), 1e-5);
  capture->readMask(1, {2, 1, 2, 2}, mask);
  capture->readDepth(1, {2, 1, 2, 2}, depth);
  EXPECT_THAT(mask, testing::Each(1.0f));
  EXPECT_THAT(depth, testing::Each(testing::FloatNear(0, 1e-6f)));
}

TEST(RenderedCapture, TheFingerprintKnowsAllThatMatters) {
  SceneCapture scene{named(), {}};
  scene.setup.views = {frontalView(6)};
  scene.setup.lights = {{"light", {Direction()}}};
  const std::string before = sceneFingerprint(scene);
  EXPECT_EQ(before, sceneFingerprint(scene));
  const auto changed = [&](auto change) {
    SceneCapture other = scene;
    change(other);
    return sceneFingerprint(other);
  };
  EXPECT_NE(before, changed([](auto& s) { s.scene.meshes[0].positions[3][1] += 1e-6f; }));
  EXPECT_NE(before, changed([](auto& s) { s.scene.materials[0].roughness = 0.9f; }));
  EXPECT_NE(before, changed([](auto& s) { s.scene.curves.emplace_back(); }));
  EXPECT_NE(before, changed([](auto& s) { s.setup.seed = 1; }));
  EXPECT_NE(before, changed([](auto& s) { s.setup.bounces = 2; }));
  EXPECT_NE(before, changed([](auto& s) { s.setup.lightRadiusRadians = 0.1; }));
  EXPECT_NE(before, changed([](auto& s) { s.setup.views[0].name = "other"; }));
  EXPECT_NE(before, changed([](auto& s) {
              s.setup.lights[0].light.toLight = Direction::fromAngles(1, 0);
            }));
}

TEST(RenderedCapture, NothingToRenderIsAnError) {
  SceneCapture scene{named(), {}};
  EXPECT_THROW(renderedCapture(scene), Error);
  scene.setup.views = {frontalView(6)};
  EXPECT_THROW(renderedCapture(scene), Error);
}

}  // namespace
}  // namespace illum
