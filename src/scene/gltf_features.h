// What a glTF file has, and what it asks for that this program does not have.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_check.h"

namespace illum {

struct GltfFeatures {
  /// One sentence for each extension, animation, skin, morph target, camera or light in the file
  /// that is not taken over.
  std::vector<std::string> remarks;
  GltfMeshes meshes;
};

/// Throws Error naming `source` for a file that requires an extension that is not known here, for
/// one that is no glTF 2, and for one whose numbers contradict each other (gltf_check.h). Untrusted
/// input is safe.
GltfFeatures gltfFeatures(std::span<const std::byte> file, const std::string& source);

}  // namespace illum
