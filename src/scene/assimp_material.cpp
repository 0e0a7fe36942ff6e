#include "scene/assimp_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "illum/error.h"
#include "scene/texture_file.h"
#include "scene/uri.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

/// Where a texture of that name lies: as named, beside the mesh file, or there without its folders
/// (exporters leave the author's own in the name).
std::optional<fs::path> findTexture(const fs::path& meshFile, std::string name) {
  std::ranges::replace(name, '\\', '/');
  const fs::path folder = meshFile.parent_path();
  for (const std::string& spelling : {name, unescaped(name)}) {
    for (const fs::path& candidate : {folder / spelling, folder / fs::path(spelling).filename()}) {
      std::error_code ignored;
      if (fs::is_regular_file(candidate, ignored)) return candidate;
    }
  }
  return std::nullopt;
}

/// Eight-bit texels that are not in a picture format of their own.
Texture rawTexture(const aiTexture& from, const std::string& name, TextureUse use) {
  Texture texture{name,
                  Picture({static_cast<int>(from.mWidth), static_cast<int>(from.mHeight)}, 4)};
  const auto value = [&](unsigned char byte) {
    const float unit = static_cast<float>(byte) / 255;
    return use == TextureUse::Colour ? linearFromDisplay(unit) : unit;
  };
  float* to = texture.texels.samples().data();
  for (std::size_t i = 0; i < texture.texels.size().pixels(); ++i, to += 4) {
    const aiTexel& texel = from.pcData[i];
    to[0] = value(texel.r), to[1] = value(texel.g), to[2] = value(texel.b);
    to[3] = static_cast<float>(texel.a) / 255;
  }
  return texture;
}

class MaterialReader {
 public:
  MaterialReader(const aiScene& from, const fs::path& file, Scene& scene,
                 std::vector<std::string>& remarks)
      : from_(from), file_(file), scene_(scene), remarks_(remarks) {}

  void add(const aiMaterial& from) {
    Material material;
    material.name = from.GetName().C_Str();
    title_ = fmt::format("{}: material '{}'", file_.string(), material.name);
    addColours(from, material);
    addTextures(from, material);
    addTransparency(from, material);
    remarkOnTheRest(from);
    scene_.materials.push_back(std::move(material));
  }

 private:
  void remark(const std::string& sentence) {
    remarks_.push_back(fmt::format("{} {}", title_, sentence));
  }
  float finite(const char* name, float value) const {
    if (std::isfinite(value)) return value;
    throw Error(Fault::Input,
                fmt::format("{}: expected a number as its {}, found {}", title_, name, value));
  }
  /// Between 0 and 1, with a word if it was not.
  float unit(const char* name, float value) {
    constexpr float kRounding = 1e-5F;
    const float bounded = std::clamp(finite(name, value), 0.0F, 1.0F);
    if (std::abs(bounded - value) > kRounding)
      remark(fmt::format("has {} as its {}; {} is taken", value, name, bounded));
    return bounded;
  }

  void addColours(const aiMaterial& from, Material& material) {
    aiColor3D base(0.8F, 0.8F, 0.8F);
    if (from.Get(AI_MATKEY_BASE_COLOR, base) != AI_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, base);
    constexpr const char* kBase = "base colour";
    material.baseColour = {unit(kBase, base.r), unit(kBase, base.g), unit(kBase, base.b)};
    float metallic = 0, roughness = 1;
    const bool physical = from.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS;
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) != AI_SUCCESS && !physical)
      roughness = phongRoughness(from, material);
    material.metallic = unit("metallic factor", metallic);
    material.roughness = unit("roughness", roughness);
  }
  /// Phong's exponent n and Beckmann's alpha: n = 2 / alpha^2 - 2 (Walter et al. 2007,
  /// section 5.2).
  float phongRoughness(const aiMaterial& from, Material& material) const {
    float exponent = 0;
    aiColor3D highlight(0, 0, 0);
    from.Get(AI_MATKEY_COLOR_SPECULAR, highlight);
    for (const float value : {highlight.r, highlight.g, highlight.b}) finite("highlight", value);
    if (from.Get(AI_MATKEY_SHININESS, exponent) != AI_SUCCESS ||
        finite("shininess", exponent) <= 0 || highlight.IsBlack()) {
      material.specular = 0;
      return 1;
    }
    return std::pow(2 / (exponent + 2), 0.25F);
  }

  void addTextures(const aiMaterial& from, Material& material) {
    material.baseColourTexture = textureOf(from, aiTextureType_BASE_COLOR, TextureUse::Colour);
    if (material.baseColourTexture < 0)
      material.baseColourTexture = textureOf(from, aiTextureType_DIFFUSE, TextureUse::Colour);
    material.metallicRoughnessTexture = textureOf(from, aiTextureType_UNKNOWN, TextureUse::Data);
    material.normalTexture = textureOf(from, aiTextureType_NORMALS, TextureUse::Data);
  }
  int textureOf(const aiMaterial& from, aiTextureType type, TextureUse use) {
    aiString name;
    if (from.GetTexture(type, 0, &name) != AI_SUCCESS || name.length == 0) return -1;
    int set = 0;
    if (from.Get(AI_MATKEY_UVWSRC(type, 0), set) == AI_SUCCESS && set != 0)
      remark("has a texture on another set of texture coordinates; it is laid by the first");
    aiUVTransform moved;
    if (from.Get(AI_MATKEY_UVTRANSFORM(type, 0), moved) == AI_SUCCESS)
      remark("moves a texture; it is laid where it would be unmoved");
    int wrap = aiTextureMapMode_Wrap;
    if (from.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), wrap) == AI_SUCCESS &&
        wrap != aiTextureMapMode_Wrap)
      remark("does not repeat a texture; here it repeats");
    return loaded(name.C_Str(), use);
  }
  int loaded(const std::string& name, TextureUse use) {
    const auto key = std::pair(name, use);
    if (const auto known = indices_.find(key); known != indices_.end()) return known->second;
    int index = -1;
    if (const std::optional<Texture> texture = load(name, use)) {
      index = static_cast<int>(scene_.textures.size());
      scene_.textures.push_back(*texture);
    }
    return indices_[key] = index;
  }
  std::optional<Texture> load(const std::string& name, TextureUse use) {
    if (const aiTexture* held = from_.GetEmbeddedTexture(name.c_str())) {
      const std::string title = fmt::format("{}: texture '{}'", file_.string(), name);
      if (held->mHeight > 0) return rawTexture(*held, title, use);
      return textureFromBytes(
          {reinterpret_cast<const std::byte*>(held->pcData), std::size_t{held->mWidth}}, title,
          use);
    }
    if (const std::optional<fs::path> found = findTexture(file_, name))
      return readTexture(*found, use);
    remark(fmt::format("names the texture '{}', which is not there; it is shown without", name));
    return std::nullopt;
  }

  void addTransparency(const aiMaterial& from, Material& material) {
    float transmission = 0, ior = 1.5F;
    from.Get(AI_MATKEY_TRANSMISSION_FACTOR, transmission);
    if (from.Get(AI_MATKEY_REFRACTI, ior) == AI_SUCCESS) {
      finite("index of refraction", ior);
      if (ior >= 1 && ior <= 4)
        material.ior = ior;
      else
        remark(fmt::format("has {} as its index of refraction; {} is taken", ior, material.ior));
    }
    if (transmission >= 0.5F) {
      material.kind = Material::Kind::Glass;
      remark("transmits light; it is shown as clear glass");
    } else if (transmission > 0) {
      remark("transmits a part of the light; it is shown opaque");
    }
    aiString mode;
    if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS) {
      addAlpha(from, mode.C_Str(), material);
      return;
    }
    float opacity = 1;
    from.Get(AI_MATKEY_OPACITY, opacity);
    if (finite("opacity", opacity) < 1)
      remark(fmt::format("has an opacity of {}; it is shown opaque", opacity));
  }
  void addAlpha(const aiMaterial& from, const std::string& mode, Material& material) {
    float cutoff = 0.5F;
    from.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
    if (mode == "MASK") material.alphaCutoff = unit("alpha cutoff", cutoff);
    if (mode == "BLEND") {
      material.alphaCutoff = 0.5F;
      remark("blends with what is behind it; where its alpha is below 0.5 there are holes instead");
    }
  }

  void remarkOnTheRest(const aiMaterial& from) {
    aiColor3D emissive(0, 0, 0);
    from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
    if (!emissive.IsBlack() || from.GetTextureCount(aiTextureType_EMISSIVE) > 0)
      remark("emits light, which no reflectance holds; it is shown without");
    const std::pair<aiTextureType, const char*> kinds[] = {
        {aiTextureType_SPECULAR, "specular"},
        {aiTextureType_HEIGHT, "height"},
        {aiTextureType_OPACITY, "opacity"},
        {aiTextureType_DISPLACEMENT, "displacement"},
        {aiTextureType_METALNESS, "metalness"},
        {aiTextureType_SHININESS, "shininess"},
        {aiTextureType_DIFFUSE_ROUGHNESS, "roughness"}};
    for (const auto& [type, name] : kinds) {
      // glTF's one texture of both stands under these two names as well.
      const bool both = type == aiTextureType_METALNESS || type == aiTextureType_DIFFUSE_ROUGHNESS;
      if (both && from.GetTextureCount(aiTextureType_UNKNOWN) > 0) continue;
      if (from.GetTextureCount(type) > 0)
        remark(fmt::format("has a {} texture, which is not supported", name));
    }
  }

  const aiScene& from_;
  const fs::path& file_;
  Scene& scene_;
  std::vector<std::string>& remarks_;
  std::string title_;
  std::map<std::pair<std::string, TextureUse>, int> indices_;
};

}  // namespace

void addMaterials(const aiScene& from, const fs::path& file, Scene& scene,
                  std::vector<std::string>& remarks) {
  MaterialReader reader(from, file, scene, remarks);
  for (unsigned i = 0; i < from.mNumMaterials; ++i) reader.add(*from.mMaterials[i]);
  if (from.mNumMaterials == 0) scene.materials.emplace_back();
}

}  // namespace illum
