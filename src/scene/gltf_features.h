// What a glTF file asks for that this program does not have.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace illum {

/// One sentence for each extension, animation, skin, morph target, camera or light in the file that
/// is not taken over. Throws Error naming `source` for a file that requires an extension that is
/// not known here, and for one that is no glTF 2. Untrusted input is safe.
std::vector<std::string> gltfRemarks(std::span<const std::byte> file, const std::string& source);

}  // namespace illum
