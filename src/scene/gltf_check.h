// The numbers of a glTF file, checked before assimp reads it: assimp 5.2 believes many of them, and
// reads beside its buffers, leaves faces out or never ends where they are wrong.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace illum {

struct GltfMeshes {
  std::uint64_t triangles = 0;   ///< of the scene that is shown, each mesh counted once
  bool packedTexcoords = false;  ///< some are bytes or shorts, see gltf_texcoords.h
};

/// `root`: the file's tree. `binaryBytes`: of a .glb's second chunk, 0 if there is none. Throws
/// Error (Fault::Input) naming `source` and the field unless buffers are the chunk, data or files
/// in the file's folder or below, views lie within buffers, accessors within views, attributes are
/// of one length and of types that can be read, materials as gltf_material_check.h has it, and
/// nodes are trees of bounded depth. Untrusted input is safe.
GltfMeshes checkedGltf(const nlohmann::json& root, std::uint64_t binaryBytes,
                       const std::string& source);

}  // namespace illum
