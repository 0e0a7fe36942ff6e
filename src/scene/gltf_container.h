// What a .gltf or .glb file is made of.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// Within the bytes of a file.
struct GltfParts {
  std::string_view json;              ///< a .gltf as it is, a .glb's first chunk
  std::span<const std::byte> binary;  ///< a .glb's second chunk; none: empty
};

/// Throws Error naming `source` for a .glb whose chunks contradict its length.
GltfParts gltfParts(std::span<const std::byte> file, const std::string& source);

/// The file with another text for its own. What follows it in a .glb stays.
std::vector<std::byte> withJson(std::span<const std::byte> file, const GltfParts& parts,
                                std::string json);

}  // namespace illum
