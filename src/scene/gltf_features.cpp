#include "scene/gltf_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "illum/error.h"
#include "scene/gltf_container.h"
#include "scene/json_guard.h"

namespace illum {
namespace {

using Json = nlohmann::json;

/// Extensions that are understood, at least by their factors.
constexpr std::array<std::string_view, 4> kKnown{"KHR_materials_unlit",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_transmission", "KHR_materials_ior"};

std::size_t countOf(const Json& root, const char* name) {
  const auto found = root.find(name);
  return found != root.end() && found->is_array() ? found->size() : 0;
}

bool hasMorphTargets(const Json& root) {
  if (countOf(root, "meshes") == 0) return false;
  for (const Json& mesh : root["meshes"]) {
    if (!mesh.is_object() || countOf(mesh, "primitives") == 0) continue;
    for (const Json& primitive : mesh["primitives"])
      if (primitive.is_object() && primitive.contains("targets")) return true;
  }
  return false;
}

/// Extensions of a list that are not known, for messages.
std::vector<std::string> unknownOf(const Json& root, const char* list) {
  std::vector<std::string> unknown;
  if (countOf(root, list) == 0) return unknown;
  for (const Json& name : root[list]) {
    if (!name.is_string()) continue;
    const auto& text = name.get_ref<const std::string&>();
    if (std::ranges::find(kKnown, text) == kKnown.end())
      unknown.push_back(name.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 100));
  }
  return unknown;
}

void checkVersion(const Json& root, const std::string& source) {
  const Json::json_pointer version("/asset/version");
  const bool second = root.is_object() && root.contains(version) && root[version].is_string() &&
                      root[version].get_ref<const std::string&>().starts_with("2");
  if (!second)
    throw Error(Fault::Input,
                fmt::format("{}: expected glTF 2, found another version or none", source));
}

}  // namespace

GltfFeatures gltfFeatures(std::span<const std::byte> file, const std::string& source) {
  const GltfParts parts = gltfParts(file, source);
  const Json root = guardedJson(parts.json, source);
  checkVersion(root, source);
  const std::vector<std::string> required = unknownOf(root, "extensionsRequired");
  if (!required.empty())
    throw Error(Fault::Input,
                fmt::format("{}: expected a file that can be read without extensions, "
                            "found that it requires {}",
                            source, required.front()));
  GltfFeatures features;
  features.meshes = checkedGltf(root, parts.binary.size(), source);
  std::vector<std::string>& remarks = features.remarks;
  for (const std::string& name : unknownOf(root, "extensionsUsed"))
    remarks.push_back(
        fmt::format("{}: the extension {} is not supported; the file is read without "
                    "it",
                    source, name));
  if (countOf(root, "animations") > 0)
    remarks.push_back(
        fmt::format("{}: animations are not supported; what stands still is shown", source));
  if (countOf(root, "skins") > 0)
    remarks.push_back(fmt::format("{}: skins are not supported; meshes are shown unposed", source));
  if (hasMorphTargets(root))
    remarks.push_back(
        fmt::format("{}: morph targets are not supported; meshes are shown without", source));
  if (countOf(root, "cameras") > 0)
    remarks.push_back(fmt::format("{}: cameras of mesh files are not used", source));
  return features;
}

}  // namespace illum
