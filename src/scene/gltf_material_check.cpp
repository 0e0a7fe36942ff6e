#include "scene/gltf_material_check.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/gltf_fields.h"

namespace illum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class GltfMaterialChecker : private GltfFields {
 public:
  GltfMaterialChecker(const Json& root, std::size_t views, const std::string& source)
      : GltfFields(source), root_(root), views_(views) {}

  void check() {
    for (const Place& image : records(root_, "images")) checkImage(image);
    for (const Place& sampler : records(root_, "samplers")) checkSampler(sampler);
    for (const Place& texture : records(root_, "textures")) {
      maybeIndex(texture, "source", countOf("images"));
      maybeIndex(texture, "sampler", countOf("samplers"));
    }
    for (const Place& material : records(root_, "materials")) checkMaterial(material);
  }

 private:
  std::size_t countOf(const char* name) const { return list(root_, name, "").size(); }

  void checkImage(const Place& image) const {
    const Json* uri = fieldOf(image.record, "uri");
    if (uri != nullptr && !uri->is_string()) fail(image.path + ".uri", "data or a name", uri);
    maybeIndex(image, "bufferView", views_);
  }
  void checkSampler(const Place& sampler) const {
    constexpr std::array<std::uint64_t, 3> kClampMirrorRepeat{33071, 33648, 10497};
    for (const char* wrap : {"wrapS", "wrapT"}) {
      const std::uint64_t found = whole(sampler, wrap, 0, 0xFFFF, kClampMirrorRepeat.back());
      if (std::ranges::find(kClampMirrorRepeat, found) == kClampMirrorRepeat.end())
        fail(sampler.path + "." + wrap, "33071, 33648 or 10497", fieldOf(sampler.record, wrap));
    }
  }

  void checkMaterial(const Place& material) const {
    checkNumbers(material, "emissiveFactor", 3, 0, kInfinity);
    checkNumbers(material, "alphaCutoff", 1, 0, kInfinity);
    checkTextures(material, {"normalTexture", "occlusionTexture", "emissiveTexture"});
    constexpr std::array<const char*, 3> kModes{"OPAQUE", "MASK", "BLEND"};
    const Json* mode = fieldOf(material.record, "alphaMode");
    if (mode != nullptr && std::ranges::find(kModes, *mode) == kModes.end())
      fail(material.path + ".alphaMode", "OPAQUE, MASK or BLEND", mode);
    if (material.record.contains("pbrMetallicRoughness"))
      checkMetallicRoughness(record(material, "pbrMetallicRoughness"));
    if (material.record.contains("extensions")) checkExtensions(record(material, "extensions"));
  }
  void checkMetallicRoughness(const Place& place) const {
    checkNumbers(place, "baseColorFactor", 4, 0, 1);
    checkNumbers(place, "metallicFactor", 1, 0, 1);
    checkNumbers(place, "roughnessFactor", 1, 0, 1);
    checkTextures(place, {"baseColorTexture", "metallicRoughnessTexture"});
  }
  void checkExtensions(const Place& extensions) const {
    const auto check = [&](const char* name, const auto& fields) {
      if (extensions.record.contains(name)) fields(record(extensions, name));
    };
    check("KHR_materials_transmission", [&](const Place& place) {
      checkNumbers(place, "transmissionFactor", 1, 0, 1);
      checkTextures(place, {"transmissionTexture"});
    });
    check("KHR_materials_ior",
          [&](const Place& place) { checkNumbers(place, "ior", 1, 0, kInfinity); });
    check("KHR_materials_pbrSpecularGlossiness", [&](const Place& place) {
      checkNumbers(place, "diffuseFactor", 4, 0, 1);
      checkNumbers(place, "specularFactor", 3, 0, 1);
      checkNumbers(place, "glossinessFactor", 1, 0, 1);
      checkTextures(place, {"diffuseTexture", "specularGlossinessTexture"});
    });
  }
  void checkTextures(const Place& place, std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (!place.record.contains(name)) continue;
      const Place texture = record(place, name);
      index(texture, "index", countOf("textures"));
      whole(texture, "texCoord", 0, std::numeric_limits<std::uint32_t>::max(), 0);
      checkNumbers(texture, "scale", 1, -kInfinity, kInfinity);
      checkNumbers(texture, "strength", 1, 0, 1);
    }
  }

  const Json& root_;
  std::size_t views_;
};

}  // namespace

void checkGltfMaterials(const nlohmann::json& root, std::size_t views, const std::string& source) {
  GltfMaterialChecker(root, views, source).check();
}

}  // namespace illum
