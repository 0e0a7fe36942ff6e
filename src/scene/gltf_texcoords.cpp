#include "scene/gltf_texcoords.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/data_uri.h"
#include "core/files.h"
#include "illum/error.h"
#include "scene/gltf_container.h"
#include "scene/gltf_forms.h"
#include "scene/json_guard.h"
#include "scene/uri.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uint64_t kMaxBufferBytes = std::uint64_t{4} << 30;

std::size_t numberOf(const Json& record, const char* name) {
  return record.value(name, std::size_t{0});
}

/// Little-endian, as all of glTF.
std::uint32_t wholeAt(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

class TexcoordConverter {
 public:
  TexcoordConverter(Json& root, std::span<const std::byte> binary, const fs::path& path)
      : root_(root), binary_(binary), path_(path) {}

  void convert() {
    for (Json& mesh : root_["meshes"])
      for (Json& primitive : mesh["primitives"])
        for (auto& [name, accessor] : primitive["attributes"].items())
          if (name.starts_with("TEXCOORD")) accessor = converted(accessor.get<std::size_t>());
    root_["buffers"].push_back(
        {{"byteLength", floats_.size() * sizeof(float)},
         {"uri", dataUri("application/octet-stream", std::as_bytes(std::span(floats_)))}});
  }

 private:
  /// The number of an accessor of floats with the same values.
  std::size_t converted(std::size_t accessor) {
    const Json from = root_["accessors"][accessor];
    if (numberOf(from, "componentType") == gltf::kFloat) return accessor;
    if (const auto known = known_.find(accessor); known != known_.end()) return known->second;
    const std::vector<float> values = valuesOf(from, fmt::format("accessors[{}]", accessor));
    Json& views = root_["bufferViews"];
    views.push_back({{"buffer", root_["buffers"].size()},
                     {"byteOffset", floats_.size() * sizeof(float)},
                     {"byteLength", values.size() * sizeof(float)}});
    floats_.insert(floats_.end(), values.begin(), values.end());
    Json& accessors = root_["accessors"];
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", gltf::kFloat},
                         {"count", from["count"]},
                         {"type", "VEC2"}});
    return known_[accessor] = accessors.size() - 1;
  }

  /// Bytes of a view from an accessor's first on, and how far apart elements are.
  struct Elements {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;
  };
  /// `place`: an accessor, or the indices or values of a sparse one.
  Elements elementsOf(const Json& place, std::size_t elementBytes) {
    const Json& view = root_["bufferViews"][numberOf(place, "bufferView")];
    const std::span<const std::byte> buffer = bufferOf(numberOf(view, "buffer"));
    const std::size_t stride = numberOf(view, "byteStride");
    return {buffer.subspan(numberOf(view, "byteOffset"), numberOf(view, "byteLength"))
                .subspan(numberOf(place, "byteOffset")),
            stride > 0 ? stride : elementBytes};
  }
  std::span<const std::byte> bufferOf(std::size_t index) {
    const Json& buffer = root_["buffers"][index];
    const std::size_t expected = numberOf(buffer, "byteLength");
    if (!buffer.contains("uri")) return binary_.first(expected);
    std::vector<std::byte>& bytes = buffers_[index];
    if (bytes.empty()) bytes = bytesOf(buffer["uri"].get<std::string>(), index);
    if (bytes.size() < expected)
      throw Error(Fault::Input,
                  fmt::format("{}: field 'buffers[{}].byteLength': expected at most the {} bytes "
                              "that are there, found {}",
                              path_.string(), index, bytes.size(), expected));
    return bytes;
  }
  std::vector<std::byte> bytesOf(const std::string& uri, std::size_t index) const {
    if (!uri.starts_with("data:")) {
      // As it is spelt, or as it is escaped.
      const fs::path plain = path_.parent_path() / uri;
      std::error_code ignored;
      return readFile(fs::exists(plain, ignored) ? plain : path_.parent_path() / unescaped(uri),
                      kMaxBufferBytes);
    }
    if (std::optional<std::vector<std::byte>> bytes = bytesOfDataUri(uri)) return std::move(*bytes);
    throw Error(Fault::Input,
                fmt::format("{}: field 'buffers[{}].uri': expected data in base64, found other",
                            path_.string(), index));
  }

  /// Pairs of numbers from 0 to 1; of bytes and shorts that are normalised (glTF 2.0, section
  /// 3.6.2.2).
  std::vector<float> valuesOf(const Json& accessor, const std::string& field) {
    const std::size_t size = gltf::bytesOfComponent(numberOf(accessor, "componentType"));
    const auto count = accessor["count"].get<std::size_t>();
    std::vector<float> values(2 * count);
    const auto copy = [&](const Elements& from, std::size_t element, std::size_t to) {
      const float whole = size == 1 ? 255 : 65535;
      for (std::size_t i = 0; i < 2; ++i)
        values[2 * to + i] =
            static_cast<float>(wholeAt(from.bytes, element * from.stride + i * size, size)) / whole;
    };
    if (accessor.contains("bufferView")) {
      const Elements from = elementsOf(accessor, 2 * size);
      for (std::size_t i = 0; i < count; ++i) copy(from, i, i);
    }
    if (!accessor.contains("sparse")) return values;
    const Json& sparse = accessor["sparse"];
    const std::size_t indexSize =
        gltf::bytesOfComponent(numberOf(sparse["indices"], "componentType"));
    const Elements indices = elementsOf(sparse["indices"], indexSize);
    const Elements changed = elementsOf(sparse["values"], 2 * size);
    for (std::size_t i = 0; i < numberOf(sparse, "count"); ++i) {
      const std::uint32_t to = wholeAt(indices.bytes, i * indices.stride, indexSize);
      if (to >= count)
        throw Error(Fault::Input,
                    fmt::format("{}: field '{}.sparse': expected numbers of one of {} elements, "
                                "found {}",
                                path_.string(), field, count, to));
      copy(changed, i, to);
    }
    return values;
  }

  Json& root_;
  std::span<const std::byte> binary_;
  const fs::path& path_;
  std::map<std::size_t, std::vector<std::byte>> buffers_;
  std::map<std::size_t, std::size_t> known_;
  std::vector<float> floats_;
};

}  // namespace

std::vector<std::byte> withFloatTexcoords(std::span<const std::byte> file, const fs::path& path) {
  static_assert(std::endian::native == std::endian::little, "glTF's floats are little-endian");
  const GltfParts parts = gltfParts(file, path.string());
  Json root = guardedJson(parts.json, path.string());
  TexcoordConverter(root, parts.binary, path).convert();
  return withJson(file, parts, root.dump(-1, ' ', true, Json::error_handler_t::replace));
}

}  // namespace illum
