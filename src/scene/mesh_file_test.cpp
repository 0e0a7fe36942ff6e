#include "scene/mesh_file.h"

#include <assimp/postprocess.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cstdlib>

#include "illum/error.h"
#include "illum/picture_io.h"
#include "scene/mesh_check.h"
#include "scene/obj_check.h"
#include "scene/shapes.h"
#include "scene/smooth_normals.h"
#include "scene/teapot.h"
#include "scene/test_files.h"
#include "scene/uri.h"

namespace illum {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr const char* kSquareObj = R"(mtllib square.mtl
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
)";
constexpr const char* kSquareMtl = "newmtl paint\nKd 0.5 0.25 1\nmap_Kd dots.png\n";

constexpr const char* kColouredPly = R"(ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
0 1 0 188 188 188
3 0 1 2
)";

/// A 2 x 2 picture: red and green above, blue and mid grey below.
std::vector<std::byte> dotsPng() {
  BytePicture dots({2, 2}, 3);
  const std::array<std::array<int, 3>, 4> colours{
      {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {188, 188, 188}}};
  for (std::size_t i = 0; i < 12; ++i)
    dots.samples()[i] = static_cast<std::uint8_t>(colours[i / 3][i % 3]);
  return encodePng(dots);
}

std::string errorOf(const std::filesystem::path& file) {
  std::vector<std::string> remarks;
  try {
    readMeshFile(file, {}, remarks);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), HasSubstr(file.filename().string()));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

Scene readWithoutRemarks(const std::filesystem::path& file) {
  std::vector<std::string> remarks;
  Scene scene = readMeshFile(file, {}, remarks);
  EXPECT_THAT(remarks, testing::IsEmpty());
  return scene;
}

void expectSquare(const std::filesystem::path& file) {
  std::vector<std::string> remarks;
  const Scene scene = readMeshFile(file, {}, remarks);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_NEAR(scene.materials.at(static_cast<std::size_t>(scene.meshes[0].material)).baseColour.g,
              0.25, 1e-5);
}

// Binary FBX, as its readers understand it: assimp 5.2 leaves the empty records out that close its
// own, and then refuses what it wrote.

template <class T>
std::string bytesOf(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string fbxString(const std::string& text) {
  return "S" + bytesOf(static_cast<std::uint32_t>(text.size())) + text;
}

template <class T>
std::string fbxNumber(char kind, T value) {
  return kind + bytesOf(value);
}

template <class T>
std::string fbxArray(char kind, const std::vector<T>& values) {
  constexpr std::uint32_t kNotPacked = 0;
  std::string array = kind + bytesOf(static_cast<std::uint32_t>(values.size())) +
                      bytesOf(kNotPacked) +
                      bytesOf(static_cast<std::uint32_t>(values.size() * sizeof(T)));
  for (const T value : values) array += bytesOf(value);
  return array;
}

struct FbxRecord {
  std::string name;
  std::vector<std::string> properties;
  std::vector<FbxRecord> within;
};

void appendFbx(std::string& file, const FbxRecord& record, std::size_t wordBytes) {
  const auto word = [&](std::uint64_t value) { return bytesOf(value).substr(0, wordBytes); };
  const std::size_t start = file.size();
  std::string properties;
  for (const std::string& property : record.properties) properties += property;
  file += word(0) + word(record.properties.size()) + word(properties.size());
  file += static_cast<char>(record.name.size()) + record.name + properties;
  for (const FbxRecord& inner : record.within) appendFbx(file, inner, wordBytes);
  if (!record.within.empty()) file.append(3 * wordBytes + 1, '\0');
  file.replace(start, wordBytes, word(file.size()));
}

/// From version 7500 on words have eight bytes.
std::string binaryFbx(int version, const std::vector<FbxRecord>& records) {
  const std::size_t wordBytes = version >= 7500 ? 8 : 4;
  std::string file = "Kaydara FBX Binary  " + std::string("\0\x1a\0", 3) +
                     bytesOf(static_cast<std::uint32_t>(version));
  for (const FbxRecord& record : records) appendFbx(file, record, wordBytes);
  return file.append(3 * wordBytes + 1, '\0');
}

TEST(MeshFile, ObjWithItsMaterialAndTexture) {
  const ScratchFolder folder;
  folder.write("square.mtl", kSquareMtl);
  folder.write("dots.png", dotsPng());
  const Scene scene = readWithoutRemarks(folder.write("square.obj", kSquareObj));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const TriangleMesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 2u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << "smooth where the file has none";
  for (const auto& n : mesh.normals) EXPECT_NEAR(n[2], 1, 1e-6);
  const Material& paint = scene.materials.at(static_cast<std::size_t>(mesh.material));
  EXPECT_EQ(paint.name, "paint");
  EXPECT_EQ(paint.baseColour, (LinearRgb{0.5F, 0.25F, 1}));
  ASSERT_GE(paint.baseColourTexture, 0);
  const Picture& texels =
      scene.textures.at(static_cast<std::size_t>(paint.baseColourTexture)).texels;
  EXPECT_EQ(texels.at(0, 0, 0), 1) << "row 0 is the top one";
  EXPECT_NEAR(texels.at(1, 1, 0), 0.5, 0.005) << "sRGB 188 is half the light";
  // Texture coordinate (0, 1) is the top left corner of the square.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.texcoords[i][0], mesh.positions[i][0] / 2, 1e-6);
    EXPECT_NEAR(mesh.texcoords[i][1], mesh.positions[i][1] / 2, 1e-6);
  }
}

TEST(MeshFile, MaterialsBeyondTheirRangeAreRemarkedOrRefused) {
  const ScratchFolder folder;
  const auto file = folder.write("square.obj", kSquareObj);
  folder.write("square.mtl", "newmtl paint\nKd 2 0.25 -1\nNi 7\n");
  std::vector<std::string> remarks;
  const Scene scene = readMeshFile(file, {}, remarks);
  EXPECT_THAT(remarks, testing::UnorderedElementsAre(
                           HasSubstr("2 as its base colour; 1 is taken"),
                           HasSubstr("-1 as its base colour; 0 is taken"),
                           HasSubstr("7 as its index of refraction; 1.5 is taken")));
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.meshes[0].material)).baseColour,
            (LinearRgb{1, 0.25F, 0}));
  folder.write("square.mtl", "newmtl paint\nKd nan 0 0\n");
  EXPECT_THAT(errorOf(file), HasSubstr("base colour, found nan"));
}

TEST(MeshFile, TexturesThatAreNotThereAreRemarked) {
  const ScratchFolder folder;
  folder.write("square.mtl", kSquareMtl);
  std::vector<std::string> remarks;
  const Scene scene = readMeshFile(folder.write("square.obj", kSquareObj), {}, remarks);
  EXPECT_THAT(remarks, Contains(HasSubstr("'dots.png', which is not there")));
}

TEST(MeshFile, TexturesThatAreDamagedAreErrors) {
  const ScratchFolder folder;
  folder.write("square.mtl", kSquareMtl);
  std::vector<std::byte> png = dotsPng();
  png.resize(png.size() / 2);
  folder.write("dots.png", png);
  std::vector<std::string> remarks;
  EXPECT_THROW(readMeshFile(folder.write("square.obj", kSquareObj), {}, remarks), Error);
  folder.write("dots.png", "this is text");
  EXPECT_THROW(readMeshFile(folder.path("square.obj"), {}, remarks), Error);
}

TEST(MeshFile, PlyColoursAreDecoded) {
  const ScratchFolder folder;
  const Scene scene = readWithoutRemarks(folder.write("c.ply", kColouredPly));
  ASSERT_EQ(scene.meshes.at(0).colours.size(), 3u);
  EXPECT_NEAR(scene.meshes[0].colours[2].g, 0.5, 0.005);
}

TEST(MeshFile, BinaryPlyOfBothOrders) {
  const ScratchFolder folder;
  for (const bool big : {false, true}) {
    std::string ply = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                      "property float z\nproperty float quality\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n";
    const auto append = [&](auto value) {
      std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
      if (big) std::ranges::reverse(bytes);
      ply += bytes;
    };
    for (const float x :
         {0.F, 0.F, 0.F, 9.F, 1.F, 0.F, 0.F, 9.F, 1.F, 2.F, 0.F, 9.F, 0.F, 2.F, 0.F, 9.F})
      append(x);
    append(std::uint8_t{4});
    for (const std::int32_t index : {0, 1, 2, 3}) append(index);
    std::vector<std::string> remarks;
    const Scene scene = readMeshFile(folder.write("b.ply", ply), {}, remarks);
    EXPECT_EQ(scene.meshes.at(0).triangles.size(), 2u);
    EXPECT_EQ(boundsOf(scene).high, (Vector3{1, 2, 0}));
    EXPECT_THAT(remarks, Contains(HasSubstr("'quality' is not used")));
    for (std::size_t bytes = 0; bytes < ply.size(); ++bytes)
      EXPECT_NE(errorOf(folder.write("b.ply", ply.substr(0, bytes))), "no error") << bytes;
  }
}

TEST(MeshFile, GltfTransformsFlatNormalsAndMaterial) {
  const ScratchFolder folder;
  const std::string gltf = triangleGltf(
      R"("materials": [{"name": "gold", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1],
         "metallicFactor": 1, "roughnessFactor": 0.25}}])",
      R"(, "material": 0)", R"(, "translation": [1, 2, 3], "scale": [2, 2, -2])");
  for (const bool binary : {false, true}) {
    const auto file = binary ? folder.write("t.glb", glbOf(gltf)) : folder.write("t.gltf", gltf);
    const Scene scene = readWithoutRemarks(file);
    ASSERT_EQ(scene.meshes.size(), 1u);
    const TriangleMesh& mesh = scene.meshes[0];
    EXPECT_TRUE(mesh.normals.empty()) << "glTF without normals is flat";
    const Bounds bounds = boundsOf(scene);
    EXPECT_EQ(bounds.low, (Vector3{1, 2, 3}));
    EXPECT_EQ(bounds.high, (Vector3{3, 4, 3}));
    // Mirrored: what was counter-clockwise from +z is now so from -z.
    const auto p = [&](std::size_t i) { return vectorOf(mesh.positions[mesh.triangles[0][i]]); };
    EXPECT_LT(cross(p(1) - p(0), p(2) - p(0)).z, 0);
    const Material& gold = scene.materials.at(static_cast<std::size_t>(mesh.material));
    EXPECT_EQ(gold.baseColour, (LinearRgb{1, 0.5F, 0.25F}));
    EXPECT_EQ(gold.metallic, 1);
    EXPECT_EQ(gold.roughness, 0.25F);
  }
}

TEST(MeshFile, GltfFeaturesThatAreNotTakenOverAreNamed) {
  const ScratchFolder folder;
  std::vector<std::string> remarks;
  const auto file = folder.write(
      "t.gltf", triangleGltf(R"("cameras": [{"type": "perspective", "perspective": {"yfov": 1,
                "znear": 0.1}}], "extensionsUsed": ["KHR_materials_clearcoat"],
                "materials": [{"name": "lamp", "emissiveFactor": [1, 1, 1], "alphaMode": "BLEND"}])",
                             R"(, "material": 0)"));
  readMeshFile(file, {}, remarks);
  EXPECT_THAT(remarks, Contains(HasSubstr("cameras of mesh files")));
  EXPECT_THAT(remarks, Contains(HasSubstr("\"KHR_materials_clearcoat\" is not supported")));
  EXPECT_THAT(remarks, Contains(HasSubstr("'lamp' emits light")));
  EXPECT_THAT(remarks, Contains(HasSubstr("'lamp' blends")));
}

TEST(MeshFile, RequiredExtensionsAndOtherVersionsAreRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(errorOf(folder.write("d.gltf", triangleGltf(R"("extensionsRequired":
                                                  ["KHR_draco_mesh_compression"])"))),
              HasSubstr("KHR_draco_mesh_compression"));
  EXPECT_THAT(errorOf(folder.write("1.gltf", R"({"asset": {"version": "1.0"}})")),
              HasSubstr("expected glTF 2"));
}

TEST(MeshFile, FbxFromAnotherProgramsHand) {
  const ScratchFolder folder;
  folder.write("square.mtl", "newmtl paint\nKd 0.5 0.25 1\n");
  Assimp::Importer importer;
  const aiScene* obj = importer.ReadFile(folder.write("square.obj", kSquareObj).string(), 0);
  ASSERT_NE(obj, nullptr);
  Assimp::Exporter exporter;
  ASSERT_EQ(exporter.Export(obj, "fbxa", folder.path("square.fbx").string()), aiReturn_SUCCESS);
  expectSquare(folder.path("square.fbx"));
}

TEST(MeshFile, BinaryFbxOfBothWordSizes) {
  const ScratchFolder folder;
  const auto objectName = [](const std::string& name, const std::string& kind) {
    return fbxString(name + std::string("\0\1", 2) + kind);
  };
  const FbxRecord geometry{
      "Geometry",
      {fbxNumber('L', std::int64_t{1}), objectName("square", "Geometry"), fbxString("Mesh")},
      {{"Vertices", {fbxArray<double>('d', {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0})}, {}},
       {"PolygonVertexIndex", {fbxArray<std::int32_t>('i', {0, 1, 2, -4})}, {}},
       {"LayerElementMaterial",
        {fbxNumber('I', std::int32_t{0})},
        {{"MappingInformationType", {fbxString("AllSame")}, {}},
         {"ReferenceInformationType", {fbxString("IndexToDirect")}, {}},
         {"Materials", {fbxArray<std::int32_t>('i', {0})}, {}}}},
       {"Layer",
        {fbxNumber('I', std::int32_t{0})},
        {{"LayerElement",
          {},
          {{"Type", {fbxString("LayerElementMaterial")}, {}},
           {"TypedIndex", {fbxNumber('I', std::int32_t{0})}, {}}}}}}}};
  const FbxRecord model{
      "Model",
      {fbxNumber('L', std::int64_t{2}), objectName("square", "Model"), fbxString("Mesh")},
      {{"Version", {fbxNumber('I', std::int32_t{232})}, {}}}};
  const FbxRecord paint{
      "Material",
      {fbxNumber('L', std::int64_t{3}), objectName("paint", "Material"), fbxString("")},
      {{"Properties70",
        {},
        {{"P",
          {fbxString("DiffuseColor"), fbxString("Color"), fbxString(""), fbxString("A"),
           fbxNumber('D', 0.5), fbxNumber('D', 0.25), fbxNumber('D', 1.0)},
          {}}}}}};
  const auto link = [](std::int64_t child, std::int64_t parent) {
    return FbxRecord{"C", {fbxString("OO"), fbxNumber('L', child), fbxNumber('L', parent)}, {}};
  };
  for (const int version : {7400, 7500}) {
    const std::vector<FbxRecord> records{
        {"FBXHeaderExtension",
         {},
         {{"FBXVersion", {fbxNumber('I', static_cast<std::int32_t>(version))}, {}}}},
        {"Objects", {}, {geometry, model, paint}},
        {"Connections", {}, {link(1, 2), link(2, 0), link(3, 2)}}};
    SCOPED_TRACE(version);
    expectSquare(folder.write("square.fbx", binaryFbx(version, records)));
  }
}

TEST(MeshFile, BadFilesAreRefusedInOneSentence) {
  const ScratchFolder folder;
  errorOf(folder.path("missing.obj"));
  EXPECT_NE(errorOf(folder.write("empty.ply", "")), "no error");
  EXPECT_NE(errorOf(folder.write("points.obj", "v 0 0 0\nv 1 0 0\n")), "no error");
  EXPECT_NE(errorOf(folder.write("text.glb", "hello")), "no error");
  EXPECT_NE(errorOf(folder.write("text.fbx", "hello")), "no error");
  EXPECT_THAT(errorOf(folder.write("a.stl", "solid")), HasSubstr("another ending"));
  EXPECT_THAT(errorOf(folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
              HasSubstr("nan"));
}

TEST(MeshFile, IndicesOutOfRangeAreRefused) {
  const ScratchFolder folder;
  std::string gltf = triangleGltf();
  gltf.replace(gltf.find("AAABAAIA"), 8, "AAABAP9/");
  EXPECT_NE(errorOf(folder.write("i.gltf", gltf)), "no error");
  std::string ply = kColouredPly;
  ply.replace(ply.find("3 0 1 2"), 7, "3 0 1 7");
  EXPECT_NE(errorOf(folder.write("i.ply", ply)), "no error");
}

TEST(MeshFile, GltfWhoseNumbersContradictEachOtherIsRefused) {
  const ScratchFolder folder;
  const std::string good = triangleGltf();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string gltf = good;
    EXPECT_NE(gltf.find(from), std::string::npos) << from;
    return errorOf(folder.write("a.gltf", gltf.replace(gltf.find(from), from.size(), to)));
  };
  EXPECT_THAT(with("\"byteOffset\": 36", "\"byteOffset\": 18446744073709551612"),
              HasSubstr("bufferViews[1].byteOffset"));
  EXPECT_THAT(with("\"count\": 3, \"type\": \"VEC3\"", "\"count\": 4, \"type\": \"VEC3\""),
              HasSubstr("accessors[0]"));
  EXPECT_THAT(with("data:application/octet-stream;base64,", "../"), HasSubstr("buffers[0].uri"));
  EXPECT_THAT(with("{\"mesh\": 0", "{\"mesh\": 0, \"children\": [0]"),
              HasSubstr("child of its own"));
}

TEST(MeshFile, LongListsOfGltfTakeTimeInProportion) {
  const ScratchFolder folder;
  std::string nodes;
  for (int i = 0; i < 200000; ++i) nodes += ", {}";
  std::string gltf = triangleGltf();
  const std::string node = R"("nodes": [{"mesh": 0})";
  gltf.insert(gltf.find(node) + node.size(), nodes);
  // With a parser that looks through the list for each of its entries this takes minutes.
  EXPECT_EQ(readWithoutRemarks(folder.write("long.gltf", gltf)).meshes.size(), 1u);
}

TEST(Uri, StaysBelow) {
  for (const char* name : {"a.bin", "a/b.bin", "./a.bin", "a/../b.bin", "a%20b.bin", "..a", "%"})
    EXPECT_TRUE(staysBelow(name)) << name;
  for (const char* name : {"", ".", "..", "/a", "\\a", "../a", "a/../../b", "a/../..", "%2e%2e/a",
                           "..%2fa", "%2fa", "c:a", "http://a/b", "a\nb", "a%00b"})
    EXPECT_FALSE(staysBelow(name)) << name;
  EXPECT_EQ(unescaped("a%20b%2"), "a b%2");
}

TEST(ObjCheck, CountsFromBothEndsAndNamesTheLine) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto lineOf = [](const std::string& text) {
    try {
      checkedObjMaterials(text, "a.obj");
      return std::string("none");
    } catch (const Error& error) {
      return std::string(error.what()).substr(0, 8);
    }
  };
  EXPECT_EQ(lineOf(points + "f 1 2 3\nf -1 -2 -3"), "none");
  EXPECT_EQ(lineOf("f 1 2 3\n" + points), "none") << "points may come later";
  EXPECT_EQ(lineOf(points + "f 1 2 4\nv 1 1 1\nf 1 2 5\n"), "a.obj:6:");
  EXPECT_EQ(lineOf(points + "f -1 -2 -4\n"), "a.obj:4:");
  EXPECT_EQ(lineOf(points + "f 1/1 2 3\n"), "a.obj:4:");
  EXPECT_EQ(lineOf("vn 0 0 1\n" + points + "f 1//1 2//1 3//2\n"), "a.obj:5:");
  EXPECT_THAT(checkedObjMaterials("mtllib  a b.mtl \r\nmtllib c.mtl", "a.obj"),
              testing::ElementsAre("a b.mtl", "c.mtl"));
}

TEST(MeshFile, EveryTruncationIsReadOrRefused) {
  const ScratchFolder folder;
  const std::vector<std::byte> glb = glbOf(triangleGltf());
  const std::string ply = kColouredPly;
  std::vector<std::string> remarks;
  const auto attempt = [&](const std::filesystem::path& file) {
    try {
      readMeshFile(file, {}, remarks);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input) << error.what();
    }
  };
  for (std::size_t bytes = 0; bytes < glb.size(); bytes += 7)
    attempt(folder.write("t.glb", std::span(glb).first(bytes)));
  for (std::size_t bytes = 0; bytes < ply.size(); bytes += 3)
    attempt(folder.write("t.ply", ply.substr(0, bytes)));
}

TEST(MeshFile, SharedTeapotIsOurs) {
  const char* shared = std::getenv("ILLUM_SHARED");
  const std::filesystem::path file =
      std::filesystem::path(shared != nullptr ? shared : ILLUM_SOURCE_DIR "/../shared") /
      "data/geometry/teapot.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Scene theirs = readWithoutRemarks(file), ours;
  ours.meshes = {teapotMesh(16)};
  const Bounds a = boundsOf(theirs), b = boundsOf(ours);
  EXPECT_NEAR((a.high.x - a.low.x) / (b.high.x - b.low.x), 1, 0.01);
  EXPECT_NEAR((a.high.y - a.low.y) / (b.high.y - b.low.y), 1, 0.01);
  EXPECT_NEAR((a.high.z - a.low.z) / (b.high.z - b.low.z), 1, 0.01);
  EXPECT_NEAR(a.high.x, b.high.x, 0.02);
}

TEST(MeshCheck, DegenerateTrianglesAreDroppedWithARemark) {
  TriangleMesh mesh = rectangleMesh(1, 1);
  mesh.name = "m";
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({0.5F, -0.5F, 0});  // on the edge from 0 to 1 when it is 1 long
  mesh.normals.push_back({0, 0, 1});
  mesh.texcoords.push_back({1, 0});
  mesh.triangles.push_back({0, 1, 4});
  std::vector<std::string> remarks;
  checkMesh(mesh, "f.obj", remarks);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_THAT(remarks, Contains("f.obj: mesh 'm': 2 of 4 triangles have no area and are left out"));
}

TEST(MeshCheck, BadNormalsAndTexcoordsAreDroppedBadPointsRefused) {
  std::vector<std::string> remarks;
  TriangleMesh mesh = rectangleMesh(1, 1);
  mesh.normals[1] = {0, 0, 0};
  mesh.texcoords[2][0] = NAN;
  checkMesh(mesh, "f", remarks);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.texcoords.empty());
  EXPECT_EQ(remarks.size(), 2u);
  mesh.positions[0][1] = INFINITY;
  EXPECT_THROW(checkMesh(mesh, "f", remarks), Error);
  TriangleMesh wrong = rectangleMesh(1, 1);
  wrong.triangles[1][2] = 4;
  EXPECT_THROW(checkMesh(wrong, "f", remarks), Error);
  TriangleMesh few = rectangleMesh(1, 1);
  few.colours.resize(3);
  EXPECT_THROW(checkMesh(few, "f", remarks), Error);
}

TEST(SmoothNormals, KeepSharpEdgesAndRoundFlatOnes) {
  TriangleMesh box = boxMesh({1, 1, 1});
  box.normals.clear();
  TriangleMesh round = box;
  addSmoothNormals(box, 1.0);
  EXPECT_EQ(box.positions.size(), 24u) << "right angles stay sharp";
  for (const auto& n : box.normals)
    EXPECT_NEAR(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1, 1e-6);
  addSmoothNormals(round, 2.0);
  for (std::size_t i = 0; i < round.normals.size(); ++i) {
    const Vector3 p = vectorOf(round.positions[i]), n = vectorOf(round.normals[i]);
    EXPECT_NEAR(dot(p, n) / length(p), 1, 1e-6) << "corners point away from the middle";
  }
}

TEST(SmoothNormals, OfASphereAreItsPositions) {
  TriangleMesh sphere = sphereMesh(32);
  sphere.normals.clear();
  std::vector<std::string> remarks;
  checkMesh(sphere, "sphere", remarks);
  addSmoothNormals(sphere, 1.0);
  for (const auto& t : sphere.triangles) {
    for (const std::uint32_t v : t)
      EXPECT_LT(length(vectorOf(sphere.positions[v]) - vectorOf(sphere.normals[v])), 0.01);
  }
}

}  // namespace
}  // namespace illum
