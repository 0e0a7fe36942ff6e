// Texture coordinates as bytes and shorts, read through a whole file.
#include "scene/gltf_texcoords.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/data_uri.h"
#include "illum/error.h"
#include "scene/mesh_file.h"
#include "scene/test_files.h"

namespace illum {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kBytes = 5121, kShorts = 5123;
// Top left, top right, bottom: glTF's v goes down.
constexpr std::array<std::uint8_t, 6> kCorners{0, 0, 255, 0, 51, 255};

std::string dataOf(std::span<const std::uint8_t> bytes) {
  return dataUri("application/octet-stream", std::as_bytes(bytes));
}

/// The triangle with texture coordinates in a buffer of their own.
Json gltfWith(int componentType, std::span<const std::uint8_t> bytes, int stride = 0) {
  Json root = Json::parse(triangleGltf());
  root["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", dataOf(bytes)}});
  root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", bytes.size()}});
  if (stride > 0) root["bufferViews"].back()["byteStride"] = stride;
  root["accessors"].push_back({{"bufferView", 2},
                               {"componentType", componentType},
                               {"normalized", true},
                               {"count", 3},
                               {"type", "VEC2"}});
  root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  return root;
}

class GltfTexcoords : public testing::Test {
 protected:
  std::vector<std::array<float, 2>> read(const std::filesystem::path& file) {
    std::vector<std::string> remarks;
    Scene scene = readMeshFile(file, {}, remarks);
    EXPECT_THAT(remarks, ElementsAre());
    return scene.meshes.at(0).texcoords;
  }
  std::vector<std::array<float, 2>> read(const Json& root) {
    return read(folder_.write("a.gltf", root.dump()));
  }
  std::string errorOf(const Json& root) {
    try {
      read(root);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  ScratchFolder folder_;
};

/// v up, as a scene has them.
MATCHER_P(AreCorners, tolerance, "") {
  const std::vector<std::array<float, 2>> expected{{0, 1}, {1, 1}, {0.2F, 0}};
  if (arg.size() != expected.size()) return false;
  for (std::size_t i = 0; i < arg.size(); ++i)
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (std::abs(arg[i][axis] - expected[i][axis]) > tolerance) return false;
  return true;
}

TEST_F(GltfTexcoords, OfBytes) {
  EXPECT_THAT(read(gltfWith(kBytes, kCorners)), AreCorners(1e-6));
}

TEST_F(GltfTexcoords, OfShortsThatAreFarApart) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < 6; i += 2) {
    // 255 as a byte is 65535 as a short, 51 is 13107.
    for (const std::uint8_t value : {kCorners[i], kCorners[i + 1]})
      bytes.insert(bytes.end(), {value, value});
    bytes.insert(bytes.end(), {9, 9, 9, 9});
  }
  EXPECT_THAT(read(gltfWith(kShorts, bytes, 8)), AreCorners(1e-6));
}

TEST_F(GltfTexcoords, OfAFileBeside) {
  Json root = gltfWith(kBytes, kCorners);
  folder_.write("my coordinates.bin", std::as_bytes(std::span(kCorners)));
  root["buffers"][1]["uri"] = "my%20coordinates.bin";
  EXPECT_THAT(read(root), AreCorners(1e-6));
  root["buffers"][1]["byteLength"] = 7;
  EXPECT_THAT(errorOf(root), HasSubstr("field 'buffers[1].byteLength': expected at most the 6"));
}

TEST_F(GltfTexcoords, OfABinaryFile) {
  // The file's own chunk has points and indices, which serve as coordinates here: the shorts of
  // its nine floats 0 0 0 1 0 0 0 1 0, of which 1 is 0x3F800000.
  Json root = Json::parse(triangleGltf());
  root["accessors"].push_back({{"bufferView", 0},
                               {"byteOffset", 12},
                               {"componentType", kShorts},
                               {"normalized", true},
                               {"count", 3},
                               {"type", "VEC2"}});
  root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  // glbOf takes the address out of a text in which it is not the first field.
  std::string text = root.dump();
  const std::string uri = ",\"uri\":\"";
  text.replace(text.find(uri), uri.size(), ", \"uri\": \"");
  const auto found = read(folder_.write("a.glb", glbOf(text)));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FLOAT_EQ(found[0][1], 1 - 16256.0F / 65535);
  EXPECT_EQ(found[0][0], 0);
  EXPECT_EQ(found[1][1], 1);
  EXPECT_EQ(found[2][1], 1);
}

TEST_F(GltfTexcoords, OfWhichSomeAreChanged) {
  Json root = gltfWith(kBytes, kCorners);
  // No bytes of its own: zeros, then the second and third as given.
  Json& accessor = root["accessors"][2];
  accessor.erase("bufferView");
  constexpr std::array<std::uint8_t, 6> kChanges{1, 2, 255, 0, 51, 255};
  root["buffers"][1] = {{"byteLength", kChanges.size()}, {"uri", dataOf(kChanges)}};
  root["bufferViews"][2] = {{"buffer", 1}, {"byteLength", 6}};
  accessor["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", 2}, {"componentType", kBytes}}},
                        {"values", {{"bufferView", 2}, {"byteOffset", 2}}}};
  EXPECT_THAT(read(root), AreCorners(1e-6));
  const auto changes = std::array<std::uint8_t, 6>{1, 3, 255, 0, 51, 255};
  root["buffers"][1]["uri"] = dataOf(changes);
  EXPECT_THAT(errorOf(root), HasSubstr("'accessors[2].sparse': expected numbers of one of 3"));
}

TEST_F(GltfTexcoords, ThatAreNotNormalisedAreRefused) {
  Json root = gltfWith(kBytes, kCorners);
  root["accessors"][2].erase("normalized");
  EXPECT_THAT(errorOf(root), HasSubstr("attributes.TEXCOORD_0"));
  root["accessors"][2]["normalized"] = 1;
  EXPECT_THAT(errorOf(root), HasSubstr("accessors[2].normalized"));
  root = gltfWith(kBytes, kCorners);
  root["buffers"][1]["uri"] = "data:,abcdef";
  EXPECT_THAT(errorOf(root), HasSubstr("buffers[1].uri"));
}

}  // namespace
}  // namespace illum
