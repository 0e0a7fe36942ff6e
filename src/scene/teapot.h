// Newell's teapot (M. E. Newell, "The Utilization of Procedure Models in Digital Image Synthesis",
// 1975) from its Bezier patches.
#pragma once

#include <array>
#include <vector>

#include "illum/vector.h"
#include "scene/scene.h"

namespace illum {

/// A bicubic Bezier patch: 4 rows of 4 control points.
struct BezierPatch {
  std::array<std::array<Vector3, 4>, 4> control;
  Vector3 point(double u, double v) const;  ///< u along a row, v from row to row
};

/// The 32 patches as they are passed around: the foot's centre is the origin, y is up, the spout
/// points to +x, 3.15 high, of the proportions that became the custom.
/// Outside is where u right and v up are seen.
std::vector<BezierPatch> teapotPatches();

/// The teapot with `steps` x `steps` pairs of triangles to a patch and smooth normals.
TriangleMesh teapotMesh(int steps);

/// The same about the origin, from -1 to 1 in x, finely divided.
TriangleMesh unitTeapotMesh();

}  // namespace illum
