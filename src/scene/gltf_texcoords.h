// Texture coordinates that assimp 5.2 cannot read: of those that are bytes or shorts it copies the
// bytes as if they were floats.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace illum {

/// The glTF file with its texture coordinates as floats, in a buffer of their own. `file`: the
/// bytes of `path`, which gltfFeatures let pass. Reads the buffers beside it. Throws Error
/// (Fault::Input) naming the file for buffers that are shorter than they say and for sparse
/// coordinates of vertices that are not there.
std::vector<std::byte> withFloatTexcoords(std::span<const std::byte> file,
                                          const std::filesystem::path& path);

}  // namespace illum
