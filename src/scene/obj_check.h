// What assimp passes over in an OBJ file without a word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// Throws Error (Fault::Input) naming `source` and the line of a face that names a point, a texture
/// coordinate or a normal that the file does not have. Returns the names of material files
/// ("mtllib"), in their order. Untrusted input is safe.
std::vector<std::string> checkedObjMaterials(std::string_view text, const std::string& source);

}  // namespace illum
