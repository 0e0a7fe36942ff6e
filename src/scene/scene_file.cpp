#include "scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/files.h"
#include "illum/error.h"
#include "scene/capture_cost.h"
#include "scene/hair_file.h"
#include "scene/mesh_check.h"
#include "scene/mesh_file.h"
#include "scene/placement.h"
#include "scene/scene_text.h"
#include "scene/shapes.h"
#include "scene/teapot.h"
#include "scene/texture_file.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxHairFileBytes = std::uint64_t{1} << 30;

TriangleMesh shapeMesh(Shape shape) {
  switch (shape) {
    case Shape::Box:
      return boxMesh({2, 2, 2});
    case Shape::Rectangle:
      return rectangleMesh(2, 2);
    case Shape::Sphere:
      return sphereMesh(96);
    case Shape::Teapot:
      break;
  }
  return unitTeapotMesh();
}

/// Makes a scene of a description, reading what it names.
class SceneReader {
 public:
  SceneReader(const fs::path& file, const SceneDescription& description, Progress& progress)
      : file_(file), description_(description), progress_(progress) {}

  Scene read() {
    progress_.begin("reading the scene", description_.meshes.size() + description_.hair.size());
    for (const auto& [name, record] : description_.materials) addMaterial(name, record);
    for (const MeshRecord& mesh : description_.meshes) {
      addMesh(mesh);
      progress_.advance();
    }
    for (const HairRecord& hair : description_.hair) {
      addHair(hair);
      progress_.advance();
    }
    progress_.end();
    return std::move(scene_);
  }

 private:
  fs::path beside(const std::string& name) const { return file_.parent_path() / name; }

  void addMaterial(const std::string& name, const MaterialRecord& record) {
    Material material = record.material;
    material.name = name;
    material.baseColourTexture = textureOf(record.baseColourTexture, TextureUse::Colour);
    material.metallicRoughnessTexture =
        textureOf(record.metallicRoughnessTexture, TextureUse::Data);
    material.normalTexture = textureOf(record.normalTexture, TextureUse::Data);
    materials_[name] = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
  }
  int textureOf(const std::optional<std::string>& name, TextureUse use) {
    if (!name) return -1;
    const auto [known, isNew] =
        textures_.try_emplace({*name, use}, static_cast<int>(scene_.textures.size()));
    if (isNew) scene_.textures.push_back(readTexture(beside(*name), use));
    return known->second;
  }
  /// Of what names no material.
  int plainMaterial(Material::Kind kind) {
    const auto [known, isNew] = plain_.try_emplace(kind, static_cast<int>(scene_.materials.size()));
    if (isNew) {
      Material& material = scene_.materials.emplace_back();
      material.kind = kind;
      material.name = kind == Material::Kind::Hair ? "hair" : "plain";
    }
    return known->second;
  }

  void addMesh(const MeshRecord& record) {
    Scene part;
    if (record.shape) {
      part.meshes = {shapeMesh(*record.shape)};
      part.meshes[0].material = record.material ? materials_.at(*record.material)
                                                : plainMaterial(Material::Kind::Surface);
      part.meshes[0].name = record.name;
    } else {
      std::vector<std::string> remarks;
      part = readMeshFile(beside(*record.file), record.smoothDegrees, remarks);
      for (const std::string& remark : remarks) progress_.remark(remark);
      adoptMaterials(part, record);
    }
    for (TriangleMesh& mesh : part.meshes) {
      place(mesh, record.placement);
      // Placed out of reach, it would be infinite in float.
      std::vector<std::string> known;
      checkMesh(mesh, file_.string(), known);
      scene_.meshes.push_back(std::move(mesh));
    }
  }

  /// Gives the meshes of a file indices into our materials, and takes over its own where nothing
  /// replaces them.
  void adoptMaterials(Scene& part, const MeshRecord& record) {
    const int firstTexture = static_cast<int>(scene_.textures.size());
    std::vector<int> ours(part.materials.size(), -1);
    for (auto& texture : part.textures) scene_.textures.push_back(std::move(texture));
    const auto indexOf = [&](std::size_t theirs) {
      if (record.material) return materials_.at(*record.material);
      Material& material = part.materials[theirs];
      const auto replaced = record.materials.find(material.name);
      if (replaced != record.materials.end()) return materials_.at(replaced->second);
      for (int* index : {&material.baseColourTexture, &material.metallicRoughnessTexture,
                         &material.normalTexture})
        if (*index >= 0) *index += firstTexture;
      scene_.materials.push_back(std::move(material));
      return static_cast<int>(scene_.materials.size()) - 1;
    };
    checkReplaced(part, record);
    for (TriangleMesh& mesh : part.meshes) {
      const auto theirs = static_cast<std::size_t>(mesh.material);
      if (ours.at(theirs) < 0) ours[theirs] = indexOf(theirs);
      mesh.material = ours[theirs];
    }
  }
  void checkReplaced(const Scene& part, const MeshRecord& record) const {
    for (const auto& [theirs, replacement] : record.materials) {
      const bool found = std::ranges::any_of(
          part.materials, [&](const Material& material) { return material.name == theirs; });
      if (!found) {
        std::string names;
        for (const Material& material : part.materials)
          if (names.size() < 200)
            names += fmt::format("{}'{}'", names.empty() ? "" : ", ", material.name);
        throw inputError(beside(*record.file), fmt::format("a material '{}' to replace", theirs),
                         names.empty() ? "none" : names);
      }
    }
  }

  void addHair(const HairRecord& record) {
    CurveSet set;
    set.name = record.name;
    set.material =
        record.material ? materials_.at(*record.material) : plainMaterial(Material::Kind::Hair);
    const auto add = [&](const std::vector<std::vector<Vector3>>& hairs) {
      for (const auto& points : hairs) illum::addHair(set, points, record.radius);
    };
    if (record.file) {
      const fs::path file = beside(*record.file);
      add(hairsFromText(readTextFile(file, kMaxHairFileBytes), file.string()));
    } else {
      add(record.curves);
    }
    place(set, record.placement);
    checkCurves(set, file_.string());
    scene_.curves.push_back(std::move(set));
  }

  const fs::path& file_;
  const SceneDescription& description_;
  Progress& progress_;
  Scene scene_;
  std::map<std::string, int> materials_;
  std::map<std::pair<std::string, TextureUse>, int> textures_;
  std::map<Material::Kind, int> plain_;
};

SceneCapture captureOf(const fs::path& file, const SceneDescription& description,
                       const SceneFileOptions& options, Progress& progress) {
  CapturePlan plan = planOf(description);
  if (description.lights.file) {
    LightFile lights = readLightFile(file.parent_path() / *description.lights.file);
    for (const std::string& remark : lights.remarks) progress.remark(remark);
    for (LightFileEntry& entry : lights.entries) entry.light.intensity = {1, 1, 1};
    plan.lights.lights = std::move(lights.entries);
  }
  apply(options.overrides, plan);
  checkCost(plan, options.maxShadowRays);
  Scene scene = SceneReader(file, description, progress).read();
  if (description.normalise) normalise(scene);
  CaptureSetup setup = captureSetup(plan, scene);
  return {std::move(scene), std::move(setup)};
}

}  // namespace

bool isSceneFile(const fs::path& file) {
  if (isMeshFile(file)) return true;
  std::error_code ignored;
  if (file.extension() != ".json" || !fs::is_regular_file(file, ignored)) return false;
  return readTextFile(file, kMaxSceneTextBytes).find("\"illumScene\"") != std::string::npos;
}

SceneCapture readScene(const fs::path& file, const SceneFileOptions& options, Progress& progress) {
  SceneDescription description;
  if (isMeshFile(file)) {
    MeshRecord& mesh = description.meshes.emplace_back();
    mesh.file = file.filename().string();
    description.normalise = true;
  } else {
    description = sceneFromText(readTextFile(file, kMaxSceneTextBytes), file.string());
  }
  try {
    return captureOf(file, description, options, progress);
  } catch (const Error& error) {
    // What concerns the scene as a whole does not know where it came from.
    const std::string sentence = error.what();
    if (sentence.starts_with("expected") || sentence.starts_with("slab"))
      throw Error(error.fault(), fmt::format("{}: {}", file.string(), sentence));
    throw;
  }
}

}  // namespace illum
