// Triangles of a surface that is given as a signed distance.
#pragma once

#include <functional>

#include "scene/scene.h"

namespace illum {

/// Negative inside. It may overestimate a distance by a quarter, and underestimate it by anything.
using DistanceFunction = std::function<double(Vector3)>;

/// The surface inside `bounds` by surface nets (Gibson 1998, "Constrained Elastic Surface Nets"):
/// one vertex to a cell of the given side that the surface passes, drawn onto the surface, with the
/// field's normal. Closed, faces outward. The surface keeps at least a cell away from the bounds;
/// what leaves them is cut off open.
TriangleMesh isosurface(const DistanceFunction& distance, const Bounds& bounds, double cell);

}  // namespace illum
