#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scene/shapes.h"

namespace illum {
namespace {

Scene planeScene(LinearRgb colour) {
  Scene scene;
  Material matt;
  matt.specular = 0;
  matt.baseColour = colour;
  scene.materials.push_back(matt);
  scene.meshes.push_back(rectangleMesh(10, 10));
  return scene;
}

View frontal(int side) {
  return {"front", OrthographicView{{side, side}}};
}

std::vector<float> rendered(const Renderer& renderer, const View& view,
                            const std::vector<RenderLight>& lights) {
  const Size size = sizeOf(view.geometry);
  std::vector<float> samples(3 * lights.size() * size.pixels());
  renderer.render(view, {0, 0, size.width, size.height}, lights, samples);
  return samples;
}

TEST(Renderer, AMattPlaneFollowsTheCosine) {
  const Renderer renderer(planeScene({1, 0.5f, 0.25f}), {});
  for (const double theta : {0.0, 0.4, 1.0, 1.5, 1.6}) {
    const auto samples = rendered(renderer, frontal(8), {{Direction::fromAngles(theta, 0.7), 3}});
    for (std::size_t p = 0; p < 64; ++p) {
      const double expected = std::max(0.0, std::cos(theta));
      EXPECT_NEAR(samples[p], expected, 1e-5) << "theta " << theta << " pixel " << p;
      EXPECT_NEAR(samples[128 + p], 0.25 * expected, 1e-5) << "theta " << theta;
    }
  }
}

}  // namespace
}  // namespace illum
