#include "scene/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "illum/error.h"
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

constexpr std::array<std::pair<std::uint64_t, std::uint64_t>, 6> kComponentBytes{
    {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}}};
constexpr std::array<std::pair<std::string_view, std::uint64_t>, 7> kComponents{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

/// A record and where it stands, such as accessors[3].
struct Place {
  const Json& record;
  std::string path;
};

class GltfChecker {
 public:
  GltfChecker(const Json& root, std::uint64_t binaryBytes, const std::string& source)
      : root_(root), binaryBytes_(binaryBytes), source_(source) {}

  std::uint64_t triangles() {
    checkBuffers();
    checkViews();
    checkAccessors();
    checkMeshes();
    checkNodes();
    return checkScenes();
  }

 private:
  [[noreturn]] void fail(const std::string& field, std::string_view expected,
                         const Json* found) const {
    const std::string shown =
        found == nullptr ? "none"
                         : found->dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
    throw Error(Fault::Input, fmt::format("{}: field '{}': expected {}, found {}", source_, field,
                                          expected, shown));
  }

  static const Json* fieldOf(const Json& record, const char* name) {
    const auto found = record.find(name);
    return found == record.end() ? nullptr : &*found;
  }

  /// `fallback`: of a field that may be missing.
  std::uint64_t whole(const Place& place, const char* name, std::uint64_t low, std::uint64_t high,
                      std::optional<std::uint64_t> fallback = {}) const {
    const Json* found = fieldOf(place.record, name);
    if (found == nullptr && fallback) return *fallback;
    if (found == nullptr || !found->is_number_unsigned() || found->get<std::uint64_t>() < low ||
        found->get<std::uint64_t>() > high)
      fail(place.path + "." + name, fmt::format("a whole number from {} to {}", low, high), found);
    return found->get<std::uint64_t>();
  }

  /// The number of an entry of a list that has `count`; nothing if the field is missing.
  std::optional<std::size_t> maybeIndex(const Place& place, const char* name,
                                        std::size_t count) const {
    const Json* found = fieldOf(place.record, name);
    if (found == nullptr) return std::nullopt;
    checkIndex(*found, place.path + "." + name, count);
    return found->get<std::size_t>();
  }
  std::size_t index(const Place& place, const char* name, std::size_t count) const {
    const std::optional<std::size_t> found = maybeIndex(place, name, count);
    if (!found) fail(place.path + "." + name, "a number", nullptr);
    return *found;
  }
  void checkIndex(const Json& found, const std::string& field, std::size_t count) const {
    if (!found.is_number_unsigned() || found.get<std::uint64_t>() >= count)
      fail(field, fmt::format("the number of one of {}", count), &found);
  }

  /// A list that may be missing.
  const Json& list(const Json& record, const char* name, const std::string& path) const {
    static const Json kEmpty = Json::array();
    const Json* found = fieldOf(record, name);
    if (found != nullptr && !found->is_array()) fail(path + name, "a list", found);
    return found == nullptr ? kEmpty : *found;
  }
  std::vector<Place> records(const Json& record, const char* name,
                             const std::string& path = "") const {
    std::vector<Place> places;
    for (const Json& entry : list(record, name, path)) {
      places.push_back({entry, fmt::format("{}{}[{}]", path, name, places.size())});
      if (!entry.is_object()) fail(places.back().path, "a record", &entry);
    }
    return places;
  }
  Place record(const Place& place, const char* name) const {
    const Json* found = fieldOf(place.record, name);
    const std::string path = place.path + "." + name;
    if (found == nullptr || !found->is_object()) fail(path, "a record", found);
    return {*found, path};
  }

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
                              source_, place.path, view.bytes, count, elementBytes));
  }
  std::uint64_t componentBytes(const Place& place) const {
    const std::uint64_t type = whole(place, "componentType", 5120, 5126);
    const auto* found = std::ranges::find(kComponentBytes, type, [](auto& p) { return p.first; });
    if (found == kComponentBytes.end())
      fail(place.path + ".componentType", "a type of glTF 2",
           fieldOf(place.record, "componentType"));
    return found->second;
  }
  std::uint64_t components(const Place& place) const {
    const Json* type = fieldOf(place.record, "type");
    for (const auto& [name, count] : kComponents)
      if (type != nullptr && *type == name) return count;
    fail(place.path + ".type", "a type of glTF 2", type);
  }

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
      counts_.push_back(count);
    }
  }

  void checkMeshes() {
    for (const Place& mesh : records(root_, "meshes")) {
      triangles_.push_back(0);
      for (const Place& primitive : records(mesh.record, "primitives", mesh.path + "."))
        triangles_.back() += trianglesOf(primitive);
    }
  }
  std::uint64_t trianglesOf(const Place& primitive) const {
    constexpr std::uint64_t kTriangles = 4, kMostModes = 6;
    const std::uint64_t mode = whole(primitive, "mode", 0, kMostModes, kTriangles);
    const Place attributes = record(primitive, "attributes");
    for (const auto& [name, accessor] : attributes.record.items())
      checkIndex(accessor, attributes.path + "." + name, counts_.size());
    std::optional<std::size_t> corners = maybeIndex(primitive, "indices", counts_.size());
    if (!corners) corners = maybeIndex(attributes, "POSITION", counts_.size());
    if (mode < kTriangles || !corners || !attributes.record.contains("POSITION")) return 0;
    const std::uint64_t count = counts_[*corners];
    if (count < 3) fail(primitive.path, "at least three corners", nullptr);
    return mode == kTriangles ? count / 3 : count - 2;
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
                              source_));
  }
  /// Calls use(node) for these nodes and all below them, a level at a time.
  template <typename Use>
  void goDown(std::vector<std::size_t> level, Use use) const {
    std::vector<std::size_t> below;
    for (std::size_t depth = 0; !level.empty(); ++depth) {
      if (depth >= kDeepest)
        throw Error(Fault::Input, fmt::format("{}: field 'nodes': expected trees of at most {} "
                                              "levels, found deeper ones",
                                              source_, kDeepest));
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
  const std::string& source_;
  std::vector<std::uint64_t> buffers_, counts_;  // bytes; elements of accessors
  std::vector<BufferView> views_;
  std::vector<std::uint64_t> triangles_;  // of meshes
  std::vector<Node> nodes_;
};

}  // namespace

std::uint64_t checkedGltfTriangles(const Json& root, std::uint64_t binaryBytes,
                                   const std::string& source) {
  return GltfChecker(root, binaryBytes, source).triangles();
}

}  // namespace illum
