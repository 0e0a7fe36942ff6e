// fuzz_seeds FOLDER: writes a small first corpus for every fuzzer, FOLDER/NAME_fuzz/ each.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "capture/capture_file.h"
#include "core/files.h"
#include "encode/encode_tile.h"
#include "encode/raw_archive.h"
#include "encode/sample_object.h"
#include "illum/lighting.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

class Corpus {
 public:
  explicit Corpus(const fs::path& folder) : folder_(folder) { fs::create_directories(folder); }
  void add(std::span<const std::byte> bytes) {
    std::ofstream(folder_ / ("seed" + std::to_string(count_++)), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  void add(const std::string& text) { add(std::as_bytes(std::span(text))); }

 private:
  fs::path folder_;
  int count_ = 0;
};

std::vector<SampleOptions> smallObjects() {
  std::vector<SampleOptions> all;
  for (const auto& [coding, bits] : {std::pair{Coding::Png, 8},
                                     {Coding::Png, 12},
                                     {Coding::Avif, 8},
                                     {Coding::Avif, 10},
                                     {Coding::Jpeg, 8}}) {
    SampleOptions options;
    options.coding = coding;
    options.bits = bits;
    options.size = {12, 9};
    options.poster = false;
    options.mask = bits == 8;
    all.push_back(options);
  }
  SampleOptions views = all.front();
  views.views = {sampleViews()[0], sampleViews()[3], sampleViews()[4]};
  views.bases = 2;
  views.depthSteps = 1000;
  all.push_back(views);
  SampleOptions exact = all.front();
  exact.exact = true;
  exact.bits = 16;
  all.push_back(exact);
  return all;
}

/// As fuzz_object takes entries: the index of the name, the length, the contents.
void appendEntry(std::vector<std::byte>& out, int name, std::span<const std::byte> contents) {
  out.push_back(static_cast<std::byte>(name));
  out.push_back(static_cast<std::byte>(contents.size() & 0xff));
  out.push_back(static_cast<std::byte>(contents.size() >> 8));
  for (const std::byte b : contents) out.push_back(b);
}

int fuzzedName(const std::string& name) {
  if (name == "object.json") return 0;
  if (name == "basis.bin") return 1;
  if (name.starts_with("mask")) return 5;
  if (name.starts_with("depth")) return 8;
  return name.ends_with(".png") ? 2 : name.ends_with(".avif") ? 3 : 4;
}

void addObjects(const fs::path& folder) {
  Corpus objects(folder / "object_fuzz"), manifests(folder / "manifest_fuzz"),
      tables(folder / "basis_table_fuzz"), tiles(folder / "tile_fuzz");
  for (const SampleOptions& options : smallObjects()) {
    std::vector<RawEntry> raw;
    std::vector<std::byte> list;
    for (const auto& [name, bytes] : sampleEntries(options)) {
      raw.push_back(name == "object.json" ? deflatedEntry(name, bytes) : storedEntry(name, bytes));
      appendEntry(list, fuzzedName(name), bytes);
      if (name == "object.json") manifests.add(bytes);
      if (name == "basis.bin") tables.add(bytes);
      if (name.starts_with("planes")) {
        std::vector<std::byte> tile;
        const int coding = options.coding == Coding::Png    ? 0
                           : options.coding == Coding::Avif ? 1
                                                            : 2;
        const int bits = options.bits == 8    ? 0
                         : options.bits == 10 ? 1
                         : options.bits == 12 ? 2
                                              : 3;
        for (const int value : {coding, bits, 11, options.size.width - 1, options.size.height - 1})
          tile.push_back(static_cast<std::byte>(value));
        for (const std::byte b : bytes) tile.push_back(b);
        tiles.add(tile);
      }
    }
    objects.add(rawArchive(raw));
    objects.add(list);
  }
}

void addLightFiles(const fs::path& folder) {
  Corpus corpus(folder / "light_file_fuzz");
  corpus.add("2\na.jpg 0 0 1\nb.jpg 0.6 0 0.8\n");
  corpus.add("# comment\r\nC:\\photos\\my photo.jpg\t0.1\t-0.2\t0.9\r\n\r\nb.png,1,2,3,0.5\r\n");
  corpus.add("\xef\xbb\xbfname;x;y;z;r;g;b\n\"a b.jpg\";0;0;100;1;0.5;2\n// end\n");
  corpus.add("1\na.jpg nan 0 inf\n");
}

void addLightingFiles(const fs::path& folder) {
  Corpus corpus(folder / "lighting_fuzz");
  EnvironmentLight surroundings;
  surroundings.picture = "room.exr";
  const std::vector<Light> lights{DirectionalLight(), PointLight(),  SpotLight{{0, 0, 2}, {}},
                                  RectangleLight(),   SphereLight(), surroundings,
                                  SkyLight()};
  for (const Light& light : lights) corpus.add(textOf(Lighting{{light}}));
  corpus.add(textOf(Lighting{lights}));
}

void addCameras(const fs::path& folder) {
  Corpus corpus(folder / "cameras_fuzz");
  const std::string look =
      R"({"kind":"look","eye":[0,1,4],"target":[0,0,0],"up":[0,1,0],"fieldOfViewDegrees":40})";
  const std::string pose =
      R"("size":{"width":8,"height":6},"objectFromCamera":{"rotation":[1,0,0,0,1,0,0,0,1],)"
      R"("translation":[0,0,4]})";
  const std::string camera = R"({"kind":"camera","camera":{)" + pose +
                             R"(,"focalX":9,"focalY":9,"centre":{"x":4,"y":3}}})";
  const std::string panorama = R"({"kind":"panorama","panorama":{"projection":"cylindrical",)" +
                               pose + R"(,"extent":{"left":-3,"right":3,"bottom":-1,"top":1}}})";
  for (const std::string& text : {look, camera, panorama}) corpus.add(text);
  corpus.add(R"({"path":1,"cameras":[)" + camera + "," + panorama + "]}");
  corpus.add(R"({"path":1,"frames":9,"closed":true,"cameras":[)" + look + "," + look + "]}");
}

void addCameraLists(const fs::path& folder) {
  Corpus transforms(folder / "transforms_fuzz");
  transforms.add(
      R"({"fl_x":100,"cx":41,"cy":29,"w":80,"h":60,"k1":0,"frames":[{"file_path":"./a.jpg",)"
      R"("transform_matrix":[[0,0,1,1],[1,0,0,2],[0,1,0,3],[0,0,0,1]],"pl_pos":[1,2,3]}]})");
  transforms.add(R"({"camera_angle_x":1.2,"frames":[{"file_path":"train/r_0",)"
                 R"("transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,4]]}]})");
  Corpus colmap(folder / "colmap_fuzz");
  colmap.add(
      "# c\n1 PINHOLE 80 60 100 110 41 29\n2 SIMPLE_PINHOLE 8 6 9 4 3\n@\n"
      "1 1 0 0 0 0.5 0 2 1 my photo.jpg\n1 2 3\n2 0 1 0 0 0 0 0 2 b.jpg\n\n");
  colmap.add("1 SIMPLE_RADIAL 80 60 100 41 29 -0.01\n@\n1 1 0 0 0 0 0 0 1 a.jpg\n");
  Corpus proxy(folder / "proxy_fuzz");
  proxy.add("v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nvn 0 0 1\nf 1//1 2//1 3//1 -1\n");
}

void addCaptureFiles(const fs::path& folder) {
  Corpus corpus(folder / "capture_file_fuzz");
  LightSlab slab;
  slab.uCount = 2;
  slab.size = {8, 6};
  PinholeCamera camera;
  camera.size = {8, 6};
  Panorama panorama;
  panorama.size = {16, 8};
  CaptureFile file;
  file.lights = {{"lamp", {Direction(), {1, 1, 1}}, 0}};
  file.views = {{{"left", SlabView{slab, 0, 0}}, "l/{index}.exr", "l/mask.exr", "l/depth.exr"},
                {{"camera", camera}, "c/{light}.exr", "c/mask.exr", "c/depth.exr"},
                {{"around", panorama}, "a/{light}.exr", "a/mask.exr", "a/depth.exr"}};
  corpus.add(textOf(file));
  file.views = {{{"one", OrthographicView{{8, 6}}}, "{light}.jpg", "", ""}};
  corpus.add(textOf(file));
}

/// One FBX record of the form before 7500, which begins at `at`, around others.
std::string fbxRecord(std::size_t at, const std::string& name, const std::string& properties,
                      const std::string& within = "") {
  constexpr std::size_t kHead = 13;
  std::string record;
  const std::size_t bytes = kHead + name.size() + properties.size() + within.size();
  for (const std::size_t value : {at + bytes, std::size_t{1}, properties.size()})
    for (int shift = 0; shift < 32; shift += 8)
      record.push_back(static_cast<char>(value >> shift & 0xff));
  record.push_back(static_cast<char>(name.size()));
  return record + name + properties + within;
}

void addMeshes(const fs::path& folder) {
  Corpus objs(folder / "obj_fuzz");
  objs.add(
      "# c\nmtllib a b.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
      "usemtl m\nf 1/1/1 2//1 \\\n3/1\nf -1 -2 -3\n");
  objs.add("v 0 0 0\r\nf 1 1 99999999999999999999\r\n");
  Corpus fbxs(folder / "fbx_fuzz");
  fbxs.add(
      "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7300\n}\nObjects:  {\n"
      "\tModel: 5, \"Model::a\", \"Null\" {\n\t\tVersion: 232\n\t}\n\tModel: 6, \"Model::b\", "
      "\"Mesh\" {\n\t}\n}\nConnections:  {\n\tC: \"OO\",5,0\n\tC: \"OO\",6,5\n}\n");
  std::string binary("Kaydara FBX Binary  \0\x1a\0\x84\x1c\0\0", 27);
  const std::string model("L\5\0\0\0\0\0\0\0", 9), last(13, '\0');
  constexpr std::size_t kNamed = 13 + 7;  // bytes of a record "Objects" before what is within
  binary += fbxRecord(27, "Objects", "", fbxRecord(27 + kNamed, "Model", model) + last);
  const std::string link =
      std::string("S\2\0\0\0OO", 7) + model + std::string("L", 1) + std::string(8, '\0');
  binary += fbxRecord(binary.size(), "C", link);
  fbxs.add(binary);
}

void addScenes(const fs::path& folder) {
  Corpus scenes(folder / "scene_fuzz");
  scenes.add(R"({"illumScene":1,"meshes":[{"shape":"teapot","material":"clay"},{"file":"a.glb",)"
             R"("place":{"move":[0,1,0],"turn":[0,90,0],"scale":2}}],"materials":{"clay":)"
             R"({"baseColour":[0.5,0.4,0.3],"roughness":0.4,"metallic":0}},"samples":4,)"
             R"("views":[{"slab":{"viewPoints":[3,3],"pixels":[64,48]}}],)"
             R"("lights":{"polar":[20,20],"radiusDegrees":2}})");
  scenes.add(R"({"illumScene":1,"meshes":[{"shape":"box"}],"views":[{"turn":{"slabs":8}},)"
             R"({"camera":{"eye":[0,0,4]}},{"panorama":{"projection":"cylindrical"}}],)"
             R"("lights":{"directions":[[0,0,1],[1,0,1]]},"bounces":2,"seed":7})");
  scenes.add(R"({"illumScene":1,"curves":[{"lines":[[[0,0,0],[0,1,0]]],"radius":[0.01,0]}],)"
             R"("lights":{"fibonacci":9,"sphere":true}})");
  Corpus plys(folder / "ply_fuzz");
  plys.add(
      "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 9 9 9\n4 0 1 2 3\n");
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar uint vertex_index\nend_header\n";
  for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
    binary.append(reinterpret_cast<const char*>(&value), sizeof value);
  binary.append("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  plys.add(binary);
  Corpus hairs(folder / "hair_fuzz");
  hairs.add("# two hairs\n0 0 0\n0,0.5,0.1\n0 1 0.3\n\n1 0 0\r\n1e-3 1 -2.5\n");
  Corpus gltfs(folder / "gltf_fuzz");
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_ior","OWN"],"cameras":[{}],)"
      R"("animations":[{}],"skins":[{}],"meshes":[{"primitives":[{"targets":[{}]}]}]})";
  gltfs.add(gltf);
  gltfs.add(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]})");
  gltfs.add(
      R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"TEXCOORD_0":0},"mode":0}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5121,"normalized":true,"count":3,"type":"VEC2",)"
      R"("sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":6}],)"
      R"("buffers":[{"byteLength":6,"uri":"data:;base64,AQIDBAUG"}]})");
  std::string glb("glTF\2\0\0\0", 8);
  const auto add32 = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      glb.push_back(static_cast<char>(value >> shift & 0xff));
  };
  add32(20 + gltf.size());
  add32(gltf.size());
  gltfs.add(glb + "JSON" + gltf);
}

}  // namespace
}  // namespace illum

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  try {
    illum::addObjects(argv[1]);
    illum::addLightFiles(argv[1]);
    illum::addCaptureFiles(argv[1]);
    illum::addCameraLists(argv[1]);
    illum::addLightingFiles(argv[1]);
    illum::addCameras(argv[1]);
    illum::addScenes(argv[1]);
    illum::addMeshes(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
