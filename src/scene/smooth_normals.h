// Normals for meshes that bring none.
#pragma once

#include "scene/scene.h"

namespace illum {

/// Gives a mesh normals: at every corner the mean of the faces around the same point whose normals
/// are within `angleRadians` of its own, weighted by their angles there (Thuermer and Wuethrich
/// 1998). Vertices are doubled along the edges that stay sharp. The mesh has been checked
/// (mesh_check.h); 0 leaves it flat.
void addSmoothNormals(TriangleMesh& mesh, double angleRadians);

}  // namespace illum
