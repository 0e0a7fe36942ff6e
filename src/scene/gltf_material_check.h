// The materials and textures of a glTF file, checked before assimp reads it: assimp 5.2 takes the
// default for what is of another type, and any number as it is.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace illum {

/// `root`: the file's tree. `views`: how many buffer views it has. Throws Error (Fault::Input)
/// naming `source` and the field for factors out of the range that glTF 2.0 gives them (section
/// 5.19; KHR_materials_transmission, _ior, _pbrSpecularGlossiness), and for textures, images and
/// samplers that are not there. Untrusted input is safe.
void checkGltfMaterials(const nlohmann::json& root, std::size_t views, const std::string& source);

}  // namespace illum
