#include "scene/test_files.h"

#include <stdlib.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace illum {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "illum-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a scratch folder");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path ScratchFolder::write(const std::string& name, std::string_view text) const {
  return write(name, std::as_bytes(std::span(text)));
}

std::filesystem::path ScratchFolder::write(const std::string& name,
                                           std::span<const std::byte> bytes) const {
  const std::filesystem::path file = path(name);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::string triangleGltf(const std::string& more, const std::string& primitive,
                         const std::string& node) {
  // Nine floats, and three indices of 16 bits.
  const std::string buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA";
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0)" +
         node + R"(}], "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0},
    "indices": 1)" +
         primitive + R"(}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,)" +
         buffer + R"("}])" + (more.empty() ? "" : ", " + more) + "}";
}

std::vector<std::byte> glbOf(const std::string& gltf) {
  // Without its address the buffer is the file's second chunk.
  std::string json = gltf;
  const std::size_t uri = json.find(", \"uri\": \"");
  json.erase(uri, json.find('"', uri + 10) + 1 - uri);
  while (json.size() % 4 != 0) json += ' ';
  const std::array<float, 9> points{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::array<std::uint16_t, 4> indices{0, 1, 2, 0};
  constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942,
                          kBytes = 44;

  std::vector<std::byte> bytes;
  const auto word = [&](std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::byte>(value >> shift));
  };
  const auto append = [&](auto data) {
    const auto raw = std::as_bytes(data);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  };
  const auto jsonBytes = static_cast<std::uint32_t>(json.size());
  for (const std::uint32_t value : {kMagic, 2U, 12 + 8 + jsonBytes + 8 + kBytes, jsonBytes, kJson})
    word(value);
  append(std::span(json));
  word(kBytes), word(kBinary);
  append(std::span(points));
  append(std::span(indices));
  return bytes;
}

}  // namespace illum
