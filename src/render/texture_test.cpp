// Textures, by themselves and on surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/test_scenes.h"
#include "render/texture_pyramid.h"
#include "scene/shapes.h"

namespace illum {
namespace {

Texture texture(Size size, int channels) {
  return {"texture", Picture(size, channels)};
}

// Red to the right, green upward.
Texture ramp(int width, int height) {
  Texture t = texture({width, height}, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      t.texels.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      t.texels.at(x, y, 1) = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
    }
  }
  return t;
}

const TextureFootprint kPoint{{0, 0}, {0, 0}};

TEST(TexturePyramid, ULiesToTheRightAndVUpward) {
  const TexturePyramid pyramid(ramp(16, 8));
  for (const float u : {0.1f, 0.5f, 0.9f}) {
    for (const float v : {0.1f, 0.5f, 0.9f}) {
      const Texel texel = pyramid.mean({u, v}, kPoint);
      EXPECT_NEAR(texel[0], u, 1e-5) << u << " " << v;
      EXPECT_NEAR(texel[1], v, 1e-5) << u << " " << v;
      EXPECT_EQ(texel[3], 1);
      const Texel turned = pyramid.mean({u + 3, v - 2}, kPoint);
      EXPECT_NEAR(turned[0], u, 1e-5) << "repeats";
      EXPECT_NEAR(turned[1], v, 1e-5) << "repeats";
    }
  }
}

TEST(TexturePyramid, AWideFootprintSeesTheMean) {
  for (const Size size : {Size{16, 16}, Size{13, 7}, Size{1, 9}}) {
    Texture noise = texture(size, 1);
    double mean = 0;
    for (std::size_t i = 0; i < noise.texels.samples().size(); ++i) {
      noise.texels.samples()[i] = static_cast<float>((i * 7919) % 101) / 100;
      mean += static_cast<double>(noise.texels.samples()[i]);
    }
    mean /= static_cast<double>(noise.texels.samples().size());
    const Texel texel = TexturePyramid(noise).mean({0.3f, 0.4f}, {{2, 0}, {0, 2}});
    EXPECT_NEAR(texel[0], mean, 1e-5) << size.width << " x " << size.height;
    EXPECT_EQ(texel[0], texel[2]);
  }
}

// Stripes along u, seen in a footprint that is long along them: they stay sharp.
TEST(TexturePyramid, LongFootprintsBlurAlongTheirLengthOnly) {
  Texture stripes = texture({64, 64}, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) stripes.texels.at(x, y, 0) = y / 8 % 2 == 0 ? 1.0f : 0.0f;
  }
  const TexturePyramid pyramid(stripes);
  const float middleOfStripe = 1 - 4.0f / 64;
  const TexturePoint longer{6.0f / 64, 0}, shorter{0, 0.7f / 64};
  EXPECT_NEAR(pyramid.mean({0.5f, middleOfStripe}, {longer, shorter})[0], 1, 0.02);
  EXPECT_NEAR(pyramid.mean({0.5f, middleOfStripe}, {shorter, longer})[0], 1, 0.02);
  EXPECT_NEAR(pyramid.mean({0.5f, middleOfStripe}, {{0, 16.0f / 64}, shorter})[0], 0.5, 0.1);
}

TEST(TexturePyramid, OddFootprintsGiveNumbers) {
  const TexturePyramid pyramid(ramp(5, 3));
  const float huge = 1e38f, none = std::nanf("");
  for (const float odd : {huge, -huge, none, std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE(std::isfinite(pyramid.mean({odd, 0.5f}, kPoint)[0])) << odd;
    EXPECT_TRUE(std::isfinite(pyramid.mean({0.5f, 0.5f}, {{odd, 0}, {0, odd}})[0])) << odd;
    EXPECT_TRUE(std::isfinite(pyramid.mean({0.5f, 0.5f}, {{odd, 0}, {0, 0.1f}})[0])) << odd;
  }
}

constexpr RenderSettings kSettings{0, 16, 0, 0.5, 0};

float lit(const Scene& scene, int x, int y, std::size_t channel, Direction light = {}) {
  const Renderer renderer(scene, kSettings);
  std::vector<float> samples(3);
  renderer.render(frontalView(10), {x, y, 1, 1}, std::vector<RenderLight>{{light, 0}}, samples);
  return samples[channel];
}

// A square that fills the picture.
Scene square(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  scene.meshes.push_back(rectangleMesh(2, 2));
  return scene;
}

TEST(Texture, LiesUprightOnASurface) {
  Scene scene = square(mattMaterial({1, 1, 1}));
  scene.textures.push_back(ramp(64, 64));
  scene.materials[0].baseColourTexture = 0;
  for (const int at : {1, 4, 8}) {
    EXPECT_NEAR(lit(scene, at, 5, 0), (at + 0.5) / 10, 0.01) << "red at column " << at;
    EXPECT_NEAR(lit(scene, 5, at, 1), 1 - (at + 0.5) / 10, 0.01) << "green at row " << at;
  }
}

TEST(Texture, FineChecksAreGreyFromFarOff) {
  Scene scene = square(mattMaterial({1, 1, 1}));
  scene.textures.push_back(texture({512, 512}, 1));
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) scene.textures[0].texels.at(x, y, 0) = (x + y) % 2 ? 1.0f : 0.0f;
  }
  scene.materials[0].baseColourTexture = 0;
  EXPECT_NEAR(lit(scene, 3, 4, 0), 0.5, 0.01);
}

TEST(Texture, RoughnessInGreenAndMetalInBlue) {
  Material metal;
  metal.baseColour = {1, 0, 0};
  metal.metallic = 1;
  metal.roughness = 1;
  Scene scene = square(metal);
  scene.textures.push_back(texture({64, 1}, 3));
  for (int x = 0; x < 64; ++x) {  // left: rough, no metal; right: half as rough, metal
    scene.textures[0].texels.at(x, 0, 1) = x < 32 ? 1 : 0.5f;
    scene.textures[0].texels.at(x, 0, 2) = x < 32 ? 0 : 1;
  }
  scene.materials[0].metallicRoughnessTexture = 0;
  Scene plain = square(metal);
  plain.materials[0].roughness = 0.5f;
  EXPECT_NEAR(lit(scene, 7, 5, 0), lit(plain, 7, 5, 0), 0.01 * lit(plain, 7, 5, 0));
  plain.materials[0].roughness = 1;
  plain.materials[0].metallic = 0;
  EXPECT_NEAR(lit(scene, 2, 5, 0), lit(plain, 2, 5, 0), 0.01 * lit(plain, 2, 5, 0));
}

// glTF: x along u, y along v.
TEST(Texture, NormalMapsTiltTheNormal) {
  Scene scene = square(mattMaterial({1, 1, 1}));
  scene.textures.push_back(texture({1, 1}, 3));
  scene.materials[0].normalTexture = 0;
  const Direction tilted = Direction::fromVector({0.3, 0.4, 0.8});
  const double axes[] = {tilted.x(), tilted.y(), tilted.z()};
  for (std::size_t c = 0; c < 3; ++c) {
    scene.textures[0].texels.samples()[c] = static_cast<float>(axes[c] * 0.5 + 0.5);
  }
  for (const Vector3 toward :
       {Vector3{0, 0, 1}, Vector3{1, 0, 1}, Vector3{0, 1, 1}, Vector3{-1, -1, 1}}) {
    const Direction light = Direction::fromVector(toward);
    const double expected = std::max(0.0, dot(tilted.vector(), light.vector()));
    EXPECT_NEAR(lit(scene, 5, 5, 0, light), expected, 1e-4);
  }
}

TEST(Texture, HolesAreSeenThroughAndLetLightThrough) {
  Scene scene = square(mattMaterial({1, 1, 1}));
  scene.materials.push_back(mattMaterial({0.5f, 0.5f, 0.5f}));
  scene.materials[1].baseColourTexture = 0;
  scene.materials[1].alphaCutoff = 0.5f;
  scene.textures.push_back(texture({2, 1}, 4));
  // Opaque to the left, a hole to the right.
  const float texels[] = {1, 1, 1, 1, 1, 1, 1, 0};
  std::copy_n(texels, 8, scene.textures[0].texels.samples().begin());
  TriangleMesh screen = rectangleMesh(2, 2);
  transform(screen, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0.5}});
  screen.material = 1;
  scene.meshes.push_back(screen);
  EXPECT_NEAR(lit(scene, 2, 5, 0), 0.5, 1e-4) << "the screen";
  EXPECT_NEAR(lit(scene, 7, 5, 0), 1, 1e-4) << "what is behind it";
  // Seen through the hole, light from the right comes past it, light from the left does not.
  const Direction left = Direction::fromVector({-1.2, 0, 0.5}),
                  through = Direction::fromVector({0.2, 0, 0.5});
  EXPECT_EQ(lit(scene, 7, 5, 0, left), 0);
  EXPECT_NEAR(lit(scene, 7, 5, 0, through), through.z(), 1e-4);
}

TEST(Texture, VertexColoursTint) {
  Scene scene = square(mattMaterial({0.5f, 1, 1}));
  scene.meshes[0].colours.assign(scene.meshes[0].positions.size(), {1, 0.25f, 2});
  EXPECT_NEAR(lit(scene, 5, 5, 0), 0.5, 1e-5);
  EXPECT_NEAR(lit(scene, 5, 5, 1), 0.25, 1e-5);
  EXPECT_NEAR(lit(scene, 5, 5, 2), 1, 1e-5) << "never more than 1";
}

}  // namespace
}  // namespace illum
