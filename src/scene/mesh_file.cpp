#include "scene/mesh_file.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/IOSystem.hpp>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

#include "core/files.h"
#include "illum/error.h"
#include "scene/assimp_material.h"
#include "scene/fbx_check.h"
#include "scene/gltf_features.h"
#include "scene/gltf_texcoords.h"
#include "scene/mesh_check.h"
#include "scene/obj_check.h"
#include "scene/ply_file.h"
#include "scene/smooth_normals.h"
#include "scene/uri.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{4} << 30;
constexpr std::uint64_t kMaxCorners = std::uint64_t{1} << 29;  // of all instances together

std::string endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool isGltf(const fs::path& file) {
  return endingOf(file) == ".gltf" || endingOf(file) == ".glb";
}

// --- files ---

class HeldStream;
using OpenStreams = std::set<HeldStream*>;

using Bytes = std::shared_ptr<const std::vector<std::byte>>;

/// A whole file in memory that assimp reads from.
class HeldStream final : public Assimp::MemoryIOStream {
 public:
  HeldStream(Bytes bytes, std::shared_ptr<OpenStreams> open)
      : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size(), false),
        bytes_(std::move(bytes)),
        open_(std::move(open)) {
    open_->insert(this);
  }
  ~HeldStream() override { open_->erase(this); }

 private:
  Bytes bytes_;
  std::shared_ptr<OpenStreams> open_;
};

/// Opens ordinary files alone, for reading alone, up to a limit. Names may be escaped as in glTF,
/// which assimp does not know. The scene's own file has been read, and checked, already.
class OrdinaryFiles final : public Assimp::IOSystem {
 public:
  OrdinaryFiles(std::string scene, Bytes bytes)
      : scene_(std::move(scene)), bytes_(std::move(bytes)) {}

  bool Exists(const char* name) const override { return !found(name).empty(); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    const std::string file = found(name);
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos || file.empty())
      return nullptr;
    if (file == scene_) return new HeldStream(bytes_, open_);
    return new HeldStream(
        std::make_shared<const std::vector<std::byte>>(readFile(file, kMaxFileBytes)), open_);
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  /// assimp closes some streams, deletes others, and leaves some where it gives up.
  ~OrdinaryFiles() override {
    while (!open_->empty()) delete *open_->begin();
  }

 private:
  std::string scene_;
  Bytes bytes_;
  std::shared_ptr<OpenStreams> open_ = std::make_shared<OpenStreams>();

  /// Empty: there is none.
  static std::string found(const std::string& name) {
    std::error_code ignored;
    for (const std::string& spelling : {name, unescaped(name)})
      if (fs::is_regular_file(spelling, ignored)) return spelling;
    return {};
  }
};

std::string oneLine(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "something that cannot be read" : text.substr(0, 200);
}

const aiScene& import(Assimp::Importer& importer, const fs::path& file, Bytes bytes) {
  // The importer deletes it.
  importer.SetIOHandler(new OrdinaryFiles(file.string(), std::move(bytes)));
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                           aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw inputError(file, "a mesh file", oneLine(importer.GetErrorString()));
  return *scene;
}

// --- meshes ---

std::array<float, 3> floatsOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// Eight-bit colours of scanned points are meant for a screen; glTF says that its own are linear.
LinearRgb colourOf(const aiColor4D& c, bool linear) {
  if (linear) return {c.r, c.g, c.b};
  return {linearFromDisplay(c.r), linearFromDisplay(c.g), linearFromDisplay(c.b)};
}

void addVertices(const aiMesh& from, const aiMatrix4x4& objectFromMesh, bool linearColours,
                 TriangleMesh& mesh) {
  aiMatrix3x3 normals(objectFromMesh);
  normals.Inverse().Transpose();
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    mesh.positions.push_back(floatsOf(objectFromMesh * from.mVertices[i]));
    if (from.HasNormals()) mesh.normals.push_back(floatsOf(normals * from.mNormals[i]));
    if (from.HasTextureCoords(0))
      mesh.texcoords.push_back({from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y});
    if (from.HasVertexColors(0))
      mesh.colours.push_back(colourOf(from.mColors[0][i], linearColours));
  }
}

void addTriangles(const aiMesh& from, bool mirrored, TriangleMesh& mesh) {
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines, named by a remark
    const std::uint32_t a = face.mIndices[0], b = face.mIndices[1], c = face.mIndices[2];
    mesh.triangles.push_back(mirrored ? std::array{a, c, b} : std::array{a, b, c});
  }
}

struct Instance {
  const aiNode* node;
  aiMatrix4x4 objectFromNode;
};

/// Every node of the tree with its place, without recursion.
std::vector<Instance> instancesOf(const aiScene& scene) {
  std::vector<Instance> all{{scene.mRootNode, scene.mRootNode->mTransformation}};
  for (std::size_t next = 0; next < all.size(); ++next) {
    const Instance instance = all[next];
    for (unsigned i = 0; i < instance.node->mNumChildren; ++i) {
      const aiNode* child = instance.node->mChildren[i];
      all.push_back({child, instance.objectFromNode * child->mTransformation});
    }
  }
  return all;
}

void checkSize(const aiScene& scene, const std::vector<Instance>& instances, const fs::path& file) {
  std::uint64_t corners = 0;
  for (const Instance& instance : instances) {
    for (unsigned i = 0; i < instance.node->mNumMeshes; ++i)
      corners += std::uint64_t{3} * scene.mMeshes[instance.node->mMeshes[i]]->mNumFaces;
  }
  if (corners > kMaxCorners)
    throw inputError(file, fmt::format("at most {} triangles", kMaxCorners / 3),
                     fmt::format("{} when all copies are counted", corners / 3));
}

void remarkOn(const aiScene& scene, const fs::path& file, std::vector<std::string>& remarks) {
  const std::string name = file.string();
  if (scene.mNumLights > 0)
    remarks.push_back(fmt::format("{}: lights of mesh files are not used", name));
  if (isGltf(file)) return;  // its own file says the rest more exactly
  if (scene.mNumAnimations > 0)
    remarks.push_back(
        fmt::format("{}: animations are not supported; what stands still is shown", name));
  if (scene.mNumCameras > 0)
    remarks.push_back(fmt::format("{}: cameras of mesh files are not used", name));
  const bool boned = std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                                 [](const aiMesh* mesh) { return mesh->HasBones(); });
  if (boned)
    remarks.push_back(fmt::format("{}: skins are not supported; meshes are shown unposed", name));
}

void remarkOn(const aiMesh& mesh, const fs::path& file, std::vector<std::string>& remarks) {
  if (mesh.GetNumUVChannels() > 1)
    remarks.push_back(
        fmt::format("{}: mesh '{}' has {} sets of texture coordinates; the first is "
                    "used",
                    file.string(), mesh.mName.C_Str(), mesh.GetNumUVChannels()));
  if (mesh.GetNumColorChannels() > 1)
    remarks.push_back(fmt::format("{}: mesh '{}' has {} sets of vertex colours; the first is used",
                                  file.string(), mesh.mName.C_Str(), mesh.GetNumColorChannels()));
}

TriangleMesh meshOf(const aiMesh& from, const Instance& instance, const fs::path& file,
                    double smoothRadians, std::vector<std::string>& remarks) {
  TriangleMesh mesh;
  mesh.name = oneLine(from.mName.length > 0 ? from.mName.C_Str() : instance.node->mName.C_Str());
  mesh.material = static_cast<int>(from.mMaterialIndex);
  addVertices(from, instance.objectFromNode, isGltf(file), mesh);
  addTriangles(from, instance.objectFromNode.Determinant() < 0, mesh);
  checkMesh(mesh, file.string(), remarks);
  if (mesh.normals.empty()) addSmoothNormals(mesh, smoothRadians);
  return mesh;
}

void addMeshes(const aiScene& from, const fs::path& file, double smoothRadians, Scene& scene,
               std::vector<std::string>& remarks) {
  const std::vector<Instance> instances = instancesOf(from);
  checkSize(from, instances, file);
  for (unsigned i = 0; i < from.mNumMeshes; ++i) remarkOn(*from.mMeshes[i], file, remarks);
  for (const Instance& instance : instances) {
    for (unsigned i = 0; i < instance.node->mNumMeshes; ++i) {
      const aiMesh& mesh = *from.mMeshes[instance.node->mMeshes[i]];
      TriangleMesh made = meshOf(mesh, instance, file, smoothRadians, remarks);
      if (!made.triangles.empty()) scene.meshes.push_back(std::move(made));
    }
  }
  if (scene.meshes.empty()) throw inputError(file, "triangles", "none");
}

/// assimp leaves out faces whose corners are not there and says so to nobody.
void checkTriangles(const aiScene& scene, std::uint64_t expected, const fs::path& file) {
  std::uint64_t found = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) found += scene.mMeshes[i]->mNumFaces;
  if (found < expected)
    throw inputError(file, fmt::format("{} triangles between vertices that are there", expected),
                     fmt::format("{} with others", expected - found));
}

void remarkOnMissingMaterials(const std::vector<std::string>& names, const fs::path& file,
                              std::vector<std::string>& remarks) {
  std::error_code ignored;
  fs::path beside = file;  // assimp looks there, too
  if (fs::is_regular_file(beside.replace_extension(".mtl"), ignored)) return;
  for (const std::string& name : names)
    if (!fs::is_regular_file(file.parent_path() / name, ignored))
      remarks.push_back(
          fmt::format("{}: names the materials '{}', which are not there; it is shown without",
                      file.string(), oneLine(name)));
}

/// assimp 5.2 neither ends nor lives on where a PLY file is cut off.
Scene plyScene(const std::vector<std::byte>& bytes, const fs::path& file, double smoothRadians,
               std::vector<std::string>& remarks) {
  TriangleMesh mesh = meshFromPly(bytes, file.string(), remarks);
  checkMesh(mesh, file.string(), remarks);
  if (mesh.triangles.empty()) throw inputError(file, "triangles", "none");
  if (mesh.normals.empty()) addSmoothNormals(mesh, smoothRadians);
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.materials.emplace_back();
  return scene;
}

}  // namespace

bool isMeshFile(const fs::path& file) {
  constexpr std::array<std::string_view, 5> kEndings{".gltf", ".glb", ".obj", ".ply", ".fbx"};
  return std::ranges::find(kEndings, endingOf(file)) != kEndings.end();
}

Scene readMeshFile(const fs::path& file, std::optional<double> smoothDegrees,
                   std::vector<std::string>& remarks) {
  if (!isMeshFile(file))
    throw inputError(file, "a mesh file (.gltf, .glb, .obj, .ply, .fbx)",
                     "a name with another ending");
  std::vector<std::byte> bytes = readFile(file, kMaxFileBytes);
  if (bytes.empty()) throw inputError(file, "a mesh file", "an empty one");
  GltfFeatures features;
  if (isGltf(file)) features = gltfFeatures(bytes, file.string());
  if (features.meshes.packedTexcoords) bytes = withFloatTexcoords(bytes, file);
  std::ranges::move(features.remarks, std::back_inserter(remarks));
  const double degrees = smoothDegrees.value_or(isGltf(file) ? 0 : 60);
  const double smoothRadians = degrees * std::numbers::pi / 180;
  if (endingOf(file) == ".ply") return plyScene(bytes, file, smoothRadians, remarks);
  if (endingOf(file) == ".obj") {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    remarkOnMissingMaterials(checkedObjMaterials(text, file.string()), file, remarks);
  }
  if (endingOf(file) == ".fbx") checkFbx(bytes, file.string());
  Assimp::Importer importer;
  const aiScene& from =
      import(importer, file, std::make_shared<const std::vector<std::byte>>(std::move(bytes)));
  checkTriangles(from, features.meshes.triangles, file);
  Scene scene;
  remarkOn(from, file, remarks);
  addMeshes(from, file, smoothRadians, scene, remarks);
  addMaterials(from, file, scene, remarks);
  return scene;
}

}  // namespace illum
