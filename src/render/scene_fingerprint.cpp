#include <bit>
#include <cstdio>
#include <span>
#include <type_traits>

#include "render/rendered_capture.h"

namespace illum {
namespace {

// Two sums of 64 bits with different multipliers (after Fowler, Noll, Vo), over whole words. Not
// against people who mean harm: it tells whether work that was begun may be gone on with.
class Fingerprint {
 public:
  void add(std::uint64_t word) {
    first_ = (first_ ^ word) * 0x9e3779b97f4a7c15u;
    first_ ^= first_ >> 29;
    second_ = (std::rotl(second_, 23) + word) * 0xbf58476d1ce4e5b9u;
    second_ ^= second_ >> 31;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
  template <typename Integer>
  requires std::is_integral_v<Integer> || std::is_enum_v<Integer>
  void add(Integer number) { add(static_cast<std::uint64_t>(number)); }
  void add(const std::string& text) {
    add(text.size());
    for (const char c : text) add(c);
  }
  void add(LinearRgb c) { add(c.r), add(c.g), add(c.b); }
  void add(Vector3 v) { add(v.x), add(v.y), add(v.z); }
  template <typename T, std::size_t N>
  void add(const std::array<T, N>& values) {
    for (const T& value : values) add(value);
  }
  template <typename T>
  void add(std::span<const T> values) {
    add(values.size());
    for (const T& value : values) add(value);
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }

  void add(Size size) { add(size.width), add(size.height); }
  void add(const PlaneRectangle& r) { add(r.left), add(r.bottom), add(r.right), add(r.top); }
  void add(const RigidTransform& t) { add(t.rotation), add(t.translation); }
  void add(const OrthographicView& view) { add(view.size); }
  void add(const SlabView& view) {
    const LightSlab& slab = view.slab;
    add(slab.name), add(slab.objectFromSlab), add(slab.distance), add(slab.uv), add(slab.uCount);
    add(slab.vCount), add(slab.st), add(slab.size), add(view.u), add(view.v);
  }
  void add(const PinholeCamera& camera) {
    add(camera.objectFromCamera), add(camera.focalX), add(camera.focalY), add(camera.centre.x);
    add(camera.centre.y), add(camera.size);
  }
  void add(const Panorama& panorama) {
    add(panorama.projection), add(panorama.objectFromCamera), add(panorama.extent);
    add(panorama.size);
  }
  void add(const View& view) {
    add(view.name), add(view.geometry.index());
    std::visit([this](const auto& geometry) { add(geometry); }, view.geometry);
  }

  void add(const Texture& texture) {
    add(texture.texels.size()), add(texture.texels.channels()), add(texture.texels.samples());
  }
  void add(const Material& m) {
    add(m.kind), add(m.baseColour), add(m.metallic), add(m.roughness), add(m.specular), add(m.ior);
    add(m.alphaCutoff), add(m.baseColourTexture), add(m.metallicRoughnessTexture);
    add(m.normalTexture);
  }
  void add(const TriangleMesh& mesh) {
    add(mesh.material), add(mesh.positions), add(mesh.normals), add(mesh.texcoords);
    add(mesh.colours), add(mesh.triangles);
  }
  void add(const CurveSet& curves) {
    add(curves.material), add(curves.points), add(curves.firstPoints), add(curves.colours);
  }
  void add(const LightFileEntry& light) { add(light.name), add(light.light.toLight.vector()); }

  std::string text() const {
    char digits[33];
    std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(first_),
                  static_cast<unsigned long long>(second_));
    return digits;
  }

 private:
  std::uint64_t first_ = 0xcbf29ce484222325u, second_ = 0x84222325cbf29ce4u;
};

}  // namespace

std::string sceneFingerprint(const SceneCapture& capture) {
  Fingerprint hash;
  const auto& [scene, setup] = capture;
  hash.add(scene.textures), hash.add(scene.materials), hash.add(scene.meshes);
  hash.add(scene.curves), hash.add(setup.views), hash.add(setup.lights);
  hash.add(setup.lightRadiusRadians), hash.add(setup.samplesPerPixel), hash.add(setup.bounces);
  hash.add(setup.filterRadius), hash.add(setup.seed);
  return "scene " + hash.text();
}

}  // namespace illum
