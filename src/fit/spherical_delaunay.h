// Delaunay's triangulation on the sphere: the convex hull of the directions.
#pragma once

#include <span>
#include <vector>

#include "basis/light_mesh.h"
#include "illum/vector.h"

namespace illum {

/// A light nearer to an earlier one than this, in radians, is taken for the same.
inline constexpr double kDistinctRadians = 1e-5;

/// The triangulation of `lights`, which are at least one, at most LightMesh::kMaxLights and all
/// distinct. Where no light is within kGapRadians of some direction, closing directions are added
/// at the middle of the widest empty circles until there is none: the south pole under a dome, both
/// poles of a ring of lights on a great circle. The same lights give the same mesh on every
/// machine.
LightMesh delaunayMesh(std::span<const Direction> lights);
/// Radius of the empty circles that count as a gap: 80 degrees. The four lights of a tetrahedron
/// leave 71 degrees, which interpolation bridges; nearly a hemisphere it does not.
inline constexpr double kGapRadians = 1.3962634015954636;

/// Index of the first of `lights` that is the same as each: itself, or an earlier one.
std::vector<int> firstOfSame(std::span<const Direction> lights);

}  // namespace illum
