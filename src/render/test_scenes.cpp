#include "render/test_scenes.h"

#include <cmath>
#include <numbers>

#include "scene/shapes.h"

namespace illum {

Material mattMaterial(LinearRgb colour) {
  Material material;
  material.baseColour = colour;
  material.specular = 0;
  return material;
}

TriangleMesh sphereMesh(double radius, Vector3 centre, int material) {
  TriangleMesh mesh = surfaceMesh(
      [&](double u, double v) {
        const double phi = 2 * std::numbers::pi * u, theta = std::numbers::pi * (1 - v);
        return radius * Vector3{std::sin(theta) * std::sin(phi), std::cos(theta),
                                std::sin(theta) * std::cos(phi)};
      },
      192, 96);
  RigidTransform moved;
  moved.translation = centre;
  transform(mesh, moved);
  mesh.material = material;
  return mesh;
}

Scene planeScene(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  scene.meshes.push_back(rectangleMesh(10, 10));
  return scene;
}

Scene sphereScene(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  scene.meshes.push_back(sphereMesh(1, {}));
  return scene;
}

View frontalView(int side) {
  return {"front", OrthographicView{{side, side}}};
}

std::vector<RenderLight> fibonacciLights(int count) {
  std::vector<RenderLight> lights;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    lights.push_back({Direction::fromAngles(std::acos(z), golden * i), i});
  }
  return lights;
}

std::vector<float> renderAll(const Renderer& renderer, const View& view,
                             const std::vector<RenderLight>& lights) {
  const Size size = sizeOf(view.geometry);
  std::vector<float> samples(3 * lights.size() * size.pixels());
  renderer.render(view, {0, 0, size.width, size.height}, lights, samples);
  return samples;
}

double meanOf(const std::vector<float>& samples, std::size_t pixels, std::size_t light,
              std::size_t channel) {
  double sum = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    sum += static_cast<double>(samples[(3 * light + channel) * pixels + p]);
  }
  return sum / static_cast<double>(pixels);
}

std::vector<float> underWhiteSky(const std::vector<float>& samples, std::size_t pixels,
                                 std::size_t lights) {
  std::vector<float> sum(3 * pixels);
  for (std::size_t l = 0; l < lights; ++l) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += samples[l * sum.size() + i] * 4 / static_cast<float>(lights);
    }
  }
  return sum;
}

double referenceMicrofacets(double alpha, double facing, double grazing, Float3 toViewer,
                            Float3 toLight) {
  const Vector3 v = vector3(toViewer), l = vector3(toLight), sum = v + l;
  const Vector3 h = (1 / length(sum)) * sum;
  const double a2 = alpha * alpha;
  // Walter et al. 2007, equation 33.
  const double d = a2 / (std::numbers::pi * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
  // Heitz 2014, equations 72 and 99.
  const auto lambda = [&](double c) { return (std::sqrt(1 + a2 * (1 / (c * c) - 1)) - 1) / 2; };
  const double g = 1 / (1 + lambda(v.z) + lambda(l.z));
  const double f = facing + (grazing - facing) * std::pow(1 - dot(v, h), 5);
  return d * g * f / (4 * v.z * l.z);
}

}  // namespace illum
