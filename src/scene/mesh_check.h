// What a mesh must be before anybody traces it.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace illum {

/// Makes a mesh of whatever origin safe: drops triangles without area, normals and texture
/// coordinates that are not finite, and says so in `remarks`, one sentence each. Throws Error
/// naming `source` and the mesh for points that are not finite or further than 1e9 from the origin,
/// for indices out of range and for attributes of another number than the points.
void checkMesh(TriangleMesh& mesh, const std::string& source, std::vector<std::string>& remarks);

/// The same of hairs: finite points, radii from 0, at least 4 points a hair.
void checkCurves(const CurveSet& curves, const std::string& source);

}  // namespace illum
