// Where a ray is taken to end when no depth tells.
#pragma once

#include <optional>
#include <span>

#include "illum/lumigraph.h"
#include "lumigraph/view_projector.h"

namespace illum {

/// The window's plane, in the object frame.
Plane windowOf(const LightSlab& slab);

/// Facing the cameras, through the point to which their axes come nearest. Empty, which means
/// infinity, for parallel axes and for panoramas.
std::optional<Plane> planeLookedAt(std::span<const ViewProjector* const> views);

/// In the middle of slabs' windows; where free cameras' axes come nearest to each other; before a
/// single camera; the view point of panoramas; 0 for a photograph.
Vector3 middleOf(std::span<const View> views);

/// Where the ray meets the plane (empty: far away), only ahead unless `wholeLine`. Not numbers
/// where it does not.
Vector3 onPlane(const Ray& ray, const std::optional<Plane>& plane, bool wholeLine);

}  // namespace illum
