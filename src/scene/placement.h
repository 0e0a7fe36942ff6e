// Where the parts of a scene file stand.
#pragma once

#include "scene/scene.h"
#include "scene/scene_description.h"

namespace illum {

/// Normals too; triangles keep facing outward where the scale mirrors.
void place(TriangleMesh& mesh, const PlacementRecord& placement);
/// The three factors of the scale are one, positive; radii grow with it.
void place(CurveSet& curves, const PlacementRecord& placement);

/// Moves the middle of the scene's bounds to the origin and scales its longest side to 2. A scene
/// without extent is only moved.
void normalise(Scene& scene);

}  // namespace illum
