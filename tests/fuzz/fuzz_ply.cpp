// A PLY file, and what is repaired of its mesh.
#include <cstdint>
#include <span>

#include "illum/error.h"
#include "scene/mesh_check.h"
#include "scene/ply_file.h"
#include "scene/smooth_normals.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> remarks;
  try {
    illum::TriangleMesh mesh =
        illum::meshFromPly(std::as_bytes(std::span(data, size)), "mesh.ply", remarks);
    illum::checkMesh(mesh, "mesh.ply", remarks);
    if (mesh.normals.empty()) illum::addSmoothNormals(mesh, 1);
  } catch (const illum::Error&) {
  }
  return 0;
}
