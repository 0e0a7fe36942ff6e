// PLY, the format of scanners (G. Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace illum {

/// The one mesh of a PLY file: points, normals, colours (screen colours, decoded), texture
/// coordinates, polygons as fans. ASCII and both binary orders. Properties that are not taken over
/// are named in one remark. Throws Error naming `source` for everything that is no whole PLY file
/// of a mesh. Untrusted input is safe.
TriangleMesh meshFromPly(std::span<const std::byte> file, const std::string& source,
                         std::vector<std::string>& remarks);

}  // namespace illum
