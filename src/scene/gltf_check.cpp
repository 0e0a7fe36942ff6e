#include "scene/gltf_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "illum/error.h"
#include "scene/gltf_fields.h"
#include "scene/gltf_forms.h"
#include "scene/gltf_material_check.h"
#include "scene/uri.h"

namespace illum {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 40;
constexpr std::uint64_t kMaxCount = 0xFFFFFFFF;
/// Of an accessor whose elements are all zero and take no bytes of the file.
constexpr std::uint64_t kMaxZeros = std::uint64_t{1} << 20;
/// Deeper than any skeleton; assimp goes down a tree by recursion.
constexpr std::size_t kDeepest = 1000;

constexpr std::array<std::pair<std::string_view, std::uint64_t>, 7> kComponents{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

using gltf::kFloat, gltf::kUnsignedByte, gltf::kUnsignedShort, gltf::kUnsignedInt;

/// What is understood of an attribute, by the beginning of its name.
struct AttributeForm {
  std::string_view name;
  std::vector<std::string_view> types;
  std::vector<std::uint64_t> components;
};
constexpr std::string_view kTexcoord = "TEXCOORD";
const std::array<AttributeForm, 7> kAttributes{{
    {"POSITION", {"VEC3"}, {kFloat}},
    {"NORMAL", {"VEC3"}, {kFloat}},
    {"TANGENT", {"VEC4", "VEC3"}, {kFloat}},  // of three numbers in morph targets
    {kTexcoord, {"VEC2"}, {kFloat, kUnsignedByte, kUnsignedShort}},
    {"COLOR", {"VEC3", "VEC4"}, {kFloat, kUnsignedByte, kUnsignedShort}},
    {"JOINTS", {"VEC4"}, {kUnsignedByte, kUnsignedShort}},
    {"WEIGHTS", {"VEC4"}, {kFloat, kUnsignedByte, kUnsignedShort}},
}};

class GltfChecker : private GltfFields {
 public:
  GltfChecker(const Json& root, std::uint64_t binaryBytes, const std::string& source)
      : GltfFields(source), root_(root), binaryBytes_(binaryBytes) {}

  GltfMeshes meshes() {
    checkBuffers();
    checkViews();
    checkAccessors();
    checkGltfMaterials(root_, views_.size(), source());
    checkMeshes();
    checkNodes();
    return {checkScenes(), packedTexcoords_};
  }

 private:
  void checkBuffers() {
    for (const Place& buffer : records(root_, "buffers")) {
      const std::uint64_t bytes = whole(buffer, "byteLength", 1, kMaxBytes);
      const Json* uri = fieldOf(buffer.record, "uri");
      if (uri == nullptr && bytes > binaryBytes_)
        fail(buffer.path + ".byteLength",
             fmt::format("at most the {} bytes that a binary file holds", binaryBytes_),
             fieldOf(buffer.record, "byteLength"));
      if (uri != nullptr) checkUri(*uri, buffer.path + ".uri");
      buffers_.push_back(bytes);
    }
  }
  void checkUri(const Json& uri, const std::string& field) const {
    const bool stays = uri.is_string() && (uri.get_ref<const std::string&>().starts_with("data:") ||
                                           staysBelow(uri.get_ref<const std::string&>()));
    if (!stays) fail(field, "data, or the name of a file in this one's folder or below", &uri);
  }

  struct BufferView {
    std::uint64_t bytes = 0, stride = 0;
  };
  void checkViews() {
    for (const Place& view : records(root_, "bufferViews")) {
      const std::uint64_t buffer = buffers_[index(view, "buffer", buffers_.size())];
      const std::uint64_t offset = whole(view, "byteOffset", 0, buffer, 0);
      const std::uint64_t bytes = whole(view, "byteLength", 1, buffer - offset);
      views_.push_back({bytes, whole(view, "byteStride", 4, 252, 0)});
    }
  }

  /// That `count` elements of so many bytes lie within the view that the record names.
  void checkWithin(const Place& place, std::uint64_t count, std::uint64_t elementBytes) const {
    const BufferView& view = views_[index(place, "bufferView", views_.size())];
    const std::uint64_t stride = view.stride > 0 ? view.stride : elementBytes;
    const std::uint64_t offset = whole(place, "byteOffset", 0, view.bytes, 0);
    if (offset + stride * (count - 1) + elementBytes > view.bytes)
      throw Error(Fault::Input,
                  fmt::format("{}: field '{}': expected elements within the {} bytes of their "
                              "view, found {} of {} bytes",
                              source(), place.path, view.bytes, count, elementBytes));
  }
  std::uint64_t componentBytes(const Place& place) const {
    const std::uint64_t type = whole(place, "componentType", 5120, 5126);
    const std::uint64_t bytes = gltf::bytesOfComponent(type);
    if (bytes == 0)
      fail(place.path + ".componentType", "a type of glTF 2",
           fieldOf(place.record, "componentType"));
    return bytes;
  }
  std::uint64_t components(const Place& place) const {
    const Json* type = fieldOf(place.record, "type");
    for (const auto& [name, count] : kComponents)
      if (type != nullptr && *type == name) return count;
    fail(place.path + ".type", "a type of glTF 2", type);
  }

  struct Accessor {
    std::uint64_t count = 0;
    std::string type;
    std::uint64_t component = 0;
    bool normalized = false;
  };
  void checkAccessors() {
    for (const Place& accessor : records(root_, "accessors")) {
      const std::uint64_t bytes = componentBytes(accessor) * components(accessor);
      const bool held = accessor.record.contains("bufferView");
      const std::uint64_t count = whole(accessor, "count", 1, held ? kMaxCount : kMaxZeros);
      if (held) checkWithin(accessor, count, bytes);
      if (accessor.record.contains("sparse")) {
        const Place sparse = record(accessor, "sparse");
        const std::uint64_t changed = whole(sparse, "count", 1, count);
        const Place indices = record(sparse, "indices");
        checkWithin(indices, changed, componentBytes(indices));
        checkWithin(record(sparse, "values"), changed, bytes);
      }
      accessors_.push_back({count, accessor.record["type"].get<std::string>(),
                            whole(accessor, "componentType", 0, kFloat),
                            flag(accessor, "normalized")});
    }
  }

  void checkMeshes() {
    for (const Place& mesh : records(root_, "meshes")) {
      triangles_.push_back(0);
      for (const Place& primitive : records(mesh.record, "primitives", mesh.path + "."))
        triangles_.back() += trianglesOf(primitive);
    }
  }
  std::uint64_t trianglesOf(const Place& primitive) {
    constexpr std::uint64_t kTriangles = 4, kMostModes = 6;
    const std::uint64_t mode = whole(primitive, "mode", 0, kMostModes, kTriangles);
    maybeIndex(primitive, "material", list(root_, "materials", "").size());
    const Place attributes = record(primitive, "attributes");
    const std::optional<std::uint64_t> vertices = verticesOf(attributes, {});
    for (const Place& target : records(primitive.record, "targets", primitive.path + "."))
      verticesOf(target, vertices);
    for (const auto& [name, number] : attributes.record.items())
      if (name.starts_with(kTexcoord)) noteTexcoords(number, attributes.path + "." + name);
    const std::optional<std::size_t> indices = maybeIndex(primitive, "indices", accessors_.size());
    if (indices)
      checkForm(accessors_[*indices],
                {"", {"SCALAR"}, {kUnsignedByte, kUnsignedShort, kUnsignedInt}},
                primitive.path + ".indices");
    if (mode < kTriangles || !attributes.record.contains("POSITION")) return 0;
    const std::uint64_t count = indices ? accessors_[*indices].count : *vertices;
    if (count < 3) fail(primitive.path, "at least three corners", nullptr);
    return mode == kTriangles ? count / 3 : count - 2;
  }

  /// Of all attributes, which have as many; nothing if there are none.
  std::optional<std::uint64_t> verticesOf(const Place& attributes,
                                          std::optional<std::uint64_t> vertices) const {
    for (const auto& [name, number] : attributes.record.items()) {
      const std::string field = attributes.path + "." + name;
      checkIndex(number, field, accessors_.size());
      const Accessor& accessor = accessors_[number.get<std::size_t>()];
      if (!vertices) vertices = accessor.count;
      if (accessor.count != *vertices)
        failForm(field, fmt::format("{} elements as other attributes have", *vertices), accessor);
      for (const AttributeForm& form : kAttributes)
        if (name.starts_with(form.name)) checkForm(accessor, form, field);
    }
    return vertices;
  }
  void noteTexcoords(const Json& number, const std::string& field) {
    const Accessor& accessor = accessors_[number.get<std::size_t>()];
    if (accessor.component == kFloat) return;
    if (!accessor.normalized)
      failForm(field, "an accessor of floats, or one that is normalized", accessor);
    packedTexcoords_ = true;
  }
  void checkForm(const Accessor& accessor, const AttributeForm& form,
                 const std::string& field) const {
    if (std::ranges::find(form.types, accessor.type) == form.types.end() ||
        std::ranges::find(form.components, accessor.component) == form.components.end())
      failForm(field,
               fmt::format("an accessor of type {} and of component type {}",
                           fmt::join(form.types, " or "), fmt::join(form.components, " or ")),
               accessor);
  }
  [[noreturn]] void failForm(const std::string& field, const std::string& expected,
                             const Accessor& found) const {
    throw Error(Fault::Input,
                fmt::format("{}: field '{}': expected {}, found {} of type {} and of component "
                            "type {}",
                            source(), field, expected, found.count, found.type, found.component));
  }

  void checkNodes() {
    const std::vector<Place> nodes = records(root_, "nodes");
    nodes_.resize(nodes.size());
    std::vector<bool> hasParent(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      checkPlacement(nodes[i]);
      nodes_[i].mesh = maybeIndex(nodes[i], "mesh", triangles_.size());
      for (const Json& child : list(nodes[i].record, "children", nodes[i].path + ".")) {
        checkIndex(child, nodes[i].path + ".children", nodes.size());
        const auto at = child.get<std::size_t>();
        if (hasParent[at])
          fail(nodes[i].path + ".children", "nodes that no other node has as its child", &child);
        hasParent[at] = true;
        nodes_[i].children.push_back(at);
      }
    }
    checkTrees(hasParent);
  }
  void checkPlacement(const Place& node) const {
    constexpr std::array<std::pair<const char*, std::size_t>, 4> kFields{
        {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
    for (const auto& [name, count] : kFields) {
      const Json* found = fieldOf(node.record, name);
      if (found == nullptr) continue;
      const bool numbers = found->is_array() && found->size() == count &&
                           std::ranges::all_of(*found, [](const Json& x) { return x.is_number(); });
      if (!numbers) fail(node.path + "." + name, fmt::format("{} numbers", count), found);
    }
  }
  /// No node has two parents, so that those in a circle are never reached from the roots.
  void checkTrees(const std::vector<bool>& hasParent) const {
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (!hasParent[i]) roots.push_back(i);
    std::size_t reached = 0;
    goDown(roots, [&](std::size_t) { ++reached; });
    if (reached < nodes_.size())
      throw Error(Fault::Input,
                  fmt::format("{}: field 'nodes': expected trees, found a node that is a child of "
                              "its own",
                              source()));
  }
  /// Calls use(node) for these nodes and all below them, a level at a time.
  template <typename Use>
  void goDown(std::vector<std::size_t> level, Use use) const {
    std::vector<std::size_t> below;
    for (std::size_t depth = 0; !level.empty(); ++depth) {
      if (depth >= kDeepest)
        throw Error(Fault::Input, fmt::format("{}: field 'nodes': expected trees of at most {} "
                                              "levels, found deeper ones",
                                              source(), kDeepest));
      below.clear();
      for (const std::size_t node : level) {
        use(node);
        below.insert(below.end(), nodes_[node].children.begin(), nodes_[node].children.end());
      }
      level.swap(below);
    }
  }

  /// The triangles of the meshes of the scene that is shown, each mesh counted once.
  std::uint64_t checkScenes() const {
    const std::vector<Place> scenes = records(root_, "scenes");
    std::size_t shown = 0;
    if (const Json* scene = fieldOf(root_, "scene")) {
      checkIndex(*scene, "scene", scenes.size());
      shown = scene->get<std::size_t>();
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      std::set<std::size_t> named;
      for (const Json& node : list(scenes[i].record, "nodes", scenes[i].path + ".")) {
        checkIndex(node, scenes[i].path + ".nodes", nodes_.size());
        if (!named.insert(node.get<std::size_t>()).second)
          fail(scenes[i].path + ".nodes", "each node once", &node);
        if (i == shown) roots.push_back(node.get<std::size_t>());
      }
    }
    std::set<std::size_t> meshes;
    goDown(std::move(roots), [&](std::size_t node) {
      if (nodes_[node].mesh) meshes.insert(*nodes_[node].mesh);
    });
    std::uint64_t triangles = 0;
    for (const std::size_t mesh : meshes) triangles += triangles_[mesh];
    return triangles;
  }

  struct Node {
    std::optional<std::size_t> mesh;
    std::vector<std::size_t> children;
  };
  const Json& root_;
  std::uint64_t binaryBytes_;
  std::vector<std::uint64_t> buffers_;  // bytes
  std::vector<BufferView> views_;
  std::vector<Accessor> accessors_;
  std::vector<std::uint64_t> triangles_;  // of meshes
  std::vector<Node> nodes_;
  bool packedTexcoords_ = false;
};

}  // namespace

GltfMeshes checkedGltf(const Json& root, std::uint64_t binaryBytes, const std::string& source) {
  return GltfChecker(root, binaryBytes, source).meshes();
}

}  // namespace illum
