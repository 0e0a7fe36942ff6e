// A mesh of about the shape of what was photographed, from which views get their depth.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "illum/camera.h"
#include "illum/picture.h"

namespace illum {

struct ProxyMesh {
  std::vector<Vector3> positions;  ///< object frame
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Vertices and faces of a Wavefront OBJ file; faces of more corners are fans, all else is skipped.
/// Untrusted input is safe. Throws Error naming `source` and the line.
ProxyMesh proxyFromObj(std::string_view text, std::string_view source);

/// depthOf (camera.h) the nearest triangle through each pixel's centre, from either side; infinity
/// where there is none.
Picture depthOfProxy(const ProxyMesh& mesh, const ViewGeometry& view);

}  // namespace illum
